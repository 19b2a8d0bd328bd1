//! Perfect specular reflection.

use crate::Rgb;
use glam::DVec3;

/// A perfect mirror.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mirror {
    /// Reflected over incident flux, each channel in [0, 1], at every angle.
    pub reflectance: Rgb,
}

impl Mirror {
    /// The mirror direction of `wo` about the unit normal `n`; both point away from the surface.
    #[must_use]
    pub fn reflect(wo: DVec3, n: DVec3) -> DVec3 {
        n * (2.0 * wo.dot(n)) - wo
    }
}
