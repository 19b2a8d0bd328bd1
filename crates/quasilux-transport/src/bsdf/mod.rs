//! How surfaces scatter light on its way: a closed set, one file a kind.
//!
//! Directions are local: z is the geometric normal of the side that `wo` is on, so `wo.z > 0`, and
//! `wi.z < 0` means transmitted; x and y are those of [`Frame`]. Both point away from the surface. For
//! a path `wo` is where it comes from, for a photon where light comes from: the functions are
//! reciprocal but for the square of the index of refraction, which [`Mode`] tells apart.

mod diffuse;
mod mirror;

use crate::spectrum::Spectrum;
use diffuse::Diffuse;
use glam::DVec3;
use mirror::Mirror;
use quasilux_sampling::SampleCursor;
use quasilux_scene::bsdf as scene;

/// How a surface scatters light, on both sides.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Bsdf<S> {
    Diffuse(Diffuse<S>),
    Mirror(Mirror<S>),
}

/// What travels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mode {
    /// Paths: `wo` is where radiance goes.
    Radiance,
    /// Photons: `wo` is where flux comes from.
    Flux,
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

impl<S: Spectrum> Bsdf<S> {
    /// What a scene says of a surface, in the channels of this simulation.
    pub(crate) fn new(bsdf: &quasilux_scene::Bsdf) -> Self {
        match bsdf {
            quasilux_scene::Bsdf::Diffuse(scene::Diffuse { reflectance }) => {
                Self::Diffuse(Diffuse { reflectance: S::from_rgb(*reflectance) })
            }
            quasilux_scene::Bsdf::Mirror(scene::Mirror { reflectance }) => {
                Self::Mirror(Mirror { reflectance: S::from_rgb(*reflectance) })
            }
        }
    }

    /// Whether it scatters into finitely many directions only, so that no light can be connected to it.
    pub(crate) fn is_specular(&self) -> bool {
        match self {
            Self::Diffuse(_) => false,
            Self::Mirror(_) => true,
        }
    }

    /// Whether the light that leaves it hangs on its illuminance alone, so that an illumination map can
    /// stand on it.
    pub(crate) fn keeps_illuminance(&self) -> bool {
        match self {
            Self::Diffuse(_) => true,
            Self::Mirror(_) => false,
        }
    }

    /// Whether light passes through to the other side by more than finitely many directions.
    pub(crate) fn transmits(&self) -> bool {
        match self {
            Self::Diffuse(_) | Self::Mirror(_) => false,
        }
    }

    /// The share of the light along `wo` that goes on, for survival. `front`: `wo` is on the front side.
    pub(crate) fn albedo(&self, _wo: DVec3, _front: bool) -> S {
        match self {
            Self::Diffuse(diffuse) => diffuse.reflectance,
            Self::Mirror(mirror) => mirror.reflectance,
        }
    }

    /// Draws the direction in which light goes on; `None` where none does. What choices left of the open
    /// coordinate is used first.
    pub(crate) fn sample(
        &self,
        wo: DVec3,
        _front: bool,
        _mode: Mode,
        cursor: &mut SampleCursor<'_>,
    ) -> Option<BsdfSample<S>> {
        match self {
            Self::Diffuse(diffuse) => Some(diffuse.sample([cursor.rest_1d(), cursor.next_1d()])),
            Self::Mirror(mirror) => Some(mirror.sample(wo)),
        }
    }

    /// The scattering function f in sr^-1, without the cosine; 0 for mirror directions.
    pub(crate) fn evaluate(&self, _wo: DVec3, wi: DVec3, _front: bool, _mode: Mode) -> S {
        match self {
            Self::Diffuse(diffuse) => diffuse.evaluate(wi),
            Self::Mirror(_) => S::black(),
        }
    }

    /// Density in sr^-1 with which [`Self::sample`] draws `wi`; 0 for mirror directions.
    pub(crate) fn pdf_sr(&self, _wo: DVec3, wi: DVec3, _front: bool) -> f64 {
        match self {
            Self::Diffuse(diffuse) => diffuse.pdf_sr(wi),
            Self::Mirror(_) => 0.0,
        }
    }
}
