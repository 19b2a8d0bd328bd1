//! Reader of ASTM E1392 files: reflection and transmission as a list of measured directions.
//!
//! What is read and tolerated stands in [`formats::astm`](crate::formats::astm).

mod colour;
mod exits;
mod grid;
mod lines;
mod records;

use crate::defects::warn_of_defects;
use crate::defects::warn_of_one_way;
use crate::distribution::Distribution;
use crate::facts::BsdfFacts;
use crate::facts::BsdfFormat;
use crate::gridded::GriddedTable;
use crate::measured::MeasuredBsdf;
use crate::parsed::Parsed;
use crate::side::ScatteringMode;
use crate::side::Side;
use crate::tokens::Style;
use crate::tokens::Tokens;
use crate::warning::Warnings;
use lines::{Lines, NumberedLine};
use quasilux_text::{ParseError, Position, Token, decode, lines, quoted};
use records::Records;

/// The angles that come first in each line.
const ANGLES: [&str; 4] = ["theta_i", "phi_i", "theta_s", "phi_s"];

/// What the columns behind the angles are.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Columns {
    Grey,
    Rgb,
    Xyz,
}

/// The line that names the columns.
struct Heading {
    columns: Columns,
    /// Its number, from 1.
    line: usize,
}

/// Reads an ASTM E1392 file. What is measured counts for light on the front. Total: any bytes give
/// a surface or an error with its place.
///
/// # Errors
/// [`ParseError`] with the position where the columns or the angles are not those of a measured
/// surface, or a value is no number.
pub fn read_astm(bytes: &[u8]) -> Result<Parsed, ParseError> {
    let mut warnings = Warnings::default();
    let text = decode(bytes, &mut warnings);
    let numbered = (1..).zip(lines(text.trim_start_matches('\u{FEFF}')));
    let mut all = numbered.map(|(number, text)| NumberedLine { number, text });
    let Some(Heading { columns, line: first_line }) = heading(&mut all)? else {
        let at = Position { line: 1, column: 1 };
        return Err(ParseError::new(at, "no line VARS", "VARS theta_i,phi_i,theta_s,phi_s,..."));
    };
    let lines = Lines::survey(all, columns, &mut warnings).ok_or_else(|| {
        let at = Position { line: first_line, column: 1 };
        ParseError::new(at, "VARS without data", "a line for each pair of directions")
    })?;
    let at = lines.first();
    let tables = if columns == Columns::Grey {
        tables::<1>(&lines, &mut warnings)?
    } else {
        tables::<3>(&lines, &mut warnings)?
    };

    let facts = BsdfFacts {
        format: BsdfFormat::Astm,
        name: String::new(),
        manufacturer: String::new(),
        thickness_m: None,
    };
    let mut bsdf = MeasuredBsdf::new(facts);
    for (mode, table) in ScatteringMode::ALL.into_iter().zip(tables) {
        if let Some(table) = table {
            bsdf.set(Side::Front, mode, Distribution::Gridded(table));
        }
    }
    warn_of_one_way(&bsdf, at, &mut warnings);
    warn_of_defects(&bsdf, at, &mut warnings)?;
    Ok(Parsed { bsdf, warnings: warnings.into_vec() })
}

/// The tables of reflection and of transmission, where there are lines, of one or three channels.
fn tables<'t, const N: usize>(
    lines: &Lines<impl Iterator<Item = NumberedLine<'t>> + Clone>,
    warnings: &mut Warnings,
) -> Result<[Option<GriddedTable>; 2], ParseError> {
    let records = Records::<N>::read(lines, warnings)?;
    let reflection = grid::table(&records, ScatteringMode::Reflection, warnings)?;
    let transmission = grid::table(&records, ScatteringMode::Transmission, warnings)?;
    Ok([reflection, transmission])
}

/// Whether a line names the columns.
pub(super) fn names_columns(line: &[u8]) -> bool {
    let word = line.split(u8::is_ascii_whitespace).find(|word| !word.is_empty());
    word.is_some_and(|word| word.eq_ignore_ascii_case(b"VARS"))
}

/// The line that names the columns.
fn heading<'t>(
    lines: &mut impl Iterator<Item = NumberedLine<'t>>,
) -> Result<Option<Heading>, ParseError> {
    let Some(found) = lines.find(|line| names_columns(line.text.as_bytes())) else {
        return Ok(None);
    };
    let NumberedLine { number: line, text } = found;
    let start = Position { line, column: 1 };
    let names: Vec<Token<'_>> = Tokens::new(text, start, Style::Plain).skip(1).collect();
    for (index, expected) in ANGLES.iter().enumerate() {
        let name = names.get(index).map_or("nothing", |name| name.text);
        if !name.eq_ignore_ascii_case(expected) {
            let at = names.get(index).map_or(start, |name| name.at);
            let all = ANGLES.join(",");
            return Err(ParseError::new(
                at,
                quoted(name),
                format_args!("the columns {all}, then f"),
            ));
        }
    }
    let values: Vec<String> =
        names[4..].iter().map(|name| name.text.to_ascii_uppercase()).collect();
    let values: Vec<&str> = values.iter().map(String::as_str).collect();
    let columns = match values[..] {
        [_] => Columns::Grey,
        ["R", "G", "B"] => Columns::Rgb,
        ["X", "Y", "Z"] => Columns::Xyz,
        _ => {
            let found = format!("{} columns of values", values.len());
            return Err(ParseError::new(start, found, "one, or R,G,B or X,Y,Z"));
        }
    };
    Ok(Some(Heading { columns, line }))
}
