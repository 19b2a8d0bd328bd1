//! `quasilux run`: from a project file to results.

use crate::arguments::{OutputArguments, RunArguments, SimulationArguments};
use crate::build::{BUILD, VERSION};
use crate::checkpoint::{CheckpointWriter, RunPaths};
use crate::door::{Admitted, Door, prepare};
use crate::exit::{CliError, Exit};
use crate::forecast::Forecast;
use crate::plan::Plan;
use crate::print::{print, print_document, print_styled, tell, tell_text};
use crate::project::Project;
use crate::watcher::{Stopped, Watcher};
use crate::{interrupt, project, results};
use quasilux_inspection::{DarkPoints, Finding, explain_darkness};
use quasilux_report::{PictureOf, Report, RunFacts, Style, json, table};
use quasilux_scene::Scene;
use quasilux_transport::{
    DaylightComponents, Estimates, FoundIlluminance, Interval, PreparedScene, Settings,
    daylight_components,
};
use std::io::IsTerminal;
use std::path::{Path, PathBuf};

/// Estimates, or that there are none yet.
pub(crate) type Outcome = Result<Option<Estimates>, CliError>;

/// Work on a scene under a watcher's eyes.
pub(crate) type Job<'j> =
    Box<dyn FnOnce(&PreparedScene<'_>, &mut Watcher<'_>) -> Outcome + Send + 'j>;

/// A finished simulation.
#[derive(Clone, Debug)]
pub struct Finished {
    /// Its results.
    pub report: Report,
    /// What they are made of: the figures of each replicate.
    pub estimates: Estimates,
    /// Why it was told to stop, if it was.
    pub stopped: Option<Stopped>,
    /// What nobody was told while it went.
    pub remarks: Vec<String>,
    /// How the program would end after it.
    pub exit: Exit,
}

/// Runs a project, writes its results and prints what was asked for.
pub(crate) fn run(arguments: &RunArguments) -> Result<Exit, CliError> {
    interrupt::listen()?;
    let project = project::open(&arguments.project)?;
    let folder = Folder::by_name(&arguments.project);
    let folder = Folder::prepare(&arguments.output, folder, &project)?;
    if arguments.explain && project.loaded.scene.sensors.is_empty() {
        return Err(CliError::new(format!(
            "{}: --explain looks at sensors, and the project has none",
            project.name
        )));
    }
    if let Some(plan) = &arguments.plan {
        return run_plan(arguments, &project, &folder, plan);
    }
    let SimulationArguments { time, threads, .. } = arguments.simulation;
    let (scene, settings) =
        (&project.loaded.scene, project::settings(&project, &arguments.simulation)?);
    let forecast = Forecast::new(&project.loaded, &settings, count(threads));
    let mut watcher = Watcher::new(forecast, time, arguments.output.quiet);
    if let Some(path) = &arguments.keeping.checkpoint {
        let kept = RunPaths { file: &arguments.project, out: folder.path(), settings: &settings };
        let writer = CheckpointWriter::fresh(path, &project, kept)?;
        watcher = watcher.checkpoints(writer, arguments.keeping.checkpoint_every);
    }
    let simulate = |prepared: &PreparedScene<'_>, watcher: &mut Watcher<'_>| {
        Ok(Some(quasilux_transport::simulate(prepared.clone(), &settings, watcher)))
    };
    let door = Door { strict: arguments.strict, announces: !arguments.output.quiet };
    let Some(mut finished) = work(&project, door, watcher, simulate)? else {
        return Ok(Exit::Interrupted);
    };
    if arguments.explain && finished.exit != Exit::Interrupted {
        let pool = pool(count(threads))?;
        finished.report.explanation =
            Some(pool.install(|| quasilux_transport::explain(scene, &settings)));
    }
    folder.deliver(&finished)
}

