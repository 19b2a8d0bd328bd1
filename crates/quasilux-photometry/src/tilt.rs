//! How much light tilted lamps give: the factors of `TILT=`, applied.
//!
//! The output of some discharge lamps depends on how they lie. A photometric file may list factors
//! by the angle that the *luminaire* is tilted from straight down, with the lamp-to-luminaire
//! geometry that says which tilt is meant (ANSI/IES LM-63-19, annex F):
//!
//! | geometry | the lamp, with the luminaire aimed straight down | tilt angle here |
//! |---|---|---|
//! | 1 | stands on its base or hangs from it | between gamma = 0 and straight down |
//! | 2 | lies, and stays level while the luminaire turns about the C0-C180 axis | about that axis |
//! | 3 | lies, and leaves the level while the luminaire turns about the C0-C180 axis | about that axis |
//!
//! Between listed angles the factor is piecewise linear. Factors that end at 90 degrees hold
//! mirrored from there to 180, as Radiance's `ies2rad` reads them; other ends are held, and
//! [`TiltSupport`] says so. Of a turn about another axis, geometries 2 and 3 say nothing: only its
//! part about C0-C180 counts, and [`TiltSupport`] says that too.

use crate::Tilt;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};

/// The smallest sine between the C0-C180 axis and the horizontal that counts as a turn about
/// another axis: a thousandth of a degree.
const LEVEL_SINE: f64 = 1.8e-5;

/// Angles that differ by less are the same, in radians.
const ANGLE_TOLERANCE_RAD: f64 = 1e-9;

/// The output of a tilted luminaire's lamps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TiltFactor {
    /// Light relative to that of the luminaire as it was measured; all intensities scale with it.
    pub factor: f64,
    /// The tilt angle that the factor belongs to.
    pub angle_rad: f64,
    /// What the file says of that angle.
    pub support: TiltSupport,
}

/// What a file says of a tilt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TiltSupport {
    /// The output does not depend on the tilt, or the angle lies between listed ones.
    Listed,
    /// The angle lies outside the listed ones: the factor of the nearest is held.
    EndHeld,
    /// The lamp lies and the luminaire is turned about another axis than C0-C180, for which there
    /// are no factors: that part of the turn counts as none.
    OtherAxis,
    /// The factors are in a file that has not been read: the factor is 1.
    NotRead,
}

impl Tilt {
    /// The factor for a luminaire placed so that straight down, in its own frame (gamma = 0 along
    /// -z, C0 along +x), is the unit vector `down`.
    pub fn factor(&self, down: DVec3) -> TiltFactor {
        if !matches!(self, Self::Include { lamp_geometry: 2 | 3, .. }) {
            return self.factor_at(angle_between(down, DVec3::NEG_Z));
        }
        let across_axis = DVec3::new(0.0, down.y, down.z);
        let tilt = self.factor_at(angle_between(across_axis, DVec3::NEG_Z));
        let is_level = down.x.abs() < LEVEL_SINE;
        TiltFactor { support: if is_level { tilt.support } else { TiltSupport::OtherAxis }, ..tilt }
    }

    /// The factor at a tilt angle between 0 (straight down) and pi (straight up).
    pub fn factor_at(&self, angle_rad: f64) -> TiltFactor {
        let unchanged = |support| TiltFactor { factor: 1.0, angle_rad, support };
        match self {
            Self::None => unchanged(TiltSupport::Listed),
            Self::File(_) => unchanged(TiltSupport::NotRead),
            Self::Include { angles_rad, factors, .. } => {
                let (Some(first_rad), Some(last_rad)) = (angles_rad.first(), angles_rad.last())
                else {
                    return unchanged(TiltSupport::Listed);
                };
                let is_mirrored = (last_rad - FRAC_PI_2).abs() < ANGLE_TOLERANCE_RAD;
                let listed_rad =
                    if is_mirrored { angle_rad.min(PI - angle_rad) } else { angle_rad };
                let is_listed = listed_rad >= first_rad - ANGLE_TOLERANCE_RAD
                    && listed_rad <= last_rad + ANGLE_TOLERANCE_RAD;
                TiltFactor {
                    factor: interpolated(angles_rad, factors, listed_rad),
                    angle_rad,
                    support: if is_listed { TiltSupport::Listed } else { TiltSupport::EndHeld },
                }
            }
        }
    }
}

