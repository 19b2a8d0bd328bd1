//! Which format a file of a measured surface has, and what a reader returns.

use crate::astm;
use crate::astm::read_astm;
use crate::ddr::read_ddr;
use crate::merl;
use crate::merl::read_merl;
use crate::parsed::Parsed;
use crate::side::ScatteringMode;
use crate::warning::WarningKind;
use crate::warning::Warnings;
use crate::window_xml::read_bsdf_xml;
use quasilux_text::{ParseError, Position, quoted};

/// The mark of a format stands within this many bytes, those of comments before it not counted.
const SEARCHED: usize = 1 << 14;

/// Reads a measured surface of any known format, told by the content; that of a DDR file is
/// reflection, with a warning, see [`read_bsdf_named`]. Total: any bytes give a surface or an error
/// with its place, in memory bounded by [`max_bsdf_memory_bytes`](crate::max_bsdf_memory_bytes).
///
/// # Errors
/// [`ParseError`] for content of no known format, and all errors of the reader of the format.
pub fn read_bsdf(bytes: &[u8]) -> Result<Parsed, ParseError> {
    read_bsdf_named("", bytes)
}

/// The same with the name of the file, whose extension tells reflection, `.ddr`, from transmission,
/// `.ddt`.
///
/// # Errors
/// All errors of [`read_bsdf`].
pub fn read_bsdf_named(name: &str, bytes: &[u8]) -> Result<Parsed, ParseError> {
    quasilux_text::refuse_web_page(bytes)?;
    if merl::counts(bytes).is_some() {
        return read_merl(bytes);
    }
    let start = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes).trim_ascii_start();
    let is_wide = matches!(bytes, [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..]);
    if start.starts_with(b"<") || is_wide || contains(bytes, b"<WindowElement") {
        return read_bsdf_xml(bytes);
    }
    let searched = behind_comments(start);
    let searched = &searched[..searched.len().min(SEARCHED)];
    let has_line = |is_mark: fn(&[u8]) -> bool| lines(searched).any(is_mark);
    if has_line(astm::names_columns) {
        return read_astm(bytes);
    }
    if has_line(begins_ddr) { read_ddr_named(name, bytes) } else { Err(unknown(bytes)) }
}

/// The content of DDR and DDT files does not tell which it is.
fn read_ddr_named(name: &str, bytes: &[u8]) -> Result<Parsed, ParseError> {
    let extension = name.rsplit_once('.').map_or("", |(_, extension)| extension);
    let is = |known: &str| extension.eq_ignore_ascii_case(known);
    let mode = if is("ddt") { ScatteringMode::Transmission } else { ScatteringMode::Reflection };
    let mut read = read_ddr(bytes, mode)?;
    if !is("ddt") && !is("ddr") {
        let mut warnings = Warnings::default();
        let at = Position { line: 1, column: 1 };
        let found = if name.is_empty() {
            "no name".to_owned()
        } else {
            format!("the name {}", quoted(name))
        };
        let expected =
            "a name in .ddr for reflection, or .ddt for transmission (read as reflection)";
        warnings.push(WarningKind::UnknownScatteringMode, at, found, expected);
        read.warnings.splice(..0, warnings.into_vec());
    }
    Ok(read)
}

/// A line that only the head of a DDR file has.
fn begins_ddr(line: &[u8]) -> bool {
    let word = line.split(u8::is_ascii_whitespace).find(|word| !word.is_empty());
    let is = |known: &&[u8]| word.is_some_and(|word| word.eq_ignore_ascii_case(known));
    [&b"typesym"[..], b"typecolormodel", b"sigma"].iter().any(is)
}

/// What follows after lines that are empty or comments.
fn behind_comments(bytes: &[u8]) -> &[u8] {
    let is_end = |byte: &u8| matches!(byte, b'\n' | b'\r');
    let mut rest = bytes.trim_ascii_start();
    while let [b';' | b'#', ..] = rest {
        let end = rest.iter().position(is_end).unwrap_or(rest.len());
        rest = rest[end..].trim_ascii_start();
    }
    rest
}

fn lines(bytes: &[u8]) -> impl Iterator<Item = &[u8]> {
    bytes.split(|byte| matches!(byte, b'\n' | b'\r'))
}

/// Why a file of no known format is refused: what it seems to be.
fn unknown(bytes: &[u8]) -> ParseError {
    let at = Position { line: 1, column: 1 };
    let found = if bytes.starts_with(b"tensor_file\0") {
        "a container of tensors (RGL, .bsdf or .pbsdf)"
    } else if contains(bytes, b"{ Units, Wavelength Units }") {
        "spectra of a glazing (Optics, .dat)"
    } else if is_json(bytes) {
        return ParseError::new(
            at,
            "JSON",
            "a measured surface; a glazing product of the IGSDB \
            goes into layers of kind = \"glazing\"",
        );
    } else if bytes.is_empty() {
        "an empty file"
    } else {
        "none of their marks"
    };
    ParseError::new(at, found, "a measured surface: WINDOW XML, MERL, ASTM E1392 or DDR")
}

fn is_json(bytes: &[u8]) -> bool {
    bytes.trim_ascii_start().starts_with(b"{") && bytes.trim_ascii_end().ends_with(b"}")
}

/// Whether the mark stands near the beginning.
fn contains(bytes: &[u8], mark: &[u8]) -> bool {
    bytes.windows(mark.len()).take(SEARCHED).any(|window| window == mark)
}
