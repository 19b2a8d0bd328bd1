//! What eye paths ask for at their vertices: light of one light of each kind, and that of a light
//! subpath.

use super::{EyePath, EyePaths, EyeWeights};
use crate::bsdf::TransportMode;
use crate::estimator::bidirectional::engine::Engine;
use crate::estimator::bidirectional::leading::WayOut;
use crate::estimator::bidirectional::light_subpath::LightVertex;
use crate::estimator::bidirectional::plan::{CONNECTED, FoundBy, favour};
use crate::estimator::bidirectional::subpath_weights::{of_connection, product};
use crate::lights::{Asking, Choice, ChosenPlace, DrawnDirection, EmitterPoint};
use crate::spectrum::Spectrum;
use crate::world::vertex::Vertex;
use crate::world::visibility::LightSample;
use glam::DVec3;
use quasilux_bvh::RayQuery;
use quasilux_sampling::choose_weights;

/// Light vertices that are looked at from an eye vertex.
const CANDIDATES: usize = 4;

/// Lights without extent that are asked at the surface that a pixel sees.
const ASKED_AT_ONCE: usize = 8;

/// Vertex of an eye path that asks for light.
pub(super) struct EyeVertex<'v, 'w, S> {
    pub(super) vertex: &'v Vertex<'w, S>,
    pub(super) way_out: WayOut,
    pub(super) weights: EyeWeights,
    /// Copies of light subpaths that leave it.
    pub(super) copies: f64,
    /// In its path, 0 for the target.
    pub(super) number: usize,
}

