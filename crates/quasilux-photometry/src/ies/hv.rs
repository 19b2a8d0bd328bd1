//! The angles (H, V) of types A and B: checks, mirror images, and the grid in the frame of the
//! table.
//!
//! ANSI/IESNA LM-63-2002 lets vertical angles run from -90 or 0 to 90, and horizontal angles from
//! -90 to 90, or from 0 to 90 in a luminaire whose sides mirror each other. One of the two is a
//! latitude, between the poles of the [`Web`](crate::Web), the other a longitude around them. Where
//! nothing was measured the intensity is zero; the standard's sector is the half of the sphere that
//! the beam lies in.

use crate::angles::{check_ascending, radians, snapped};
use crate::warning::{WarningKind, Warnings};
use crate::{Grid, PhotometricType, Symmetry};
use quasilux_text::{Number, ParseError};
use std::f64::consts::FRAC_PI_2;

/// The angles of a type A or B file, checked.
pub(crate) struct HvAngles {
    photometric_type: PhotometricType,
    horizontal: Side,
    vertical: Side,
}

/// The angles of one kind in degrees, ascending, mirror images included.
struct Side {
    degrees: Vec<f64>,
    /// Which of the file's angles each one stands for.
    source: Vec<usize>,
}

impl HvAngles {
    /// The lists of horizontal and of vertical angles of a file.
    pub(crate) fn check(
        photometric_type: PhotometricType,
        horizontal: &[Number],
        vertical: &[Number],
        warnings: &mut Warnings,
    ) -> Result<Self, ParseError> {
        // A latitude ends at the poles, a longitude where it meets itself.
        let (horizontal_limit, vertical_limit) = match photometric_type {
            PhotometricType::A => (180.0, 90.0),
            _ => (90.0, 180.0),
        };
        let vertical_side = Side::read(vertical, "vertical", vertical_limit)?;
        let horizontal_side = Side::read(horizontal, "horizontal", horizontal_limit)?;
        note_range(vertical, "vertical", WarningKind::VerticalRange, warnings);
        note_range(horizontal, "horizontal", WarningKind::HorizontalRange, warnings);
        if vertical_side.source[0] > 0 {
            let expected = "angles from -90 (the half below 0 is taken to mirror that above)";
            let found = "vertical angles that begin at 0";
            warnings.push(WarningKind::VerticalMirror, vertical[0].at, found, expected);
        }
        Ok(Self { photometric_type, horizontal: horizontal_side, vertical: vertical_side })
    }

    /// The grid of the table, from the file's values: those of all horizontal angles at the first
    /// vertical one, then the next.
    pub(crate) fn grid(&self, horizontals: usize, values: &[f64]) -> Grid {
        let (latitude, longitude, row_stride, column_stride) = match self.photometric_type {
            PhotometricType::A => (&self.vertical, &self.horizontal, horizontals, 1),
            _ => (&self.horizontal, &self.vertical, 1, horizontals),
        };
        let (first, last) = (longitude.degrees[0], longitude.degrees[longitude.degrees.len() - 1]);
        let at = |row: usize, column: usize| values[row * row_stride + column * column_stride];
        let row = |row: usize| longitude.source.iter().map(move |&column| at(row, column));
        Grid {
            theta_rad: latitude.degrees.iter().map(|&d| FRAC_PI_2 + radians(d)).collect(),
            phi_rad: longitude.degrees.iter().map(|&d| radians(d)).collect(),
            symmetry: if last - first == 360.0 { Symmetry::None } else { Symmetry::Sector },
            values: latitude.source.iter().flat_map(|&source| row(source)).collect(),
        }
    }
}

impl Side {
    fn read(angles: &[Number], what: &str, limit_deg: f64) -> Result<Self, ParseError> {
        if let [single] = angles {
            let found = format_args!("a single {what} angle").to_string();
            let expected = "two or more, as types A and B need";
            return Err(ParseError::new(single.at, found, expected));
        }
        check_ascending(angles, what)?;
        let measured = in_degrees(angles);
        for (angle, degrees) in angles.iter().zip(&measured) {
            if degrees.abs() > limit_deg {
                let expected =
                    format!("{what} angles between -{limit_deg} and {limit_deg} degrees");
                return Err(ParseError::new(angle.at, degrees, expected));
            }
        }
        let count = measured.len();
        let images = if measured[0] == 0.0 { count - 1 } else { 0 };
        let source: Vec<usize> = (0..images).map(|i| count - 1 - i).chain(0..count).collect();
        let sign = |index| if index < images { -1.0 } else { 1.0 };
        let degrees = source.iter().enumerate().map(|(i, &j)| sign(i) * measured[j]).collect();
        Ok(Self { degrees, source })
    }
}

/// Notes angles that do not cover what the standard asks for.
fn note_range(angles: &[Number], what: &str, deviation: WarningKind, warnings: &mut Warnings) {
    let degrees = in_degrees(angles);
    let (first, last) = (degrees[0], degrees[degrees.len() - 1]);
    if !(matches!(first, -90.0 | 0.0) && last == 90.0) {
        let found = format_args!("{what} angles from {first} to {last}").to_string();
        let expected = "-90 or 0 to 90 degrees (elsewhere, the intensity is zero)";
        warnings.push(deviation, angles[0].at, found, expected);
    }
}

fn in_degrees(angles: &[Number]) -> Vec<f64> {
    angles.iter().map(|angle| snapped(angle.value, 90.0)).collect()
}
