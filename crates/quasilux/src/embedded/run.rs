//! Runs, and their results as files.

use crate::arguments::{self, Arguments, Command, RunArguments, SimulationArguments};
use crate::checkpoint::{CheckpointWriter, RunPaths};
use crate::commands::{Finished, Folder, Job, count, work};
use crate::door::Door;
use crate::exit::CliError;
use crate::forecast::Forecast;
use crate::kernel;
use crate::project::{self, Project};
use crate::results::{self, ResultFile};
use crate::source::from_the_root;
use crate::watcher::{Listener, Watcher};
use clap::Parser;
use quasilux_report::PictureOf;
use quasilux_transport::{PreparedScene, Settings};
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// What is asked of a run.
#[derive(Debug)]
pub struct Order(pub(super) RunArguments);

impl Order {
    /// From options as they stand on the command line, such as `--rel-tol=0.01`. Where results go
    /// and what is printed is not asked of such a run.
    ///
    /// # Errors
    /// When an option is unknown or its value makes no sense, in the words of the command line; or
    /// when `QUASILUX_KERNEL` names no ray kernel of this machine.
    pub fn from_words(words: impl IntoIterator<Item = OsString>) -> Result<Self, CliError> {
        kernel::choose()?;
        match parse("run", Path::new("scene"), words)? {
            Command::Run(arguments) => Ok(Self(arguments)),
            _ => Err(CliError::new("no run")),
        }
    }
}

/// A command with its options.
pub(super) fn parse(
    command: &str,
    first: &Path,
    words: impl IntoIterator<Item = OsString>,
) -> Result<Command, CliError> {
    // What comes after two dashes is no option.
    let all = ["quasilux", command].map(OsString::from).into_iter().chain(words);
    let all = all.chain(["--".into(), first.into()]);
    let parsed = Arguments::try_parse_from(all).map(|arguments| arguments.command);
    parsed.map_err(|error| {
        CliError::new(arguments::refusal(&error).unwrap_or_else(|| error.to_string()))
    })
}

/// Simulates a project, as `quasilux run` does, up to the wanted tolerance or a limit, or until the
/// listener stops it.
///
/// # Errors
/// When the options make no sense for the scene, the run cannot be kept where it was to be, or the
/// scene has findings and was to be refused for them.
pub fn simulate(
    project: &Project,
    order: &Order,
    listener: Option<Listener<'_>>,
) -> Result<Finished, CliError> {
    let settings = project::settings(project, &order.0.simulation)?;
    let simulate = |prepared: &PreparedScene<'_>, watcher: &mut Watcher<'_>| {
        Ok(Some(quasilux_transport::simulate(prepared.clone(), &settings, watcher)))
    };
    perform(project, &settings, order, listener, Box::new(simulate))
}

/// Does a job that has results, with a watcher as the options say.
pub(super) fn perform(
    project: &Project,
    settings: &Settings,
    Order(arguments): &Order,
    listener: Option<Listener<'_>>,
    job: Job<'_>,
) -> Result<Finished, CliError> {
    let SimulationArguments { time, threads, .. } = arguments.simulation;
    let forecast = Forecast::new(&project.loaded, settings, count(threads));
    let mut watcher = Watcher::new(forecast, time, true).listened_to(listener);
    if let Some(path) = &arguments.keeping.checkpoint {
        let file = kept_project(path, project);
        let kept = RunPaths { file: &file, out: &Folder::by_name(&file), settings };
        let writer = CheckpointWriter::fresh(path, project, kept)?;
        if project.source.path.is_none() {
            results::write_atomic(&file, &project.to_bundle()?)?;
        }
        watcher = watcher.checkpoints(writer, arguments.keeping.checkpoint_every);
    }
    let door = Door { strict: arguments.strict, announces: false };
    work(project, door, watcher, job)?.ok_or_else(|| CliError::new("the run has no results"))
}

/// The project file of a run that is kept: a bundle beside the checkpoint where there is none.
fn kept_project(checkpoint: &Path, project: &Project) -> PathBuf {
    match &project.source.path {
        Some(path) => path.clone(),
        None => {
            let mut name = from_the_root(checkpoint).into_os_string();
            name.push(".scene");
            name.into()
        }
    }
}

/// Writes the files of `quasilux run` to a folder.
///
/// # Errors
/// When one cannot be written.
pub fn write(folder: &Path, project: &Project, finished: &Finished) -> Result<(), CliError> {
    let _claim = results::claim(folder)?;
    let of = PictureOf { scene: &project.loaded.scene, title: project.title() };
    results::write(folder, &finished.report, of)
}

/// The same files, in memory.
pub fn files<'a>(
    project: &'a Project,
    finished: &'a Finished,
) -> impl Iterator<Item = ResultFile<'a>> {
    let of = PictureOf { scene: &project.loaded.scene, title: project.title() };
    results::files(&finished.report, of)
}