impl<S: Spectrum> EyePath<'_, S> {
    /// Asks for the light of every light without extent.
    pub(super) fn sample_direct_all_pointlikes(
        &self,
        engine: &Engine<'_, '_, S>,
        eye_vertex: &EyeVertex<'_, '_, S>,
        work: &mut EyePaths<S>,
    ) {
        let pointlikes = &engine.context.lights.pointlikes;
        for number in 0..pointlikes.len() {
            let sample = pointlikes.light_sample_of(number, eye_vertex.vertex);
            let per_lm = engine.sources.per_lm(number);
            self.ask(
                sample.map(|it| eye_vertex.beside_landings(it, per_lm, 1.0)),
                eye_vertex.vertex,
                work,
            );
        }
    }

    /// Asks for the light of each light without extent where there are few, else of some, where
    /// photons take no part.
    pub(super) fn sample_direct_some_pointlikes(
        &mut self,
        engine: &Engine<'_, '_, S>,
        vertex: &Vertex<'_, S>,
        work: &mut EyePaths<S>,
    ) {
        let pointlikes = &engine.context.lights.pointlikes;
        if pointlikes.len() <= ASKED_AT_ONCE {
            for number in 0..pointlikes.len() {
                let sample = pointlikes.light_sample_of(number, vertex);
                self.ask(sample, vertex, work);
            }
            return;
        }
        let u = self.sampler.next_1d();
        let (share, place) = (1.0 / ASKED_AT_ONCE as f64, Asking::at(vertex));
        for number in 0..ASKED_AT_ONCE {
            let u = (number as f64 + u) * share;
            let sample = match pointlikes.choose(place, u, &mut work.choice) {
                None => LightSample::without_choice(work.choice.total()),
                Some(Choice { number, pdf }) => pointlikes
                    .light_sample_of(number, vertex)
                    .map(|it| LightSample { light: it.light * (share / pdf), ..it }),
            };
            self.ask(sample, vertex, work);
        }
    }

    /// Asks for the light of one light without extent.
    pub(super) fn sample_direct_pointlike(
        &mut self,
        engine: &Engine<'_, '_, S>,
        eye_vertex: &EyeVertex<'_, '_, S>,
        work: &mut EyePaths<S>,
    ) {
        let pointlikes = &engine.context.lights.pointlikes;
        if pointlikes.is_empty() {
            return;
        }
        let u = if pointlikes.len() > 1 { self.sampler.next_1d() } else { 0.0 };
        let place = Asking::at(eye_vertex.vertex);
        let Some(Choice { number, pdf }) = pointlikes.choose(place, u, &mut work.choice) else {
            let sample = LightSample::without_choice(work.choice.total());
            self.ask(sample, eye_vertex.vertex, work);
            return;
        };
        let sample = pointlikes.light_sample_of(number, eye_vertex.vertex);
        let per_lm = engine.sources.per_lm(number);
        self.ask(
            sample.map(|it| eye_vertex.beside_landings(it, per_lm, pdf)),
            eye_vertex.vertex,
            work,
        );
    }

    /// Asks for the light of lights without extent in mirrors: of all images, or of one for
    /// several, which is no part of weights.
    pub(super) fn sample_direct_images(
        &mut self,
        engine: &Engine<'_, '_, S>,
        eye_vertex: &EyeVertex<'_, '_, S>,
        work: &mut EyePaths<S>,
    ) {
        let images = &engine.context.images;
        if images.is_empty() {
            return;
        }
        let u = self.sampler.next_1d();
        let share = |light: u32, direction: DVec3, lx: f64| {
            let landings = engine.sources.per_lm(light as usize) * lx;
            let to_eye = eye_vertex.to_eye(direction, FoundBy::Photons, 1.0);
            of_connection(product(landings, to_eye), 0.0)
        };
        let query = engine.context.image_query(self.number, eye_vertex.vertex);
        images.sample_direct(&query, u, share, &mut work.images, &mut work.shadows);
    }

    /// Asks for the light of lights with an area, and from outside; `beside_area` has the weights
    /// where photons come straight from those with an area.
    pub(super) fn sample_direct_areas(
        &mut self,
        engine: &Engine<'_, '_, S>,
        eye_vertex: &EyeVertex<'_, '_, S>,
        beside_area: &EyeVertex<'_, '_, S>,
        work: &mut EyePaths<S>,
    ) {
        self.sample_direct_luminaire(engine, beside_area, work);
        self.sample_direct_emitter(engine, beside_area, work);
        self.sample_direct_outside(engine, eye_vertex, work);
        self.sample_direct_emitter_images(engine, eye_vertex, work);
    }

    fn sample_direct_luminaire(
        &mut self,
        engine: &Engine<'_, '_, S>,
        eye_vertex: &EyeVertex<'_, '_, S>,
        work: &mut EyePaths<S>,
    ) {
        let luminaires = &engine.context.lights.area_luminaires;
        if luminaires.is_empty() {
            return;
        }
        let u = self.sampler.next_2d();
        let vertex = eye_vertex.vertex;
        let chosen = luminaires.choose(Asking::at(vertex), u, &mut work.choice);
        let Some(ChosenPlace { choice: Choice { number, pdf }, place }) = chosen else { return };
        let cos = |direction| vertex.cos(direction);
        let incidence = luminaires.incidence(number, &place, vertex.position(), cos);
        let Some(incidence) = incidence else { return };
        let light = vertex.weight(incidence.direction) * incidence.illuminance_lx;
        let sample = LightSample::unless_dark(
            incidence.direction,
            incidence.distance_m,
            light,
            incidence.illuminance_lx,
        );
        let per_lm = engine.sources.of_luminaire_per_lm(number);
        self.ask(
            sample.map(|it| eye_vertex.beside_landings(it, per_lm, pdf)),
            eye_vertex.vertex,
            work,
        );
    }

    fn sample_direct_emitter(
        &mut self,
        engine: &Engine<'_, '_, S>,
        eye_vertex: &EyeVertex<'_, '_, S>,
        work: &mut EyePaths<S>,
    ) {
        let Some(emitters) = &engine.context.lights.emitters else { return };
        let u = self.sampler.next_2d();
        let beside_sr = |point: &EmitterPoint| eye_vertex.beside_asked_sr(engine, point);
        let sample = emitters.light_sample(
            &engine.context.world,
            eye_vertex.vertex,
            u,
            beside_sr,
            &mut work.choice,
        );
        self.ask(sample, eye_vertex.vertex, work);
    }

    /// Asks for the light of area lights as mirrors show them.
    fn sample_direct_emitter_images(
        &mut self,
        engine: &Engine<'_, '_, S>,
        eye_vertex: &EyeVertex<'_, '_, S>,
        work: &mut EyePaths<S>,
    ) {
        let images = &engine.context.images;
        if !images.show_emitters() {
            return;
        }
        let u = self.sampler.next_2d();
        let beside_sr = |point: &EmitterPoint| eye_vertex.beside_asked_sr(engine, point);
        let query = engine.context.image_query(self.number, eye_vertex.vertex);
        images.sample_emitters(&query, u, beside_sr, &mut work.images, &mut work.shadows);
    }

    fn sample_direct_outside(
        &mut self,
        engine: &Engine<'_, '_, S>,
        eye_vertex: &EyeVertex<'_, '_, S>,
        work: &mut EyePaths<S>,
    ) {
        let Some(outside) = &engine.context.lights.outside else { return };
        let vertex = eye_vertex.vertex;
        let sample = |direction: DVec3, pdf_sr: f64, cd_m2: f64, of_sun: bool| {
            let cos = vertex.cos(direction);
            if cos <= 0.0 {
                return None;
            }
            let line = engine.sources.pdf_line(vertex.position(), -direction, of_sun);
            let found_by = if of_sun { FoundBy::Photons } else { engine.sky_found_by };
            let landed = product(line * cos / pdf_sr, eye_vertex.to_eye(direction, found_by, 1.0));
            let hit = eye_vertex.survival_pdf_sr(engine, direction) / pdf_sr;
            let lx = cd_m2 * cos / pdf_sr * of_connection(landed, hit);
            let light = vertex.weight(direction) * lx;
            LightSample::unless_dark(direction, outside.beyond_m(), light, lx)
        };
        if outside.is_asked_for() {
            let u = self.sampler.next_2d();
            let asked = eye_vertex.way_out.sample_asked(outside, u);
            let found = asked.and_then(|DrawnDirection { direction, pdf_sr }| {
                sample(direction, pdf_sr, outside.luminance_cd_m2(direction), false)
            });
            self.ask(found, vertex, work);
        }
        if outside.has_sun() {
            let u = self.sampler.next_2d();
            let [cd_m2, lx] = outside.sun_brightness();
            let found = outside
                .sample_sun(u)
                .and_then(|direction| sample(direction, cd_m2 / lx, cd_m2, true));
            self.ask(found, vertex, work);
        }
    }

    fn ask(&self, sample: Option<LightSample<S>>, vertex: &Vertex<'_, S>, work: &mut EyePaths<S>) {
        if let Some(sample) = sample {
            self.receiver.assert_capped("a light that was asked", sample.light);
            work.shadows.ask(self.number, vertex, &sample);
        }
    }

    /// Asks for the light of its light subpath by one of the vertices. Of many some are looked at,
    /// evenly spaced, and one of these is chosen in proportion to what each would give: choices are
    /// no part of weights.
    pub(super) fn connect(
        &mut self,
        engine: &Engine<'_, '_, S>,
        eye_vertex: &EyeVertex<'_, '_, S>,
        work: &mut EyePaths<S>,
    ) {
        let most = engine.context.max_bounces.unwrap_or(u32::MAX);
        let bounces = self.last.bounces_asked;
        let own = self.partner.iter();
        let own = own.take_while(|it| bounces + it.bounces < most);
        let count = own.clone().count();
        if count == 0 {
            return;
        }
        let u = self.sampler.next_1d() / CONNECTED;
        if u >= 1.0 {
            return;
        }
        let stride = count.div_ceil(CANDIDATES);
        let first = ((u * stride as f64) as usize).min(stride - 1);
        let u = u * stride as f64 - first as f64;
        let candidates = own.skip(first).step_by(stride);
        let connections = candidates.filter_map(|it| eye_vertex.connection(engine, it));
        let connections: Vec<Connection<'_, S>> = connections.collect();
        let Some(choice) = choose_weights(u, connections.iter().map(|it| it.light.luminance()))
        else {
            return;
        };
        let &Connection { vertex, direction, distance_m, light } = &connections[choice.index];
        self.receiver.assert_capped("a connection", light);
        let light = light * stride as f64;
        let from = eye_vertex.vertex.ray_origin(direction);
        let ray = from.shadow_ray(direction, distance_m, vertex.at.facet);
        let (light, bounces) = (light * choice.pdf.recip(), vertex.bounces + 1);
        work.shadows.max_bounces = most - self.last.bounces_asked;
        work.shadows.push_polyline(self.number, light, bounces, RayQuery::NONE, |rays| {
            rays.push(ray);
        });
    }
}

