//! Rough conductor: the GGX microfacet BSDF ([`super::ggx`]) with Schlick's Fresnel factor, and
//! multiple scattering between the facets (Kulla and Conty 2017).
//!
//! The facets reflect by Schlick's approximation, `F = F0 + (1 - F0) (1 - cos)^5` (Schlick 1994).
//! Light that a second facet catches is lost to single reflection: with facets that reflect all,
//! `1 - E(cos)`. It comes out diffuse and reciprocal (Kulla and Conty 2017):
//!
//! ```text
//! f_more = R (1 - E(wo)) (1 - E(wi)) / (pi (1 - mean E)).
//! ```
//!
//! This light was reflected once and is reflected again; then the share `E` (the mean) leaves and
//! the rest is scattered again. Each time the mean Fresnel factor `F` is kept, so that of multiple
//! scattering `R = F^2 E (1 + F (1 - E) + ...) = F^2 E / (1 - F (1 - E))` comes out. With `F0 = 1`,
//! R = 1.

use super::BsdfSample;
use super::albedo_curve::AlbedoCurve;
use super::fresnel::schlick;
use super::ggx::{Ggx, pdf_reflection, sample_reflection};
use super::lobes::Lobes;
use super::multiple_scattering::{
    MultipleScattering, pdf_multiple_scattering, sample_multiple_scattering,
};
use crate::spectrum::Spectrum;
use glam::DVec3;
use quasilux_sampling::Sampler;
use std::f64::consts::FRAC_1_PI;

/// The mean of Schlick's `(1 - cos)^5` over diffuse light.
const MEAN_SCHLICK: f64 = 1.0 / 21.0;

/// A rough conductor.
#[derive(Clone, Debug)]
pub(crate) struct Conductor<S> {
    /// Of the facets at normal incidence.
    reflectance: S,
    ggx: Ggx,
    /// Single reflection by facets that reflect all.
    full: AlbedoCurve,
    /// Single reflection by facets that reflect Schlick's `(1 - cos)^5`.
    rising: AlbedoCurve,
    multiple_scattering: MultipleScattering,
    /// `R` of the module.
    repeated: S,
}

impl<S: Spectrum> Conductor<S> {
    pub(super) fn new(reflectance: S, alpha: f64) -> Self {
        let ggx = Ggx::new(alpha);
        let full = AlbedoCurve::new(ggx, |_| 1.0);
        let rising = AlbedoCurve::new(ggx, schlick);
        let escaping = full.mean();
        let repeated = S::from_channels(|channel| {
            let mean = mix(reflectance.channel(channel), MEAN_SCHLICK);
            mean * mean * escaping / (1.0 - mean * (1.0 - escaping))
        });
        let multiple_scattering = MultipleScattering::new(&full);
        Self { reflectance, ggx, full, rising, multiple_scattering, repeated }
    }

    pub(super) fn alpha(&self) -> f64 {
        self.ggx.alpha()
    }

    /// The share of light from `wo` that goes on.
    pub(super) fn albedo(&self, wo: DVec3) -> S {
        self.single_albedo(wo.z) + self.repeated * (1.0 - self.full.at(wo.z))
    }

    pub(super) fn sample(&self, wo: DVec3, sampler: &mut Sampler<'_>) -> Option<BsdfSample<S>> {
        let lobes = self.lobes(wo);
        let once = |u| sample_reflection(self.ggx, wo, u);
        let wi = lobes.sample(sampler, once, |u| {
            sample_multiple_scattering(&self.multiple_scattering, &self.full, u)
        })?;
        Some(BsdfSample::reflected(wi, self.evaluate(wo, wi), self.pdf_of(lobes, wo, wi)))
    }

    pub(super) fn evaluate(&self, wo: DVec3, wi: DVec3) -> S {
        if wi.z <= 0.0 {
            return S::black();
        }
        let risen = schlick(wi.dot((wo + wi).normalize()));
        let single = self.ggx.evaluate(wo, wi);
        let multiple_scattering = (1.0 - self.full.at(wo.z)) * (1.0 - self.full.at(wi.z));
        let diffuse = FRAC_1_PI * multiple_scattering / (1.0 - self.full.mean());
        S::from_channels(|channel| {
            let fresnel = mix(self.reflectance.channel(channel), risen);
            fresnel * single + self.repeated.channel(channel) * diffuse
        })
    }

    pub(super) fn pdf_sr(&self, wo: DVec3, wi: DVec3) -> f64 {
        self.pdf_of(self.lobes(wo), wo, wi)
    }

    fn pdf_of(&self, lobes: Lobes, wo: DVec3, wi: DVec3) -> f64 {
        let broad = pdf_multiple_scattering(&self.multiple_scattering, &self.full, wi);
        lobes.pdf(pdf_reflection(self.ggx, wo, wi), broad)
    }

    fn lobes(&self, wo: DVec3) -> Lobes {
        let single = self.single_albedo(wo.z).luminance();
        let repeated = self.repeated.luminance() * (1.0 - self.full.at(wo.z));
        Lobes::new(single, repeated)
    }

    fn single_albedo(&self, cos: f64) -> S {
        let (full, rising) = (self.full.at(cos), self.rising.at(cos));
        S::from_channels(|channel| {
            let reflectance = self.reflectance.channel(channel);
            reflectance * (full - rising) + rising
        })
    }
}

/// Schlick's reflectance where it has risen by the share `risen` of the way to 1.
fn mix(reflectance: f64, risen: f64) -> f64 {
    reflectance + (1.0 - reflectance) * risen
}
