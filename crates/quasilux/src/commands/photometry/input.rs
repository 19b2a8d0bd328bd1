//! Luminaire files, read by what is in them.

use crate::commands::inputs::{Failure, bytes_of, name_of, stem_of};
use quasilux_photometry::{Analysis, Format, Photometry, Standard, Warning, WarningKind};
use quasilux_scene::FileKind;
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

impl Input {
    /// Reads and analyses a file.
    pub(super) fn read(path: &Path) -> Self {
        let name = name_of(path);
        let luminaire =
            bytes_of(path, FileKind::Photometry).and_then(|bytes| luminaire(&name, &bytes));
        Self { name, luminaire }
    }

    /// The file's name without folder and extension.
    pub(super) fn stem(&self) -> String {
        stem_of(&self.name)
    }
}

fn luminaire(name: &str, bytes: &[u8]) -> Result<Luminaire, Failure> {
    let Some(format) = Format::from_file(name, bytes) else {
        let message = "found no line TILT= and no numbers in lines 3 to 7; expected a luminaire \
                       file, LM-63, EULUMDAT or TM-33";
        return Err(Failure::at(name, [1, 1], message.to_owned()));
    };
    let read = format.read(bytes).map_err(|error| Failure::new(name, &error))?;
    Ok(Luminaire {
        analysis: Analysis::new(&read.photometry),
        photometry: read.photometry,
        warnings: read.warnings,
        misnamed: format.misnamed(name),
    })
}

impl Luminaire {
    /// Whether there are warnings, other than that the luminaire gives less light than its lamps:
    /// each luminaire does.
    pub(super) fn is_odd(&self) -> bool {
        let has_losses = self.analysis.light_output_ratio.is_some_and(|ratio| ratio < 1.0)
            && matches!(self.photometry.facts().standard, Standard::Lm63(_));
        self.warnings.iter().any(|w| !(has_losses && w.kind() == WarningKind::FluxDiffers))
    }
}
