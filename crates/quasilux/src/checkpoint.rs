//! Checkpoints: a run on disk, to go on from.
//!
//! A checkpoint is written beside its place and renamed into it, so that it is there whole or not
//! at all; the one before of the same run stays as `FILE.previous`.

use crate::arguments::ResumeArguments;
use crate::atomic_file::{self, beside};
use crate::build::{self, BUILD, VERSION};
use crate::container::{self, Contents};
use crate::digest::SceneIdentity;
use crate::exit::CliError;
use crate::project::Project;
use crate::results;
use quasilux_report::json;
use quasilux_transport::Settings;
use serde::{Deserialize, Serialize};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Name and version of the format.
pub(crate) const FORMAT: &str = "quasilux-checkpoint/1";

/// What a checkpoint says of its run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Heading {
    pub(crate) version: String,
    pub(crate) build: String,
    /// The project file as it was given, and from the root.
    pub(crate) project: PathBuf,
    pub(crate) project_absolute: PathBuf,
    pub(crate) scene: SceneIdentity,
    pub(crate) settings: Settings,
    /// Where the results go, as it was given, and from the root.
    #[serde(default)]
    pub(crate) out: PathBuf,
    #[serde(default)]
    pub(crate) out_absolute: PathBuf,
    /// What the run took in s up to this state.
    #[serde(default)]
    pub(crate) seconds: f64,
}

/// A checkpoint that was read.
#[derive(Debug)]
pub(crate) struct Checkpoint {
    pub(crate) heading: Heading,
    pub(crate) state: Vec<u8>,
}

/// Writes the checkpoints of a run to its path.
pub(crate) struct CheckpointWriter {
    path: PathBuf,
    heading: Heading,
    before: Before,
}

/// What a run is kept with.
#[derive(Clone, Copy)]
pub(crate) struct RunPaths<'a> {
    /// The project file.
    pub(crate) file: &'a Path,
    /// Folder for the results.
    pub(crate) out: &'a Path,
    pub(crate) settings: &'a Settings,
}

/// What is at the path before the next state is.
#[derive(Clone, Copy)]
enum Before {
    /// A state of the same run.
    Own,
    /// Something that cannot be read: the one before it is the only good one.
    Damaged,
    /// Nothing, or what another run left.
    Foreign,
}

impl Heading {
    /// Of a run that begins.
    pub(crate) fn new(project: &Project, kept: RunPaths<'_>) -> Self {
        let RunPaths { file, out, settings } = kept;
        Self {
            version: VERSION.to_owned(),
            build: BUILD.to_owned(),
            project: file.to_owned(),
            project_absolute: from_the_root(file),
            scene: project.identity.clone(),
            settings: settings.clone(),
            out: out.to_owned(),
            out_absolute: from_the_root(out),
            seconds: 0.0,
        }
    }

    /// Where the results went: as it was given where the project is found as it was given, and so
    /// most likely from the same folder.
    pub(crate) fn folder(&self) -> &Path {
        if self.project.is_file() { &self.out } else { &self.out_absolute }
    }

    /// Where the project of this program's run is: as told, or as it was given to the run, here or
    /// there. Refuses what another build of the program left.
    pub(crate) fn project_file(&self, arguments: &ResumeArguments) -> Result<PathBuf, CliError> {
        let name = arguments.checkpoint.display();
        build::expect(&self.version, &self.build)
            .map_err(|what| CliError::in_file(name, None, what))?;
        let known = [&self.project, &self.project_absolute];
        let found = known.into_iter().find(|path| path.is_file()).unwrap_or(&self.project);
        Ok(arguments.project.clone().unwrap_or_else(|| found.clone()))
    }
}

impl CheckpointWriter {
    /// Of a run from the start: refuses to take the place of one that is not over.
    pub(crate) fn fresh(
        path: &Path,
        project: &Project,
        kept: RunPaths<'_>,
    ) -> Result<Self, CliError> {
        let writer = Self::new(path, project, kept)?;
        expect_nothing_to_lose(path, project)?;
        Ok(writer)
    }