/// Piecewise linear in ascending `x`, constant outside.
fn interpolated(x: &[f64], y: &[f64], at: f64) -> f64 {
    let above = x.partition_point(|&node| node <= at);
    match (above.checked_sub(1), x.get(above)) {
        (None, _) => y[0],
        (Some(below), None) => y[below],
        (Some(below), Some(end)) => {
            let t = (at - x[below]) / (end - x[below]);
            (1.0 - t) * y[below] + t * y[above]
        }
    }
}

/// Accurate at all angles; 0 where a vector has no length.
fn angle_between(a: DVec3, b: DVec3) -> f64 {
    libm::atan2(a.cross(b).length(), a.dot(b))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tilt(lamp_geometry: u8, degrees: &[f64], factors: &[f64]) -> Tilt {
        Tilt::Include {
            lamp_geometry,
            angles_rad: degrees.iter().map(|degrees| degrees / 180.0 * PI).collect(),
            factors: factors.to_vec(),
        }
    }

    fn at(tilt: &Tilt, degrees: f64) -> (f64, TiltSupport) {
        let TiltFactor { factor, support, .. } = tilt.factor_at(degrees / 180.0 * PI);
        (factor, support)
    }

    fn close(got: (f64, TiltSupport), expected: (f64, TiltSupport)) {
        assert!((got.0 - expected.0).abs() < 1e-12 && got.1 == expected.1, "{got:?}");
    }

    /// Straight down for a luminaire turned by `degrees` about its x or y axis.
    fn turned(degrees: f64, about_y: bool) -> DVec3 {
        let (sin, cos) = libm::sincos(degrees / 180.0 * PI);
        if about_y { DVec3::new(sin, 0.0, -cos) } else { DVec3::new(0.0, sin, -cos) }
    }

    #[test]
    fn linear_between_angles_and_held_beyond() {
        let full = tilt(1, &[0.0, 45.0, 90.0, 180.0], &[1.0, 0.9, 0.8, 1.0]);
        for (degrees, factor) in [(0.0, 1.0), (15.0, 0.9 + 0.1 * 2.0 / 3.0), (45.0, 0.9)] {
            close(at(&full, degrees), (factor, TiltSupport::Listed));
        }
        close(at(&full, 135.0), (0.9, TiltSupport::Listed));
        close(at(&full, 180.0), (1.0, TiltSupport::Listed));
        let part = tilt(1, &[10.0, 60.0], &[0.98, 0.7]);
        close(at(&part, 5.0), (0.98, TiltSupport::EndHeld));
        close(at(&part, 61.0), (0.7, TiltSupport::EndHeld));
        close(at(&tilt(1, &[0.0], &[0.5]), 0.0), (0.5, TiltSupport::Listed));
        close(at(&tilt(1, &[0.0], &[0.5]), 30.0), (0.5, TiltSupport::EndHeld));
    }

    #[test]
    fn factors_to_90_degrees_are_mirrored_there() {
        let half = tilt(1, &[0.0, 90.0], &[1.0, 0.5]);
        close(at(&half, 120.0), (2.0 / 3.0, TiltSupport::Listed));
        close(at(&half, 180.0), (1.0, TiltSupport::Listed));
    }

    #[test]
    fn standing_lamps_feel_every_tilt_and_lying_ones_that_about_their_axis() {
        let factors = (&[0.0, 180.0], &[1.0, 0.0]);
        let standing = tilt(1, factors.0, factors.1);
        for about_y in [false, true] {
            for degrees in [0.0, 30.0, 170.0] {
                let got = standing.factor(turned(degrees, about_y));
                close((got.factor, got.support), (1.0 - degrees / 180.0, TiltSupport::Listed));
            }
        }
        for geometry in [2, 3] {
            let lying = tilt(geometry, factors.0, factors.1);
            for degrees in [-120.0_f64, 0.0, 60.0] {
                let got = lying.factor(turned(degrees, false));
                let expected = 1.0 - degrees.abs() / 180.0;
                close((got.factor, got.support), (expected, TiltSupport::Listed));
            }
            let got = lying.factor(turned(60.0, true));
            close((got.factor, got.support), (1.0, TiltSupport::OtherAxis));
            let got = lying.factor(DVec3::X);
            close((got.factor, got.support), (1.0, TiltSupport::OtherAxis));
        }
    }

    #[test]
    fn without_factors_the_output_is_that_of_the_file() {
        let down = turned(50.0, true);
        assert_eq!(Tilt::None.factor(down).support, TiltSupport::Listed);
        let unread = Tilt::File("lamp.tlt".to_owned()).factor(down);
        assert_eq!((unread.factor, unread.support), (1.0, TiltSupport::NotRead));
    }
}
