//! Intensities as files write them: factors, signs and sizes, and the plane that closes the turn.

use crate::warning::{WarningKind, Warnings};
use crate::{Grid, Symmetry};
use quasilux_text::{Number, ParseError, Position};

/// No file means more; sums of intensities stay far from overflow.
const MAX_INTENSITY_CD: f64 = 1e18;

/// Planes at 0 and 360 may differ by this part of the greatest intensity without a warning.
const CLOSING_TOLERANCE: f64 = 1e-3;

/// Candela of a written value, of which `factor` candela are one.
pub(crate) fn intensity_cd(
    written: Number,
    factor: f64,
    warnings: &mut Warnings,
) -> Result<f64, ParseError> {
    if written.value < 0.0 {
        let expected = "intensities of 0 or more (read as 0)";
        warnings.push(WarningKind::NegativeCandela, written.at, written.value, expected);
    }
    let intensity_cd = written.value.max(0.0) * factor;
    if intensity_cd > MAX_INTENSITY_CD {
        let found = format!("an intensity of {intensity_cd:e} cd");
        return Err(ParseError::new(written.at, found, "no more than 1e18 cd"));
    }
    Ok(intensity_cd)
}

/// Notes a plane at the end of a full turn that is not the plane at its start.
pub(crate) fn check_closing(grid: &Grid, at: Position, warnings: &mut Warnings) {
    if grid.symmetry != Symmetry::None {
        return;
    }
    let columns = grid.phi_rad.len();
    let max_value = grid.values.iter().copied().fold(0.0, f64::max);
    let difference = grid
        .values
        .chunks_exact(columns)
        .map(|row| (row[0] - row[columns - 1]).abs())
        .fold(0.0, f64::max);
    if difference > CLOSING_TOLERANCE * max_value {
        let found =
            format_args!("a closing plane that differs by up to {difference} cd").to_string();
        let expected = "the values of the first plane (both are kept)";
        warnings.push(WarningKind::ClosingPlaneDiffers, at, found, expected);
    }
}