/// Runs all indices of a plan as one part.
fn run_plan(
    arguments: &RunArguments,
    project: &Project,
    folder: &Folder<'_>,
    path: &Path,
) -> Result<Exit, CliError> {
    let plan = Plan::read(path)?;
    let settings = plan.settings(&path.display().to_string(), project)?;
    let threads = count(arguments.simulation.threads);
    let forecast = Forecast::new(&project.loaded, &settings, threads);
    let watcher = Watcher::new(forecast, None, arguments.output.quiet);
    let run = |prepared: &PreparedScene<'_>, watcher: &mut Watcher<'_>| {
        let (samples, scene) = (plan.samples, prepared.clone());
        let part = quasilux_transport::trace_part(scene, &settings, samples, 0..samples, watcher);
        let merge = |part: Vec<u8>| {
            plan.expect_decisions(&part, &path.display().to_string())?;
            quasilux_transport::merge(prepared.clone(), &settings, samples, &[&part], watcher)
                .map_err(CliError::new)
        };
        part.map(merge).transpose()
    };
    let door = Door { strict: arguments.strict, announces: !arguments.output.quiet };
    match work(project, door, watcher, run)? {
        Some(finished) => folder.deliver(&finished),
        None => Ok(Exit::Interrupted),
    }
}

/// Simulates a loaded project on the wanted number of threads.
pub(crate) fn simulate(
    project: &Project,
    arguments: &SimulationArguments,
    quiet: bool,
) -> Result<Finished, CliError> {
    let settings = project::settings(project, arguments)?;
    let forecast = Forecast::new(&project.loaded, &settings, count(arguments.threads));
    let watcher = Watcher::new(forecast, arguments.time, quiet);
    let simulate = |prepared: &PreparedScene<'_>, watcher: &mut Watcher<'_>| {
        Ok(Some(quasilux_transport::simulate(prepared.clone(), &settings, watcher)))
    };
    let door = Door { strict: false, announces: false };
    let finished = work(project, door, watcher, simulate)?;
    Ok(finished.expect("a run has results once it has begun"))
}

/// Does a job on the threads that its watcher knows of, with a scene that the door lets in; `None`
/// when the user interrupted it before it had results.
pub(crate) fn work(
    project: &Project,
    door: Door,
    mut watcher: Watcher<'_>,
    job: impl FnOnce(&PreparedScene<'_>, &mut Watcher<'_>) -> Outcome + Send,
) -> Result<Option<Finished>, CliError> {
    let forecast = watcher.forecast;
    let Forecast { scene, settings, threads, .. } = forecast;
    let pool = pool(threads)?;
    let admitted = pool.install(|| prepare(project));
    let Admitted { prepared, mut findings } = door.admit(admitted, &watcher)?;
    let outcome = pool.install(|| job(&prepared, &mut watcher));
    interrupt::keep_results();
    let seconds = watcher.finish();
    let Some(estimates) = outcome? else { return Ok(None) };
    findings.extend(pool.install(|| in_the_dark(project, &prepared, &estimates, &findings)));
    let clock = watcher.clock();
    let is_stopped = watcher.stopped == Some(Stopped::Listener);
    let goes_on = || !is_stopped && !interrupt::requested() && !clock.is_late();
    let daylight = pool.install(|| daylight(&prepared, settings, &estimates, &goes_on));
    let samples = estimates.convergence.samples.unwrap_or(estimates.samples);
    let facts = RunFacts {
        version: VERSION.to_owned(),
        build: BUILD.to_owned(),
        scene_sha256: project.identity.sha256.clone(),
        seconds,
        earlier_seconds: watcher.earlier_seconds,
        earlier_rays: watcher.earlier_rays,
        threads,
        expected_bytes: Some(forecast.bytes(Some(samples))),
        maintenance_factor: Some(project.loaded.maintenance_factor),
        daylight,
        warnings: project.loaded.warnings.iter().map(ToString::to_string).collect(),
        findings,
    };
    let exit = match watcher.stopped {
        Some(Stopped::Interrupt) => Exit::Interrupted,
        _ if estimates.tolerance_reached => Exit::Done,
        _ => Exit::Limited,
    };
    let report = Report::new(scene, settings, &estimates, facts);
    let Watcher { stopped, remarks, .. } = watcher;
    Ok(Some(Finished { report, estimates, stopped, remarks, exit }))
}

