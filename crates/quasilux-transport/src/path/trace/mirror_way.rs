//! The way of a path over plane mirrors, since the vertex that asked what they show of area lights.

use super::Path;
use crate::bsdf::BsdfSample;
use crate::context::Context;
use crate::path::end::Rest;
use crate::spectrum::Spectrum;
use crate::world::Interaction;
use glam::DVec3;

/// Mirrors that a path met one after the other, and nothing else since it last asked for light.
pub(super) struct MirrorWay {
    /// Density in sr^-1 of the direction in which it left.
    pdf_sr: f64,
    /// Over all of the mirrors, in m.
    distance_m: f64,
    /// Numbers of their planes.
    planes: Vec<u32>,
}

/// How the last vertex of a path asks for the place on an area light that it ran into.
#[derive(Default)]
pub(super) struct Asked {
    /// Density in m^-2 with which it does.
    pub(super) pdf_m2: f64,
    /// One over the density in m^-2 with which its direction there leads to it.
    pub(super) inverse_of_direction_m2: f64,
}

impl MirrorWay {
    /// At the vertex.
    pub(super) fn new(pdf_sr: f64) -> Self {
        Self { pdf_sr, distance_m: 0.0, planes: Vec::new() }
    }

    /// After one more surface mirrored it; `None` where that is no plane mirror.
    pub(super) fn mirrored<S: Spectrum>(
        mut self,
        context: &Context<'_, S>,
        at: &Interaction,
    ) -> Option<Self> {
        self.planes.push(context.images.plane_of(at.facet)?);
        self.distance_m += at.distance_m;
        Some(self)
    }
}

impl<S: Spectrum> Path<'_, S> {
    /// Whether it asks for images of area lights: not where it ends on a map or might, which holds
    /// their light.
    pub(super) fn asks_for_emitter_images(&self, context: &Context<'_, S>) -> bool {
        let is_on_no_map = self.bounces_asked == 0 || matches!(self.rest, Rest::Path);
        context.images.show_emitters() && is_on_no_map
    }

    /// Whether it would, if it did not note where it might have ended.
    pub(super) fn would_ask_for_emitter_images(&self, context: &Context<'_, S>) -> bool {
        context.images.show_emitters() && matches!(self.rest, Rest::Recorded)
    }

    /// Notes that it goes on from a surface, from `wo` in its frame to what was drawn.
    pub(super) fn note_mirrors(
        &mut self,
        context: &Context<'_, S>,
        at: &Interaction,
        wo: DVec3,
        next: &BsdfSample<S>,
    ) {
        let way = self.mirror_way.take();
        self.mirror_way = match next.pdf_sr {
            Some(pdf_sr) => self.asks_for_emitter_images(context).then(|| {
                let bsdf = context.world.bsdf(at);
                let of_partition = |_| bsdf.partition_pdf_sr(wo, next.wi);
                MirrorWay::new(self.subpath.map_or(pdf_sr, of_partition))
            }),
            None if next.wi.z > 0.0 => way.and_then(|way| way.mirrored(context, at)),
            None => None,
        };
    }

    /// The image that its last vertex asks for of the place on an area light, where it came over
    /// mirrors.
    pub(super) fn asked_image(&self, context: &Context<'_, S>, at: &Interaction) -> Option<Asked> {
        let way = self.mirror_way.as_ref().filter(|way| !way.planes.is_empty())?;
        let facet = context.world.facet(at);
        let images = &context.images;
        let light = images.emitter(facet.material)?;
        let mut planes = way.planes.iter().rev();
        let image = planes.try_fold(light, |image, plane| images.emitter_in(image, *plane))?;
        let pdf_m2 = images.asked_m2(image, facet.emitted_cd_m2);
        let distance_m = way.distance_m + at.distance_m;
        let cos = at.n.dot(self.direction).abs();
        let inverse_of_direction_m2 = distance_m * distance_m / (cos * way.pdf_sr);
        Some(Asked { pdf_m2, inverse_of_direction_m2 })
    }
}
