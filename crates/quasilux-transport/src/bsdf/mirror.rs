//! Ideal mirror: the BSDF of perfect specular reflection.

use crate::bsdf::BsdfSample;
use glam::DVec3;

#[derive(Clone, Copy, Debug)]
pub(crate) struct Mirror<S> {
    /// Reflected over incident flux, the same at every angle.
    pub(crate) reflectance: S,
}

impl<S: Copy> Mirror<S> {
    /// The mirror direction.
    pub(crate) fn sample(&self, wo: DVec3) -> BsdfSample<S> {
        let wi = DVec3::new(-wo.x, -wo.y, wo.z);
        BsdfSample { wi, weight: self.reflectance, pdf_sr: None }
    }
}
