//! Files of measured surfaces, read by what is in them.

use crate::commands::inputs::{Failure, bytes_of, name_of};
use quasilux_bsdf::Warning;
use quasilux_bsdf::{MeasuredBsdf, read_bsdf_named};
use quasilux_scene::FileKind;
use std::path::Path;

/// A file, and what came of it.
pub(super) struct Input {
    /// As the user names it.
    pub(super) name: String,
    /// The surface, or why there is none.
    pub(super) surface: Result<Surface, Failure>,
}

/// A file that was read.
pub(super) struct Surface {
    pub(super) bsdf: MeasuredBsdf,
    pub(super) warnings: Vec<Warning>,
}

impl Input {
    /// Reads and analyses a file.
    pub(super) fn read(path: &Path) -> Self {
        let name = name_of(path);
        let surface = bytes_of(path, FileKind::Bsdf).and_then(|bytes| {
            let read =
                read_bsdf_named(&name, &bytes).map_err(|error| Failure::new(&name, &error))?;
            Ok(Surface { bsdf: read.bsdf, warnings: read.warnings })
        });
        Self { name, surface }
    }
}
