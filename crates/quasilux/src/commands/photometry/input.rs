//! Luminaire files, read by what is in them.

use super::outputs::is_stdin;
use crate::project::{read_all, read_bounded};
use quasilux_photometry::{Analysis, Deviation, Format, Photometry, ReadError, Standard, Warning};
use std::fmt;
use std::io;
use std::path::Path;

/// A file, and what came of it.
pub(super) struct Input {
    /// As the user names it.
    pub(super) name: String,
    /// The luminaire, or why there is none.
    pub(super) luminaire: Result<Luminaire, Failure>,
}

/// A file that was read.
pub(super) struct Luminaire {
    pub(super) photometry: Photometry,
    pub(super) warnings: Vec<Warning>,
    pub(super) analysis: Analysis,
    /// The format that the file's name promises, where its content is of another one.
    pub(super) misnamed: Option<Format>,
}

/// Why a file cannot be read.
pub(super) struct Failure {
    name: String,
    /// What is wrong, without the place.
    pub(super) message: String,
    /// Line and column, counted from 1, where the file could be opened.
    pub(super) place: Option<[usize; 2]>,
}

impl Input {
    /// Reads and analyses a file.
    pub(super) fn read(path: &Path) -> Self {
        let name = if is_stdin(path) { "stdin".to_owned() } else { path.display().to_string() };
        let luminaire = bytes(path)
            .map_err(|error| Failure {
                name: name.clone(),
                message: error.to_string(),
                place: None,
            })
            .and_then(|bytes| luminaire(&name, &bytes));
        Self { name, luminaire }
    }

    /// The file's name without folder and extension.
    pub(super) fn stem(&self) -> String {
        let stem = Path::new(&self.name).file_stem();
        stem.map_or_else(|| self.name.clone(), |stem| stem.to_string_lossy().into_owned())
    }
}

fn bytes(path: &Path) -> io::Result<Vec<u8>> {
    if is_stdin(path) { read_all(io::stdin().lock()) } else { read_bounded(path) }
}

fn luminaire(name: &str, bytes: &[u8]) -> Result<Luminaire, Failure> {
    let Some(format) = Format::of_file(name, bytes) else {
        let message = "found no line TILT= and no numbers in lines 3 to 7; expected a luminaire \
                       file, LM-63, EULUMDAT or TM-33";
        let place = Some([1, 1]);
        return Err(Failure { name: name.to_owned(), message: message.to_owned(), place });
    };
    let read = format.read(bytes).map_err(|error| Failure::of(name, &error))?;
    Ok(Luminaire {
        analysis: Analysis::of(&read.photometry),
        photometry: read.photometry,
        warnings: read.warnings,
        misnamed: format.misnamed(name),
    })
}

impl Luminaire {
    /// Whether there are warnings, other than that the luminaire gives less light than its lamps: each
    /// luminaire does.
    pub(super) fn is_odd(&self) -> bool {
        let has_losses = self.analysis.light_output_ratio.is_some_and(|ratio| ratio < 1.0)
            && matches!(self.photometry.facts().standard, Standard::Lm63(_));
        self.warnings.iter().any(|w| !(has_losses && w.deviation() == Deviation::FluxDiffers))
    }
}

impl Failure {
    fn of(name: &str, error: &ReadError) -> Self {
        Self {
            name: name.to_owned(),
            message: error.message(),
            place: Some([error.line(), error.column()]),
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, message, .. } = self;
        match self.place {
            Some([line, column]) => write!(f, "{name}:{line}:{column}: {message}"),
            None => write!(f, "{name}: {message}"),
        }
    }
}