    /// Makes sure that it can be.
    pub(crate) fn new(
        path: &Path,
        project: &Project,
        kept: RunPaths<'_>,
    ) -> Result<Self, CliError> {
        let RunPaths { file, out, .. } = kept;
        results::prepare_file(path, &[file])?;
        results::expect_text(file)?;
        results::expect_text(out)?;
        atomic_file::try_beside(path).map_err(|error| {
            let message = format!("cannot keep the run: {error}");
            CliError::in_file(path.display(), None, message)
        })?;
        let heading = Heading::new(project, kept);
        Ok(Self { path: path.to_owned(), heading, before: Before::Foreign })
    }

    /// For a run that goes on from there, or, where that was damaged, from the one before.
    pub(crate) fn going_on(self, was_damaged: bool) -> Self {
        let before = if was_damaged { Before::Damaged } else { Before::Own };
        Self { before, ..self }
    }

    /// Puts a state in the place of the one before; the run took `seconds` up to it.
    pub(crate) fn write(&mut self, state: &[u8], seconds: f64) -> io::Result<()> {
        self.heading.seconds = seconds;
        let bytes = container::encode(FORMAT, &json::text(&self.heading), state);
        // On disk before it takes the place of one that is.
        let fresh = atomic_file::write_beside(&self.path, |file| file.write_all(&bytes))?;
        let previous = beside(&self.path, "previous");
        let made_way = match self.before {
            Before::Own => fs::rename(&self.path, previous),
            Before::Damaged => Ok(()),
            // Nobody may go on from another run by mistake.
            Before::Foreign => fs::remove_file(previous),
        };
        match made_way {
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
            _ => {}
        }
        fresh.publish()?;
        self.before = Before::Own;
        Ok(())
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }
}

/// The newest checkpoint that can be read.
#[derive(Debug)]
pub(crate) struct Latest {
    pub(crate) checkpoint: Checkpoint,
    /// Where it is the one before, because that at the path is damaged or missing.
    pub(crate) warning: Option<String>,
}

/// Reads a checkpoint, or the one before it where it is damaged or missing.
pub(crate) fn read(path: &Path) -> Result<Latest, CliError> {
    let error = match read_one(path) {
        Ok(checkpoint) => return Ok(Latest { checkpoint, warning: None }),
        Err(error) => error,
    };
    let previous = beside(path, "previous");
    match read_one(&previous) {
        Ok(checkpoint) => {
            let warning = format!("{error}; continuing from {}", previous.display());
            Ok(Latest { checkpoint, warning: Some(warning) })
        }
        Err(_) => Err(error),
    }
}

/// Refuses where a run from the start would take the place of one that is not over, or of something
/// that nobody can tell. Pictures come after the last checkpoint, so that runs with cameras may
/// lack them still.
fn expect_nothing_to_lose(path: &Path, project: &Project) -> Result<(), CliError> {
    if !path.exists() && !beside(path, "previous").exists() {
        return Ok(());
    }
    let name = path.display();
    let Checkpoint { heading, state } = read(path)
        .map(|latest| latest.checkpoint)
        .map_err(|error| error.with_advice("; remove it to begin a run there"))?;
    let has_pictures = !project.loaded.scene.cameras.is_empty();
    if quasilux_transport::is_over(&state) && !has_pictures {
        return Ok(());
    }
    let project = heading.project.display();
    let message = format!(
        "keeps a run of {project} that may not be over: go on with `quasilux resume {name}`, or \
         remove it to begin anew"
    );
    Err(CliError::in_file(name, None, message))
}

fn from_the_root(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned())
}

fn read_one(path: &Path) -> Result<Checkpoint, CliError> {
    let name = path.display();
    let bytes = container::read(path).map_err(|error| CliError::in_file(&name, None, error))?;
    parse(&bytes).map_err(|what| CliError::in_file(&name, None, what))
}

/// A checkpoint from the bytes of its file.
fn parse(bytes: &[u8]) -> Result<Checkpoint, String> {
    let Contents { header, body } = container::decode(FORMAT, bytes)?;
    let heading = serde_json::from_str(header).map_err(|error| format!("its header: {error}"))?;
    Ok(Checkpoint { heading, state: body.to_vec() })
}
