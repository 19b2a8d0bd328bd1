//! Lambertian reflection and transmission, the BSDF of paper, cloth and opal glass.
//!
//! `reflectance / pi` toward the side the light comes from, `transmittance / pi` to the other,
//! both sides alike.

use super::BsdfSample;
use crate::spectrum::Spectrum;
use glam::DVec3;
use quasilux_sampling::Sampler;
use quasilux_sampling::warp::{pdf_cosine_hemisphere, sample_cosine_hemisphere};
use std::f64::consts::FRAC_1_PI;

/// A sheet that scatters light to both sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Translucent<S> {
    reflectance: S,
    transmittance: S,
}

impl<S: Spectrum> Translucent<S> {
    pub(super) const fn new(reflectance: S, transmittance: S) -> Self {
        Self { reflectance, transmittance }
    }

    /// The share of light that goes on, from any direction.
    pub(super) fn albedo(&self) -> S {
        self.reflectance + self.transmittance
    }

    pub(super) fn sample(&self, sampler: &mut Sampler<'_>) -> BsdfSample<S> {
        let p_reflected = self.p_reflected();
        let is_reflected = sampler.choose_bool(p_reflected);
        let mut wi: DVec3 =
            sample_cosine_hemisphere([sampler.remapped_1d(), sampler.next_1d()]).into();
        let (share, p) = if is_reflected {
            (self.reflectance, p_reflected)
        } else {
            (self.transmittance, 1.0 - p_reflected)
        };
        let pdf_sr = p * pdf_cosine_hemisphere(wi.to_array());
        wi.z = if is_reflected { wi.z } else { -wi.z };
        BsdfSample { wi, weight: share * (1.0 / p), pdf_sr: Some(pdf_sr) }
    }

    pub(super) fn evaluate(&self, wi: DVec3) -> S {
        (if wi.z > 0.0 { self.reflectance } else { self.transmittance }) * FRAC_1_PI
    }

    pub(super) fn pdf_sr(&self, wi: DVec3) -> f64 {
        let p_reflected = self.p_reflected();
        let p = if wi.z > 0.0 { p_reflected } else { 1.0 - p_reflected };
        p * FRAC_1_PI * wi.z.abs()
    }

    /// By the light that each side gets.
    fn p_reflected(&self) -> f64 {
        let sum = self.albedo().luminance();
        if sum > 0.0 { self.reflectance.luminance() / sum } else { 1.0 }
    }
}
