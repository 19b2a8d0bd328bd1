//! One sensor as comma-separated values: a header with units, then one line a point.
//!
//! Fields are numbers, so none needs the quoting of RFC 4180; lines end in LF; a missing number is
//! an empty field, as are `unseen_lx` and `merged_lx` of estimators without a bound. Where only the
//! sky shines, columns of the daylight factor and of its parts follow, shares, each with its
//! half-width.

use crate::number::exact;
use crate::outside::DaylightColumn;
use crate::{DaylightFactor, SensorReport};
use std::fmt::Write;

const COLUMNS: &str =
    "x_m,y_m,z_m,nx,ny,nz,illuminance_lx,half_width_lx,direct_lx,unseen_lx,merged_lx";

/// The points of a sensor as CSV; the lines of a grid begin with the indices `i` along u and `j`
/// along v, `i` running fastest.
#[must_use]
pub fn csv(sensor: &SensorReport) -> String {
    let mut text = String::new();
    if sensor.grid.is_some() {
        text.push_str("i,j,");
    }
    text.push_str(COLUMNS);
    let daylight = sensor.points.iter().find_map(|point| point.daylight_factor);
    for DaylightColumn { name, .. } in daylight.iter().flat_map(DaylightFactor::columns) {
        write!(text, ",{name},{name}_half_width").expect("strings grow");
    }
    text.push('\n');
    for (index, point) in sensor.points.iter().enumerate() {
        if let Some(grid) = &sensor.grid {
            let columns = grid.counts[0] as usize;
            write!(text, "{},{},", index % columns, index / columns).expect("strings grow");
        }
        let place = point.position_m.to_array().into_iter().chain(point.normal.to_array());
        let light = [
            point.illuminance_lx.value,
            point.illuminance_lx.half_width,
            point.direct_lx,
            point.unseen.bound_lx,
            point.unseen.merged_lx,
        ];
        let daylight = point.daylight_factor.iter().flat_map(DaylightFactor::columns);
        let daylight = daylight.flat_map(|it| [it.figure.value, it.figure.half_width]);
        let light = light.into_iter().chain(daylight);
        let fields: Vec<String> =
            place.map(exact).chain(light.map(|x| x.map(exact).unwrap_or_default())).collect();
        text.push_str(&fields.join(","));
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{DaylightFactorComponents, Figure, example};

    #[test]
    fn grids_have_indices_and_every_number_reads_back() {
        let report = example::office();
        let sensor = &report.sensors[0];
        let text = csv(sensor);
        let mut lines = text.lines();
        assert_eq!(lines.next(), Some(format!("i,j,{COLUMNS}").as_str()));
        let number = |field: &str| match field {
            "" => f64::NAN,
            _ => field.parse().expect("a number"),
        };
        let rows: Vec<Vec<f64>> = lines.map(|l| l.split(',').map(number).collect()).collect();
        assert_eq!(rows.len(), sensor.points.len());
        assert_eq!(rows[25][..2], [1.0, 1.0]);
        for (row, point) in rows.iter().zip(&sensor.points) {
            assert_eq!(row[2..5], point.position_m.to_array());
            assert_eq!(Some(row[8]), point.illuminance_lx.value);
            assert_eq!(Some(row[9]), point.illuminance_lx.half_width);
            assert_eq!(Some(row[10]), point.direct_lx);
        }
        assert!(text.ends_with('\n') && !text.contains('\r'));
    }

    #[test]
    fn what_samples_leave_open_has_columns() {
        let text = csv(&example::with_unseen().sensors[0]);
        let ends: Vec<&str> = text
            .lines()
            .skip(1)
            .filter_map(|line| line.split_once(",80.0,"))
            .map(|at| at.1)
            .collect();
        assert_eq!(ends, ["2.0,0.5"], "{text}");
        assert!(text.ends_with(",0.0,0.02,0.0\n"), "{text}");
    }

    #[test]
    fn daylight_factors_follow() {
        let mut report = example::without_intervals();
        let figure = |value| Figure { value: Some(value), half_width: None };
        let [sky, externally_reflected, internally_reflected] = [0.25, 0.125, 0.5].map(figure);
        let unseen = 0.0;
        let parts =
            DaylightFactorComponents { sky, externally_reflected, internally_reflected, unseen };
        report.sensors[0].points[0].daylight_factor =
            Some(DaylightFactor { total: figure(0.875), components: Some(parts) });
        let text = csv(&report.sensors[0]);
        let [head, line] = [0, 1].map(|n| text.lines().nth(n).unwrap());
        assert!(head.ends_with(
            ",direct_lx,unseen_lx,merged_lx,daylight_factor,daylight_factor_half_width,\
             sky_component,sky_component_half_width,externally_reflected_component,\
             externally_reflected_component_half_width,internally_reflected_component,\
             internally_reflected_component_half_width"
        ));
        assert!(line.ends_with(",80.0,,,0.875,,0.25,,0.125,,0.5,"), "{line}");
    }

    #[test]
    fn single_points_have_no_indices_and_missing_numbers_are_empty() {
        let report = example::without_intervals();
        let text = csv(&report.sensors[0]);
        assert_eq!(text, format!("{COLUMNS}\n0.0,0.0,0.5,0.0,0.0,1.0,100.0,,80.0,,\n"));
    }
}
