//! An isotropic point light.

use glam::DVec3;
use std::f64::consts::PI;

/// A point that emits equally in all directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLight {
    /// World position in m.
    pub position: DVec3,
    /// Luminous intensity in cd, the same in all directions.
    pub intensity_cd: f64,
}

impl PointLight {
    /// Total emitted flux in lm: 4 pi times the intensity.
    #[must_use]
    pub fn flux_lm(&self) -> f64 {
        4.0 * PI * self.intensity_cd
    }
}
