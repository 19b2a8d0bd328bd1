//! What virtual lights give to the first diffuse surface of a pixel's path, and what they leave to
//! the path.

use super::{Path, PathWork};
use crate::bsdf::Bsdf;
use crate::context::Context;
use crate::photon::virtual_lights::{AskedLight, Receiving, ShadowSegment, Site};
use crate::spectrum::Spectrum;
use crate::world::Interaction;

impl<S: Spectrum> Path<'_, S> {
    /// Takes the light of the virtual lights at a surface, if that is a diffuse one, and asks some
    /// of them; a path does so once.
    pub(super) fn sample_direct_virtual_lights(
        &mut self,
        context: &Context<'_, S>,
        bounces: u32,
        at: &Interaction,
        work: &mut PathWork<S>,
    ) {
        let Some(probed) = self.virtual_lights else { return };
        if !context.world.bsdf(at).keeps_illuminance() {
            return;
        }
        // There are lights with all bounces but one: too many where mirrors came before.
        if bounces > 0 && context.max_bounces.is_some() {
            self.virtual_lights = None;
            return;
        }
        let (from, to_start) = (context.world.ray_origin(at), self.weight(context, at));
        let site = Site::new(at);
        let place = Receiving {
            site,
            seen_by: &probed.seen_by,
            probes: if bounces == 0 { probed.probes_near(&site) } else { 0 },
            u: self.sampler.next_1d(),
        };
        let (number, PathWork { shadows, sums, .. }) = (self.number, work);
        let expected_lx = probed.lights.illuminance_lx(&place, sums, |asked: AskedLight<S>| {
            let AskedLight {
                way: ShadowSegment { direction, distance_m, facet },
                bounces,
                if_seen_lx,
            } = asked;
            let ray = from.shadow_ray(direction, distance_m, facet);
            shadows.push_connection(number, to_start * if_seen_lx, bounces, ray);
        });
        self.found.add(bounces + 2, to_start * expected_lx);
        self.has_asked_virtual = true;
    }

    /// Takes along from a surface what virtual lights left of it to the one before; whether that is
    /// anything.
    pub(super) fn takes_from_virtual_lights(&mut self, bsdf: &Bsdf<S>, at: &Interaction) -> bool {
        if !std::mem::take(&mut self.has_asked_virtual) {
            return true;
        }
        let asked = self.virtual_lights.take().zip(self.pdf_sr);
        let Some((probed, pdf_sr)) = asked.filter(|_| bsdf.keeps_illuminance()) else {
            return true;
        };
        let cos_there = -at.n.dot(self.direction);
        let share = probed.lights.left_to_paths(pdf_sr, cos_there, at.distance_m);
        self.beta = self.beta * share;
        share > 0.0
    }
}
