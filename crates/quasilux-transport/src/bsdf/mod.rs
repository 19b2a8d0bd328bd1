//! BSDFs, a closed set of one file a kind: their value, albedo, sampling and pdf. A new one gets a
//! file here, a variant of [`Bsdf`] with its match arms, and one of `quasilux_scene::Bsdf`.
//!
//! Directions are local: z is the geometric normal of the side that `wo` is on, so `wo.z > 0`, and
//! `wi.z < 0` means transmitted; x and y are those of [`Frame`]. Both point away from the surface.
//! For a path `wo` is where it comes from, for a photon where light comes from: the functions are
//! reciprocal but for the square of the index of refraction, which [`TransportMode`] tells apart.

mod albedo_curve;
mod conductor;
mod dielectric;
mod diffuse;
mod fresnel;
mod ggx;
mod lobes;
mod measured;
mod mirror;
mod multiple_scattering;
mod pane;
mod plastic;
#[cfg(test)]
mod tests;
mod translucent;

pub(crate) use pane::Pane;

use crate::spectrum::Spectrum;
use conductor::Conductor;
use dielectric::Dielectric;
use diffuse::Diffuse;
use glam::DVec3;
use measured::Measured;
use mirror::Mirror;
use plastic::Plastic;
use quasilux_sampling::Sampler;
use quasilux_scene::{Rgb, bsdf as scene};
use std::f64::consts::FRAC_1_PI;
use translucent::Translucent;

/// A material as a laboratory would measure it.
#[derive(Clone, Debug)]
pub struct Scattering(Bsdf<Rgb>);

impl Scattering {
    /// Of a material.
    #[must_use]
    pub fn from_material(material: &quasilux_scene::Bsdf) -> Self {
        Self(Bsdf::new(material))
    }

    /// The scattering function f in sr^-1, without the cosine, of light that arrives from `wi` on
    /// the front and leaves along `wo`: unit vectors away from the surface in its frame, z along
    /// the normal. 0 of what goes into single directions.
    #[must_use]
    pub fn evaluate(&self, wi: DVec3, wo: DVec3) -> Rgb {
        self.0.evaluate(wi, wo, true, TransportMode::Importance)
    }
}

/// How a surface scatters light, on both sides.
#[derive(Clone, Debug)]
pub(crate) enum Bsdf<S> {
    Diffuse(Diffuse<S>),
    Mirror(Mirror<S>),
    Translucent(Translucent<S>),
    Dielectric(Dielectric),
    Pane(Pane<S>),
    Conductor(Conductor<S>),
    Plastic(Plastic<S>),
    Measured(Box<Measured>),
}

/// Quantity that is transported: radiance from the sensors, importance from the lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TransportMode {
    /// Paths: `wo` is where radiance goes.
    Radiance,
    /// Photons: `wo` is where flux comes from.
    Importance,
}

/// A direction drawn from a surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BsdfSample<S> {
    /// Unit direction.
    pub(crate) wi: DVec3,
    /// `f |cos wi| / pdf`, the chances of all choices in it.
    pub(crate) weight: S,
    /// Density in sr^-1; `None` for one of finitely many directions.
    pub(crate) pdf_sr: Option<f64>,
}

impl<S: Spectrum> BsdfSample<S> {
    /// A direction above the surface with the function's value there (sr^-1), drawn with this
    /// density.
    fn reflected(wi: DVec3, value: S, pdf_sr: f64) -> Self {
        Self { wi, weight: value * (wi.z / pdf_sr), pdf_sr: Some(pdf_sr) }
    }
}

impl<S: Spectrum> Bsdf<S> {
    /// Converts the BSDF of a scene to the channels of this simulation.
    pub(crate) fn new(bsdf: &quasilux_scene::Bsdf) -> Self {
        use quasilux_scene::Bsdf as In;
        match bsdf {
            In::Diffuse(scene::Diffuse { reflectance }) => {
                Self::Diffuse(Diffuse { reflectance: S::from_rgb(*reflectance) })
            }
            In::Mirror(scene::Mirror { reflectance }) => {
                Self::Mirror(Mirror { reflectance: S::from_rgb(*reflectance) })
            }
            In::Translucent(sheet) => {
                let [reflected, transmitted] =
                    [sheet.reflectance, sheet.transmittance].map(S::from_rgb);
                Self::Translucent(Translucent::new(reflected, transmitted))
            }
            In::Dielectric(scene::Dielectric { eta }) => Self::Dielectric(Dielectric::new(*eta)),
            In::Pane(pane) => Self::Pane(Pane::new(pane)),
            In::Conductor(scene::Conductor { reflectance, alpha }) => {
                Self::Conductor(Conductor::new(S::from_rgb(*reflectance), *alpha))
            }
            In::Plastic(scene::Plastic { reflectance, eta, alpha }) => {
                Self::Plastic(Plastic::new(S::from_rgb(*reflectance), *eta, *alpha))
            }
            In::Measured(sheet) => Self::Measured(Box::new(Measured::new(sheet.clone()))),
        }
    }

