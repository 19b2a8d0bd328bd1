//! A year of a project, ready to be simulated.

#![allow(clippy::disallowed_methods, reason = "the command line reports how long a year took")]

use super::sink::{HOURS_FILE, Sink, write};
use crate::arguments::OutputArguments;
use crate::build::VERSION;
use crate::commands::pool;
use crate::exit::{CliError, Exit};
use crate::interrupt;
use crate::meter::Meter;
use crate::print::{print, print_document, tell};
use crate::project::Project;
use crate::results;
use crate::year_file::{YearBlock, YearCost};
use quasilux_report::annual::{
    AnnualReport, AnnualRun, BlindsOfYear, Calendar, Dimming, PointOfHours, RoomOfYear,
    annual_json, annual_table, sun_hours,
};
use quasilux_scene::{ElectricLight, Loaded, Occupancy, Scene, Sensor, YearTerms};
use quasilux_sky::Weather;
use quasilux_transport::{
    Control, OtherRoom, PointOfYear, Settings, YearHours, YearObserver, YearProgress, YearRun,
    YearWork, simulate_year,
};
use rayon::ThreadPool;
use std::io;
use std::ops::Range;
use std::path::Path;
use std::sync::OnceLock;
use std::time::Instant;

/// A year of a project.
pub(super) struct Year<'p> {
    project: &'p Project,
    weather: &'p Weather,
    calendar: Calendar,
    pub(super) settings: Settings,
    terms: YearTerms,
    /// Zones of electric light without any daylight yet.
    dimmings: Vec<Dimming>,
    threads: usize,
    pool: ThreadPool,
    blinds: OnceLock<Option<BlindsOfYear>>,
}

/// A room that blinds make, and whether it is the room, by hour.
struct OwnRoom {
    scene: Scene,
    is_own: Vec<bool>,
}

/// A room that a year is traced in, and those that it becomes in some hours.
#[derive(Clone, Copy)]
pub(super) struct TracedRoom<'r> {
    scene: &'r Scene,
    other_rooms: &'r [OtherRoom<'r>],
}

/// Where blocks go.
pub(super) type Keep<'k> = dyn FnMut(YearBlock) -> Result<(), CliError> + Send + 'k;

/// Points block by block, and what each block took.
struct Blocks<'b, 'k> {
    keep: &'b mut Keep<'k>,
    kept: Result<(), CliError>,
    points: Vec<PointOfHours>,
    begin: Instant,
    before: YearWork,
}

impl<'b, 'k> Blocks<'b, 'k> {
    fn new(keep: &'b mut Keep<'k>) -> Self {
        Self {
            keep,
            kept: Ok(()),
            points: Vec::new(),
            begin: Instant::now(),
            before: YearWork::default(),
        }
    }
}

impl YearObserver<PointOfHours> for Blocks<'_, '_> {
    fn keep(&mut self, point: PointOfHours) {
        self.points.push(point);
    }

    fn progress(&mut self, YearProgress { work, .. }: YearProgress) -> Control {
        let took = YearCost {
            rays: work.rays - self.before.rays,
            paths: work.paths - self.before.paths,
            seconds: self.begin.elapsed().as_secs_f64(),
        };
        (self.before, self.begin) = (work, Instant::now());
        self.kept = (self.keep)(YearBlock { took, points: std::mem::take(&mut self.points) });
        if self.kept.is_ok() { Control::Continue } else { Control::Stop }
    }
}

impl<'p> Year<'p> {
    pub(super) fn new(
        project: &'p Project,
        settings: Settings,
        occupied_h: Option<&Range<f64>>,
        threads: usize,
    ) -> Result<Self, CliError> {
        let weather = weather(project)?;
        let mut terms = project.loaded.annual.clone();
        if let Some(hours) = occupied_h.cloned() {
            terms.occupancy = match terms.occupancy {
                Occupancy::Hours { days, .. } => Occupancy::Hours { hours, days },
                Occupancy::Schedule { .. } => Occupancy::daily(hours),
            };
        }
        let calendar = Calendar::new(weather, &terms.occupancy).map_err(CliError::new)?;
        let loaded = &project.loaded;
        let begin = |light: &ElectricLight| Dimming::begin(light.clone(), &loaded.scene);
        Ok(Self {
            project,
            weather,
            calendar,
            settings,
            terms,
            dimmings: loaded.electric_light.iter().map(begin).collect(),
            threads,
            pool: pool(threads)?,
            blinds: OnceLock::new(),
        })
    }

    pub(super) fn project(&self) -> &Project {
        self.project
    }

