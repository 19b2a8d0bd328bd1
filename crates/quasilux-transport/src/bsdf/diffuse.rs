//! Lambertian reflection: f is `reflectance / pi` on the side that light comes from.

use crate::bsdf::BsdfSample;
use crate::spectrum::Spectrum;
use glam::DVec3;
use quasilux_sampling::warp::sample_cosine_hemisphere;
use std::f64::consts::FRAC_1_PI;

#[derive(Clone, Copy, Debug)]
pub(crate) struct Diffuse<S> {
    /// Reflected over incident flux.
    pub(crate) reflectance: S,
}

impl<S: Spectrum> Diffuse<S> {
    /// Draws a direction in proportion to its cosine.
    #[inline]
    pub(crate) fn sample(&self, u: [f64; 2]) -> BsdfSample<S> {
        let wi = DVec3::from_array(sample_cosine_hemisphere(u));
        BsdfSample { wi, weight: self.reflectance, pdf_sr: Some(wi.z * FRAC_1_PI) }
    }

    pub(crate) fn evaluate(&self, wi: DVec3) -> S {
        if wi.z > 0.0 { self.reflectance * FRAC_1_PI } else { S::black() }
    }

    /// Density in sr^-1 of [`Self::sample`].
    pub(crate) fn pdf_sr(&self, wi: DVec3) -> f64 {
        wi.z.max(0.0) * FRAC_1_PI
    }
}
