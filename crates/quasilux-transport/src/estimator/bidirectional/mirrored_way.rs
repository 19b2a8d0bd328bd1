//! Ways over plane mirrors between an emitting facet and a vertex that asks for its image: both
//! kinds of subpaths follow them, for neither can be joined to a mirror.

use crate::bsdf::Bsdf;
use crate::context::Context;
use crate::spectrum::Spectrum;
use crate::world::Interaction;

/// Mirrors that a subpath met one after the other, and nothing else.
#[derive(Clone)]
pub(super) struct MirroredWay<S> {
    /// Up to the last of them, in m.
    distance_m: f64,
    /// The planes that they mirror in.
    pub(super) planes: Vec<u32>,
    /// Share of the light that all of them together reflect.
    reflected: S,
}

impl<S: Spectrum> MirroredWay<S> {
    /// Of a subpath that has just left an emitting facet, or a place that asks; `None` where images
    /// of area lights are not asked for.
    pub(super) fn new(context: &Context<'_, S>) -> Option<Self> {
        let nothing = || Self { distance_m: 0.0, planes: Vec::new(), reflected: S::white() };
        context.images.show_emitters().then(nothing)
    }

    /// After a specular surface met at this cosine, `mirrored` where the subpath stays on its side;
    /// `None` where no image shows what is behind.
    pub(super) fn past(
        mut self,
        context: &Context<'_, S>,
        at: &Interaction,
        bsdf: &Bsdf<S>,
        cos: f64,
    ) -> Option<Self> {
        self.planes.push(context.images.plane_of(at.facet)?);
        self.reflected = self.reflected * bsdf.image_reflectance(cos, at.front)?;
        self.distance_m += at.distance_m;
        Some(self)
    }

    /// Its length in m with this much behind the last mirror.
    pub(super) fn distance_m(&self, beyond_m: f64) -> f64 {
        self.distance_m + beyond_m
    }

    /// The part of the photons that pass all mirrors.
    pub(super) fn kept(&self) -> f64 {
        self.reflected.max_channel()
    }
}
