//! Next-event estimation: the samples of direct light that a path asks for at its start and at each
//! surface.

use super::{Path, PathWork};
use crate::context::Context;
use crate::lights::images::ImageQuery;
use crate::purpose::Purpose;
use crate::spectrum::Spectrum;
use crate::world::Interaction;
use crate::world::vertex::Vertex;
use crate::world::visibility::LightSample;
use quasilux_sampling::Sampler;

impl<S: Spectrum> Path<'_, S> {
    /// Asks for the light of all kinds of lights on a surface.
    pub(super) fn sample_direct_all(
        &mut self,
        context: &Context<'_, S>,
        bounces: u32,
        at: &Interaction,
        work: &mut PathWork<S>,
    ) {
        let vertex = Vertex::surface(&context.world, at, self.direction, self.beta);
        work.shadows.max_bounces = context.max_bounces.map_or(u32::MAX, |most| most - bounces);
        self.sample_direct_area_luminaires(context, &vertex, work);
        self.sample_direct_pointlikes(context, &vertex, work);
        self.sample_direct_images(context, &vertex, work);
        self.sample_direct_emitters(context, &vertex, work);
    }

    /// Asks for the light of point-like lights in mirrors.
    pub(super) fn sample_direct_images(
        &mut self,
        context: &Context<'_, S>,
        vertex: &Vertex<'_, S>,
        work: &mut PathWork<S>,
    ) {
        if !context.images.is_empty() {
            let choice = Purpose::Image { surface: self.bounces_asked };
            let u = context.draw(&mut self.sampler, choice, Sampler::next_1d);
            let PathWork { shadows, images, .. } = work;
            let query = ImageQuery {
                world: &context.world,
                pointlikes: &context.lights.pointlikes,
                who: self.number,
                vertex,
            };
            context.images.sample_direct(&query, u, images, shadows);
        }
    }

    /// Asks for the light of one point on the area lights.
    pub(super) fn sample_direct_emitters(
        &mut self,
        context: &Context<'_, S>,
        vertex: &Vertex<'_, S>,
        work: &mut PathWork<S>,
    ) {
        if let Some(emitters) = &context.lights.emitters {
            let place = Purpose::AreaLight { surface: self.bounces_asked };
            let u = context.draw(&mut self.sampler, place, Sampler::next_2d);
            self.ask(emitters.light_sample(&context.world, vertex, u), vertex, work);
        }
    }

    /// Asks for the light of one place on the luminaires with an area.
    pub(super) fn sample_direct_area_luminaires(
        &mut self,
        context: &Context<'_, S>,
        vertex: &Vertex<'_, S>,
        work: &mut PathWork<S>,
    ) {
        let lights = &context.lights.area_luminaires;
        if !lights.is_empty() {
            let place = Purpose::AreaLuminaire { surface: self.bounces_asked };
            let u = context.draw(&mut self.sampler, place, Sampler::next_2d);
            self.ask(lights.light_sample(vertex, u, &mut work.weights), vertex, work);
        }
    }

    /// Asks for the light of one point-like light.
    fn sample_direct_pointlikes(
        &mut self,
        context: &Context<'_, S>,
        vertex: &Vertex<'_, S>,
        work: &mut PathWork<S>,
    ) {
        let lights = &context.lights.pointlikes;
        if !lights.is_empty() {
            let choice = Purpose::PointLike { surface: self.bounces_asked };
            // A single light is no choice, and takes no coordinate.
            let draw = || context.draw(&mut self.sampler, choice, Sampler::next_1d);
            let u = (lights.len() > 1).then(draw).unwrap_or_default();
            self.ask(lights.light_sample(vertex, u, &mut work.light_samples), vertex, work);
        }
    }

    fn ask(
        &self,
        light_sample: Option<LightSample<S>>,
        vertex: &Vertex<'_, S>,
        work: &mut PathWork<S>,
    ) {
        if let Some(light_sample) = light_sample {
            work.shadows.ask(self.number, vertex, &light_sample);
        }
    }
}
