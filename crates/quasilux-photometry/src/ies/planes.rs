//! The horizontal angles of a type C file: checks, and what symmetry the planes mean.

use crate::Symmetry;
use crate::angles::{ROUNDING_DEG, check_ascending, radians, snapped};
use crate::warning::{WarningKind, Warnings};
use quasilux_text::{Number, ParseError};

/// The half-planes of a type C file.
pub(crate) struct CPlanes {
    /// Azimuths C, ascending.
    pub(crate) phi_rad: Vec<f64>,
    /// The symmetry that their span stands for.
    pub(crate) symmetry: Symmetry,
}

/// The half-planes from their horizontal angles in degrees.
pub(crate) fn c_planes(angles: &[Number], warnings: &mut Warnings) -> Result<CPlanes, ParseError> {
    check_ascending(angles, "horizontal")?;
    let degrees: Vec<f64> = angles.iter().map(|angle| snapped(angle.value, 90.0)).collect();
    let (first, last) = (degrees[0], degrees[degrees.len() - 1]);
    let at = angles[0].at;
    if let Some(far) = angles.iter().find(|angle| angle.value.abs() > 720.0) {
        return Err(ParseError::new(far.at, far.value, "horizontal angles from 0 to 360 degrees"));
    }
    let symmetry = symmetry(angles, &degrees, warnings)?;
    let usual = first == 0.0 || (first == 90.0 && symmetry == Symmetry::Bilateral);
    // Mirrored halves and quarters need a first plane that is one of the luminaire's axes.
    if matches!(symmetry, Symmetry::Quadrant | Symmetry::Bilateral) && first % 90.0 != 0.0 {
        let found = format_args!("horizontal planes from {first} to {last}").to_string();
        return Err(ParseError::new(at, found, "planes that begin at 0 or 90 degrees"));
    }
    if !usual && symmetry != Symmetry::Rotational {
        let found = format_args!("planes from {first} to {last}").to_string();
        let expected = "planes from 0 to 90, 0 to 180, 90 to 270 or 0 to 360 (read by their span)";
        warnings.push(WarningKind::FirstPlane, at, found, expected);
    }
    Ok(CPlanes { phi_rad: degrees.into_iter().map(radians).collect(), symmetry })
}

/// The symmetry by the span of the planes; `degrees` are the angles after rounding.
fn symmetry(
    angles: &[Number],
    degrees: &[f64],
    warnings: &mut Warnings,
) -> Result<Symmetry, ParseError> {
    let (first, last) = (degrees[0], degrees[degrees.len() - 1]);
    let at = angles[0].at;
    if degrees.len() == 1 {
        if first != 0.0 {
            let found = format_args!("a single plane at {first}").to_string();
            let expected = "a single plane at 0 (read as rotationally symmetric)";
            warnings.push(WarningKind::SinglePlane, at, found, expected);
        }
        return Ok(Symmetry::Rotational);
    }
    let span = last - first;
    for (known, symmetry) in
        [(90.0, Symmetry::Quadrant), (180.0, Symmetry::Bilateral), (360.0, Symmetry::None)]
    {
        if (span - known).abs() < ROUNDING_DEG {
            return Ok(symmetry);
        }
    }
    let max_gap = degrees.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
    if span > 180.0 && span < 360.0 && 360.0 - span <= 1.5 * max_gap {
        let found = format_args!("planes that end at {last}").to_string();
        let expected = "a closing plane at 360 (taken to equal the first one)";
        let at = angles[angles.len() - 1].at;
        warnings.push(WarningKind::MissingClosingPlane, at, found, expected);
        return Ok(Symmetry::Open);
    }
    let found = format_args!("horizontal planes from {first} to {last}").to_string();
    let expected =
        "a single plane, or planes from 0 to 90, 0 to 180, 90 to 270 or 0 to 360 degrees";
    Err(ParseError::new(at, found, expected))
}
