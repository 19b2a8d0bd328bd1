//! Tilt factors: four lines behind `TILT=INCLUDE`, or a file of the same four.
//!
//! | line | values |
//! |---|---|
//! | 1 | lamp-to-luminaire geometry, 1 to 3 |
//! | 2 | number of pairs of angles and factors |
//! | 3 | tilt angles in degrees, ascending, 0 is straight down |
//! | 4 | factors, one for each angle |
//!
//! `TILT=<file>` came with LM-63-1986 and went with LM-63-2019.

use super::numbers::Numbers;
use crate::Tilt;
use crate::angles::{check_ascending, radians, snapped};
use crate::count::Count;
use crate::warning::{Warning, WarningKind, Warnings};
use quasilux_text::{ParseError, Position, Token, decode, lines, quoted};

/// A lamp does not get brighter than this by lying down; a greater number is no factor.
const MAX_FACTOR: f64 = 100.0;

/// A tilt file that was read, with what was odd about it.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct ReadTilt {
    /// The factors: always [`Tilt::Include`].
    pub tilt: Tilt,
    /// Deviations from the standard that were tolerated.
    pub warnings: Vec<Warning>,
}

/// Reads the file that `TILT=<file>` names. Total: any bytes give factors or an error with its
/// place, and memory is bounded by a multiple of the file's length.
///
/// # Errors
/// [`ParseError`] with the position where an angle or a factor is missing, no number or out of
/// range.
pub fn read_tilt(bytes: &[u8]) -> Result<ReadTilt, ParseError> {
    let mut warnings = Warnings::default();
    let text = decode(bytes, &mut warnings);
    let lines: Vec<&str> = lines(&text).collect();
    let mut numbers = Numbers::new(&lines, 0);
    let tilt = read_factors(&mut numbers, &mut warnings)?;
    if let Some(Token { text, at }) = numbers.after_last(&mut warnings) {
        warnings.push(WarningKind::TrailingText, at, quoted(text), "the end of the file");
    }
    Ok(ReadTilt { tilt, warnings: warnings.into_vec() })
}

/// The four lines.
pub(super) fn read_factors(
    numbers: &mut Numbers<'_>,
    warnings: &mut Warnings,
) -> Result<Tilt, ParseError> {
    let Count { value: lamp_geometry, at } =
        numbers.count("the lamp-to-luminaire geometry", 1, warnings)?;
    if lamp_geometry > 3 {
        let expected = "a lamp-to-luminaire geometry of 1, 2 or 3";
        return Err(ParseError::new(at, lamp_geometry, expected));
    }
    let pairs = numbers.count("the number of tilt angles", 1, warnings)?.value;
    let angles = numbers.list(pairs, "tilt angle", warnings)?;
    let factors = numbers.list(pairs, "tilt factor", warnings)?;

    check_ascending(&angles, "tilt")?;
    let degrees: Vec<f64> = angles.iter().map(|angle| snapped(angle.value, 90.0)).collect();
    let (first, last) = (degrees[0], degrees[pairs - 1]);
    for (angle, degrees) in angles.iter().zip(&degrees) {
        if !(0.0..=180.0).contains(degrees) {
            return Err(ParseError::new(
                angle.at,
                degrees,
                "tilt angles between 0 and 180 degrees",
            ));
        }
    }
    if let Some(factor) = factors.iter().find(|f| !(0.0..=MAX_FACTOR).contains(&f.value)) {
        return Err(ParseError::new(factor.at, factor.value, "a tilt factor between 0 and 100"));
    }
    if first != 0.0 || !matches!(last, 90.0 | 180.0) {
        let found = format_args!("tilt angles from {first} to {last}").to_string();
        let expected = "0 to 90 or 0 to 180 degrees (outside, the nearest factor holds)";
        warnings.push(WarningKind::TiltFactors, angles[0].at, found, expected);
    }
    Ok(Tilt::Include {
        lamp_geometry: lamp_geometry as u8,
        angles_rad: degrees.into_iter().map(radians).collect(),
        factors: factors.iter().map(|factor| factor.value).collect(),
    })
}

/// Notes factors that are in another file.
pub(super) fn in_another_file(name: &str, line: usize, warnings: &mut Warnings) -> Tilt {
    let found = format_args!("a tilt file {}", quoted(name)).to_string();
    let expected = "TILT=NONE or TILT=INCLUDE (the factor is 1 until that file is read)";
    warnings.push(WarningKind::TiltFile, Position { line, column: 1 }, found, expected);
    Tilt::File(name.to_owned())
}
