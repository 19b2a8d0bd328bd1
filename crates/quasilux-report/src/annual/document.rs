//! The document of a year, format "quasilux-annual/1".
//!
//! `hours` counts the intervals of the weather file; shares of hours are of the occupied ones. Each
//! measure of a point has its half-width beside it. Of the shares of points `low` counts the points
//! whose interval is on the right side of the threshold as a whole, `high` those whose interval
//! reaches there.

use super::blinds::{BlindsOfYear, GroupOfYear};
use super::calendar::Calendar;
use super::dimming::{Dimming, EnergyOfYear};
use super::measures::Measure;
use super::point::PointSummary;
use super::report::{AnnualReport, AnnualRun, SensorPoints};
use super::sensor::{SensorOfYear, ShareOfPoints};
use super::sun_hours::SunHours;
use crate::json::text;
use quasilux_scene::{Occupancy, OccupiedDays};
use serde::Serialize;
use serde_json::{Map, Value, json};

/// Name and version of the format.
const FORMAT: &str = "quasilux-annual/1";

#[derive(Serialize)]
struct Document<'a> {
    format: &'static str,
    complete: bool,
    tolerance_reached: bool,
    site: Value,
    hours: Value,
    #[serde(skip_serializing_if = "Option::is_none")]
    blinds: Option<Value>,
    #[serde(skip_serializing_if = "Option::is_none")]
    electric_light: Option<Value>,
    thresholds: Value,
    sensors: Vec<SensorEntry<'a>>,
    run: Value,
    warnings: &'a [String],
}

#[derive(Serialize)]
struct SensorEntry<'a> {
    name: &'a str,
    points: Vec<Map<String, Value>>,
    summary: Value,
}

/// The document, a line a sensor point.
#[must_use]
pub fn annual_json(report: &AnnualReport<'_>) -> String {
    let run = &report.run;
    let calendar = report.calendar;
    let sensors = report.sensors().zip(report.summaries()).map(|(of, summary)| {
        let SensorPoints { sensor, points, sun_hours, .. } = of;
        let places = sensor.points();
        let points = places.iter().zip(points).enumerate().map(|(number, (place, point))| {
            let mut entry = Map::new();
            entry.insert("position".to_owned(), json!(place.position.to_array()));
            entry.insert("normal".to_owned(), json!(place.normal.to_array()));
            fill(&mut entry, point);
            for (name, hours) in
                SunHours::NAMES.iter().zip(sun_hours.get(number).iter().flat_map(|it| it.values()))
            {
                entry.insert((*name).to_owned(), json!(hours));
            }
            entry
        });
        SensorEntry { name: &sensor.name, points: points.collect(), summary: summary_of(&summary) }
    });
    text(&Document {
        format: FORMAT,
        complete: run.work.is_complete,
        tolerance_reached: report.is_done(),
        site: json!({
            "place": report.place,
            "latitude_deg": report.site.latitude_deg(),
            "longitude_deg": report.site.longitude_deg(),
            "time_zone_h": report.site.time_zone_h(),
        }),
        hours: hours_entry(report),
        blinds: report.blinds.as_ref().map(|blinds| blinds_entry(blinds, calendar)),
        electric_light: electric_light(report),
        thresholds: json!({
            "enough_lx": report.thresholds.enough_lx,
            "useful_lx": report.thresholds.useful_lx,
            "sunlight_lx": report.thresholds.sunlight_lx,
        }),
        sensors: sensors.collect(),
        run: run_entry(run),
        warnings: &run.warnings,
    })
}

/// Which intervals count for what.
fn hours_entry(report: &AnnualReport<'_>) -> Value {
    let calendar = report.calendar;
    let (occupied_h, occupied_days) = match &report.occupancy {
        Occupancy::Schedule { .. } => (None, "schedule"),
        Occupancy::Hours { hours, days } => (
            Some([hours.start, hours.end]),
            match days {
                OccupiedDays::All => "all",
                OccupiedDays::Weekdays { .. } => "weekdays",
            },
        ),
    };
    json!({
        "intervals": calendar.intervals.len(),
        "interval_h": calendar.interval_h,
        "unknown": calendar.count(|it| !it.is_known),
        "lit": calendar.skies.len(),
        "occupied": calendar.count(|it| it.is_occupied),
        "daylit": calendar.count(|it| it.is_daylit),
        "occupied_h": occupied_h,
        "occupied_days": occupied_days,
    })
}

