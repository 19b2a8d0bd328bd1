//! From the pinhole to the first surface that scatters.

use crate::bsdf::TransportMode;
use crate::cutoff::{Gain, MAX_EVENTS};
use crate::estimator::bidirectional::departure::Departure;
use crate::estimator::bidirectional::engine::Engine;
use crate::estimator::bidirectional::eye_path::{FirstSurface, Sink};
use crate::path::path_batch::WorkCounts;
use crate::path::pixel_rays::PixelRay;
use crate::spectrum::Spectrum;
use crate::world::Interaction;
use crate::world::vertex::Surface;
use quasilux_bvh::{Hit, RayQuery};
use quasilux_sampling::Sampler;

/// Paths that carry less than this part of what they see may end at mirrors and glass.
const FAINT: f64 = 1.0 / 16.0;

/// A path that has left the pinhole.
pub(super) struct CameraPath<'p, S> {
    ray: PixelRay<'p>,
    beta: S,
    bounces: u32,
    gain: Gain,
}

/// A path at the first surface that scatters.
pub(super) struct Seen<'p, S> {
    pub(super) section: usize,
    pub(super) index: u64,
    pub(super) sampler: Sampler<'p>,
    pub(super) surface: FirstSurface<S>,
}

/// Outcome of a path where its ray ends.
enum Arrival<S> {
    Over,
    GoesOn,
    Sees(FirstSurface<S>),
}

impl<'p, S: Spectrum> CameraPath<'p, S> {
    pub(super) fn new(ray: PixelRay<'p>) -> Self {
        Self { ray, beta: S::white(), bounces: 0, gain: Gain::NONE }
    }

    /// Takes paths to the surfaces that they see, and adds all that shines on the way: no other
    /// technique makes that.
    pub(super) fn trace_all(
        engine: &Engine<'_, '_, S>,
        mut travelling: Vec<Self>,
        found: &mut dyn Sink<S>,
        work: &mut WorkCounts,
    ) -> Vec<Seen<'p, S>> {
        let mut seen = Vec::with_capacity(travelling.len());
        let (mut queries, mut hits) = (Vec::<RayQuery>::new(), Vec::<Option<Hit>>::new());
        let mut arrivals = Vec::new();
        for _ in 0..MAX_EVENTS {
            if travelling.is_empty() {
                break;
            }
            queries.clear();
            queries.extend(travelling.iter().map(|path| path.ray.from.query(path.ray.direction)));
            engine.context.world.trace_all(&queries, &mut hits, &mut arrivals);
            work.rays += queries.len() as u64;
            let mut next = Vec::with_capacity(travelling.len());
            for (mut path, at) in travelling.into_iter().zip(&arrivals) {
                match path.arrive(engine, at.as_ref(), found, work) {
                    Arrival::Over => {}
                    Arrival::GoesOn => next.push(path),
                    Arrival::Sees(surface) => {
                        let PixelRay { section, index, sampler, .. } = path.ray;
                        seen.push(Seen { section, index, sampler, surface });
                    }
                }
            }
            travelling = next;
        }
        work.endless += travelling.len() as u64;
        seen
    }

    fn arrive(
        &mut self,
        engine: &Engine<'_, '_, S>,
        at: Option<&Interaction>,
        found: &mut dyn Sink<S>,
        work: &mut WorkCounts,
    ) -> Arrival<S> {
        let context = engine.context;
        let Some(at) = at else {
            if let Some(outside) = &context.lights.outside {
                let direction = self.ray.direction;
                let cd_m2 = outside.luminance_cd_m2(direction) + outside.sun_cd_m2(direction);
                found.add(self.ray.section, self.bounces, self.beta * cd_m2);
            }
            return Arrival::Over;
        };
        let emitted_cd_m2 = context.world.emitted_cd_m2(at);
        if emitted_cd_m2 != 0.0 {
            found.add(self.ray.section, self.bounces, self.beta * emitted_cd_m2);
        }
        if context.max_bounces.is_some_and(|most| self.bounces >= most) {
            return Arrival::Over;
        }
        let Surface { bsdf, frame, wo, .. } = Surface::new(&context.world, at, self.ray.direction);
        if !engine.grow(&mut self.gain, at, wo, TransportMode::Radiance, self.bounces) {
            work.endless += 1;
            return Arrival::Over;
        }
        if !bsdf.is_specular() {
            let &mut Self { beta, bounces, gain, ref ray } = self;
            let direction = ray.direction;
            return Arrival::Sees(FirstSurface { at: *at, direction, beta, bounces, gain });
        }
        let next = bsdf.sample(wo, at.front, TransportMode::Radiance, &mut self.ray.sampler);
        let Some(next) = next else { return Arrival::Over };
        // All that is found behind comes this way, so no weight hangs on who survives.
        let favour = self.beta.max_channel() / FAINT;
        let departure =
            Departure::survive(&context.world, at, &frame, &next, favour, &mut self.ray.sampler);
        let Some(Departure { from, direction, factor }) = departure else { return Arrival::Over };
        (self.ray.from, self.ray.direction) = (from, direction);
        self.beta = self.beta * factor;
        self.bounces += 1;
        Arrival::GoesOn
    }
}
