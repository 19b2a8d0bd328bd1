//! Reader of ASTM E1392 files: reflection as a list of measured directions.
//!
//! What is read and tolerated stands in [`formats::astm`](crate::formats::astm).

mod grid;

use super::defects::warn_of_defects;
use super::pieces::{self, Pieces, Style};
use super::read::{BsdfFormat, ReadBsdf};
use super::{BsdfFacts, Distribution, MeasuredBsdf, Side, Way};
use crate::number::Written;
use crate::report::{Position, Warnings, quoted};
use crate::{Deviation, ReadError, text};
use std::f64::consts::{FRAC_PI_2, TAU};

/// The angles that come first in each line.
const ANGLES: [&str; 4] = ["theta_i", "phi_i", "theta_s", "phi_s"];

/// What the columns behind the angles are.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Columns {
    Grey,
    Rgb,
    Xyz,
}

/// One line of data.
#[derive(Clone, Copy, Debug)]
struct Record {
    line: usize,
    /// Polar angle and azimuth of the incident, then of the scattered direction.
    angles_rad: [f64; 4],
    /// Linear RGB, or a grey value thrice.
    f: [f64; 3],
}

/// Reads an ASTM E1392 file. What is measured counts for light on the front. Total: any bytes give a surface or an error with its
/// place.
pub fn read_astm(bytes: &[u8]) -> Result<ReadBsdf, ReadError> {
    let mut warnings = Warnings::default();
    let text = text::decode(bytes, &mut warnings);
    let mut lines = (1..).zip(text::lines(text.trim_start_matches('\u{FEFF}')));
    let Some((columns, first_line)) = columns(&mut lines)? else {
        let at = Position { line: 1, column: 1 };
        return Err(ReadError::new(at, "no line VARS", "VARS theta_i,phi_i,theta_s,phi_s,..."));
    };
    let mut records = Vec::new();
    for (line, text) in lines {
        if !text.trim().is_empty() && !text.trim_start().starts_with('#') {
            records.push(record(line, text, columns, &mut warnings)?);
        }
    }
    let Some(first) = records.first() else {
        let at = Position { line: first_line, column: 1 };
        return Err(ReadError::new(at, "VARS without data", "a line for each pair of directions"));
    };
    let at = Position { line: first.line, column: 1 };
    turn_degrees_to_radians(&mut records, at, &mut warnings)?;
    let table = grid::table(records, columns != Columns::Grey, at)?;

    let facts = BsdfFacts {
        format: BsdfFormat::Astm,
        name: String::new(),
        manufacturer: String::new(),
        thickness_m: None,
    };
    let mut bsdf = MeasuredBsdf::new(facts);
    bsdf.set(Side::Front, Way::Reflection, Distribution::Gridded(table));
    warn_of_defects(&bsdf, at, &mut warnings);
    Ok(ReadBsdf { bsdf, warnings: warnings.into_vec() })
}

/// Whether a line names the columns.
pub(super) fn names_columns(line: &str) -> bool {
    line.split_whitespace().next().is_some_and(|word| word.eq_ignore_ascii_case("VARS"))
}

/// The columns, and the line that names them.
fn columns<'t>(
    lines: &mut impl Iterator<Item = (usize, &'t str)>,
) -> Result<Option<(Columns, usize)>, ReadError> {
    let Some((line, text)) = lines.find(|(_, text)| names_columns(text)) else {
        return Ok(None);
    };
    let start = Position { line, column: 1 };
    let names: Vec<Written<'_>> = Pieces::new(text, start, Style::Plain).skip(1).collect();
    for (index, expected) in ANGLES.iter().enumerate() {
        let name = names.get(index).map_or("nothing", |name| name.text);
        if !name.eq_ignore_ascii_case(expected) {
            let at = names.get(index).map_or(start, |name| name.at);
            let all = ANGLES.join(",");
            return Err(ReadError::new(
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
            return Err(ReadError::new(start, found, "one, or R,G,B or X,Y,Z"));
        }
    };
    Ok(Some((columns, line)))
}

fn record(
    line: usize,
    text: &str,
    columns: Columns,
    warnings: &mut Warnings,
) -> Result<Record, ReadError> {
    let mut pieces = Pieces::new(text, Position { line, column: 1 }, Style::Plain);
    let count = if columns == Columns::Grey { 5 } else { 7 };
    let mut next = |index: usize| {
        let end = pieces.at();
        let expected = format_args!("{count} numbers a line").to_string();
        pieces.next().ok_or_else(|| ReadError::new(end, format_args!("{index} of them"), expected))
    };
    let mut angles = [0.0; 4];
    for (index, angle) in angles.iter_mut().enumerate() {
        *angle = next(index)?.number("an angle")?.value;
    }
    let mut values = [0.0; 3];
    for (index, value) in values.iter_mut().take(count - 4).enumerate() {
        *value = pieces::value(next(4 + index)?, warnings)?;
    }
    if let Some(further) = pieces.next() {
        let expected = format!("the end of the line after {count} numbers");
        return Err(ReadError::new(further.at, quoted(further.text), expected));
    }
    let f = match columns {
        Columns::Grey => [values[0]; 3],
        Columns::Rgb => values,
        Columns::Xyz => rgb(values),
    };
    Ok(Record { line, angles_rad: angles, f })
}

/// Linear RGB of ITU-R BT.709 from CIE XYZ; what is outside its gamut is cut.
fn rgb([x, y, z]: [f64; 3]) -> [f64; 3] {
    [
        3.240_969_9 * x - 1.537_383_2 * y - 0.498_610_8 * z,
        -0.969_243_6 * x + 1.875_967_5 * y + 0.041_555_1 * z,
        0.055_630_1 * x - 0.203_977_0 * y + 1.056_971_5 * z,
    ]
    .map(|channel| channel.max(0.0))
}

/// Angles are in radians; polar ones above a quarter turn can only be degrees.
fn turn_degrees_to_radians(
    records: &mut [Record],
    at: Position,
    warnings: &mut Warnings,
) -> Result<(), ReadError> {
    let polar = |record: &Record| record.angles_rad[0].max(record.angles_rad[2]);
    let greatest = records.iter().map(polar).fold(0.0, f64::max);
    if greatest > FRAC_PI_2 + 0.01 {
        let found = format!("a polar angle of {greatest}");
        let expected = "radians, pi/2 at most (all angles are read as degrees)";
        warnings.push(Deviation::AnglesInDegrees, at, found, expected);
        for angle in records.iter_mut().flat_map(|record| record.angles_rad.iter_mut()) {
            *angle = angle.to_radians();
        }
    }
    for record in records {
        for polar in [0, 2] {
            let angle = &mut record.angles_rad[polar];
            if !(-1e-9..=FRAC_PI_2 + 0.01).contains(angle) {
                let at = Position { line: record.line, column: 1 };
                let found = format!("a polar angle of {:.3} degrees", angle.to_degrees());
                return Err(ReadError::new(at, found, "0 to 90 degrees"));
            }
            *angle = angle.clamp(0.0, FRAC_PI_2);
        }
        for azimuth in [1, 3] {
            record.angles_rad[azimuth] = record.angles_rad[azimuth].rem_euclid(TAU);
        }
    }
    Ok(())
}
