//! Gaps between measured azimuths.
//!
//! Between azimuths values are interpolated. How much scattered light leaves the plane of incidence
//! shows a quarter turn away from that plane: over wider gaps nothing tells, and a narrow lobe
//! would be smeared over all of it. Of an isotropic surface, whose lobes are mirrored in the plane
//! of incidence, harmonics up to the second are told apart by azimuths a quarter turn apart; an
//! eighth of a turn leaves room for what a smooth lobe has besides. Azimuths *about* the mirror
//! direction smear no lobe, however wide: a quarter turn is narrow enough there, and between
//! azimuths of incidence.

use crate::warning::WarningKind;
use crate::warning::Warnings;
use quasilux_text::Position;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};

/// Angles of a file are rounded by no more, in radians.
const ROUNDING_RAD: f64 = 1e-3;

/// What a gap means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Gap {
    /// An eighth of a turn at most.
    Narrow,
    /// A quarter of a turn at most.
    Wide,
    /// More than that.
    Open,
}

pub(super) fn judge(gap_rad: f64) -> Gap {
    if gap_rad <= FRAC_PI_4 + ROUNDING_RAD {
        Gap::Narrow
    } else if gap_rad <= FRAC_PI_2 + ROUNDING_RAD {
        Gap::Wide
    } else {
        Gap::Open
    }
}

/// The widest gap between ascending azimuths, none at the ends; 0 of one alone.
pub(super) fn between(azimuths_rad: &[f64]) -> f64 {
    azimuths_rad.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max)
}

/// The same around a turn: that of one alone is a whole turn.
pub(super) fn around(azimuths_rad: &[f64]) -> f64 {
    let [first, .., last] = azimuths_rad else {
        return TAU;
    };
    between(azimuths_rad).max(first + TAU - last)
}

/// The same within half a turn that is mirrored at both its ends.
pub(super) fn mirrored(azimuths_rad: &[f64]) -> f64 {
    let (Some(first), Some(last)) = (azimuths_rad.first(), azimuths_rad.last()) else {
        return TAU;
    };
    let at_ends = (2.0 * first).max(TAU - 2.0 * last);
    between(azimuths_rad).max(at_ends)
}

/// Warns of an open gap between azimuths of incidence.
pub(super) fn warn_of_incidence(gap_rad: f64, at: Position, warnings: &mut Warnings) {
    if judge(gap_rad) != Gap::Open {
        return;
    }
    let degrees = gap_rad.to_degrees();
    let found = format!("incident azimuths that leave a gap of {degrees:.0} degrees");
    let expected = "gaps of 90 degrees at most (lobes are mixed across it)";
    warnings.push(WarningKind::AzimuthGap, at, found, expected);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_are_those_of_the_circle_or_of_its_half() {
        let degrees = |angles: &[f64]| angles.iter().map(|a| a.to_radians()).collect::<Vec<_>>();
        for (angles, whole, half) in [
            (&[0.0, 90.0, 180.0, 270.0][..], 90.0, 90.0),
            (&[0.0, 180.0], 180.0, 180.0),
            (&[0.0, 45.0, 90.0], 270.0, 180.0),
            (&[0.0], 360.0, 360.0),
            (&[10.0, 100.0, 170.0], 200.0, 90.0),
        ] {
            let angles = degrees(angles);
            assert!((around(&angles).to_degrees() - whole).abs() < 1e-9, "{angles:?}");
            if angles.last().is_some_and(|last| *last <= std::f64::consts::PI) {
                assert!((mirrored(&angles).to_degrees() - half).abs() < 1e-9, "{angles:?}");
            }
        }
        assert_eq!(judge(FRAC_PI_4), Gap::Narrow);
        assert_eq!(judge(FRAC_PI_2), Gap::Wide);
        assert_eq!(judge(1.6), Gap::Open);
    }
}
