//! How eye paths start: at a target, or at the first surface that a pixel sees, which measures the
//! light that it sends to the camera as a target measures its illuminance.

use super::asking::EyeVertex;
use super::{EyePath, EyePaths, EyeWeights, LastVertex, MirroredFrom, Passed};
use crate::context::Context;
use crate::cutoff::Gain;
use crate::estimator::bidirectional::engine::Engine;
use crate::estimator::bidirectional::leading::{OnwardSample, WayOut};
use crate::estimator::bidirectional::light_subpath::LightSubpaths;
use crate::estimator::bidirectional::plan::{Receiver, favour};
use crate::estimator::bidirectional::subpath_weights::SubpathWeights;
use crate::lights::DrawnDirection;
use crate::spectrum::Spectrum;
use crate::world::Interaction;
use crate::world::vertex::{Surface, Vertex};
use glam::DVec3;
use quasilux_sampling::Sampler;
use std::f64::consts::{FRAC_1_PI, PI};

/// Where an eye path starts, and who gets what it finds.
pub(in crate::estimator::bidirectional) struct Start<'p, S> {
    /// Number of its sums.
    pub(in crate::estimator::bidirectional) section: usize,
    pub(in crate::estimator::bidirectional) receiver: &'p Receiver,
    pub(in crate::estimator::bidirectional) light: &'p LightSubpaths<S>,
    /// That of the light subpaths which it is connected to.
    pub(in crate::estimator::bidirectional) subpath: usize,
    pub(in crate::estimator::bidirectional) sampler: Sampler<'p>,
    /// Where a pixel sees it; `None` of targets.
    pub(in crate::estimator::bidirectional) surface: Option<&'p FirstSurface<S>>,
}

/// The first surface that scatters on the way from a camera.
pub(in crate::estimator::bidirectional) struct FirstSurface<S> {
    pub(in crate::estimator::bidirectional) at: Interaction,
    /// Unit direction of the ray that met it.
    pub(in crate::estimator::bidirectional) direction: DVec3,
    /// Factor from its luminance to what the pixel sees.
    pub(in crate::estimator::bidirectional) beta: S,
    /// Mirrors and panes before it.
    pub(in crate::estimator::bidirectional) bounces: u32,
    pub(in crate::estimator::bidirectional) gain: Gain,
}

/// An eye path that has started.
pub(super) struct Started<'p, S> {
    pub(super) path: EyePath<'p, S>,
    /// Whether it goes on.
    pub(super) goes_on: bool,
}

