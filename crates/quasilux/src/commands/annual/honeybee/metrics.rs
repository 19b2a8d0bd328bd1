//! Measures of the project's own year, a file for each grid with a percentage a line.

use super::documents::grids;
use crate::exit::CliError;
use crate::results::{cannot_write, write_atomic};
use quasilux_report::annual::{Measure, PointSummary};
use quasilux_scene::Sensor;
use std::fs;
use std::path::Path;

/// A measure as Honeybee names it.
struct Metric {
    folder: &'static str,
    ending: &'static str,
    /// Its value is the sum of these shares of the occupied hours.
    measures: &'static [Measure],
}

const METRICS: [Metric; 5] = [
    Metric { folder: "da", ending: "da", measures: &[Measure::Autonomy] },
    Metric { folder: "cda", ending: "cda", measures: &[Measure::ContinuousAutonomy] },
    Metric {
        folder: "udi",
        ending: "udi",
        measures: &[Measure::Supplementary, Measure::Autonomous],
    },
    Metric { folder: "udi_lower", ending: "udi", measures: &[Measure::TooLittle] },
    Metric { folder: "udi_upper", ending: "udi", measures: &[Measure::TooMuch] },
];

/// The measures of points, as they come.
pub(super) struct Metrics<'s> {
    sensors: &'s [Sensor],
    /// In percent, in the order of [`METRICS`].
    points: Vec<[f64; METRICS.len()]>,
}

impl<'s> Metrics<'s> {
    pub(super) fn new(sensors: &'s [Sensor]) -> Self {
        Self { sensors, points: Vec::new() }
    }

    pub(super) fn take(&mut self, point: &PointSummary) {
        let share = |measure: &Measure| point.measure(*measure).value.unwrap_or(f64::NAN);
        let percent = |metric: Metric| 100.0 * metric.measures.iter().map(share).sum::<f64>();
        self.points.push(METRICS.map(percent));
    }

    pub(super) fn write(&self, folder: &Path) -> Result<(), CliError> {
        for (column, Metric { folder: name, ending, .. }) in METRICS.iter().enumerate() {
            let folder = folder.join(name);
            fs::create_dir_all(&folder).map_err(|error| cannot_write(&folder, &error))?;
            let mut points = self.points.iter();
            for sensor in self.sensors {
                let own = points.by_ref().take(sensor.len());
                let text: String = own.map(|point| format!("{:.2}\n", point[column])).collect();
                let file = folder.join(format!("{}.{ending}", sensor.name));
                write_atomic(&file, text.as_bytes())?;
            }
            let info = format!("{:#}\n", grids(self.sensors, &[]));
            write_atomic(&folder.join("grids_info.json"), info.as_bytes())?;
        }
        Ok(())
    }
}
