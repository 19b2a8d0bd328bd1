//! Lambertian emitting triangles.

use std::f64::consts::PI;

/// Every triangle of one material, emitting from its front side.
#[derive(Clone, Debug, PartialEq)]
pub struct AreaLight {
    /// Index into `Scene::materials`.
    pub material: u32,
    /// The emitting triangles, in ascending order.
    pub triangles: Vec<u32>,
    /// Their total area in m^2.
    pub area_m2: f64,
    /// Luminance of the front side in cd/m^2, the same in all directions.
    pub luminance_cd_m2: f64,
}

impl AreaLight {
    /// Total emitted flux in lm: pi times luminance times area.
    #[must_use]
    pub fn flux_lm(&self) -> f64 {
        PI * self.luminance_cd_m2 * self.area_m2
    }
}