/// The light of one light vertex, unless something stands in the way.
struct Connection<'l, S> {
    vertex: &'l LightVertex<S>,
    direction: DVec3,
    distance_m: f64,
    light: S,
}

impl<S: Spectrum> EyeVertex<'_, '_, S> {
    /// The techniques that leave this vertex and more to light subpaths, over the density with
    /// which light that comes from `direction` makes it; this many copies leave the place that it
    /// comes from, one a light.
    fn to_eye(&self, direction: DVec3, found: FoundBy, copies_there: f64) -> f64 {
        let copied = self.copies / copies_there;
        let back_sr = copied * self.vertex.reverse_survival_pdf_sr(direction);
        self.weights.select(found).towards(back_sr)
    }

    /// Density in sr^-1 of paths that go on from here along `direction`, survival in it.
    fn survival_pdf_sr(&self, engine: &Engine<'_, '_, S>, direction: DVec3) -> f64 {
        self.way_out.survival_pdf_sr(engine, self.vertex, direction, favour(self.number))
    }

    /// Densities in sr^-1 of the other techniques beside asking for a point of an emitting facet,
    /// over mirrors or not.
    fn beside_asked_sr(&self, engine: &Engine<'_, '_, S>, point: &EmitterPoint) -> f64 {
        let &EmitterPoint { direction, lx_sr, kept, .. } = point;
        let to_eye = self.to_eye(direction, engine.emitters_found_by, 1.0);
        let landed = product(engine.sources.of_emitters_per_lm() * lx_sr, to_eye);
        kept * (self.survival_pdf_sr(engine, direction) + landed)
    }

