//! Luminaire files, read by what is in them.

use crate::commands::inputs::{Failure, bytes_of, name_of, stem_of};
use quasilux_photometry::{
    Analysis, ContainerFact, ContainerWarning, DMat3, Format, GldfChoice, Photometry, Standard,
    Warning, WarningKind, is_gldf, read_gldf, refused_format,
};
use quasilux_scene::FileKind;
use quasilux_text::Position;
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
    /// Facts of a container beside its photometry.
    pub(super) container: Option<Container>,
    pub(super) warnings: Vec<FileWarning>,
    pub(super) analysis: Analysis,
    /// The format that the file's name promises, where its content is of another one.
    pub(super) misnamed: Option<Format>,
}

/// Facts that only containers have.
pub(super) struct Container {
    /// The photometric file that was read from it.
    pub(super) part: String,
    pub(super) facts: Vec<ContainerFact>,
    pub(super) rotation: Turn,
}

/// How a container turns its photometry.
pub(super) struct Turn {
    pub(super) luminaire_from_photometry: DMat3,
    /// Whether the luminaire is the turned one, in its own frame: else it is as in the photometric
    /// file.
    pub(super) is_applied: bool,
}

/// A warning, and the file that it is about: the file itself, or one in a container.
pub(super) struct FileWarning {
    pub(super) file: String,
    pub(super) warning: Warning,
}

impl Input {
    /// Reads and analyses a file; of a container the light that is chosen.
    pub(super) fn read(path: &Path, choice: &GldfChoice) -> Self {
        let name = name_of(path);
        let kind = if is_gldf(&name, &[]) { FileKind::Container } else { FileKind::Photometry };
        let luminaire = match refused_format(&name) {
            Some(refused) => Err(Failure::of_file(&name, format!("found {refused}"))),
            None => bytes_of(path, kind).and_then(|bytes| luminaire(&name, &bytes, choice)),
        };
        Self { name, luminaire }
    }

    /// The file's name without folder and extension.
    pub(super) fn stem(&self) -> String {
        stem_of(&self.name)
    }
}

fn luminaire(name: &str, bytes: &[u8], choice: &GldfChoice) -> Result<Luminaire, Failure> {
    if is_gldf(name, bytes) {
        return of_container(name, bytes, choice);
    }
    if !choice.is_open() {
        let message = "found a photometric file; expected a GLDF container, of which the options \
                       choose a light";
        return Err(Failure::of_file(name, message.to_owned()));
    }
    let Some(format) = Format::from_file(name, bytes) else {
        let message = "found no line TILT= and no numbers in lines 3 to 7; expected a luminaire \
                       file, LM-63, EULUMDAT, TM-33 or GLDF";
        return Err(Failure::at(name, [1, 1], message.to_owned()));
    };
    let read = format.read(bytes).map_err(|error| Failure::new(name, &error))?;
    let of_file = |warning: Warning| FileWarning { file: name.to_owned(), warning };
    Ok(Luminaire {
        analysis: Analysis::new(&read.photometry),
        photometry: read.photometry,
        container: None,
        warnings: read.warnings.into_iter().map(of_file).collect(),
        misnamed: format.misnamed(name),
    })
}

fn of_container(name: &str, bytes: &[u8], choice: &GldfChoice) -> Result<Luminaire, Failure> {
    let read = read_gldf(bytes, choice).map_err(|error| {
        let file = match error.part() {
            "" => name.to_owned(),
            part => format!("{name}/{part}"),
        };
        match error.position() {
            Some(Position { line, column }) => {
                Failure::at(&file, [line, column], error.message().to_owned())
            }
            None => Failure::of_file(&file, error.message().to_owned()),
        }
    })?;
    let of_part = |told: ContainerWarning| FileWarning {
        file: format!("{name}/{}", told.part),
        warning: told.warning,
    };
    let luminaire_from_photometry = read.luminaire_from_photometry;
    let turned = read.photometry.turned(luminaire_from_photometry);
    let rotation = Turn { luminaire_from_photometry, is_applied: turned.is_some() };
    let photometry = turned.unwrap_or(read.photometry);
    Ok(Luminaire {
        analysis: Analysis::new(&photometry),
        photometry,
        container: Some(Container { part: read.part, facts: read.facts, rotation }),
        warnings: read.warnings.into_iter().map(of_part).collect(),
        misnamed: None,
    })
}

impl Turn {
    /// Whether there is any.
    pub(super) fn is_turned(&self) -> bool {
        !self.luminaire_from_photometry.abs_diff_eq(DMat3::IDENTITY, 1e-9)
    }
}

impl Luminaire {
    /// Whether there are warnings, other than that the luminaire gives less light than its lamps:
    /// each luminaire does.
    pub(super) fn is_odd(&self) -> bool {
        let has_losses = self.analysis.light_output_ratio.is_some_and(|ratio| ratio < 1.0)
            && matches!(self.photometry.facts().standard, Standard::Lm63(_));
        let is_loss = |kind| has_losses && kind == WarningKind::FluxDiffers;
        self.warnings.iter().any(|told| !is_loss(told.warning.kind()))
    }
}
