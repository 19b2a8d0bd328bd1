//! `quasilux resume`: a run goes on from its checkpoint.

use super::run::{Folder, count, work};
use crate::arguments::ResumeArguments;
use crate::checkpoint::{self, Checkpoint, CheckpointWriter, Heading, Latest, RunPaths};
use crate::door::Door;
use crate::exit::{CliError, Exit};
use crate::forecast::Forecast;
use crate::print::tell;
use crate::project::Project;
use crate::watcher::Watcher;
use crate::{interrupt, project};
use quasilux_transport::PreparedScene;
use std::path::PathBuf;

/// Goes on with a run, and ends with the bits that it would have had.
pub(crate) fn resume(arguments: &ResumeArguments) -> Result<Exit, CliError> {
    interrupt::listen()?;
    let Latest { checkpoint, warning } = checkpoint::read(&arguments.checkpoint)?;
    let Checkpoint { heading, state } = checkpoint;
    if let (Some(warning), false) = (&warning, arguments.output.quiet) {
        tell(format_args!("warning: {warning}"));
    }
    let name = arguments.checkpoint.display().to_string();
    heading.expect_build().map_err(|what| CliError::new(format!("{name}: {what}")))?;
    let file = project_file(arguments, &heading);
    let project = project::open(&file)?;
    if let Some(change) = project.identity.difference(&heading.scene) {
        let project = &project.name;
        return Err(CliError::new(format!("{name}: {project} is another scene now: {change}")));
    }
    let settings = project::kept_settings(&heading.settings, &name, &project)?;
    let scene = &project.loaded.scene;
    if settings.sequence.points().is_some() && arguments.time.is_some() {
        return Err(CliError::new(format!(
            "{name}: {} needs all of its points: --time cannot end the run before",
            settings.sequence.name()
        )));
    }
    let folder = Folder::prepare(&arguments.output, heading.folder().to_owned(), &project)?;
    let kept = RunPaths { file: &file, out: folder.path(), settings: &settings };
    let writer =
        CheckpointWriter::new(&arguments.checkpoint, &project, kept)?.going_on(warning.is_some());
    let threads = count(arguments.work.threads);
    let forecast = Forecast::new(scene, &settings, threads);
    let watcher = Watcher::new(forecast, arguments.time, arguments.output.quiet)
        .going_on(heading.seconds)
        .checkpoints(writer, arguments.checkpoint_every);
    let go_on = |prepared: &PreparedScene<'_>, watcher: &mut Watcher<'_>| {
        let estimates = quasilux_transport::resume(prepared.clone(), &settings, &state, watcher);
        estimates.map(Some).map_err(|error| CliError::new(format!("{name}: {error}")))
    };
    let door = Door { strict: false, announces: !arguments.output.quiet };
    let finished = work(&project, door, watcher, go_on)?;
    if !arguments.output.quiet && quasilux_transport::is_over(&state) {
        tell(format_args!("note: {name}: {}", over(&project)));
    }
    match finished {
        Some(finished) => folder.deliver(&finished),
        None => Ok(Exit::Interrupted),
    }
}

/// What was left of a run whose sensors have all they get.
fn over(project: &Project) -> &'static str {
    if project.loaded.scene.cameras.is_empty() {
        "the run was over; its results are written again"
    } else {
        "its sensors had all their samples; its pictures are taken and its results written again"
    }
}

/// Where the project is: as told, or as it was given to the run, here or there.
fn project_file(arguments: &ResumeArguments, heading: &Heading) -> PathBuf {
    let known = [&heading.project, &heading.project_absolute];
    let found = known.into_iter().find(|path| path.is_file()).unwrap_or(&heading.project);
    arguments.project.clone().unwrap_or_else(|| found.clone())
}