    /// Whether it scatters into finitely many directions only, so that no light can be connected to
    /// it.
    pub(crate) fn is_specular(&self) -> bool {
        match self {
            Self::Mirror(_) | Self::Dielectric(_) | Self::Pane(_) => true,
            Self::Diffuse(_)
            | Self::Translucent(_)
            | Self::Conductor(_)
            | Self::Plastic(_)
            | Self::Measured(_) => false,
        }
    }

    /// Where the local y axis points, in so far as it lies in the surface; `None` where the surface
    /// may be turned in its plane.
    pub(crate) fn up(&self) -> Option<DVec3> {
        match self {
            Self::Measured(measured) => measured.up(),
            Self::Diffuse(_)
            | Self::Mirror(_)
            | Self::Translucent(_)
            | Self::Dielectric(_)
            | Self::Pane(_)
            | Self::Conductor(_)
            | Self::Plastic(_) => None,
        }
    }

    /// Whether light passes it to the other side, scattered or straight.
    pub(crate) fn lets_through(&self) -> bool {
        self.transmits() || self.straight_transmittance(1.0).is_some()
    }

    /// Whether the light that leaves it depends on its illuminance alone, so that an illumination
    /// map can stand on it.
    pub(crate) fn keeps_illuminance(&self) -> bool {
        match self {
            Self::Diffuse(_) => true,
            Self::Mirror(_)
            | Self::Translucent(_)
            | Self::Dielectric(_)
            | Self::Pane(_)
            | Self::Conductor(_)
            | Self::Plastic(_)
            | Self::Measured(_) => false,
        }
    }

    /// Whether light passes through to the other side by more than finitely many directions.
    pub(crate) fn transmits(&self) -> bool {
        match self {
            Self::Translucent(_) => true,
            Self::Measured(measured) => measured.transmits(),
            Self::Diffuse(_)
            | Self::Mirror(_)
            | Self::Dielectric(_)
            | Self::Pane(_)
            | Self::Conductor(_)
            | Self::Plastic(_) => false,
        }
    }

    /// Mirror reflectance at this cosine, on the front or on the back, of a surface where all of
    /// the rest is absorbed or goes straight on, so that images can be followed; `None` for other
    /// surfaces.
    pub(crate) fn image_reflectance(&self, cos: f64, front: bool) -> Option<S> {
        match self {
            Self::Mirror(mirror) => Some(mirror.reflectance),
            Self::Pane(pane) => Some(pane.pane_reflectance(cos, front)),
            Self::Diffuse(_)
            | Self::Translucent(_)
            | Self::Dielectric(_)
            | Self::Conductor(_)
            | Self::Plastic(_)
            | Self::Measured(_) => None,
        }
    }

    /// Transmittance of light that goes straight through at this cosine; `None` where none does.
    pub(crate) fn straight_transmittance(&self, cos: f64) -> Option<S> {
        match self {
            Self::Pane(pane) => Some(pane.pane_transmittance(cos)),
            Self::Diffuse(_)
            | Self::Mirror(_)
            | Self::Translucent(_)
            | Self::Dielectric(_)
            | Self::Conductor(_)
            | Self::Plastic(_)
            | Self::Measured(_) => None,
        }
    }

    /// The share of the light along `wo` that goes on, for survival. `front`: `wo` is on the front
    /// side.
    pub(crate) fn albedo(&self, wo: DVec3, front: bool, mode: TransportMode) -> S {
        match self {
            Self::Diffuse(diffuse) => diffuse.reflectance,
            Self::Mirror(mirror) => mirror.reflectance,
            Self::Translucent(translucent) => translucent.albedo(),
            Self::Dielectric(_) => S::white(),
            Self::Pane(pane) => pane.albedo(wo, front),
            Self::Conductor(conductor) => conductor.albedo(wo),
            Self::Plastic(plastic) => plastic.albedo(wo),
            Self::Measured(measured) => measured.albedo(wo, front, mode),
        }
    }

    /// [`Self::sample`] with a point of the unit square, where that is all it takes: on Lambertian
    /// surfaces.
    pub(crate) fn sample_lambertian(&self, u: [f64; 2]) -> Option<BsdfSample<S>> {
        match self {
            Self::Diffuse(diffuse) => Some(diffuse.sample(u)),
            Self::Mirror(_)
            | Self::Translucent(_)
            | Self::Dielectric(_)
            | Self::Pane(_)
            | Self::Conductor(_)
            | Self::Plastic(_)
            | Self::Measured(_) => None,
        }
    }

    /// The factor on radiance that is followed to where `wi` leads, of media alone: what is in
    /// glass is brighter, and nothing is lost.
    pub(crate) fn radiance_scale(&self, wi: DVec3, front: bool) -> f64 {
        match self {
            Self::Dielectric(dielectric) if wi.z < 0.0 => dielectric.radiance_scale(front),
            _ => 1.0,
        }
    }

