//! Rough plastic: a clear rough coat over a diffuse base.
//!
//! The coat reflects by GGX facets with Fresnel's factor; `E(cos)` of the light is reflected there
//! at once. What enters is scattered by the base and leaves through the same coat, in the
//! reciprocal form of Kelemen and Szirmay-Kalos (2001):
//!
//! ```text
//! f_base = reflectance (1 - E(wo)) (1 - E(wi)) / (pi (1 - mean E)).
//! ```
//!
//! A base that reflects all gives all light back: `E + (1 - E)`. Light that the coat's facets would
//! reflect several times counts as entering. `reflectance` is thus the share of the light that
//! enters the coat and comes out again; inner reflections at the coat are part of it.

use super::BsdfSample;
use super::albedo_curve::AlbedoCurve;
use super::fresnel::fresnel;
use super::ggx::{Ggx, pdf_reflection, sample_reflection};
use super::lobes::Lobes;
use crate::spectrum::Spectrum;
use glam::DVec3;
use quasilux_sampling::Sampler;
use quasilux_sampling::warp::{pdf_cosine_hemisphere, sample_cosine_hemisphere};
use std::f64::consts::FRAC_1_PI;

/// A diffuse base under a rough dielectric coat.
#[derive(Clone, Debug)]
pub(crate) struct Plastic<S> {
    /// Of the base.
    reflectance: S,
    /// Index of the coat over that of the room.
    eta: f64,
    ggx: Ggx,
    /// Reflected by the coat.
    coat: AlbedoCurve,
}

impl<S: Spectrum> Plastic<S> {
    pub(super) fn new(reflectance: S, eta: f64, alpha: f64) -> Self {
        let ggx = Ggx::new(alpha);
        let coat = AlbedoCurve::new(ggx, |cos| fresnel(cos, eta));
        Self { reflectance, eta, ggx, coat }
    }

    pub(super) fn alpha(&self) -> f64 {
        self.ggx.alpha()
    }

    /// The share of light from `wo` that goes on.
    pub(super) fn albedo(&self, wo: DVec3) -> S {
        let coat = self.coat.at(wo.z);
        S::white() * coat + self.reflectance * (1.0 - coat)
    }

    pub(super) fn sample(&self, wo: DVec3, sampler: &mut Sampler<'_>) -> Option<BsdfSample<S>> {
        let lobes = self.lobes(wo);
        let once = |u| sample_reflection(self.ggx, wo, u);
        let wi = lobes.sample(sampler, once, |u| sample_cosine_hemisphere(u).into())?;
        Some(BsdfSample::reflected(wi, self.evaluate(wo, wi), self.pdf_of(lobes, wo, wi)))
    }

    pub(super) fn evaluate(&self, wo: DVec3, wi: DVec3) -> S {
        if wi.z <= 0.0 {
            return S::black();
        }
        let share = fresnel(wi.dot((wo + wi).normalize()), self.eta);
        let coat = share * self.ggx.evaluate(wo, wi);
        let through = (1.0 - self.coat.at(wo.z)) * (1.0 - self.coat.at(wi.z));
        let base = FRAC_1_PI * through / (1.0 - self.coat.mean());
        S::white() * coat + self.reflectance * base
    }

    pub(super) fn pdf_sr(&self, wo: DVec3, wi: DVec3) -> f64 {
        self.pdf_of(self.lobes(wo), wo, wi)
    }

    fn pdf_of(&self, lobes: Lobes, wo: DVec3, wi: DVec3) -> f64 {
        let broad = pdf_cosine_hemisphere(wi.to_array());
        lobes.pdf(pdf_reflection(self.ggx, wo, wi), broad)
    }

    fn lobes(&self, wo: DVec3) -> Lobes {
        let coat = self.coat.at(wo.z);
        Lobes::new(coat, self.reflectance.luminance() * (1.0 - coat))
    }
}