/// Blinds: in how many intervals with light some are closed, and where each of several groups is.
fn blinds_entry(blinds: &BlindsOfYear, calendar: &Calendar) -> Value {
    let mut entry = json!({
        "closed": blinds.closed(calendar, |_| true),
        "closed_occupied": blinds.closed(calendar, |interval| interval.is_occupied),
    });
    let group = |group: &GroupOfYear| {
        let position = |(number, name): (usize, &String)| {
            json!({
                "name": name,
                "intervals": group.count(number, calendar, |_| true),
                "occupied": group.count(number, calendar, |interval| interval.is_occupied),
            })
        };
        let positions: Vec<Value> = group.positions.iter().enumerate().map(position).collect();
        json!({ "name": group.name, "positions": positions })
    };
    entry["groups"] = blinds.groups.iter().map(group).collect();
    entry
}

/// Electric light and its energy: of the one zone, or of all of them, and of each.
fn electric_light(report: &AnnualReport<'_>) -> Option<Value> {
    let zone = |dimming: &Dimming| {
        let light = &dimming.light;
        let energy = dimming.energy(report.calendar);
        json!({
            "name": light.name,
            "sensor": report.scene.sensors[light.sensor].name,
            "target_lx": light.target_lx,
            "power_w": light.power_w,
            "min_power_w": light.min_power_w,
            "energy_kwh": energy.dimmed_kwh.value,
            "energy_kwh_half_width": energy.dimmed_kwh.half_width,
            "full_power_kwh": energy.full_kwh,
        })
    };
    match report.dimmings.as_slice() {
        [] => None,
        [alone] => Some(zone(alone)),
        all => {
            let EnergyOfYear { dimmed_kwh, full_kwh } = EnergyOfYear::of_all(all, report.calendar);
            let zones: Vec<Value> = all.iter().map(zone).collect();
            Some(json!({
                "energy_kwh": dimmed_kwh.value,
                "energy_kwh_half_width": dimmed_kwh.half_width,
                "full_power_kwh": full_kwh,
                "zones": zones,
            }))
        }
    }
}

/// What it was made of.
fn run_entry(run: &AnnualRun) -> Value {
    json!({
        "version": run.version,
        "scene_sha256": run.scene_sha256,
        "rel_tol": run.settings.rel_tol,
        "abs_tol_lx": run.settings.abs_tol_lx,
        "confidence": run.settings.confidence,
        "replicates": run.settings.effective_replicates(),
        "seed": run.settings.seed,
        "sequence": run.settings.sequence.name(),
        "max_bounces": run.settings.max_bounces,
        "rays": run.work.rays,
        "paths": run.work.paths,
        "seconds": run.seconds,
        "threads": run.threads,
    })
}

fn fill(entry: &mut Map<String, Value>, point: &PointSummary) {
    for (measure, figure) in Measure::ALL.iter().zip(&point.measures) {
        entry.insert(measure.name().to_owned(), json!(figure.value));
        entry.insert(format!("{}_half_width", measure.name()), json!(figure.half_width));
    }
    entry.insert(
        "hours".to_owned(),
        json!({
            "surely_above": point.hours.above,
            "surely_below": point.hours.below,
            "undecided": point.hours.undecided,
        }),
    );
    entry.insert("relative_half_width".to_owned(), json!(point.relative_half_width));
    entry.insert("samples".to_owned(), json!(point.samples));
}

fn summary_of(summary: &SensorOfYear) -> Value {
    let share = |it: ShareOfPoints| json!({ "value": it.value, "low": it.low, "high": it.high });
    json!({
        "sda": share(summary.autonomy),
        "ase": share(summary.sunlight),
        "en17037_level": summary.en17037.map(|it| it.level),
        "en17037_level_bounds": summary.en17037.map(|it| it.bounds),
    })
}
