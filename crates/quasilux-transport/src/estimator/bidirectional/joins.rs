//! Light vertices joined to the target itself.
//!
//! Of the vertices of the light subpaths that a target is joined to, each is taken with a
//! probability that depends on the places of both alone, so it may stand in weights: certain where
//! cosines over squared distance are large, else in proportion to them. They are drawn evenly along
//! the list of all (systematic sampling), from one coordinate.

use super::engine::Engine;
use super::leading::WayOut;
use super::light_subpath::{LightSubpaths, LightVertex};
use super::plan::{JoinEdge, Receiver, favour};
use super::subpath_weights::{of_connection, product};
use crate::bsdf::TransportMode;
use crate::spectrum::Spectrum;
use crate::world::vertex::Vertex;
use crate::world::visibility::ShadowQueue;
use glam::DVec3;
use quasilux_bvh::RayQuery;
use std::ops::Range;

/// A place of a target that vertices are joined to.
pub(super) struct Joiner<'r, S> {
    pub(super) receiver: &'r Receiver,
    pub(super) vertex: Vertex<'r, S>,
    pub(super) way_out: WayOut,
    /// Surfaces and panes on the way of a light vertex at most, itself counted.
    pub(super) max_bounces: u32,
    /// How far it is to the next vertex that is taken, in chances.
    pub(super) next: f64,
}

/// Working space of joins.
pub(super) struct JoinWork<S> {
    per_m2: Vec<f64>,
    pub(super) shadows: ShadowQueue<S>,
}

impl<S> Default for JoinWork<S> {
    fn default() -> Self {
        Self { per_m2: Vec::new(), shadows: ShadowQueue::default() }
    }
}

impl<S: Spectrum> Joiner<'_, S> {
    /// Asks for the light of some of these vertices.
    pub(super) fn join(
        &mut self,
        engine: &Engine<'_, '_, S>,
        who: u32,
        light: &LightSubpaths<S>,
        numbers: Range<usize>,
        work: &mut JoinWork<S>,
    ) {
        let JoinWork { per_m2, shadows } = work;
        let from = self.vertex.position();
        light.places.per_m2(numbers.clone(), self.receiver.n, from, per_m2);
        for (number, per_m2) in numbers.zip(per_m2) {
            self.next -= self.receiver.join_probability_of(*per_m2);
            if self.next < 0.0 {
                self.next += 1.0;
                let vertex = &light.vertices[number];
                if vertex.bounces < self.max_bounces {
                    Join::new(self, vertex).ask(self, engine, who, vertex, shadows);
                }
            }
        }
    }
}

impl<S: Spectrum> Joiner<'_, S> {
    /// Density in sr^-1 of eye paths that start here along a direction.
    fn survival_pdf_sr(&self, engine: &Engine<'_, '_, S>, direction: DVec3) -> f64 {
        self.way_out.survival_pdf_sr(engine, &self.vertex, direction, favour(0))
    }
}

/// The edge between a target and a light vertex.
struct Join {
    /// Unit direction from the target.
    direction: DVec3,
    distance_m: f64,
    edge: JoinEdge,
}

impl Join {
    fn new<S: Spectrum>(joiner: &Joiner<'_, S>, vertex: &LightVertex<S>) -> Self {
        let way = vertex.at.position - joiner.vertex.position();
        let square_m2 = way.length_squared();
        let distance_m = square_m2.sqrt();
        let direction = way / distance_m;
        let cos = joiner.receiver.n.dot(direction);
        let cos_there = vertex.at.n.dot(direction).abs();
        let edge = JoinEdge { cos, cos_there, square_m2, is_narrow: vertex.is_narrow };
        Self { direction, distance_m, edge }
    }

    fn ask<S: Spectrum>(
        &self,
        joiner: &Joiner<'_, S>,
        engine: &Engine<'_, '_, S>,
        who: u32,
        vertex: &LightVertex<S>,
        shadows: &mut ShadowQueue<S>,
    ) {
        let &Self { direction, distance_m, ref edge } = self;
        let LightVertex {
            at, frame, wo, flux_lm, bounces, weights, is_narrow, found_by, led, ..
        } = vertex;
        let bsdf = engine.context.world.bsdf(at);
        let wi = frame.to_local(-direction);
        if wi.z <= 0.0 && !(wi.z < 0.0 && bsdf.transmits()) {
            return;
        }
        let scattered = bsdf.evaluate(*wo, wi, at.front, TransportMode::Importance);
        let &JoinEdge { cos, cos_there, square_m2, .. } = edge;
        let joins = joiner.receiver.joins(edge);
        let photons = joiner.receiver.photons(*is_narrow, *found_by);
        let to_eye = product(
            vertex.split * bsdf.survival_pdf_sr(*wo, wi, 1.0) * cos / square_m2,
            photons / joins,
        );
        let to_light = product(
            joiner.survival_pdf_sr(engine, direction) * wi.z.abs() / square_m2,
            weights.numbered(1).towards(led.survival_pdf_sr(bsdf, wi, *wo, favour(1))) / joins,
        );
        let lx = cos * cos_there / square_m2 / joins * of_connection(to_eye, to_light);
        let light = joiner.vertex.weight(direction) * *flux_lm * scattered * lx;
        let is_something = light.luminance() > 0.0 && light.luminance().is_finite();
        if is_something {
            joiner.receiver.assert_capped("a join", light);
            let from = joiner.vertex.ray_origin(direction);
            let ray = from.shadow_ray(direction, distance_m, at.facet);
            shadows.push_polyline(who, light, bounces + 1, RayQuery::NONE, |rays| rays.push(ray));
        }
    }
}