    /// How many times brighter radiance is in a body of it than outside.
    pub(crate) fn scale_inside(&self) -> f64 {
        match self {
            Self::Dielectric(dielectric) => dielectric.radiance_scale(false),
            _ => 1.0,
        }
    }

    /// Draws the direction in which light goes on; `None` where none does. What choices left of the
    /// open coordinate is used first.
    #[inline(always)]
    pub(crate) fn sample(
        &self,
        wo: DVec3,
        front: bool,
        mode: TransportMode,
        sampler: &mut Sampler<'_>,
    ) -> Option<BsdfSample<S>> {
        // Most surfaces are, and what is drawn there stays in registers.
        if let Self::Diffuse(diffuse) = self {
            return Some(diffuse.sample([sampler.remapped_1d(), sampler.next_1d()]));
        }
        self.sample_other(wo, front, mode, sampler)
    }

    #[inline(never)]
    fn sample_other(
        &self,
        wo: DVec3,
        front: bool,
        mode: TransportMode,
        sampler: &mut Sampler<'_>,
    ) -> Option<BsdfSample<S>> {
        match self {
            Self::Diffuse(_) => None,
            Self::Mirror(mirror) => Some(mirror.sample(wo)),
            Self::Translucent(translucent) => Some(translucent.sample(sampler)),
            Self::Dielectric(dielectric) => Some(dielectric.sample(wo, front, mode, sampler)),
            Self::Pane(pane) => pane.sample(wo, front, sampler),
            Self::Conductor(conductor) => conductor.sample(wo, sampler),
            Self::Plastic(plastic) => plastic.sample(wo, sampler),
            Self::Measured(measured) => measured.sample(wo, front, mode, sampler),
        }
    }

    /// The scattering function f in sr^-1, without the cosine; 0 for mirror directions.
    pub(crate) fn evaluate(&self, wo: DVec3, wi: DVec3, front: bool, mode: TransportMode) -> S {
        match self {
            Self::Diffuse(diffuse) => diffuse.evaluate(wi),
            Self::Translucent(translucent) => translucent.evaluate(wi),
            Self::Mirror(_) | Self::Dielectric(_) | Self::Pane(_) => S::black(),
            Self::Conductor(conductor) => conductor.evaluate(wo, wi),
            Self::Plastic(plastic) => plastic.evaluate(wo, wi),
            Self::Measured(measured) => measured.evaluate(wo, wi, front, mode),
        }
    }

    /// Density in sr^-1 of going on along `wi` after `wo`: that of [`Self::sample`] times the
    /// chance to survive there with `favour` times the weight of the sample, `min(pdf, favour f
    /// cos)`. Of measured sheets, whose sides have frames of their own, that of a Lambertian
    /// surface, so that it is a function of the two directions alone. 0 for mirror directions.
    pub(crate) fn survival_pdf_sr(&self, wo: DVec3, wi: DVec3, favour: f64) -> f64 {
        // Seen from the side of `wo`; what has two sides scatters alike on both.
        let side = 1.0_f64.copysign(wo.z);
        let (wo, wi) = (wo * side, wi * side);
        let scattered = || {
            favour
                * self.evaluate(wo, wi, true, TransportMode::Importance).max_channel()
                * wi.z.abs()
        };
        match self {
            Self::Diffuse(diffuse) => diffuse.pdf_sr(wi).min(scattered()),
            Self::Translucent(translucent) => translucent.pdf_sr(wi).min(scattered()),
            Self::Mirror(_) | Self::Dielectric(_) | Self::Pane(_) => 0.0,
            Self::Conductor(conductor) => conductor.pdf_sr(wo, wi).min(scattered()),
            Self::Plastic(plastic) => plastic.pdf_sr(wo, wi).min(scattered()),
            Self::Measured(_) => FRAC_1_PI * wi.z.abs(),
        }
    }

    /// The width of the slopes of its facets, where it has facets.
    pub(crate) fn facet_alpha(&self) -> Option<f64> {
        match self {
            Self::Conductor(conductor) => Some(conductor.alpha()),
            Self::Plastic(plastic) => Some(plastic.alpha()),
            Self::Diffuse(_)
            | Self::Mirror(_)
            | Self::Translucent(_)
            | Self::Dielectric(_)
            | Self::Pane(_)
            | Self::Measured(_) => None,
        }
    }

    /// Density in sr^-1 with which [`Self::sample`] draws `wi` for a path; 0 for mirror directions.
    pub(crate) fn pdf_sr(&self, wo: DVec3, wi: DVec3, front: bool) -> f64 {
        match self {
            Self::Diffuse(diffuse) => diffuse.pdf_sr(wi),
            Self::Translucent(translucent) => translucent.pdf_sr(wi),
            Self::Mirror(_) | Self::Dielectric(_) | Self::Pane(_) => 0.0,
            Self::Conductor(conductor) => conductor.pdf_sr(wo, wi),
            Self::Plastic(plastic) => plastic.pdf_sr(wo, wi),
            Self::Measured(measured) => measured.pdf_sr(wo, wi, front),
        }
    }
}
