//! Ends of a path on an illumination map, and records of the vertices where it might have ended.

use super::{Onward, Path};
use crate::context::Context;
use crate::path::end::{MapEnd, Rest};
use crate::path::frozen_map::{FrozenEnd, bounces_left};
use crate::path::russian_roulette::{CERTAIN_BOUNCES, russian_roulette_factor};
use crate::path::vertex_record::VertexRecord;
use crate::photon::map::{IlluminationMap, MapPoint};
use crate::purpose::Purpose;
use crate::spectrum::Spectrum;
use crate::world::Interaction;

/// Vertices are recorded on paths whose gain is above this, and no more of one path; until then the
/// path goes on for certain.
const MIN_RECORDED_GAIN: f64 = 1.0 / 32.0;
const MAX_RECORDS: usize = 32;

impl<S: Spectrum> Path<'_, S> {
    /// Ends it on a map, where there is one that it may end on here; or records that it might have.
    pub(super) fn end_on_map(
        &mut self,
        context: &Context<'_, S>,
        bounces: u32,
        at: &Interaction,
        albedo: f64,
    ) -> Option<Onward> {
        let bsdf = context.world.bsdf(at);
        match self.rest {
            Rest::Map(end) if bsdf.keeps_illuminance() => self.end_on(end, context, bounces, at),
            Rest::Frozen(end) if bsdf.keeps_illuminance() => {
                self.end_on_frozen(end, context, bounces, at)
            }
            Rest::Recorded
                if self.gain.left() > MIN_RECORDED_GAIN && self.records.len() < MAX_RECORDS =>
            {
                self.record_vertex(context, bounces, at, albedo);
                Some(Onward::ALL)
            }
            Rest::Path | Rest::Recorded | Rest::Map(_) | Rest::Frozen(_) => None,
        }
    }

    /// Notes that it might have ended here.
    fn record_vertex(
        &mut self,
        context: &Context<'_, S>,
        bounces: u32,
        at: &Interaction,
        albedo: f64,
    ) {
        let keeps_illuminance = context.world.bsdf(at).keeps_illuminance();
        self.records.push(VertexRecord {
            at: *at,
            weight: keeps_illuminance.then(|| self.weight(context, at)),
            alone: if bounces < CERTAIN_BOUNCES { 1.0 } else { albedo.min(1.0) },
            bounces,
            flights: self.flights,
            before: None,
            beyond: [S::black(); 2],
        });
    }

    /// Ends it on the light that a map keeps here, where it may.
    fn end_on(
        &mut self,
        end: &MapEnd<'_, S>,
        context: &Context<'_, S>,
        bounces: u32,
        at: &Interaction,
    ) -> Option<Onward> {
        if context.max_bounces.is_some() && bounces > 0 {
            // The light on the map has more bounces than are left.
            return None;
        }
        let (place, weight) = (end.layout.locate(at), self.weight(context, at));
        self.found.indirect += weight * end.map.illuminance_lx(&place, u32::MAX);
        self.take_terms(&end.map, &place, (bounces, u32::MAX), weight);
        // The direction to a light that the next surface emits is part of the direct light here, so
        // it counts in every path; so does that to light from outside, through panes too.
        Some(Onward { everything: 0.0, ..Onward::ALL })
    }

    /// The same on a map that is corrected: those that go on take the difference to it along. Where
    /// nothing is known of the map, there is none.
    fn end_on_frozen(
        &mut self,
        end: &FrozenEnd<'_, S>,
        context: &Context<'_, S>,
        bounces: u32,
        at: &Interaction,
    ) -> Option<Onward> {
        let max_bounces = bounces_left(context.max_bounces, bounces, end.layout.len() as u64)?;
        let weight = self.weight(context, at);
        let place = end.layout.locate(at);
        let lx = end.map.illuminance_lx(&place, max_bounces);
        let survival =
            end.survival_probability(&place, weight.luminance(), (weight * lx).luminance())?;
        let correction = Purpose::Correction { surface: bounces + 1 };
        let everything = context.draw(&mut self.sampler, correction, |sampler| {
            russian_roulette_factor(survival, sampler)
        });
        let weight = weight * (1.0 - everything);
        self.found.indirect += weight * lx;
        self.take_terms(&end.map, &place, (bounces, max_bounces), weight);
        Some(Onward { everything, ..Onward::ALL })
    }

    /// Adds the terms of what a map says of the light at a surface that it came to after `bounces`,
    /// of photons with so many bounces at most.
    fn take_terms(
        &mut self,
        map: &IlluminationMap<'_, S>,
        place: &MapPoint,
        (bounces, max_bounces): (u32, u32),
        weight: S,
    ) {
        if !self.found.terms.is_empty() {
            for term in map.terms_lx(*place, max_bounces) {
                let bounces = bounces + 1 + term.bounces;
                self.found.add_to_term(bounces, weight * term.illuminance_lx);
            }
        }
    }
}
