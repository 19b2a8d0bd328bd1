//! `quasilux annual`: the daylight of a year, hour by hour.

#![allow(clippy::disallowed_methods, reason = "the command line reports how long a year took")]

use super::{count, pool};
use crate::arguments::AnnualArguments;
use crate::build::VERSION;
use crate::exit::{CliError, Exit};
use crate::heartbeat::Heartbeat;
use crate::npy::NpyHeader;
use crate::print::{print, tell};
use crate::project::{self, Project};
use crate::{interrupt, results};
use quasilux_report::PictureOf;
use quasilux_report::annual::{
    AnnualReport, AnnualRun, Calendar, Dimming, PointOfHours, Thresholds, annual_csv, annual_json,
    annual_maps, annual_table, closed_hours, hours_csv, hours_png, sun_hours,
};
use quasilux_scene::Blinds;
use quasilux_sky::Weather;
use quasilux_transport::{
    ClosedHours, Control, Settings, YearHours, YearProgress, YearWork, simulate_year,
};
use std::io::{self, Write};
use std::path::Path;
use std::time::Instant;

/// The hours of all points: by point, value and half-width, and interval of the weather file.
const HOURS_FILE: &str = "hours.npy";

/// Simulates a year, writes its results and prints what was asked for.
pub(crate) fn annual(arguments: &AnnualArguments) -> Result<Exit, CliError> {
    interrupt::listen()?;
    let project = project::open(&arguments.project)?;
    let weather = weather(&project)?;
    let settings = project::annual_settings(&project, arguments)?;
    let calendar = Calendar::new(weather, &arguments.occupied).map_err(CliError::new)?;
    let threads = count(arguments.threads);
    let folder = match &arguments.output.out {
        Some(folder) => folder.clone(),
        None => Path::new("out").join(arguments.project.file_stem().unwrap_or_default()),
    };
    results::prepare(&folder)?;
    let warnings = project.loaded.warnings.iter().map(ToString::to_string).collect();
    let run = AnnualRun {
        version: VERSION.to_owned(),
        scene_sha256: project.identity.sha256.clone(),
        seconds: 0.0,
        threads,
        settings,
        work: YearWork::default(),
        warnings,
    };
    let scene = &project.loaded.scene;
    let occupied_h = arguments.occupied.clone();
    let mut report = AnnualReport::begin(scene, weather, &calendar, occupied_h, run);
    report.dimming = project.loaded.electric_light.map(|light| Dimming::begin(light, scene));
    let begin = Instant::now();
    let blinds = project.loaded.blinds.as_ref();
    let pool = pool(threads)?;
    let sun = pool.install(|| sun_hours(scene, &calendar, &report.site, &report.run.settings));
    report.sun_hours = sun.map_err(CliError::new)?;
    results::stream_atomic(&folder.join(HOURS_FILE), |file| {
        pool.install(|| simulate(&mut report, blinds, file))
    })?;
    report.run.seconds = begin.elapsed().as_secs_f64();
    write(&report, &folder, project.title())?;
    if arguments.output.json {
        project.loaded.warnings.iter().for_each(|warning| tell(format_args!("warning: {warning}")));
        print(&annual_json(&report))?;
    } else if !arguments.output.quiet {
        print(&annual_table(&report))?;
        print(&format!("results in {}\n", folder.display()))?;
    }
    Ok(match report.run.work.is_complete {
        false => Exit::Interrupted,
        true if report.is_done() => Exit::Done,
        true => Exit::Limited,
    })
}

/// The weather of a project that can have a year.
fn weather(project: &Project) -> Result<&Weather, CliError> {
    let error = |message: &str| CliError::in_file(&project.name, None, message);
    let scene = &project.loaded.scene;
    if scene.sensors.is_empty() {
        return Err(error("no sensors; expected at least one [[sensors]] for a year"));
    }
    let expected = "no weather; expected [weather] with file, an EPW or WEA file";
    scene.weather.as_ref().ok_or_else(|| error(expected))
}

/// Simulates all points, and writes their hours as they come.
fn simulate(
    report: &mut AnnualReport<'_>,
    blinds: Option<&Blinds>,
    file: &mut (dyn Write + Send),
) -> io::Result<()> {
    let (scene, calendar) = (report.scene, report.calendar);
    let points: usize = scene.sensors.iter().map(quasilux_scene::Sensor::len).sum();
    let intervals = calendar.intervals.len();
    file.write_all(&NpyHeader { shape: &[points, 2, intervals] }.bytes())?;
    let settings: Settings = report.run.settings.clone();
    let signs_of_life = Heartbeat::new("simulating a year");
    let mut written = Ok(());
    let mut progress = |YearProgress { points: [over, all], .. }: YearProgress| {
        signs_of_life.set(&format!("simulating a year: {over} of {all} points"));
        if interrupt::requested() { Control::Stop } else { Control::Continue }
    };
    let digest =
        |point| PointOfHours::new(point, calendar, &Thresholds::default(), settings.confidence);
    let is_closed = blinds.map(|blinds| closed_hours(blinds, scene, calendar, &settings));
    report.closed.clone_from(&is_closed);
    let closed = blinds.zip(is_closed.as_deref());
    let closed =
        closed.map(|(Blinds { closed: scene, .. }, is_closed)| ClosedHours { scene, is_closed });
    let hours = YearHours { skies: &calendar.skies, closed };
    let work = simulate_year(scene, hours, &settings, &mut progress, digest, |point| {
        let numbers = point.illuminance_lx.iter().chain(&point.half_width_lx);
        let bytes: Vec<u8> = numbers.flat_map(|x| x.to_le_bytes()).collect();
        if written.is_ok() {
            written = file.write_all(&bytes);
        }
        report.push(&point);
    });
    report.run.work = work;
    written?;
    // What was interrupted has not-a-numbers for the rest, so that the file is whole.
    for _ in report.points.len()..points {
        let unknown = f32::NAN.to_le_bytes().repeat(2 * intervals);
        file.write_all(&unknown)?;
    }
    Ok(())
}

fn write(report: &AnnualReport<'_>, folder: &Path, title: &str) -> Result<(), CliError> {
    let write = |name: &str, bytes: &[u8]| results::write_atomic(&folder.join(name), bytes);
    write("annual.json", annual_json(report).as_bytes())?;
    write("hours.csv", hours_csv(report).as_bytes())?;
    for (number, of) in report.sensors().enumerate() {
        let name = &of.sensor.name;
        write(&format!("{name}.annual.csv"), annual_csv(of).as_bytes())?;
        if let Some(sheet) = report.equinox.csv(of.sensor, of.first, report.calendar) {
            write(&format!("{name}.equinox.csv"), sheet.as_bytes())?;
        }
        if let Some(png) = hours_png(report, number, title) {
            write(&format!("{name}.hours.png"), &png)?;
        }
    }
    if report.run.work.is_complete {
        for map in annual_maps(report, PictureOf { scene: report.scene, title }) {
            write(&format!("{}.{}.png", map.sensor.name, map.measure.name()), &map.png)?;
        }
    }
    Ok(())
}