    /// The part of the light of a lamp that photons leave, where it is asked with this probability.
    fn beside_landings(&self, sample: LightSample<S>, per_lm: f64, pdf: f64) -> LightSample<S> {
        let landings = per_lm * sample.illuminance_lx / pdf;
        let to_eye = self.to_eye(sample.direction, FoundBy::Photons, 1.0);
        let share = of_connection(product(landings, to_eye), 0.0);
        LightSample { light: sample.light * (share / pdf), ..sample }
    }

    /// `None` where one of the two turns its back on the other.
    fn connection<'l>(
        &self,
        engine: &Engine<'_, '_, S>,
        light_vertex: &'l LightVertex<S>,
    ) -> Option<Connection<'l, S>> {
        let LightVertex { at, frame, wo, flux_lm, weights, found_by, led, copies, split, .. } =
            light_vertex;
        let way = at.position - self.vertex.position();
        let square_m2 = way.length_squared();
        let distance_m = square_m2.sqrt();
        let direction = way / distance_m;
        let cos = self.vertex.cos(direction);
        let wi = frame.to_local(-direction);
        let bsdf = engine.context.world.bsdf(at);
        let faces = cos > 0.0 && (wi.z > 0.0 || (wi.z < 0.0 && bsdf.transmits()));
        if !faces {
            return None;
        }
        let scattered = bsdf.evaluate(*wo, wi, at.front, TransportMode::Importance);
        let cos_there = wi.z.abs();
        let to_light = product(
            self.survival_pdf_sr(engine, direction) * cos_there / square_m2,
            weights.numbered(self.number + 1).towards(led.survival_pdf_sr(
                bsdf,
                wi,
                *wo,
                favour(self.number + 1),
            )),
        );
        let to_eye = product(
            split * bsdf.survival_pdf_sr(*wo, wi, 1.0) * cos / square_m2,
            self.to_eye(direction, *found_by, *copies),
        );
        let share = of_connection(to_eye / CONNECTED, to_light / CONNECTED);
        let lx = cos * cos_there / square_m2 * share / CONNECTED;
        let light = self.vertex.weight(direction) * *flux_lm * scattered * lx;
        let is_something = light.luminance() > 0.0 && light.luminance().is_finite();
        is_something.then_some(Connection { vertex: light_vertex, direction, distance_m, light })
    }
}