    pub(super) fn calendar(&self) -> &Calendar {
        &self.calendar
    }

    /// How many points there are, through all sensors.
    pub(super) fn points(&self) -> usize {
        self.project.loaded.scene.sensors.iter().map(Sensor::len).sum()
    }

    /// Whether a point with this number has the hours that it is to have.
    pub(super) fn has_hours_of(&self, number: usize, point: &PointOfHours) -> bool {
        point.fits(&self.calendar, self.is_dimmed(number))
    }

    /// Whether electric light looks at a point, and so needs all of its replicates.
    fn is_dimmed(&self, number: usize) -> bool {
        self.dimmings.iter().any(|dimming| dimming.looks_at(number))
    }

    /// Where blinds are; found out when it is first asked for.
    fn blinds(&self) -> Option<&BlindsOfYear> {
        let Loaded { scene, blinds, .. } = &self.project.loaded;
        let move_all = |blinds| BlindsOfYear::new(blinds, scene, &self.calendar, &self.settings);
        let found = || blinds.as_ref().map(|blinds| self.pool.install(|| move_all(blinds)));
        self.blinds.get_or_init(found).as_ref()
    }

    /// The rooms that blinds make, and when.
    fn rooms(&self) -> Result<Vec<OwnRoom>, CliError> {
        let Loaded { scene, blinds, .. } = &self.project.loaded;
        let Some((blinds, of_year)) = blinds.as_ref().zip(self.blinds()) else {
            return Ok(Vec::new());
        };
        let rooms =
            of_year.rooms().map_err(|it| CliError::in_file(&self.project.name, None, it))?;
        let room = |RoomOfYear { positions, is_own }| OwnRoom {
            scene: blinds.room(scene, &positions),
            is_own,
        };
        Ok(rooms.into_iter().map(room).collect())
    }

    /// Simulates some points, block by block, and shows how far it is; an interrupt ends it. The
    /// result says whether all are over.
    pub(super) fn simulate(
        &self,
        points: Range<usize>,
        keep: &mut Keep<'_>,
    ) -> Result<bool, CliError> {
        watched(|goes_on| self.trace(points, keep, goes_on))
    }

    /// Simulates all points in another room, as [`Self::simulate`] does.
    pub(super) fn simulate_in(&self, scene: &Scene, keep: &mut Keep<'_>) -> Result<bool, CliError> {
        let room = TracedRoom { scene, other_rooms: &[] };
        watched(|goes_on| self.trace_in(room, 0..self.points(), keep, goes_on))
    }

    /// Traces the year, with an observer that is told how far it is and may end it.
    pub(super) fn trace(
        &self,
        points: Range<usize>,
        keep: &mut Keep<'_>,
        goes_on: &(dyn Fn(f64) -> bool + Sync),
    ) -> Result<bool, CliError> {
        let rooms = self.rooms()?;
        let other_rooms = rooms.iter().map(|OwnRoom { scene, is_own }| OtherRoom { scene, is_own });
        let other_rooms: Vec<OtherRoom<'_>> = other_rooms.collect();
        let room = TracedRoom { scene: &self.project.loaded.scene, other_rooms: &other_rooms };
        self.trace_in(room, points, keep, goes_on)
    }

    /// Traces the year in a room that may be another than the project's, with the same sensors.
    pub(super) fn trace_in(
        &self,
        room: TracedRoom<'_>,
        points: Range<usize>,
        keep: &mut Keep<'_>,
        goes_on: &(dyn Fn(f64) -> bool + Sync),
    ) -> Result<bool, CliError> {
        if points.is_empty() {
            return Ok(true);
        }
        let TracedRoom { scene, other_rooms } = room;
        let hours = YearHours { skies: &self.calendar.skies, other_rooms };
        let thresholds = self.terms.thresholds;
        let digest = |point: PointOfYear| {
            let is_dimmed = self.is_dimmed(point.number);
            let point = PointOfHours::new(point, &self.calendar, &thresholds);
            if is_dimmed { point } else { point.slimmed() }
        };
        let settings = &self.settings;
        let run = YearRun { scene, hours, points, settings, digest: &digest, goes_on };
        let mut blocks = Blocks::new(keep);
        let work = self.pool.install(|| simulate_year(run, &mut blocks));
        blocks.kept.map(|()| work.is_complete)
    }

