//! Runs, and their results as files.

use super::options::RunOptions;
use crate::arguments::{CheckpointArguments, SimulationArguments};
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
use quasilux_report::PictureOf;
use quasilux_transport::{PreparedScene, Settings};
use std::path::{Path, PathBuf};

/// Checked options of a run.
#[derive(Debug)]
pub struct Order {
    pub(super) simulation: SimulationArguments,
    keeping: CheckpointArguments,
    strict: bool,
}

impl Order {
    /// Checks options as `quasilux run` does.
    ///
    /// # Errors
    /// When a value makes no sense, with the name of its field and what was expected; or when
    /// `QUASILUX_KERNEL` names no ray kernel of this machine.
    pub fn new(options: &RunOptions) -> Result<Self, CliError> {
        kernel::choose()?;
        let (simulation, keeping) = (options.simulation()?, options.keeping()?);
        Ok(Self { simulation, keeping, strict: options.strict })
    }
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
    let settings = project::settings(project, &order.simulation)?;
    let simulate = |prepared: &PreparedScene<'_>, watcher: &mut Watcher<'_>| {
        Ok(Some(quasilux_transport::simulate(prepared.clone(), &settings, watcher)))
    };
    perform(project, &settings, order, listener, Box::new(simulate))
}

/// Does a job that has results, with a watcher as the options say.
pub(super) fn perform(
    project: &Project,
    settings: &Settings,
    order: &Order,
    listener: Option<Listener<'_>>,
    job: Job<'_>,
) -> Result<Finished, CliError> {
    let SimulationArguments { time, threads, .. } = order.simulation;
    let forecast = Forecast::new(&project.loaded, settings, count(threads));
    let mut watcher = Watcher::new(forecast, time, true).listened_to(listener);
    if let Some(path) = &order.keeping.checkpoint {
        let file = kept_project(path, project);
        let kept = RunPaths { file: &file, out: &Folder::by_name(&file), settings };
        let writer = CheckpointWriter::fresh(path, project, kept)?;
        if project.source.path.is_none() {
            results::write_atomic(&file, &project.to_bundle()?)?;
        }
        watcher = watcher.checkpoints(writer, order.keeping.checkpoint_every);
    }
    let door = Door { strict: order.strict, announces: false };
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
