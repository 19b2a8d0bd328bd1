//! Pictures of a year: a map of each measure over each grid, and the hours of each sensor.

use super::measures::{Measure, MeasureKind};
use super::report::{AnnualReport, SensorPoints};
use crate::PictureOf;
use crate::number::{brief, count};
use crate::plan::Lights;
use quasilux_drawing::picture::{self, Caption, Cell, GridPicture, YearPicture};
use quasilux_scene::{Sensor, SensorShape};

/// What the scale of a map in percent goes through, so that maps can be compared.
const WHOLE: [Cell; 2] =
    [Cell { value: Some(0.0), half_width: None }, Cell { value: Some(100.0), half_width: None }];

/// A picture of a sensor, a PNG file.
pub struct AnnualMap<'a> {
    /// The sensor.
    pub sensor: &'a Sensor,
    /// What is shown.
    pub measure: Measure,
    /// The file.
    pub png: Vec<u8>,
}

/// Maps of all measures over all grids. Shares are in percent.
pub fn annual_maps<'a>(
    report: &'a AnnualReport<'_>,
    of: PictureOf<'a>,
) -> impl Iterator<Item = AnnualMap<'a>> {
    let lights = Lights::new(of.scene);
    report.sensors().flat_map(move |SensorPoints { sensor, points, .. }| {
        let SensorShape::Grid(grid) = &sensor.shape else { return Vec::new() };
        let map = |measure: Measure| {
            let Unit { name: unit, factor } = Unit::for_measure(measure);
            let times = |x: Option<f64>| x.map(|x| factor * x);
            let cell = |point: &super::PointSummary| {
                let figure = point.measure(measure);
                Cell { value: times(figure.value), half_width: times(figure.half_width) }
            };
            let cells: Vec<Cell> = points.iter().map(cell).collect();
            let values: Vec<f64> = cells.iter().filter_map(|cell| cell.value).collect();
            let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
            let facts = [format!("average {} {unit}", brief(mean, 4))];
            let png = picture::grid(&GridPicture {
                caption: Caption {
                    title: &format!("{}: {}", sensor.name, measure.title(&report.thresholds)),
                    project: of.title,
                    facts: &facts,
                    method: &method(report),
                    caution: caution(report),
                },
                unit,
                origin_m: grid.origin.to_array(),
                u_m: grid.u.to_array(),
                v_m: grid.v.to_array(),
                counts: grid.counts,
                cells: &cells,
                scale_cells: if measure.is_share() { &WHOLE } else { &[] },
                target: (measure == Measure::Autonomy).then_some(50.0),
                surroundings: lights.surroundings(of.scene),
            });
            AnnualMap { sensor, measure, png: png.to_png(1.0) }
        };
        Measure::ALL.map(map).into_iter().collect()
    })
}

/// The mean illuminance of a sensor hour by hour, a PNG file; `None` where days have different
/// numbers of intervals.
#[must_use]
pub fn hours_png(report: &AnnualReport<'_>, sensor: usize, title: &str) -> Option<Vec<u8>> {
    let calendar = report.calendar;
    let a_day = (24.0 / calendar.interval_h).round() as usize;
    let is_whole = !calendar.intervals.is_empty() && calendar.intervals.len().is_multiple_of(a_day);
    if !is_whole {
        return None;
    }
    let months: Vec<u32> = calendar.intervals.chunks(a_day).map(|day| day[0].month).collect();
    let hours = calendar.intervals.iter().zip(&report.mean_lx[sensor]);
    let values: Vec<Option<f64>> = hours.map(|(it, lx)| it.is_known.then_some(*lx)).collect();
    let name = &report.scene.sensors[sensor].name;
    let facts = [format!("average of {} points", count(report.scene.sensors[sensor].len() as u64))];
    let drawing = picture::year(&YearPicture {
        caption: Caption {
            title: &format!("{name}: hours of a year, {}", report.place),
            project: title,
            facts: &facts,
            method: &method(report),
            caution: caution(report),
        },
        unit: "lx",
        a_day,
        values: &values,
        months: &months,
    });
    Some(drawing.to_png(1.0))
}

/// What a measure is drawn in, and what its values are multiplied with.
struct Unit {
    name: &'static str,
    factor: f64,
}

impl Unit {
    fn for_measure(measure: Measure) -> Self {
        let (name, factor) = match measure.kind() {
            MeasureKind::SunlitHours => ("h", 1.0),
            MeasureKind::Exposure => ("klx h", 1e-3),
            MeasureKind::Median => ("lx", 1.0),
            MeasureKind::ShareOfHours | MeasureKind::ShareInPart => ("%", 100.0),
        };
        Self { name, factor }
    }
}

fn method(report: &AnnualReport<'_>) -> String {
    let run = &report.run;
    format!(
        "quasilux {}: {} intervals, {}, {} replicates, {} % intervals",
        run.version,
        count(report.calendar.intervals.len() as u64),
        run.settings.sequence.name(),
        run.settings.effective_replicates(),
        brief(100.0 * run.settings.confidence, 4),
    )
}

fn caution(report: &AnnualReport<'_>) -> &'static str {
    if report.is_done() { "" } else { "stopped before the wanted tolerance was reached" }
}
