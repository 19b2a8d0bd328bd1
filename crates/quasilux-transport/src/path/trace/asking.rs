//! What a path asks of the lights at its start and at each surface.

use super::{Path, PathWork};
use crate::context::Stage;
use crate::lights::images::ImageQuery;
use crate::purpose::Purpose;
use crate::spectrum::Spectrum;
use crate::world::Interaction;
use crate::world::vertex::Vertex;
use crate::world::visibility::Offer;
use quasilux_sampling::Sampler;

impl<S: Spectrum> Path<'_, S> {
    /// Asks for the light of all kinds of lights on a surface.
    pub(super) fn ask_all(
        &mut self,
        stage: &Stage<'_, S>,
        bounces: u32,
        at: &Interaction,
        work: &mut PathWork<S>,
    ) {
        let vertex = Vertex::surface(&stage.world, at, self.direction, self.beta);
        work.shadows.most_bounces = stage.max_bounces.map_or(u32::MAX, |most| most - bounces);
        self.ask_area_luminaires(stage, &vertex, work);
        self.ask_pointlikes(stage, &vertex, work);
        self.ask_images(stage, &vertex, work);
        self.ask_emitters(stage, &vertex, work);
    }

    /// Asks for the light of point-like lights in mirrors.
    pub(super) fn ask_images(
        &mut self,
        stage: &Stage<'_, S>,
        vertex: &Vertex<'_, S>,
        work: &mut PathWork<S>,
    ) {
        if !stage.images.is_empty() {
            let choice = Purpose::Image { surface: self.bounces_asked };
            let u = stage.draw(&mut self.sampler, choice, Sampler::next_1d);
            let PathWork { shadows, images, .. } = work;
            let query = ImageQuery {
                world: &stage.world,
                pointlikes: &stage.lights.pointlikes,
                who: self.number,
                vertex,
            };
            stage.images.ask_some(&query, u, images, shadows);
        }
    }

    /// Asks for the light of one point on the area lights.
    pub(super) fn ask_emitters(
        &mut self,
        stage: &Stage<'_, S>,
        vertex: &Vertex<'_, S>,
        work: &mut PathWork<S>,
    ) {
        if let Some(emitters) = &stage.lights.emitters {
            let place = Purpose::AreaLight { surface: self.bounces_asked };
            let u = stage.draw(&mut self.sampler, place, Sampler::next_2d);
            self.ask(emitters.offer(&stage.world, vertex, u), vertex, work);
        }
    }

    /// Asks for the light of one place on the luminaires with an area.
    pub(super) fn ask_area_luminaires(
        &mut self,
        stage: &Stage<'_, S>,
        vertex: &Vertex<'_, S>,
        work: &mut PathWork<S>,
    ) {
        let lights = &stage.lights.area_luminaires;
        if !lights.is_empty() {
            let place = Purpose::AreaLuminaire { surface: self.bounces_asked };
            let u = stage.draw(&mut self.sampler, place, Sampler::next_2d);
            self.ask(lights.offer(vertex, u, &mut work.weights), vertex, work);
        }
    }

    /// Asks for the light of one point-like light.
    fn ask_pointlikes(
        &mut self,
        stage: &Stage<'_, S>,
        vertex: &Vertex<'_, S>,
        work: &mut PathWork<S>,
    ) {
        let lights = &stage.lights.pointlikes;
        if !lights.is_empty() {
            let choice = Purpose::PointLike { surface: self.bounces_asked };
            // A single light is no choice, and takes no coordinate.
            let draw = || stage.draw(&mut self.sampler, choice, Sampler::next_1d);
            let u = (lights.len() > 1).then(draw).unwrap_or_default();
            self.ask(lights.offer(vertex, u, &mut work.offers), vertex, work);
        }
    }

    fn ask(&self, offer: Option<Offer<S>>, vertex: &Vertex<'_, S>, work: &mut PathWork<S>) {
        if let Some(offer) = offer {
            work.shadows.ask(self.number, vertex, &offer);
        }
    }
}
