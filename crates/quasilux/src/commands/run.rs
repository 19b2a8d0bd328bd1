//! `quasilux run`: from a project file to results.

use crate::arguments::{RunArguments, SimulationArguments};
use crate::exit::{Exit, Refusal};
use crate::print::print;
use crate::project::Project;
use crate::watcher::{Stopped, Watcher};
use crate::{interrupt, project, results};
use quasilux_measure::{Report, RunFacts, Style, json, table};
use std::io::IsTerminal;
use std::path::{Path, PathBuf};

/// A finished simulation.
pub(crate) struct Finished {
    pub(crate) report: Report,
    pub(crate) exit: Exit,
}

/// Runs a project, writes its results and prints what was asked for.
pub(crate) fn run(arguments: &RunArguments) -> Result<Exit, Refusal> {
    interrupt::listen()?;
    let project = project::open(&arguments.project)?;
    let folder = arguments.out.clone().unwrap_or_else(|| default_folder(&arguments.project));
    if arguments.json && !arguments.quiet {
        // The table has the warnings; the document is for programs.
        for warning in &project.loaded.warnings {
            eprintln!("warning: {warning}");
        }
    }
    if arguments.explain && project.loaded.scene.sensors.is_empty() {
        return Err(Refusal::new(format!(
            "{}: --explain looks at sensors, and the project has none",
            project.name
        )));
    }
    results::prepare(&folder)?;
    let mut finished = simulate(&project, &arguments.simulation, arguments.quiet)?;
    if arguments.explain && finished.exit != Exit::Interrupted {
        let (scene, settings) = (&project.loaded.scene, &finished.report.run.settings);
        let pool = pool(&arguments.simulation)?;
        finished.report.explanation =
            Some(pool.install(|| quasilux_transport::explain(scene, settings)));
    }
    results::write(&folder, &finished.report)?;
    if arguments.json {
        print(&json::json(&finished.report))?;
        if let (Some(explanation), false) = (&finished.report.explanation, arguments.quiet) {
            eprint!("{}", table::explanation(explanation, Style::Plain));
        }
    } else if !arguments.quiet {
        print(&table::table(&finished.report, style()))?;
        if let Some(explanation) = &finished.report.explanation {
            print(&format!("\n{}\n", table::explanation(explanation, style())))?;
        }
        print(&format!("results in {}\n", folder.display()))?;
    }
    Ok(finished.exit)
}

/// Simulates a loaded project on the wanted number of threads.
pub(crate) fn simulate(
    project: &Project,
    arguments: &SimulationArguments,
    quiet: bool,
) -> Result<Finished, Refusal> {
    let settings = project::settings(project, arguments)?;
    let scene = &project.loaded.scene;
    let pool = pool(arguments)?;
    let mut watcher = Watcher::new(scene, arguments.time, quiet);
    let estimates = pool.install(|| quasilux_transport::simulate(scene, &settings, &mut watcher));
    let facts = RunFacts {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        seconds: watcher.finish().as_secs_f64(),
        threads: pool.current_num_threads(),
        warnings: project.loaded.warnings.iter().map(ToString::to_string).collect(),
    };
    let exit = match watcher.stopped {
        Some(Stopped::Interrupt) => Exit::Interrupted,
        _ if estimates.tolerance_reached => Exit::Done,
        _ => Exit::Limited,
    };
    let report = Report::new(scene, &settings, &estimates, facts);
    Ok(Finished { report, exit })
}

/// The wanted number of threads.
fn pool(arguments: &SimulationArguments) -> Result<rayon::ThreadPool, Refusal> {
    let threads = match arguments.threads {
        Some(threads) => usize::from(threads),
        None => std::thread::available_parallelism().map_or(1, usize::from),
    };
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| Refusal::new(format!("cannot start {threads} threads: {error}")))
}

fn default_folder(project: &Path) -> PathBuf {
    Path::new("out").join(project.file_stem().unwrap_or_default())
}

/// Colours where a person looks on and has not said no (no-color.org).
fn style() -> Style {
    let unwanted = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    if std::io::stdout().is_terminal() && !unwanted { Style::Colour } else { Style::Plain }
}