impl<'p, S: Spectrum> EyePath<'p, S> {
    pub(super) fn start(
        engine: &Engine<'_, '_, S>,
        number: u32,
        start: Start<'p, S>,
        work: &mut EyePaths<S>,
    ) -> Started<'p, S> {
        let Start { section, receiver, light, subpath, mut sampler, surface } = start;
        let world = &engine.context.world;
        let from = match surface {
            None => receiver.origin(world, || sampler.next_2d()),
            Some(FirstSurface { at, .. }) => world.ray_origin(at),
        };
        let mut path = Self {
            number,
            section,
            receiver,
            partner: light.vertices_of(subpath),
            sampler,
            from,
            direction: receiver.n,
            distance_m: 0.0,
            beta: surface.map_or(S::white() * PI, |first| first.beta),
            gain: surface.map_or(Gain::NONE, |first| first.gain),
            passed: Passed { surfaces: surface.map_or(0, |first| first.bounces), vertices: 0 },
            last: LastVertex::default(),
        };
        let goes_on = match surface {
            None => path.start_at_target(engine, work),
            Some(first) => path.start_at_surface(engine, first, work),
        };
        Started { path, goes_on }
    }

    fn start_at_target(&mut self, engine: &Engine<'_, '_, S>, work: &mut EyePaths<S>) -> bool {
        let context = engine.context;
        let n = self.receiver.n;
        let vertex = &Vertex::sensor(self.from, n);
        let way_out = engine.way_out_of_start(self.receiver, vertex);
        let onward = way_out.sample_start(engine, n, self.sampler.next_2d());
        work.shadows.max_bounces = context.max_bounces.unwrap_or(u32::MAX);
        if self.receiver.is_cell() {
            let beside = &self.beside_photons(vertex, way_out, false);
            self.sample_direct_all_pointlikes(engine, beside, work);
        }
        self.sample_direct_at_start(engine, vertex, way_out, work);
        let Some(DrawnDirection { direction, pdf_sr }) = onward else { return false };
        let cos = n.dot(direction);
        self.direction = direction;
        self.beta = self.beta * (cos * FRAC_1_PI / pdf_sr);
        self.leave(context, vertex, way_out, [pdf_sr, cos]);
        true
    }

    fn start_at_surface(
        &mut self,
        engine: &Engine<'_, '_, S>,
        first: &FirstSurface<S>,
        work: &mut EyePaths<S>,
    ) -> bool {
        let context = engine.context;
        let FirstSurface { at, direction, .. } = first;
        let surface = &Surface::new(&context.world, at, *direction);
        let &Surface { bsdf, frame, wo, .. } = surface;
        let vertex = &Vertex::on(&context.world, at, surface, self.beta);
        self.last.bounces_asked = self.passed.surfaces + 1;
        work.shadows.max_bounces = context
            .max_bounces
            .map_or(u32::MAX, |most| most.saturating_sub(self.last.bounces_asked));
        // Photons of lights that have no extent, and of their images, do not count here.
        let way_out = engine.way_out_of_start(self.receiver, vertex);
        let weights = EyeWeights::default();
        let alone = &EyeVertex { vertex, way_out, weights, copies: 1.0, number: 0 };
        self.sample_direct_some_pointlikes(engine, vertex, work);
        self.sample_direct_images(engine, alone, work);
        self.sample_direct_at_start(engine, vertex, way_out, work);
        let onward = way_out.sample_onward(engine, surface, at.front, &mut self.sampler);
        let Some(OnwardSample { next, led }) = onward else { return false };
        let pdf_sr = led.survival_pdf_sr(bsdf, wo, next.wi, favour(0));
        self.leave(context, vertex, way_out, [pdf_sr, next.wi.z.abs()]);
        self.go_on(engine, at, &frame, &next, led.favour(favour(0)))
    }

    /// Asks for the light of lights with an area, and from outside, beside photons that come
    /// straight from them.
    fn sample_direct_at_start(
        &mut self,
        engine: &Engine<'_, '_, S>,
        vertex: &Vertex<'_, S>,
        way_out: WayOut,
        work: &mut EyePaths<S>,
    ) {
        let [others, of_area] = [false, true].map(|it| self.beside_photons(vertex, way_out, it));
        self.sample_direct_areas(engine, &others, &of_area, work);
    }

    /// Sets the weights after it left where it measures, in a direction of this density and cosine.
    fn leave(
        &mut self,
        context: &Context<'_, S>,
        vertex: &Vertex<'_, S>,
        way_out: WayOut,
        [pdf_sr, cos]: [f64; 2],
    ) {
        self.last.weights = EyeWeights([SubpathWeights::new(1.0 / pdf_sr, cos / pdf_sr); 2]);
        self.last.asked_from = Some(way_out);
        self.last.mirrored = MirroredFrom::new(context, vertex, pdf_sr);
    }

    /// Where it measures, with the photons that come straight from lights there.
    fn beside_photons<'v, 'w>(
        &self,
        vertex: &'v Vertex<'w, S>,
        way_out: WayOut,
        is_of_area: bool,
    ) -> EyeVertex<'v, 'w, S> {
        let photons = self.receiver.straight_m2(is_of_area);
        EyeVertex {
            vertex,
            way_out,
            number: 0,
            copies: 1.0,
            weights: EyeWeights([SubpathWeights::new(photons, 0.0); 2]),
        }
    }
}
