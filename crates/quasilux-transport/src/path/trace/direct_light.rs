//! Next-event estimation: the samples of direct light that a path asks for at its start and at each
//! surface.

use super::{Path, PathWork};
use crate::context::Context;
use crate::lights::{Asking, EmitterPlace, EmitterPoint, Emitters};
use crate::purpose::Purpose;
use crate::spectrum::Spectrum;
use crate::world::Interaction;
use crate::world::vertex::{Surface, Vertex};
use crate::world::visibility::LightSample;
use glam::DVec3;
use quasilux_sampling::Sampler;

impl<S: Spectrum> Path<'_, S> {
    /// Asks for the light of all kinds of lights on a surface.
    pub(super) fn sample_direct_all(
        &mut self,
        context: &Context<'_, S>,
        bounces: u32,
        at: &Interaction,
        surface: &Surface<'_, S>,
        work: &mut PathWork<S>,
    ) {
        let vertex = Vertex::on(&context.world, at, surface, self.beta.all);
        work.shadows.max_bounces = context.max_bounces.map_or(u32::MAX, |most| most - bounces);
        self.sample_direct_area_luminaires(context, &vertex, work);
        self.sample_direct_pointlikes(context, &vertex, work);
        self.sample_direct_images(context, &vertex, work);
        self.sample_direct_emitters(context, &vertex, work);
        self.sample_direct_emitter_images(context, &vertex, work);
        self.sample_direct_outside(context, &vertex, work);
    }

    /// Asks for the light of point-like lights in mirrors.
    pub(super) fn sample_direct_images(
        &mut self,
        context: &Context<'_, S>,
        vertex: &Vertex<'_, S>,
        work: &mut PathWork<S>,
    ) {
        if !context.images.is_empty() {
            let choice = Purpose::Image { surface: self.last.bounces_asked };
            let u = context.draw(&mut self.sampler, choice, Sampler::next_1d);
            let share = |_: u32, _: DVec3, _: f64| 1.0;
            let query = context.image_query(self.number, vertex);
            let PathWork { shadows, images, .. } = work;
            context.images.sample_direct(&query, u, share, images, shadows);
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
            let place = Purpose::AreaLight { surface: self.last.bounces_asked };
            let u = context.draw(&mut self.sampler, place, Sampler::next_2d);
            let beside_sr = Self::beside_emitter_samples(vertex);
            let light_sample =
                emitters.light_sample(&context.world, vertex, u, beside_sr, &mut work.choice);
            self.last.asked_from = Some(Asking::at(vertex));
            let through_panes = self.asks_for_emitters_through_panes(context);
            let light_sample = light_sample.map(|it| LightSample { through_panes, ..it });
            self.ask(light_sample, vertex, work);
        }
    }

    /// Density in m^-2 with which it asked for this place on them, straight or through panes.
    pub(super) fn asked_m2(
        &self,
        context: &Context<'_, S>,
        emitters: &Emitters,
        at: &Interaction,
    ) -> f64 {
        let asked = EmitterPlace { facet: at.facet, position: at.position };
        self.last.asked_from.map_or(0.0, |place| emitters.pdf_m2(&context.world, place, asked))
    }

    /// Asks for the light of one point on the mirror images of the area lights.
    pub(super) fn sample_direct_emitter_images(
        &mut self,
        context: &Context<'_, S>,
        vertex: &Vertex<'_, S>,
        work: &mut PathWork<S>,
    ) {
        if !self.asks_for_emitter_images(context) {
            return;
        }
        let place = Purpose::AreaLightImage { surface: self.last.bounces_asked };
        let u = context.draw(&mut self.sampler, place, Sampler::next_2d);
        let beside_sr = Self::beside_emitter_samples(vertex);
        let query = context.image_query(self.number, vertex);
        let PathWork { shadows, images, .. } = work;
        context.images.sample_emitters(&query, u, beside_sr, images, shadows);
    }

    /// Of a point on a light, what weighs beside the density of asking for it, in sr^-1: by the
    /// power heuristic the direction in which the path goes on.
    fn beside_emitter_samples(vertex: &Vertex<'_, S>) -> impl Fn(&EmitterPoint) -> f64 {
        move |&EmitterPoint { direction, pdf_sr, .. }| {
            let beside_sr = vertex.pdf_sr(direction);
            beside_sr * (beside_sr / pdf_sr)
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
            let place = Purpose::AreaLuminaire { surface: self.last.bounces_asked };
            let draw_2d = || context.draw(&mut self.sampler, place, Sampler::next_2d);
            let choice = lights.are_many().then(draw_2d);
            let u = context.draw(&mut self.sampler, place, Sampler::next_2d);
            let count = if vertex.is_sensor() { lights.asked_at_sensor() } else { 1 };
            for number in 0..count {
                let part = |u: f64| (f64::from(number) + u) / f64::from(count);
                let choice = choice.map(|[first, second]| [part(first), second]);
                let light_sample = lights.light_sample(vertex, choice, u, &mut work.choice);
                let light_sample = light_sample.map(|it| {
                    let light = it.light * f64::from(count).recip();
                    LightSample { light, ..it }
                });
                self.ask(light_sample, vertex, work);
            }
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
            let choice = Purpose::PointLike { surface: self.last.bounces_asked };
            let u = match lights.dimensions_of_choice() {
                0 => [0.0; 2],
                1 => [context.draw(&mut self.sampler, choice, Sampler::next_1d), 0.0],
                _ => context.draw(&mut self.sampler, choice, Sampler::next_2d),
            };
            let light_sample = lights.light_sample(vertex, u, &mut work.choice);
            self.ask(light_sample, vertex, work);
        }
    }

    pub(super) fn ask(
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
