//! Connections of an eye subpath to the vertices of its light subpath.

use super::{Path, PathWork};
use crate::bsdf::TransportMode;
use crate::context::Context;
use crate::path::light_subpath::LightVertex;
use crate::path::subpath_weights::{SubpathWeights, of_connection, product};
use crate::purpose::Purpose;
use crate::spectrum::Spectrum;
use crate::world::vertex::Vertex;
use glam::DVec3;
use quasilux_sampling::{Sampler, choose_weights};

/// The light of one light vertex, unless something stands in the way.
pub(crate) struct Connection<S> {
    /// Number of the vertex in its subpath.
    vertex: usize,
    direction: DVec3,
    distance_m: f64,
    light: S,
}

impl<S: Spectrum> Path<'_, S> {
    /// Asks for the light of all vertices of its light subpath by one of them, chosen in
    /// proportion to what each would give: the only variance of the choice comes from shadows.
    pub(super) fn connect(
        &mut self,
        context: &Context<'_, S>,
        vertex: &Vertex<'_, S>,
        work: &mut PathWork<S>,
    ) {
        let Some(weights) = self.subpath else { return };
        let u = context.draw(&mut self.sampler, Purpose::Connections, Sampler::next_1d);
        let PathWork { light_subpaths, connections, shadows, .. } = work;
        let own = &light_subpaths.vertices[self.number as usize];
        let most = context.max_bounces.unwrap_or(u32::MAX);
        let counts = |light: &&LightVertex<S>| self.bounces_asked + light.bounces < most;
        connections.clear();
        connections.extend(own.iter().take_while(counts).enumerate().filter_map(
            |(number, light)| Connection::new(context, number, vertex, weights, light),
        ));
        let lights = connections.iter().map(|connection| connection.light.luminance());
        let Some(choice) = choose_weights(u, lights.clone()) else {
            if lights.sum::<f64>() != 0.0 {
                // What is no number counts: the tally must refuse it.
                self.found.add(self.bounces_asked + 1, S::white() * f64::NAN);
            }
            return;
        };
        let Connection { vertex: number, direction, distance_m, light } = connections[choice.index];
        let end = &own[number];
        let ray = vertex.ray_origin(direction).shadow_ray(direction, distance_m, end.at.facet);
        shadows.push_connection(self.number, light * (1.0 / choice.pdf), end.bounces + 1, ray);
    }

    /// The weight of light that it asks of a light that photons leave, and land here with this
    /// density in m^-2.
    pub(super) fn weight_beside_landings(
        &self,
        vertex: &Vertex<'_, S>,
        direction: DVec3,
        landings_m2: f64,
    ) -> f64 {
        match self.subpath {
            None | Some(SubpathWeights::SENSOR) => 1.0,
            Some(weights) => {
                let to_eye = weights.towards(vertex.reverse_pdf_sr(direction));
                of_connection(product(landings_m2, to_eye), 0.0)
            }
        }
    }
}

impl<S: Spectrum> Connection<S> {
    /// `None` where one of the two turns its back on the other.
    fn new(
        context: &Context<'_, S>,
        number: usize,
        vertex: &Vertex<'_, S>,
        weights: SubpathWeights,
        light: &LightVertex<S>,
    ) -> Option<Self> {
        let LightVertex { at, frame, wo, flux_lm, weights: weights_of_light, .. } = light;
        let way = at.position - vertex.position();
        let square_m2 = way.length_squared();
        let distance_m = square_m2.sqrt();
        let direction = way / distance_m;
        let cos = vertex.cos(direction);
        let wi = frame.to_local(-direction);
        let bsdf = context.world.bsdf(at);
        let faces = cos > 0.0 && (wi.z > 0.0 || (wi.z < 0.0 && bsdf.transmits()));
        if !faces {
            return None;
        }
        let scattered = bsdf.evaluate(*wo, wi, at.front, TransportMode::Importance);
        let cos_there = wi.z.abs();
        let lx_lm = cos * cos_there / square_m2;
        let to_light = product(
            vertex.partition_pdf_sr(direction) * cos_there / square_m2,
            weights_of_light.towards(bsdf.partition_pdf_sr(wi, *wo)),
        );
        let to_eye = product(
            bsdf.partition_pdf_sr(*wo, wi) * cos / square_m2,
            weights.towards(vertex.reverse_pdf_sr(direction)),
        );
        let share = of_connection(to_eye, to_light);
        let light = vertex.weight(direction) * *flux_lm * scattered * (lx_lm * share);
        let is_something = light.luminance() != 0.0;
        is_something.then_some(Self { vertex: number, direction, distance_m, light })
    }
}
