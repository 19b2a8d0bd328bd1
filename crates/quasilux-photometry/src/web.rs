//! The photometric web: between the luminaire frame, a file's own angles, and the frame of the
//! table.
//!
//! Each type of photometry has its poles elsewhere. A table that has its own where the web has them
//! needs no resampling: what is left is a signed permutation of the axes, which is exact.

use crate::{Angles, PhotometricType};
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, TAU};

/// The web of angles of a photometric type: where its poles and zeros lie in the luminaire frame.
///
/// ANSI/IESNA LM-63-2002, clause 3.0, defines two directions from the photometric centre for all
/// types, and so ties them to one frame: *photometric zero*, straight down, is our -z, and
/// *photometric horizontal* our +x. The luminous length lies along photometric horizontal, the
/// width across it, the height along photometric zero.
///
/// | type | photometric zero, -z | photometric horizontal, +x | poles | direction at (H, V) |
/// |---|---|---|---|---|
/// | C | V = 0 | H = 0, V = 90 | V = 0 at -z, V = 180 at +z | (sin V cos H, sin V sin H, -cos V) |
/// | B | H = 0, V = 0 | H = 0, V = 90 | H = 90 at -y, H = -90 at +y | (cos H sin V, -sin H, -cos H cos V) |
/// | A | H = 0, V = -90 | H = 0, V = 0 | V = -90 at -z, V = 90 at +z | (cos V cos H, -cos V sin H, sin V) |
///
/// So a floodlight of type B shines along -z as a downlight does, and a vehicle lamp of type A
/// along +x, level. In both, +V is up and +H is to the right for somebody who looks along the beam
/// from behind: horizontal angles count clockwise in types A and B, counterclockwise in type C (the
/// same clause).
///
/// Where sources differ:
/// - The clause says that the planes of type B share a horizontal axis, without naming it. By CIE
///   121:1996 (`tan B = cos C tan gamma`, `sin beta = sin C sin gamma`) and Ashdown (1998: the
///   polar axis is the luminaire's width) it is the axis across photometric horizontal: V turns
///   around it, H rises towards it. Some readers turn H around +x instead. A published floodlight
///   decides: its intensities integrate to 100.9 % of the flux that its laboratory states in the
///   former way, to 106.8 % in the latter.
/// - CIE 121 counts beta towards C90, against the H of LM-63.
/// - Radiance's `ies2rad` has the same V and the same sign of H, but measures H in the projection
///   along x, so that it is the same only at V = 0; it does not read type A.
/// - Ashdown (1998) lays the poles of type A along the luminaire's length; LM-63-2002 makes its
///   planes vertical, as here and as vehicle lamps are measured.
///
/// The [`SphericalTable`](crate::SphericalTable) of a luminaire has its poles where the web has
/// them:
///
/// | type | theta of the table | phi of the table |
/// |---|---|---|
/// | C | V (gamma) | H (C) |
/// | B | 90 degrees + H | V |
/// | A | 90 degrees + V | H |
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Web(PhotometricType);

/// A direction in the angles of a photometric type.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WebAngles {
    /// C of type C, in [0, 2 pi); H of types A and B, in [-pi, pi] and in [-pi/2, pi/2].
    pub horizontal_rad: f64,
    /// Gamma of type C, in [0, pi]; V of types A and B, in [-pi/2, pi/2] and in [-pi, pi].
    pub vertical_rad: f64,
}

impl Web {
    /// The web of a photometric type.
    pub const fn new(photometric_type: PhotometricType) -> Self {
        Self(photometric_type)
    }

    /// The type that it is the web of.
    pub fn photometric_type(self) -> PhotometricType {
        self.0
    }

    /// The web's own angles of a direction of the luminaire frame, of any length.
    pub fn angles(self, direction: DVec3) -> WebAngles {
        let Angles { theta_rad, phi_rad } =
            Angles::from_direction(self.table_from_luminaire(direction));
        let latitude_rad = theta_rad - FRAC_PI_2;
        let (horizontal_rad, vertical_rad) = match self.0 {
            // Of a tiny negative azimuth the sum is a whole turn.
            PhotometricType::C if phi_rad < 0.0 => ((phi_rad + TAU) % TAU, theta_rad),
            PhotometricType::C => (phi_rad, theta_rad),
            PhotometricType::B => (latitude_rad, phi_rad),
            PhotometricType::A => (phi_rad, latitude_rad),
        };
        WebAngles { horizontal_rad, vertical_rad }
    }

    /// The unit direction of the luminaire frame at the web's own angles.
    pub fn direction(self, angles: WebAngles) -> DVec3 {
        self.luminaire_from_table(self.table_angles(angles).direction())
    }

    /// The spherical angles in the frame of the table.
    pub fn table_angles(self, angles: WebAngles) -> Angles {
        let WebAngles { horizontal_rad, vertical_rad } = angles;
        let (theta_rad, phi_rad) = match self.0 {
            PhotometricType::C => (vertical_rad, horizontal_rad),
            PhotometricType::B => (FRAC_PI_2 + horizontal_rad, vertical_rad),
            PhotometricType::A => (FRAC_PI_2 + vertical_rad, horizontal_rad),
        };
        Angles { theta_rad, phi_rad }
    }

