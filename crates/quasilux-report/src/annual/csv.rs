//! Spreadsheets of a year: the points of a sensor, and the hours.

use super::measures::Measure;
use super::report::{AnnualReport, SensorPoints};
use super::sun_hours::SunHours;
use crate::number::exact;

/// The points of a sensor, a line each: where they are, each measure with its half-width, the
/// occupied hours with and without enough light, and how long the sun shines there.
#[must_use]
pub fn annual_csv(of: SensorPoints<'_>) -> String {
    let SensorPoints { sensor, points, sun_hours, .. } = of;
    let mut columns: Vec<String> =
        ["x_m", "y_m", "z_m", "nx", "ny", "nz"].map(str::to_owned).to_vec();
    for measure in Measure::ALL {
        columns.extend([measure.name().to_owned(), format!("{}_half_width", measure.name())]);
    }
    let counts = ["hours_surely_above", "hours_surely_below", "hours_undecided", "samples"];
    columns.extend(counts.map(str::to_owned));
    let of_sun = SunHours::NAMES.iter().filter(|_| !sun_hours.is_empty());
    columns.extend(of_sun.map(|name| (*name).to_owned()));
    let mut text = columns.join(",") + "\n";
    for (number, (place, point)) in sensor.points().iter().zip(points).enumerate() {
        let place = place.position.to_array().into_iter().chain(place.normal.to_array());
        let mut fields: Vec<String> = place.map(exact).collect();
        let figures = point.measures.iter().flat_map(|it| [it.value, it.half_width]);
        fields.extend(figures.map(|x| x.map(exact).unwrap_or_default()));
        let hours = point.hours;
        fields.extend([hours.above, hours.below, hours.undecided].map(|hours| hours.to_string()));
        fields.push(point.samples.to_string());
        fields.extend(sun_hours.get(number).into_iter().flat_map(SunHours::values).map(exact));
        text += &(fields.join(",") + "\n");
    }
    text
}

/// The intervals of the year, a line each: when, where the sun is, what is outside, and the mean
/// illuminance of each sensor. What is not known is left out.
#[must_use]
pub fn hours_csv(report: &AnnualReport<'_>) -> String {
    let names =
        report.scene.sensors.iter().map(|sensor| format!("{}_mean_lx", quoted(&sensor.name)));
    let groups = report.blinds.as_ref().map_or(&[][..], |blinds| &blinds.groups);
    let blinds = match groups {
        [] | [_] => vec!["blinds_closed".to_owned()],
        all => all.iter().map(|group| format!("{}_position", quoted(&group.name))).collect(),
    };
    let columns = [
        "month",
        "day",
        "middle_h",
        "occupied",
        "sun_altitude_deg",
        "sun_azimuth_deg",
        "sky_horizontal_lx",
        "sun_normal_lx",
    ];
    let columns = columns.map(str::to_owned).into_iter().chain(blinds).chain(names);
    let columns: Vec<String> = columns.collect();
    let mut text = columns.join(",") + "\n";
    for (number, interval) in report.calendar.intervals.iter().enumerate() {
        let sky = interval.sky.map(|sky| &report.calendar.skies[sky]);
        let outside = [
            sky.map(|it| it.sun.altitude_deg),
            sky.map(|it| it.sun.azimuth_deg),
            sky.map(|it| it.sky.horizontal_illuminance_lx()),
            sky.map(|it| it.sun_normal_illuminance_lx),
        ];
        let position = |number: usize| {
            let group = groups.get(number);
            let of = |sky: usize| group.map_or(0, |group| group.by_hour[sky]);
            interval.sky.map(|sky| of(sky).to_string()).unwrap_or_default()
        };
        let inside = report.mean_lx.iter().map(|lx| interval.is_known.then_some(lx[number]));
        let mut fields = vec![
            interval.month.to_string(),
            interval.day.to_string(),
            exact(interval.middle_h),
            u8::from(interval.is_occupied).to_string(),
        ];
        fields.extend(outside.map(|x| x.map(exact).unwrap_or_default()));
        fields.extend((0..groups.len().max(1)).map(position));
        fields.extend(inside.map(|x| x.map(exact).unwrap_or_default()));
        text += &(fields.join(",") + "\n");
    }
    text
}

/// A name within the quotes of RFC 4180, if it needs them.
fn quoted(name: &str) -> String {
    if name.contains([',', '"', '\n']) {
        name.replace([',', '"', '\n'], "_")
    } else {
        name.to_owned()
    }
}