/// The components of daylight at all sensor points, known like their illuminances.
fn daylight(
    prepared: &PreparedScene<'_>,
    settings: &Settings,
    estimates: &Estimates,
    goes_on: &(dyn Fn() -> bool + Sync),
) -> Option<Vec<DaylightComponents>> {
    if estimates.samples == 0 {
        return None;
    }
    let sensors = 0..estimates.sensors.len();
    let of_sensor = |sensor: usize| {
        let intervals = estimates.point_intervals(sensor);
        let found = |(interval, samples): (Interval, &u64)| FoundIlluminance {
            lx: interval.value,
            half_width_lx: interval.half_width,
            samples: *samples,
        };
        intervals.into_iter().zip(&estimates.sensors[sensor].samples).map(found)
    };
    let found: Vec<FoundIlluminance> = sensors.flat_map(of_sensor).collect();
    daylight_components(prepared.clone(), settings, &found, goes_on)
}

/// Why no light was found at some sensor points.
fn in_the_dark(
    project: &Project,
    prepared: &PreparedScene<'_>,
    estimates: &Estimates,
    findings: &[Finding],
) -> Vec<Finding> {
    let loaded = &project.loaded;
    let dark: Vec<DarkPoints> = (0..)
        .zip(&estimates.sensors)
        .map(|(sensor, it)| DarkPoints { sensor, points: it.dark_points() })
        .collect();
    explain_darkness(&loaded.scene, &loaded.places, prepared.hierarchy(), &dark, findings)
}

/// The wanted number of threads.
pub(crate) fn count(threads: Option<u16>) -> usize {
    match threads {
        Some(threads) => usize::from(threads),
        None => std::thread::available_parallelism().map_or(1, usize::from),
    }
}

/// This many threads.
pub(crate) fn pool(threads: usize) -> Result<rayon::ThreadPool, CliError> {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| CliError::new(format!("cannot start {threads} threads: {error}")))
}

/// Where results go.
pub(crate) struct Folder<'a> {
    path: PathBuf,
    output: &'a OutputArguments,
    scene: &'a Scene,
    /// What the project is called: its file without the ending.
    title: String,
    _claim: results::Claim,
}

impl<'a> Folder<'a> {
    /// Where results of a project file go that nobody said a place for.
    pub(crate) fn by_name(file: &Path) -> PathBuf {
        Path::new("out").join(file.file_stem().unwrap_or_default())
    }

    /// Makes sure that results can be written before anything is computed: to where the arguments
    /// say, or else to `otherwise`.
    pub(crate) fn prepare(
        output: &'a OutputArguments,
        otherwise: PathBuf,
        project: &'a Project,
    ) -> Result<Self, CliError> {
        if output.json && !output.quiet {
            // The table has the warnings; the document is for programs.
            for warning in &project.loaded.warnings {
                tell(format_args!("warning: {warning}"));
            }
        }
        let path = output.out.clone().unwrap_or(otherwise);
        let claim = results::claim(&path)?;
        let (scene, title) = (&project.loaded.scene, project.title().to_owned());
        Ok(Self { path, output, scene, title, _claim: claim })
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Writes results and prints what was asked for.
    pub(crate) fn deliver(&self, finished: &Finished) -> Result<Exit, CliError> {
        let Finished { report, exit, .. } = finished;
        let of = PictureOf { scene: self.scene, title: &self.title };
        results::write(&self.path, report, of)?;
        if self.output.json {
            print_document(&json::json(report))?;
            if let (Some(explanation), false) = (&report.explanation, self.output.quiet) {
                tell_text(&table::explanation(explanation, Style::Plain));
            }
        } else if !self.output.quiet {
            print_styled(&table::table(report, style()))?;
            if let Some(explanation) = &report.explanation {
                print_styled(&format!("\n{}\n", table::explanation(explanation, style())))?;
            }
            print(&format!("results in {}\n", self.path.display()))?;
        }
        Ok(*exit)
    }
}

/// Colours where a person looks on and has not said no (no-color.org).
fn style() -> Style {
    let unwanted = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    if std::io::stdout().is_terminal() && !unwanted { Style::Colour } else { Style::Plain }
}