    /// Signed permutations of the axes: exact, and they keep solid angles.
    pub(crate) fn table_from_luminaire(self, direction: DVec3) -> DVec3 {
        let DVec3 { x, y, z } = direction;
        match self.0 {
            PhotometricType::C => DVec3::new(x, y, -z),
            // `0 - z`, `0 + x`: no negative zero, whose azimuth at a pole would be 180 degrees.
            PhotometricType::B => DVec3::new(0.0 - z, x, y),
            PhotometricType::A => DVec3::new(0.0 + x, 0.0 - y, -z),
        }
    }

    /// A direction of the luminaire frame from one of the frame of the table.
    pub fn luminaire_from_table(self, direction: DVec3) -> DVec3 {
        let DVec3 { x, y, z } = direction;
        match self.0 {
            PhotometricType::C => DVec3::new(x, y, -z),
            PhotometricType::B => DVec3::new(y, z, -x),
            PhotometricType::A => DVec3::new(x, -y, -z),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TYPES: [PhotometricType; 3] =
        [PhotometricType::A, PhotometricType::B, PhotometricType::C];

    /// (H, V) in degrees, and the axis of the luminaire frame that the clause puts there.
    #[test]
    fn axes_lie_where_the_standard_puts_them() {
        use PhotometricType::{A, B, C};
        let cases = [
            (C, 0.0, 0.0, DVec3::NEG_Z),
            (C, 0.0, 90.0, DVec3::X),
            (C, 90.0, 90.0, DVec3::Y),
            (C, 0.0, 180.0, DVec3::Z),
            (B, 0.0, 0.0, DVec3::NEG_Z),
            (B, 0.0, 90.0, DVec3::X),
            (B, 0.0, -90.0, DVec3::NEG_X),
            (B, 90.0, 0.0, DVec3::NEG_Y),
            (B, -90.0, 0.0, DVec3::Y),
            (B, 0.0, 180.0, DVec3::Z),
            (A, 0.0, 0.0, DVec3::X),
            (A, 0.0, -90.0, DVec3::NEG_Z),
            (A, 0.0, 90.0, DVec3::Z),
            (A, 90.0, 0.0, DVec3::NEG_Y),
            (A, -90.0, 0.0, DVec3::Y),
            (A, 180.0, 0.0, DVec3::NEG_X),
        ];
        for (photometric_type, h, v, axis) in cases {
            let angles = WebAngles {
                horizontal_rad: h * FRAC_PI_2 / 90.0,
                vertical_rad: v * FRAC_PI_2 / 90.0,
            };
            let direction = Web::new(photometric_type).direction(angles);
            assert!((direction - axis).length() < 1e-15, "{photometric_type:?} {h} {v}");
        }
    }

    #[test]
    fn frames_and_angles_are_inverse() {
        for web in TYPES.map(Web::new) {
            for (x, y, z) in [(1.0, 2.0, -3.0), (-4.0, 1.0, 0.5), (0.1, -2.0, 2.0)] {
                let direction = DVec3::new(x, y, z).normalize();
                let there = web.table_from_luminaire(direction);
                assert_eq!(web.luminaire_from_table(there), direction);
                let again = web.direction(web.angles(direction));
                assert!((again - direction).length() < 1e-15, "{web:?}");
            }
        }
    }

    /// CIE 121:1996: `tan B = cos C tan gamma`, `sin beta = sin C sin gamma`, with H = -beta.
    #[test]
    fn type_b_is_that_of_cie_121_mirrored() {
        for (c, gamma) in [(0.3, 0.2), (2.0, 1.2), (4.0, 0.9), (5.9, 1.5)] {
            let at = WebAngles { horizontal_rad: c, vertical_rad: gamma };
            let direction = Web::new(PhotometricType::C).direction(at);
            let angles = Web::new(PhotometricType::B).angles(direction);
            let tan_b = libm::cos(c) * libm::tan(gamma);
            let sin_beta = libm::sin(c) * libm::sin(gamma);
            assert!((libm::tan(angles.vertical_rad) - tan_b).abs() < 1e-12 * tan_b.abs().max(1.0));
            assert!((libm::sin(angles.horizontal_rad) + sin_beta).abs() < 1e-14);
        }
    }

    #[test]
    fn a_pole_counts_as_the_middle_of_the_sector() {
        for zero in [0.0, -0.0] {
            let b = Web::new(PhotometricType::B);
            assert_eq!(b.angles(DVec3::new(zero, 1.0, zero)).vertical_rad, 0.0);
            let a = Web::new(PhotometricType::A);
            assert_eq!(a.angles(DVec3::new(zero, zero, 1.0)).horizontal_rad, 0.0);
        }
    }
}
