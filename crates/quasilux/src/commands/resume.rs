//! `quasilux resume`: a run goes on from its checkpoint.

use super::annual::resume_year;
use super::run::{Finished, Folder, count, work};
use crate::arguments::ResumeArguments;
use crate::checkpoint::{self, Checkpoint, CheckpointWriter, Heading, Latest, RunPaths};
use crate::door::Door;
use crate::exit::{CliError, Exit};
use crate::forecast::Forecast;
use crate::print::tell;
use crate::project::Project;
use crate::watcher::{Listener, Watcher};
use crate::{interrupt, project, year_file};
use quasilux_transport::{PreparedScene, Settings};
use std::path::{Path, PathBuf};

/// A run that was kept, ready to go on.
pub(crate) struct KeptRun<'a> {
    arguments: &'a ResumeArguments,
    /// What messages call the checkpoint.
    name: String,
    /// The project file.
    file: PathBuf,
    heading: Heading,
    state: Vec<u8>,
    settings: Settings,
    was_damaged: bool,
}

/// Goes on with a run, and ends with the bits that it would have had.
pub(crate) fn resume(arguments: &ResumeArguments) -> Result<Exit, CliError> {
    if year_file::is_year(&arguments.checkpoint) {
        return resume_year(arguments);
    }
    interrupt::listen()?;
    let latest = checkpoint::read(&arguments.checkpoint)?;
    if let (Some(warning), false) = (&latest.warning, arguments.output.quiet) {
        tell(format_args!("warning: {warning}"));
    }
    let file = latest.checkpoint.heading.project_file(arguments)?;
    let project = project::open(&file)?;
    let kept = KeptRun::new(arguments, latest, file, &project)?;
    let folder = Folder::prepare(&arguments.output, kept.out().to_owned(), &project)?;
    let finished = kept.go_on(&project, folder.path(), arguments.output.quiet, None)?;
    if let (Some(note), false) = (kept.note(&project), arguments.output.quiet) {
        tell(format_args!("note: {note}"));
    }
    match finished {
        Some(finished) => folder.deliver(&finished),
        None => Ok(Exit::Interrupted),
    }
}

impl<'a> KeptRun<'a> {
    /// Of a project, which has to be the one that the run was begun with.
    pub(crate) fn new(
        arguments: &'a ResumeArguments,
        latest: Latest,
        file: PathBuf,
        project: &Project,
    ) -> Result<Self, CliError> {
        let Latest { checkpoint, warning } = latest;
        let Checkpoint { heading, state } = checkpoint;
        let name = arguments.checkpoint.display().to_string();
        let refuse = |message: String| Err(CliError::in_file(&name, None, message));
        if let Some(change) = project.identity.difference(&heading.scene) {
            return refuse(format!("{} is another scene now: {change}", project.name));
        }
        let settings = project::kept_settings(&heading.settings, &name, project)?;
        if settings.sequence.points().is_some() && arguments.time.is_some() {
            let sequence = settings.sequence.name();
            return refuse(format!(
                "{sequence} needs all of its points: --time cannot end the run before"
            ));
        }
        let was_damaged = warning.is_some();
        Ok(Self { arguments, name, file, heading, state, settings, was_damaged })
    }

    /// Goes on, keeping itself where it was kept; `out` is where its results go.
    pub(crate) fn go_on(
        &self,
        project: &Project,
        out: &Path,
        quiet: bool,
        listener: Option<Listener<'_>>,
    ) -> Result<Option<Finished>, CliError> {
        let Self { arguments, settings, .. } = self;
        let kept = RunPaths { file: &self.file, out, settings };
        let writer = CheckpointWriter::new(&arguments.checkpoint, project, kept)?;
        let threads = count(arguments.work.threads);
        let forecast = Forecast::new(&project.loaded, settings, threads);
        let watcher = Watcher::new(forecast, arguments.time, quiet)
            .listened_to(listener)
            .going_on(self.heading.seconds)
            .checkpoints(writer.going_on(self.was_damaged), arguments.checkpoint_every);
        let go_on = |prepared: &PreparedScene<'_>, watcher: &mut Watcher<'_>| {
            let scene = prepared.clone();
            let estimates = quasilux_transport::resume(scene, settings, &self.state, watcher);
            estimates.map(Some).map_err(|error| CliError::in_file(&self.name, None, error))
        };
        let door = Door { strict: false, announces: !quiet };
        work(project, door, watcher, go_on)
    }

    /// Where its results go.
    pub(crate) fn out(&self) -> &Path {
        self.heading.folder()
    }

    /// What is to be said of a run whose sensors had all they get.
    pub(crate) fn note(&self, project: &Project) -> Option<String> {
        let is_over = quasilux_transport::is_over(&self.state);
        is_over.then(|| format!("{}: {}", self.name, over(project)))
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
