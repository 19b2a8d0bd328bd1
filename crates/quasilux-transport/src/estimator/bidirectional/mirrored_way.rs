//! Ways over plane mirrors between an emitting facet and a vertex that asks for its image: both
//! kinds of subpaths follow them, for neither can be joined to a mirror.

use crate::bsdf::Bsdf;
use crate::context::Context;
use crate::lights::{Asking, EmitterPlace};
use crate::spectrum::Spectrum;
use crate::world::Interaction;

/// Mirrors that a subpath met one after the other, and nothing else.
pub(super) struct MirroredWay<S> {
    /// Up to the last of them, in m.
    distance_m: f64,
    /// The planes that they mirror in.
    planes: Vec<u32>,
    /// What all of them reflect.
    reflected: S,
}

impl<S: Spectrum> MirroredWay<S> {
    /// Of a subpath that has just left an emitting facet, or a place that asks; `None` where nobody
    /// asks for images of area lights.
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

    /// The density in m^-2 with which a place at its end asks for a point of the facet that it
    /// began at; `None` without a mirror.
    pub(super) fn asked_of_light_m2(
        &self,
        context: &Context<'_, S>,
        place: Asking,
        asked: EmitterPlace,
    ) -> Option<f64> {
        self.asked_m2(context, self.planes.iter(), place, asked)
    }

    /// The same of the place that it began at, which asks for a point of a facet at its end.
    pub(super) fn asked_of_eye_m2(
        &self,
        context: &Context<'_, S>,
        place: Asking,
        asked: EmitterPlace,
    ) -> Option<f64> {
        self.asked_m2(context, self.planes.iter().rev(), place, asked)
    }

    fn asked_m2<'p>(
        &self,
        context: &Context<'_, S>,
        mut from_light: impl Iterator<Item = &'p u32>,
        place: Asking,
        asked: EmitterPlace,
    ) -> Option<f64> {
        if self.planes.is_empty() {
            return None;
        }
        let Context { images, world, .. } = context;
        let light = images.emitter(world.facets[asked.facet as usize].material)?;
        let image = from_light.try_fold(light, |image, plane| images.emitter_in(image, *plane));
        Some(image.map_or(0.0, |image| images.asked_m2(world, image, place, asked)))
    }
}
