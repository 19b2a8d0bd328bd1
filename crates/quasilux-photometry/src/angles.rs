//! Angles as files write them, in degrees: checks, rounding, and the polar axis of type C.

use crate::warning::{WarningKind, Warnings};
use quasilux_text::{Number, ParseError};
use std::f64::consts::PI;

/// Written angles may miss a border by this much, in degrees.
pub(crate) const ROUNDING_DEG: f64 = 1e-3;

/// Polar angles gamma in radians: ascending within 0 to 180 degrees.
pub(crate) fn gamma_rad(
    angles: &[Number],
    warnings: &mut Warnings,
) -> Result<Vec<f64>, ParseError> {
    check_ascending(angles, "vertical")?;
    let degrees: Vec<f64> = angles.iter().map(|angle| snapped(angle.value, 90.0)).collect();
    for (angle, degrees) in angles.iter().zip(&degrees) {
        if !(0.0..=180.0).contains(degrees) {
            let expected = "vertical angles between 0 and 180 degrees, as type C has them";
            return Err(ParseError::new(angle.at, degrees, expected));
        }
    }
    let (first, last) = (degrees[0], degrees[degrees.len() - 1]);
    if !matches!(first, 0.0 | 90.0) || !matches!(last, 90.0 | 180.0) {
        let found = format_args!("vertical angles from {first} to {last}").to_string();
        let expected = "0 to 90, 90 to 180 or 0 to 180 degrees (outside, the intensity is zero)";
        warnings.push(WarningKind::VerticalRange, angles[0].at, found, expected);
    }
    Ok(degrees.into_iter().map(radians).collect())
}

/// Refuses angles that do not ascend.
pub(crate) fn check_ascending(angles: &[Number], what: &str) -> Result<(), ParseError> {
    match angles.windows(2).find(|pair| pair[1].value <= pair[0].value) {
        Some(pair) => {
            let found = format!("{} after {}", pair[1].value, pair[0].value);
            Err(ParseError::new(
                pair[1].at,
                found,
                format_args!("{what} angles in ascending order"),
            ))
        }
        None => Ok(()),
    }
}

/// The angle, or the multiple of `step` that it misses by rounding only.
pub(crate) fn snapped(degrees: f64, step: f64) -> f64 {
    let near = (degrees / step).round() * step;
    if (degrees - near).abs() < ROUNDING_DEG { near } else { degrees }
}

/// Exact at multiples of 90 degrees.
pub(crate) fn radians(degrees: f64) -> f64 {
    degrees / 180.0 * PI
}
