//! A luminaire file, placed in the room.
//!
//! The luminaire frame: gamma = 0 (nadir) along local -z, C0 along local +x, C90 along local +y.

use glam::{DMat3, DVec3};
use quasilux_photometry::{LuminousShape, Photometry};
use std::sync::Arc;

/// A luminaire at a place: a measured intensity distribution, from a point or a luminous shape.
#[derive(Clone, Debug)]
pub struct Luminaire {
    /// The measured distribution, shared between all luminaires of one file.
    pub photometry: Arc<Photometry>,
    /// World position in m: the centre of the shape.
    pub position: DVec3,
    /// Rotation from the luminaire frame to the world.
    pub world_from_luminaire: DMat3,
    /// Factor on all intensities, at least 0: what the project asks for, times what the lamps give
    /// at this tilt ([`Photometry::tilt_factor`]), times the maintenance factor.
    pub dimming: f64,
    /// Luminous shape; [`LuminousShape::POINT`] where it stands for a point.
    pub shape: LuminousShape,
}

impl Luminaire {
    /// Whether it shines from more than a point.
    #[must_use]
    pub fn is_area(&self) -> bool {
        !self.shape.is_point()
    }

    /// Luminous intensity in cd toward the unit world direction `direction`.
    #[must_use]
    pub fn intensity_cd(&self, direction: DVec3) -> f64 {
        self.dimming
            * self.photometry.intensity_cd(self.world_from_luminaire.transpose() * direction)
    }

    /// Total emitted flux in lm, integrated from the table.
    #[must_use]
    pub fn flux_lm(&self) -> f64 {
        self.dimming * self.photometry.flux_lm()
    }
}

/// How a luminaire is turned: the directions that the project file names.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// World direction of gamma = 0; any length but zero.
    pub aim: DVec3,
    /// World direction of the C0 half-plane, projected square to `aim`.
    pub c0: DVec3,
    /// Turn about `aim`, positive from C0 toward C90.
    pub rotation_rad: f64,
}

/// `aim` and `c0` do not span a plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PlacementError {
    /// `aim` has no length.
    #[error("aim has no length")]
    ZeroAim,
    /// `c0` has no part square to `aim`.
    #[error("c0 is parallel to aim")]
    ParallelC0,
}

impl Placement {
    /// The rotation from the luminaire frame to the world.
    ///
    /// C90 points along `(-aim) x c0`, so that with aim straight down and c0 along +x it is +y.
    ///
    /// # Errors
    /// When `aim` has no length or `c0` is parallel to it.
    pub fn world_from_luminaire(&self) -> Result<DMat3, PlacementError> {
        let up = -self.aim.try_normalize().ok_or(PlacementError::ZeroAim)?;
        let c0 = self.c0.try_normalize().ok_or(PlacementError::ParallelC0)?;
        let square = c0 - up * c0.dot(up);
        if square.length() < 1e-9 {
            return Err(PlacementError::ParallelC0);
        }
        let c0 = square.normalize();
        let c90 = up.cross(c0);
        let (sin, cos) = libm::sincos(self.rotation_rad);
        let turned_c0 = c0 * cos + c90 * sin;
        let turned_c90 = c90 * cos - c0 * sin;
        Ok(DMat3::from_cols(turned_c0, turned_c90, up))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: DVec3, b: DVec3) {
        assert!((a - b).length() < 1e-12, "{a} is not {b}");
    }

    #[test]
    fn default_placement_is_the_identity() {
        let placement = Placement { aim: -DVec3::Z, c0: DVec3::X, rotation_rad: 0.0 };
        let m = placement.world_from_luminaire().unwrap();
        close(m * DVec3::X, DVec3::X);
        close(m * DVec3::Y, DVec3::Y);
        close(m * DVec3::Z, DVec3::Z);
    }

    #[test]
    fn rotation_turns_c0_toward_c90() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let placement = Placement { aim: -DVec3::Z, c0: DVec3::X, rotation_rad: quarter };
        close(placement.world_from_luminaire().unwrap() * DVec3::X, DVec3::Y);
    }

    #[test]
    fn a_wall_washer_keeps_its_nadir_on_aim() {
        let placement =
            Placement { aim: DVec3::X, c0: DVec3::new(3.0, 1.0, 0.0), rotation_rad: 0.0 };
        let m = placement.world_from_luminaire().unwrap();
        close(m * -DVec3::Z, DVec3::X);
        close(m * DVec3::X, DVec3::Y);
        close(m * DVec3::Y, DVec3::NEG_X.cross(DVec3::Y));
    }

    #[test]
    fn degenerate_placements_are_refused() {
        let parallel = Placement { aim: DVec3::X, c0: DVec3::X * 2.0, rotation_rad: 0.0 };
        assert_eq!(parallel.world_from_luminaire(), Err(PlacementError::ParallelC0));
        let zero = Placement { aim: DVec3::ZERO, c0: DVec3::X, rotation_rad: 0.0 };
        assert_eq!(zero.world_from_luminaire(), Err(PlacementError::ZeroAim));
    }
}
