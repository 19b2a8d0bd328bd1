//! Surfaces that scatter: a light subpath leaves a vertex there, and goes on in as many copies as
//! there are to be ([`crate::importance::Copies`]), each of which carries as much less.

use super::super::engine::Engine;
use super::super::flux_tally::FluxTally;
use super::super::leading::WayOut;
use super::{LastVertex, Leg, LightSubpath, LightVertex, is_narrow};
use crate::bsdf::TransportMode;
use crate::lights::images::LightPathClass;
use crate::spectrum::Spectrum;
use crate::world::Interaction;
use crate::world::frame::Frame;
use glam::DVec3;

impl<S: Spectrum> LightSubpath<'_, S> {
    /// The vertex where it has arrived, by the direction that it came from in the frame there.
    pub(super) fn vertex(
        &self,
        engine: &Engine<'_, '_, S>,
        at: &Interaction,
        frame: Frame,
        wo: DVec3,
        way_out: &WayOut,
    ) -> LightVertex<S> {
        let bsdf = engine.context.world.bsdf(at);
        let copies = engine.copies.at(at);
        LightVertex {
            at: *at,
            frame,
            wo,
            flux_lm: self.flux_lm,
            bounces: self.bounces,
            weights: self.weights_at(engine, at, way_out, bsdf, wo.z),
            is_narrow: is_narrow(bsdf),
            found_by: engine.found_by(&self.photon),
            led: way_out.led(engine, -self.direction),
            copies,
            split: copies / self.copies,
        }
    }

    /// Goes on as the first of its copies, if that does; others are born. The first keeps its
    /// coordinates, others have some of their own.
    pub(super) fn scatter_in_copies(
        &mut self,
        engine: &Engine<'_, '_, S>,
        vertex: &LightVertex<S>,
        born: &mut Vec<Self>,
        flux: &mut FluxTally,
    ) -> bool {
        let &LightVertex { copies, split, .. } = vertex;
        // One of the two whole numbers next to the mean: copies and their ratios are powers of two.
        let count = match split < 1.0 {
            true => u32::from(self.sampler.choose_bool(split)),
            false => split as u32,
        };
        self.copies = copies;
        self.flux_lm = self.flux_lm * split.recip();
        for number in 1..count {
            let sampler = self.sampler.child(number);
            let mut copy = Self { sampler, ..self.clone() };
            if copy.scatter(engine, vertex, flux) {
                born.push(copy);
            }
        }
        count > 0 && self.scatter(engine, vertex, flux)
    }

    /// Whether it goes on.
    fn scatter(
        &mut self,
        engine: &Engine<'_, '_, S>,
        vertex: &LightVertex<S>,
        flux: &mut FluxTally,
    ) -> bool {
        let LightVertex { at, frame, wo, weights, is_narrow, split, led, .. } = vertex;
        let bsdf = engine.context.world.bsdf(at);
        let next = bsdf.sample(*wo, at.front, TransportMode::Importance, &mut self.sampler);
        let Some(next) = next else { return false };
        let cos = next.wi.z.abs();
        let weights = weights.scattered(bsdf, [*wo, next.wi], *led, *split);
        let last = LastVertex::Surface { cos, is_narrow: *is_narrow };
        let (class, mirrored) = (LightPathClass::Found, None);
        self.leg = Leg { weights, distance_m: 0.0, last, class, mirrored };
        self.go_on(engine, at, frame, &next, flux)
    }
}