    /// Makes results of the points that `fill` brings, writes them and prints what was asked for;
    /// `fill` says whether there are all.
    pub(super) fn deliver(
        &self,
        folder: &Path,
        output: &OutputArguments,
        fill: impl FnOnce(&mut Sink<'_, '_>) -> Result<bool, CliError>,
    ) -> Result<Exit, CliError> {
        let _claim = results::claim(folder)?;
        let begin = Instant::now();
        let mut report = self.report()?;
        let mut failure = None;
        let hours = folder.join(HOURS_FILE);
        let written = results::stream_atomic(&hours, |file| {
            let mut sink = Sink::begin(&mut report, file, hours.clone(), self.points())?;
            match fill(&mut sink) {
                Ok(is_complete) => sink.end(is_complete),
                Err(error) => {
                    failure = Some(error);
                    Err(io::ErrorKind::Other.into())
                }
            }
        });
        if let Some(failure) = failure {
            return Err(failure);
        }
        report.run.seconds += begin.elapsed().as_secs_f64();
        // What is known of the points is written even where their hours cannot be.
        let others = write(&report, folder, self.project.title());
        written.and(others)?;
        if output.json {
            report.run.warnings.iter().for_each(|warning| tell(format_args!("warning: {warning}")));
            print_document(&annual_json(&report))?;
        } else if !output.quiet {
            print(&annual_table(&report))?;
            print(&format!("results in {}\n", folder.display()))?;
        }
        Ok(match report.run.work.is_complete {
            false => Exit::Interrupted,
            true if report.is_done() => Exit::Done,
            true => Exit::Limited,
        })
    }

    /// Warnings of the project, and of the skies of its hours.
    fn warnings(&self) -> Vec<String> {
        let own = &self.project.loaded.warnings;
        let mut warnings: Vec<String> = own.iter().map(ToString::to_string).collect();
        warnings.extend(self.left_out());
        let held = self.calendar.skies.iter().filter(|hour| hour.sky.is_held()).count();
        if held > 0 {
            warnings.push(format!(
                "the sky is approximate in {held} of {} hours with light: the sun is too low for \
                 the model of Perez (b > 0). They take the nearest brightness that the model \
                 covers, and keep their illuminance",
                self.calendar.skies.len()
            ));
        }
        warnings
    }

    /// That a project has what no year looks at.
    fn left_out(&self) -> Option<String> {
        let Loaded { scene, sky, .. } = &self.project.loaded;
        let named = |count: usize, name: &str| {
            (count > 0).then(|| format!("{count} {name}{}", if count == 1 { "" } else { "s" }))
        };
        let has_time = sky.as_ref().is_some_and(|facts| !facts.lacks_time());
        let all = [
            named(scene.lights.len(), "light"),
            named(scene.cameras.len(), "camera"),
            has_time.then(|| "time of [sun]".to_owned()),
        ];
        let all: Vec<String> = all.into_iter().flatten().collect();
        (!all.is_empty()).then(|| {
            format!(
                "a year leaves out {} of the project: it has daylight alone, in all of its hours. \
                 `quasilux run` computes them",
                all.join(", ")
            )
        })
    }

    /// A report without points.
    pub(super) fn report(&self) -> Result<AnnualReport<'_>, CliError> {
        let scene = &self.project.loaded.scene;
        let run = AnnualRun {
            version: VERSION.to_owned(),
            scene_sha256: self.project.identity.sha256.clone(),
            seconds: 0.0,
            threads: self.threads,
            settings: self.settings.clone(),
            work: YearWork::default(),
            warnings: self.warnings(),
        };
        let terms = self.terms.clone();
        let mut report = AnnualReport::begin(scene, self.weather, &self.calendar, terms, run);
        report.dimmings.clone_from(&self.dimmings);
        report.blinds = self.blinds().cloned();
        let look = || sun_hours(scene, &self.calendar, &report.site, &report.run.settings);
        report.sun_hours = self.pool.install(look).map_err(CliError::new)?;
        Ok(report)
    }
}

/// Traces, shows how far it is, and ends by an interrupt.
fn watched(
    trace: impl FnOnce(&(dyn Fn(f64) -> bool + Sync)) -> Result<bool, CliError>,
) -> Result<bool, CliError> {
    let meter = Meter::new(1);
    let is_complete = trace(&|share: f64| {
        meter.show(share);
        !interrupt::requested()
    });
    interrupt::keep_results();
    is_complete
}

/// The weather of a project that can have a year.
fn weather(project: &Project) -> Result<&Weather, CliError> {
    let error = |message: &str| CliError::in_file(&project.name, None, message);
    let scene = &project.loaded.scene;
    if scene.sensors.is_empty() {
        return Err(error("no sensors; add at least one [[sensors]] for a year"));
    }
    let expected = "no weather; add [weather] with file, an EPW or WEA file";
    scene.weather.as_ref().ok_or_else(|| error(expected))
}
