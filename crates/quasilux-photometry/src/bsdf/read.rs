//! Which format a file of a measured surface has, and what a reader returns.

use super::{MeasuredBsdf, Way, astm, merl};
use super::{read_astm, read_bsdf_xml, read_ddr, read_merl};
use crate::report::Position;
use crate::{ReadError, Warning, text};

/// The mark of a format stands within so many bytes.
const SEARCHED: usize = 1 << 14;

/// The formats of measured surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BsdfFormat {
    /// LBNL WINDOW XML, a matrix over Klems patches.
    WindowKlems,
    /// LBNL WINDOW XML, a tensor tree.
    WindowTensorTree,
    /// Integra DDR or DDT.
    Ddr,
    /// MERL binary.
    Merl,
    /// ASTM E1392 text.
    Astm,
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
            Self::Ddr => "DDR",
            Self::Merl => "MERL",
            Self::Astm => "ASTM E1392",
        }
    }
}

/// Reads a measured surface of any known format, told by the content; that of a DDR file is reflection, see
/// [`read_bsdf_named`]. Total: any bytes give a surface or an error with its place, in memory bounded by
/// [`most_bsdf_memory_bytes`](crate::most_bsdf_memory_bytes).
pub fn read_bsdf(bytes: &[u8]) -> Result<ReadBsdf, ReadError> {
    read_as(bytes, Way::Reflection)
}

/// The same with the name of the file, which tells transmission by its extension `.ddt`.
pub fn read_bsdf_named(name: &str, bytes: &[u8]) -> Result<ReadBsdf, ReadError> {
    let extension = name.rsplit_once('.').map_or("", |(_, extension)| extension);
    let is_transmission = extension.eq_ignore_ascii_case("ddt");
    read_as(bytes, if is_transmission { Way::Transmission } else { Way::Reflection })
}

fn read_as(bytes: &[u8], way_of_ddr: Way) -> Result<ReadBsdf, ReadError> {
    if merl::counts(bytes).is_some() {
        return read_merl(bytes);
    }
    let start = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes).trim_ascii_start();
    let is_wide = matches!(bytes, [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..]);
    if start.starts_with(b"<") || is_wide || contains(bytes, b"<WindowElement") {
        return read_bsdf_xml(bytes);
    }
    let searched = String::from_utf8_lossy(&bytes[..bytes.len().min(SEARCHED)]);
    if text::lines(&searched).any(astm::names_columns) {
        return read_astm(bytes);
    }
    let words = |line: &str| line.split_whitespace().next().unwrap_or("").to_ascii_lowercase();
    let begins_ddr = |line| matches!(words(line).as_str(), "typesym" | "typecolormodel" | "sigma");
    if text::lines(&searched).any(begins_ddr) {
        return read_ddr(bytes, way_of_ddr);
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
    ReadError::new(at, found, "a measured surface: WINDOW XML, MERL, ASTM E1392 or DDR")
}

/// Whether the mark stands near the beginning.
fn contains(bytes: &[u8], mark: &[u8]) -> bool {
    bytes.windows(mark.len()).take(SEARCHED).any(|window| window == mark)
}
