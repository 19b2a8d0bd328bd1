//! Runs that go on from their checkpoints.

use super::options::ResumeOptions;
use crate::arguments::ResumeArguments;
use crate::checkpoint::{self, Latest};
use crate::commands::{Finished, KeptRun};
use crate::exit::CliError;
use crate::project::Project;
use crate::watcher::Listener;
use std::path::{Path, PathBuf};

/// A run that was kept, and the options with which it goes on.
#[derive(Debug)]
pub struct ResumableRun {
    arguments: ResumeArguments,
    latest: Latest,
    file: PathBuf,
}

impl ResumableRun {
    /// Reads a checkpoint, and checks the options as `quasilux resume` does.
    ///
    /// # Errors
    /// When an option makes no sense, or there is no checkpoint of this program.
    pub fn read(checkpoint: &Path, options: &ResumeOptions) -> Result<Self, CliError> {
        let arguments = options.arguments(checkpoint)?;
        let latest = checkpoint::read(&arguments.checkpoint)?;
        let file = latest.checkpoint.heading.project_file(&arguments)?;
        Ok(Self { arguments, latest, file })
    }

    /// Where the project of the run is.
    #[must_use]
    pub fn project_file(&self) -> &Path {
        &self.file
    }

    /// Goes on, and ends with the bits that the run would have had.
    ///
    /// # Errors
    /// When the project is another scene than that of the run, or the checkpoint is damaged.
    pub fn go_on(
        self,
        project: &Project,
        listener: Option<Listener<'_>>,
    ) -> Result<Finished, CliError> {
        let Self { arguments, latest, file } = self;
        let warning = latest.warning.clone();
        let kept = KeptRun::new(&arguments, latest, file, project)?;
        let finished = kept.go_on(project, kept.out(), true, listener)?;
        let Some(mut finished) = finished else {
            return Err(CliError::new("the run has no results"));
        };
        finished.remarks.extend(warning.into_iter().chain(kept.note(project)));
        Ok(finished)
    }
}
