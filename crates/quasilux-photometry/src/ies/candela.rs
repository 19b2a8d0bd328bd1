//! The candela values: plane by plane in the file, angle by angle in the table.

use super::numbers::Numbers;
use crate::report::{Position, Warnings};
use crate::{Deviation, Grid, ReadError, Symmetry};

/// No file means more; sums of intensities stay far from overflow.
const LARGEST_INTENSITY_CD: f64 = 1e18;

/// Planes at 0 and 360 may differ by this part of the greatest intensity without a warning.
const CLOSING_TOLERANCE: f64 = 1e-3;

/// The candela values as they stand in the file.
pub(super) struct Planes {
    /// Vertical angles in each plane.
    pub(super) verticals: usize,
    /// Planes.
    pub(super) horizontals: usize,
    /// Intensity of one written candela.
    pub(super) factor: f64,
}

impl Planes {
    /// Intensities row by row: all planes at the first vertical angle, then the next.
    pub(super) fn read(
        &self,
        numbers: &mut Numbers<'_>,
        warnings: &mut Warnings,
    ) -> Result<Vec<f64>, ReadError> {
        let mut intensities_cd = vec![0.0; self.verticals * self.horizontals];
        for plane in 0..self.horizontals {
            numbers.start_record("the candela values of each plane", warnings);
            for vertical in 0..self.verticals {
                let candela = numbers.next("a candela value", warnings).map_err(|error| {
                    let at = Position { line: error.line(), column: error.column() };
                    let (value, planes) = (vertical + 1, self.horizontals);
                    let expected = format!(
                        "candela value {value} of {} in plane {} of {planes}",
                        self.verticals,
                        plane + 1
                    );
                    ReadError::new(at, error.found(), expected)
                })?;
                if candela.value < 0.0 {
                    let expected = "candela values of 0 or more (read as 0)";
                    warnings.push(Deviation::NegativeCandela, candela.at, candela.value, expected);
                }
                let intensity_cd = candela.value.max(0.0) * self.factor;
                if intensity_cd > LARGEST_INTENSITY_CD {
                    let found = format!("an intensity of {intensity_cd:e} cd");
                    return Err(ReadError::new(candela.at, found, "no more than 1e18 cd"));
                }
                intensities_cd[vertical * self.horizontals + plane] = intensity_cd;
            }
        }
        Ok(intensities_cd)
    }
}

/// Notes a plane at the end of a full turn that is not the plane at its start.
pub(super) fn check_closing(grid: &Grid, at: Position, warnings: &mut Warnings) {
    if grid.symmetry != Symmetry::None {
        return;
    }
    let columns = grid.phi_rad.len();
    let greatest = grid.values.iter().copied().fold(0.0, f64::max);
    let difference = grid
        .values
        .chunks_exact(columns)
        .map(|row| (row[0] - row[columns - 1]).abs())
        .fold(0.0, f64::max);
    if difference > CLOSING_TOLERANCE * greatest {
        let found =
            format_args!("a closing plane that differs by up to {difference} cd").to_string();
        let expected = "the values of the first plane (both are kept)";
        warnings.push(Deviation::ClosingPlaneDiffers, at, found, expected);
    }
}
