//! The results of a year for a terminal.

use super::blinds::GroupOfYear;
use super::calendar::Calendar;
use super::dimming::Dimming;
use super::measures::Measure;
use super::point::PointSummary;
use super::report::{AnnualReport, SensorPoints};
use super::sensor::{DaylightLevel, SensorOfYear, ShareOfPoints};
use crate::number::{count, figure_text};
use quasilux_scene::{Occupancy, OccupiedDays, Thresholds};
use std::fmt::Write;

/// Names of the levels of EN 17037.
const LEVELS: [&str; 4] = ["none", "minimum", "medium", "high"];

/// The table.
#[must_use]
pub fn annual_table(report: &AnnualReport<'_>) -> String {
    let calendar = report.calendar;
    let mut text = format!(
        "{}: {} intervals of {} h, {} of them occupied ({})",
        report.place,
        count(calendar.intervals.len() as u64),
        calendar.interval_h,
        count(calendar.count(|it| it.is_occupied) as u64),
        occupied(&report.occupancy),
    );
    let unknown = calendar.count(|it| !it.is_known);
    if unknown > 0 {
        write!(text, ", {} unknown and left out", count(unknown as u64)).expect("strings grow");
    }
    for group in report.blinds.iter().flat_map(|blinds| &blinds.groups) {
        write_group(&mut text, group, calendar);
    }
    text.push_str("\n\n");
    for (SensorPoints { sensor, points, .. }, summary) in report.sensors().zip(report.summaries()) {
        write_sensor(&mut text, &sensor.name, points, &summary, &report.thresholds);
    }
    for dimming in &report.dimmings {
        write_electric_light(&mut text, report, dimming);
    }
    let worst = report.points.iter().filter_map(|point| point.relative_half_width);
    let known = match worst.fold(0.0, f64::max) {
        worst if worst.is_finite() => format!("{:.2} % or better", 100.0 * worst),
        _ => "no better than zero where no path found light".to_owned(),
    };
    let reached = if report.is_done() { "" } else { " (not all within the tolerance)" };
    writeln!(
        text,
        "hours known to {known} (rms of half-widths at {:.0} %), {} replicates{reached}; \
         {} rays, {:.1} s",
        100.0 * report.run.settings.confidence,
        report.run.settings.effective_replicates(),
        count(report.run.work.rays),
        report.run.seconds,
    )
    .expect("strings grow");
    for warning in &report.run.warnings {
        writeln!(text, "warning: {warning}").expect("strings grow");
    }
    text
}

/// When people are there.
fn occupied(occupancy: &Occupancy) -> String {
    match occupancy {
        Occupancy::Schedule { .. } => "by schedule".to_owned(),
        Occupancy::Hours { hours, days } => {
            let days = match days {
                OccupiedDays::All => "",
                OccupiedDays::Weekdays { .. } => ", Monday to Friday",
            };
            format!("{} to {} h{days}", hours.start, hours.end)
        }
    }
}

/// Where blinds are in the occupied intervals.
fn write_group(text: &mut String, group: &GroupOfYear, calendar: &Calendar) {
    write!(text, "; {}", group.name).expect("strings grow");
    for (number, name) in group.positions.iter().enumerate().skip(1) {
        let intervals = group.count(number, calendar, |interval| interval.is_occupied);
        let comma = if number == 1 { "" } else { "," };
        let intervals = count(intervals as u64);
        write!(text, "{comma} {name} in {intervals} of the occupied").expect("strings grow");
    }
}

fn write_electric_light(text: &mut String, report: &AnnualReport<'_>, dimming: &Dimming) {
    let energy = dimming.energy(report.calendar);
    let dimmed = figure_text(energy.dimmed_kwh).joined();
    let light = &dimming.light;
    writeln!(
        text,
        "{}: {dimmed} kWh a year, dimmed by the daylight of {} to {} lx; {:.0} kWh at \
         full power\n",
        light.name.replace('_', " "),
        report.scene.sensors[light.sensor].name,
        light.target_lx,
        energy.full_kwh,
    )
    .expect("strings grow");
}

fn write_sensor(
    text: &mut String,
    name: &str,
    points: &[PointSummary],
    summary: &SensorOfYear,
    thresholds: &Thresholds,
) {
    let &Thresholds { enough_lx, useful_lx: [least_lx, most_lx], sunlight_lx } = thresholds;
    let mean = |measure: Measure| {
        let values = points.iter().filter_map(|point| point.measure(measure).value);
        values.sum::<f64>() / points.len().max(1) as f64
    };
    let percent = |measure| format!("{:.1} %", 100.0 * mean(measure));
    let useful = format!(
        "{} below {least_lx} lx, {} to {enough_lx} lx, {} to {most_lx} lx, {} above",
        percent(Measure::TooLittle),
        percent(Measure::Supplementary),
        percent(Measure::Autonomous),
        percent(Measure::TooMuch),
    );
    let lines = [
        (format!("sDA ({enough_lx} lx, 50 %)"), share_text(summary.autonomy)),
        (format!("ASE ({sunlight_lx} lx, 250 h)"), share_text(summary.sunlight)),
        ("EN 17037".to_owned(), level_text(summary)),
        ("mean DA".to_owned(), percent(Measure::Autonomy)),
        ("mean cDA".to_owned(), percent(Measure::ContinuousAutonomy)),
        ("mean UDI".to_owned(), useful),
        ("mean exposure".to_owned(), format!("{:.0} klx h a year", 1e-3 * mean(Measure::Exposure))),
    ];
    writeln!(text, "{name} ({} points)", count(points.len() as u64)).expect("strings grow");
    for (what, value) in lines {
        writeln!(text, "  {what:<22}{value}").expect("strings grow");
    }
    text.push('\n');
}

fn share_text(share: ShareOfPoints) -> String {
    let ShareOfPoints { value, low, high } = share;
    let percent = |share: f64| 100.0 * share;
    format!("{:.1} % of points ({:.1} to {:.1} %)", percent(value), percent(low), percent(high))
}

fn level_text(summary: &SensorOfYear) -> String {
    let name = |level: u8| LEVELS[usize::from(level).min(LEVELS.len() - 1)];
    let Some(DaylightLevel { level, bounds: [low, high] }) = summary.en17037 else {
        return "no level: the weather file is not of a year".to_owned();
    };
    let bounds =
        if low == high { "surely".to_owned() } else { format!("{} to {}", name(low), name(high)) };
    format!("level {} ({bounds})", name(level))
}
