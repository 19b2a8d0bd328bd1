//! Which C-planes a symmetry stores, and the azimuths they stand at.

use crate::Symmetry;
use crate::angles::{ROUNDING_DEG, check_ascending, radians, snapped};
use crate::warning::{WarningKind, Warnings};
use quasilux_text::{Number, ParseError, Position};

/// The gap that closes the turn may be as wide as this many of the others.
const WIDEST_GAP: f64 = 1.5;

/// The planes that a file stores, in its order.
pub(super) struct StoredPlanes {
    /// Ascending; those of C270 to C360 are one turn lower, before C0.
    pub(super) phi_rad: Vec<f64>,
    pub(super) symmetry: Symmetry,
}

/// Stored planes of a list of all planes. The format numbers them from Mc1 to Mc2:
///
/// | Isym | Mc1 | Mc2 | planes |
/// |---|---|---|---|
/// | 0 | 1 | Mc | all |
/// | 1 | 1 | 1 | one |
/// | 2 | 1 | Mc/2 + 1 | C0 to C180 |
/// | 3 | 3 Mc/4 + 1 | Mc1 + Mc/2 | C270 over C0 to C90 |
/// | 4 | 1 | Mc/4 + 1 | C0 to C90 |
///
/// They are found by their angles: the numbers agree with these for planes at equal distances, and
/// unequal ones need not have as many planes in each quarter.
pub(super) fn stored_planes(
    isym: usize,
    isym_at: Position,
    angles: &[Number],
    warnings: &mut Warnings,
) -> Result<StoredPlanes, ParseError> {
    check_ascending(angles, "C-plane")?;
    let degrees: Vec<f64> = angles.iter().map(|angle| snapped(angle.value, 90.0)).collect();
    if let Some(index) = degrees.iter().position(|degrees| !(0.0..=360.0).contains(degrees)) {
        let expected = "C-planes between 0 and 360 degrees";
        return Err(ParseError::new(angles[index].at, angles[index].value, expected));
    }
    let plane = |angle: f64| {
        degrees.iter().position(|&degrees| degrees == angle).ok_or_else(|| {
            let found = format_args!("no plane C{angle}, which Isym = {isym} needs").to_string();
            ParseError::new(isym_at, found, "the planes of its axes in the list of field 28")
        })
    };
    let (planes_deg, symmetry): (Vec<f64>, Symmetry) = match isym {
        1 => (vec![0.0], Symmetry::Rotational),
        2 => (degrees[plane(0.0)?..=plane(180.0)?].to_vec(), Symmetry::Bilateral),
        3 => {
            let (c0, c90, c270) = (plane(0.0)?, plane(90.0)?, plane(270.0)?);
            let before = degrees[c270..].iter().filter(|&&degrees| degrees < 360.0);
            let before = before.map(|degrees| degrees - 360.0);
            (before.chain(degrees[c0..=c90].iter().copied()).collect(), Symmetry::Bilateral)
        }
        4 => (degrees[plane(0.0)?..=plane(90.0)?].to_vec(), Symmetry::Quadrant),
        _ if degrees.len() == 1 => {
            let expected = "Isym = 1 for a single plane (read as rotationally symmetric)";
            let found = "Isym = 0 with a single plane";
            warnings.push(WarningKind::SinglePlaneWithoutSymmetry, isym_at, found, expected);
            (vec![0.0], Symmetry::Rotational)
        }
        _ if degrees[degrees.len() - 1] - degrees[0] == 360.0 => {
            let expected = "planes below 360, the closing one left out (it is kept)";
            let at = angles[angles.len() - 1].at;
            warnings.push(WarningKind::ClosingPlaneGiven, at, "a plane at 360", expected);
            (degrees, Symmetry::None)
        }
        _ => {
            note_gap(isym_at, &degrees, warnings);
            (degrees, Symmetry::Open)
        }
    };
    Ok(StoredPlanes { phi_rad: planes_deg.into_iter().map(radians).collect(), symmetry })
}

/// Notes planes that do not go all around: those of a luminaire whose symmetry is left unsaid.
fn note_gap(isym_at: Position, degrees: &[f64], warnings: &mut Warnings) {
    let (first, last) = (degrees[0], degrees[degrees.len() - 1]);
    let widest = degrees.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
    if first + 360.0 - last > WIDEST_GAP * widest {
        let found = format_args!("Isym = 0 with planes from {first} to {last}").to_string();
        let expected = "planes all around (the gap is interpolated; check Isym)";
        warnings.push(WarningKind::PlanesMissing, isym_at, found, expected);
    }
}

/// Notes a distance that the listed angles do not have; 0 says that they are unequal.
pub(super) fn check_distance(
    distance: &Number,
    angles: &[Number],
    what: &str,
    warnings: &mut Warnings,
) {
    let differs = |pair: &[Number]| {
        (pair[1].value - pair[0].value - distance.value).abs() > 10.0 * ROUNDING_DEG
    };
    if distance.value != 0.0 && angles.windows(2).any(differs) {
        let found = format_args!("a distance of {} degrees", distance.value).to_string();
        let expected = format!("the distance of all {what}, or 0 if unequal (the list counts)");
        warnings.push(WarningKind::AngleDistance, distance.at, found, expected);
    }
}
