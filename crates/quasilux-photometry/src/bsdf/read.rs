//! Which format a file of a measured surface has, and what a reader returns.

use super::{MeasuredBsdf, window_xml::read_bsdf_xml};
use crate::report::Position;
use crate::{ReadError, Warning};

/// The formats of measured surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BsdfFormat {
    /// LBNL WINDOW XML, a matrix over Klems patches.
    WindowKlems,
    /// LBNL WINDOW XML, a tensor tree.
    WindowTensorTree,
}

/// A file that was read, with what was odd about it.
#[derive(Clone, Debug)]
pub struct ReadBsdf {
    /// The surface.
    pub bsdf: MeasuredBsdf,
    /// What was tolerated, left out or made up; each rule at most once, at its first place.
    pub warnings: Vec<Warning>,
}

impl BsdfFormat {
    /// What people call it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::WindowKlems => "WINDOW XML, Klems",
            Self::WindowTensorTree => "WINDOW XML, tensor tree",
        }
    }
}

/// Reads a measured surface of any known format, told by the content. Total: any bytes give a surface or an error with
/// its place, in memory bounded by [`most_read_memory_bytes`](crate::most_read_memory_bytes).
pub fn read_bsdf(bytes: &[u8]) -> Result<ReadBsdf, ReadError> {
    let start = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes).trim_ascii_start();
    let is_wide = matches!(bytes, [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..]);
    if start.starts_with(b"<") || is_wide || contains(bytes, b"<WindowElement") {
        return read_bsdf_xml(bytes);
    }
    Err(unknown(bytes))
}

/// Why a file of no known format is refused: what it seems to be.
fn unknown(bytes: &[u8]) -> ReadError {
    let at = Position { line: 1, column: 1 };
    let found = if bytes.starts_with(b"tensor_file\0") {
        "a container of tensors (RGL, .bsdf or .pbsdf)"
    } else if contains(bytes, b"{ Units, Wavelength Units }") {
        "spectra of a glazing (Optics, .dat)"
    } else if bytes.is_empty() {
        "an empty file"
    } else {
        "none of their marks"
    };
    ReadError::new(at, found, "a measured surface: WINDOW XML")
}

/// Whether the mark stands near the beginning.
fn contains(bytes: &[u8], mark: &[u8]) -> bool {
    bytes.windows(mark.len()).take(4096).any(|window| window == mark)
}
