//! Where drawings and converted files go; checked before anything is read or written.

use crate::arguments::PhotometryArguments;
use crate::commands::drawings::{self, refuse_input};
use crate::exit::CliError;
use crate::results;
use quasilux_photometry::Format;
use std::path::{Path, PathBuf};

/// The files to be written.
pub(super) struct Outputs {
    /// One for each input, or none at all.
    drawings: Vec<PathBuf>,
    /// The converted file.
    pub(super) conversion: Option<Conversion>,
}

/// A luminaire file to be written.
pub(super) struct Conversion {
    pub(super) path: PathBuf,
    pub(super) format: Format,
}

impl Outputs {
    /// Plans the files, and makes sure that they can be written, are all different and replace no
    /// input.
    pub(super) fn prepare(arguments: &PhotometryArguments) -> Result<Self, CliError> {
        let drawings = match &arguments.svg {
            Some(path) => drawings::plan(path, &arguments.files)?,
            None => Vec::new(),
        };
        let conversion = match &arguments.convert {
            Some(path) => Some(conversion(path, &arguments.files)?),
            None => None,
        };
        Ok(Self { drawings, conversion })
    }

    /// Where the drawing of an input goes.
    pub(super) fn drawing(&self, input: usize) -> Option<&Path> {
        self.drawings.get(input).map(PathBuf::as_path)
    }
}

fn conversion(path: &Path, files: &[PathBuf]) -> Result<Conversion, CliError> {
    let refuse = |what: String| Err(CliError::new(format!("--convert {}: {what}", path.display())));
    let format = match Format::from_name(&path.to_string_lossy()) {
        Some(format @ (Format::Lm63 | Format::Eulumdat)) => format,
        _ => return refuse("expected a name that ends in .ies or .ldt".to_owned()),
    };
    if files.len() > 1 {
        return refuse(format!("one name for {} files; convert them one by one", files.len()));
    }
    results::prepare_file(path, &[])?;
    refuse_input(path, files)?;
    Ok(Conversion { path: path.to_owned(), format })
}
