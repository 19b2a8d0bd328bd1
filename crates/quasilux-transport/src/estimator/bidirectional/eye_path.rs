//! Eye paths: from the targets, with next-event estimation at each surface, connected to the
//! vertices of a light subpath.

mod asking;
mod start;

use super::departure::Departure;
use super::engine::Engine;
use super::leading::{OnwardSample, WayOut};
use super::light_subpath::{LightVertex, is_narrow};
use super::mirrored_way::MirroredWay;
use super::plan::{CONNECTED, FoundBy, JoinEdge, Receiver, favour};
use super::subpath_weights::SubpathWeights;
use crate::bsdf::{Bsdf, BsdfSample, TransportMode};
use crate::context::Context;
use crate::cutoff::{Gain, MAX_EVENTS};
use crate::lights::images::ImageSamples;
use crate::lights::{Asking, ChoiceWork, EmitterPlace};
use crate::path::path_batch::WorkCounts;
use crate::spectrum::Spectrum;
use crate::world::frame::Frame;
use crate::world::vertex::{Surface, Vertex};
use crate::world::visibility::ShadowQueue;
use crate::world::{Interaction, RayOrigin};
use asking::EyeVertex;
use glam::DVec3;
use quasilux_bvh::{Hit, RayQuery};
use quasilux_sampling::Sampler;
use start::Started;
pub(super) use start::{FirstSurface, Start};

/// Working space of eye paths that travel together.
pub(super) struct EyePaths<S> {
    shadows: ShadowQueue<S>,
    choice: ChoiceWork,
    images: ImageSamples<S>,
    queries: Vec<RayQuery>,
    hits: Vec<Option<Hit>>,
    arrivals: Vec<Option<Interaction>>,
    pub(super) work: WorkCounts,
}

/// An eye path on its way.
struct EyePath<'p, S> {
    /// Its number among those that travel together.
    number: u32,
    section: usize,
    receiver: &'p Receiver,
    /// The light subpath that it is connected to.
    partner: &'p [LightVertex<S>],
    sampler: Sampler<'p>,
    from: RayOrigin,
    /// Unit direction in which it goes on.
    direction: DVec3,
    /// Since its last vertex, before the last pane, in m.
    distance_m: f64,
    /// Factors from radiance along the path to illuminance at its start.
    beta: S,
    gain: Gain,
    passed: Passed,
    last: LastVertex<S>,
}

/// Counts of what an eye path has passed.
struct Passed {
    /// Surfaces and panes.
    surfaces: u32,
    /// Surfaces among them that are vertices.
    vertices: u32,
}

/// The vertex that an eye path left last, as weights need it.
#[derive(Default)]
struct LastVertex<S> {
    /// Having left it.
    weights: EyeWeights,
    /// Where the path asked for light; `None` since it was mirrored or refracted.
    asked_from: Option<WayOut>,
    /// Since it asked for light: over mirrors alone.
    mirrored: Option<MirroredFrom<S>>,
    /// Bounces behind the light that it asked for.
    bounces_asked: u32,
}

/// A way over mirrors from a vertex that asked for light.
struct MirroredFrom<S> {
    way: MirroredWay<S>,
    asked_from: Asking,
    /// Density in sr^-1 of the direction in which it left.
    pdf_sr: f64,
}

/// Weights of an eye path, by who finds a light past narrow surfaces ([`FoundBy`]).
#[derive(Clone, Copy, Default)]
struct EyeWeights([SubpathWeights; 2]);

impl EyeWeights {
    fn select(self, found: FoundBy) -> SubpathWeights {
        match found {
            FoundBy::EyePaths => self.0[0],
            FoundBy::Photons => self.0[1],
        }
    }

    fn map(self, change: impl Fn(SubpathWeights) -> SubpathWeights) -> Self {
        Self(self.0.map(change))
    }
}

impl<S: Spectrum> Default for EyePaths<S> {
    fn default() -> Self {
        Self {
            shadows: ShadowQueue::default(),
            choice: ChoiceWork::default(),
            images: ImageSamples::default(),
            queries: Vec::new(),
            hits: Vec::new(),
            arrivals: Vec::new(),
            work: WorkCounts::default(),
        }
    }
}

/// Receives the light that paths find.
pub(crate) trait Sink<S> {
    /// Adds light that came to a section by this many surfaces and panes.
    fn add(&mut self, section: usize, bounces: u32, light: S);

    /// Adds light that a photon brought to a section by this many surfaces and panes.
    fn add_merged(&mut self, section: usize, bounces: u32, light: S);
}

impl<S: Spectrum> EyePaths<S> {
    /// Traces paths to their ends.
    pub(super) fn trace<'p>(
        &mut self,
        engine: &Engine<'_, '_, S>,
        starts: impl Iterator<Item = Start<'p, S>>,
        found: &mut dyn Sink<S>,
    ) where
        S: 'p,
    {
        let context = engine.context;
        let mut paths: Vec<EyePath<'p, S>> = Vec::new();
        let mut travelling: Vec<u32> = Vec::new();
        for (number, start) in (0..).zip(starts) {
            let Started { path, goes_on } = EyePath::start(engine, number, start, self);
            paths.push(path);
            travelling.extend(goes_on.then_some(number));
        }
        for _ in 0..MAX_EVENTS {
            self.answer(engine, &paths, found);
            if travelling.is_empty() {
                break;
            }
            self.queries.clear();
            let query = |number: &u32| {
                let path = &paths[*number as usize];
                path.from.query(path.direction)
            };
            self.queries.extend(travelling.iter().map(query));
            context.world.trace_all(&self.queries, &mut self.hits, &mut self.arrivals);
            self.work.rays += self.queries.len() as u64;
            let arrivals = std::mem::take(&mut self.arrivals);
            let mut next = arrivals.iter();
            travelling.retain(|&number| {
                let at = next.next().and_then(Option::as_ref);
                paths[number as usize].arrive(engine, at, self, found)
            });
            self.arrivals = arrivals;
        }
        self.answer(engine, &paths, found);
        self.work.rays += std::mem::take(&mut self.shadows.rays);
        self.work.endless += travelling.len() as u64;
        self.work.paths += paths.len() as u64;
        paths.iter().for_each(|path| self.work.dimensions.record(path.sampler.used()));
    }

    /// Adds the light that paths asked for, and that nothing stands in the way of.
    fn answer(
        &mut self,
        engine: &Engine<'_, '_, S>,
        paths: &[EyePath<'_, S>],
        found: &mut dyn Sink<S>,
    ) {
        self.shadows.answer(&engine.context.world, |who: u32, light: S, bounces: u32| {
            let path = &paths[who as usize];
            found.add(path.section, path.last.bounces_asked + bounces, light);
        });
    }
}

impl<S: Spectrum> EyePath<'_, S> {
    /// Handles the end of its ray; returns whether it goes on.
    fn arrive(
        &mut self,
        engine: &Engine<'_, '_, S>,
        at: Option<&Interaction>,
        work: &mut EyePaths<S>,
        found: &mut dyn Sink<S>,
    ) -> bool {
        let context = engine.context;
        let Some(at) = at else {
            self.add_outside(engine, found);
            return false;
        };
        let surface = &Surface::new(&context.world, at, self.direction);
        let &Surface { bsdf, wo, .. } = surface;
        let distance_m = self.distance_m + at.distance_m;
        let arrived = self.last.weights.map(|it| it.arrived(distance_m, wo.z));
        self.add_emitted(engine, at, arrived, found);
        if context.max_bounces.is_some_and(|most| self.passed.surfaces >= most) {
            return false;
        }
        if !engine.grow(&mut self.gain, at, wo, TransportMode::Radiance, self.passed.surfaces) {
            work.work.endless += 1;
            return false;
        }
        if bsdf.is_specular() {
            self.pass(engine, at, surface, arrived)
        } else {
            self.scatter(engine, at, surface, arrived, work)
        }
    }

    /// Asks for light, connects, and goes on from a surface that is not specular.
    fn scatter(
        &mut self,
        engine: &Engine<'_, '_, S>,
        at: &Interaction,
        surface: &Surface<'_, S>,
        arrived: EyeWeights,
        work: &mut EyePaths<S>,
    ) -> bool {
        let context = engine.context;
        let &Surface { bsdf, frame, wo, .. } = surface;
        let distance_m = self.distance_m + at.distance_m;
        // Panes bend nothing: at the first surface this is the direction in which it left.
        let edge = JoinEdge {
            cos: self.receiver.n.dot(self.direction).max(0.0),
            cos_there: wo.z,
            square_m2: distance_m * distance_m,
            is_narrow: is_narrow(bsdf),
        };
        let copies = engine.copies.at(at);
        let here = self.beside_light_subpaths(arrived, Some(&edge)).map(|it| it.at_copies(copies));
        self.passed.vertices += 1;
        let vertex = &Vertex::on(&context.world, at, surface, self.beta);
        self.last.bounces_asked = self.passed.surfaces + 1;
        work.shadows.max_bounces =
            context.max_bounces.map_or(u32::MAX, |most| most - self.last.bounces_asked);
        let number = self.passed.vertices as usize;
        let way_out = engine.way_out(Asking::at(vertex), context.world.ray_origin(at), bsdf);
        let eye_vertex = &EyeVertex { vertex, way_out, weights: here, copies, number };
        self.sample_direct_pointlike(engine, eye_vertex, work);
        self.sample_direct_images(engine, eye_vertex, work);
        self.sample_direct_areas(engine, eye_vertex, eye_vertex, work);
        self.connect(engine, eye_vertex, work);
        let onward = way_out.sample_onward(engine, surface, at.front, &mut self.sampler);
        let Some(OnwardSample { next, led }) = onward else { return false };
        let favour = favour(number);
        let pdfs_sr = [
            led.survival_pdf_sr(bsdf, wo, next.wi, favour),
            bsdf.survival_pdf_sr(next.wi, wo, 1.0),
        ];
        let cos = next.wi.z.abs();
        self.last.weights =
            here.map(|it| it.scattered_where_copied(cos, pdfs_sr[0], pdfs_sr[1], copies));
        self.distance_m = 0.0;
        self.last.asked_from = Some(way_out);
        self.last.mirrored = MirroredFrom::new(context, vertex, pdfs_sr[0]);
        self.go_on(engine, at, &frame, &next, led.favour(favour))
    }

    /// Goes on from a mirror, from glass, or through a pane.
    fn pass(
        &mut self,
        engine: &Engine<'_, '_, S>,
        at: &Interaction,
        surface: &Surface<'_, S>,
        arrived: EyeWeights,
    ) -> bool {
        let &Surface { bsdf, frame, wo, .. } = surface;
        let next = bsdf.sample(wo, at.front, TransportMode::Radiance, &mut self.sampler);
        let Some(next) = next else { return false };
        let mirrored = self.last.mirrored.take().filter(|_| next.wi.z > 0.0);
        self.last.mirrored = mirrored.and_then(|from| from.past(engine.context, at, bsdf, wo.z));
        let goes_straight = next.wi.z < 0.0 && bsdf.straight_transmittance(1.0).is_some();
        // Survival is by flux: radiance is scaled where it enters glass, and back where it leaves.
        let scale = bsdf.radiance_scale(next.wi, at.front);
        if goes_straight {
            self.distance_m += at.distance_m;
        } else {
            let here = self.beside_light_subpaths(arrived, None);
            self.last.weights = here.map(|it| it.mirrored(wo.z.abs(), scale));
            self.distance_m = 0.0;
            self.passed.vertices += 1;
            self.last.asked_from = None;
        }
        self.go_on(engine, at, &frame, &next, scale.recip())
    }

    /// Weights at a surface: light subpaths are joined to the target at the first, where photons
    /// take part as well, and connected to a part of the others; nothing is joined over a mirror,
    /// which has no edge.
    fn beside_light_subpaths(&self, arrived: EyeWeights, edge: Option<&JoinEdge>) -> EyeWeights {
        if self.passed.vertices > 0 {
            return arrived.map(|it| it.times(CONNECTED, 1.0));
        }
        let joins = edge.map_or(0.0, |edge| self.receiver.joins(edge));
        let is_narrow = edge.is_none_or(|edge| edge.is_narrow);
        EyeWeights(FoundBy::BOTH.map(|found| {
            let photons = self.receiver.photons(is_narrow, found);
            arrived.select(found).times(joins, photons)
        }))
    }

    /// Leaves a surface, if it survives.
    fn go_on(
        &mut self,
        engine: &Engine<'_, '_, S>,
        at: &Interaction,
        frame: &Frame,
        next: &BsdfSample<S>,
        favour: f64,
    ) -> bool {
        let world = &engine.context.world;
        let departure = Departure::survive(world, at, frame, next, favour, &mut self.sampler);
        let Some(Departure { from, direction, factor }) = departure else { return false };
        (self.from, self.direction) = (from, direction);
        self.beta = self.beta * factor;
        self.passed.surfaces += 1;
        true
    }

    /// Adds the light of an emitting facet that it runs into.
    fn add_emitted(
        &self,
        engine: &Engine<'_, '_, S>,
        at: &Interaction,
        arrived: EyeWeights,
        found: &mut dyn Sink<S>,
    ) {
        let context = engine.context;
        let emitted_cd_m2 = context.world.emitted_cd_m2(at);
        let emitters = context.lights.emitters.as_ref().filter(|_| emitted_cd_m2 > 0.0);
        let Some(emitters) = emitters else { return };
        let asked = EmitterPlace { facet: at.facet, position: at.position };
        let cos = at.n.dot(self.direction).abs();
        let mirrored = self.last.mirrored.as_ref().and_then(|from| from.asked(context, at, cos));
        let (pdf_m2, arrived) = match (mirrored, self.last.asked_from) {
            (Some(Asked { pdf_m2, inverse_m2 }), _) => {
                (pdf_m2, arrived.map(|it| it.asked(inverse_m2)))
            }
            (None, Some(WayOut { place, .. })) => {
                (emitters.pdf_m2(&context.world, place, asked), arrived)
            }
            (None, None) => (0.0, arrived),
        };
        let emission = engine.sources.of_emitters_per_lm() * emitted_cd_m2 * cos;
        let is_all_mirrors = self.last.mirrored.as_ref().is_some_and(|from| {
            let mirrors = from.way.planes.len();
            mirrors > 0 && mirrors == self.passed.vertices as usize
        });
        let found_by = if is_all_mirrors { FoundBy::EyePaths } else { engine.emitters_found_by };
        let weights = self.straight(arrived, true).select(found_by);
        let weight = weights.of_hit(pdf_m2, emission);
        let light = self.beta * (emitted_cd_m2 * weight);
        self.receiver.assert_capped("a facet that was met", light);
        found.add(self.section, self.passed.surfaces, light);
    }

    /// Weights where it runs into a light: straight from the start photons take part.
    fn straight(&self, weights: EyeWeights, is_of_area: bool) -> EyeWeights {
        match self.passed.vertices {
            0 => {
                let photons = self.receiver.straight_m2(is_of_area);
                weights.map(|it| it.times(1.0, photons))
            }
            _ => weights,
        }
    }

    /// Adds what it finds where it leaves the scene.
    fn add_outside(&self, engine: &Engine<'_, '_, S>, found: &mut dyn Sink<S>) {
        let Some(outside) = &engine.context.lights.outside else { return };
        let (direction, position) = (self.direction, self.from.position());
        let weights = self.straight(self.last.weights, false);
        let share = |asked_sr: f64, of_sun: bool| {
            let found_by = if of_sun { FoundBy::Photons } else { engine.sky_found_by };
            weights
                .select(found_by)
                .of_hit(asked_sr, engine.sources.pdf_line(position, -direction, of_sun))
        };
        let sky_cd_m2 = outside.luminance_cd_m2(direction);
        if sky_cd_m2 != 0.0 {
            let asked_sr =
                self.last.asked_from.map_or(0.0, |from| from.asked_sr(outside, direction));
            let light = self.beta * (sky_cd_m2 * share(asked_sr, false));
            self.receiver.assert_capped("the sky", light);
            found.add(self.section, self.passed.surfaces, light);
        }
        let sun_cd_m2 = outside.sun_cd_m2(direction);
        if sun_cd_m2 != 0.0 {
            let asked_sr = self.last.asked_from.map_or(0.0, |_| outside.sun_pdf_sr(direction));
            let light = self.beta * (sun_cd_m2 * share(asked_sr, true));
            self.receiver.assert_capped("the sun", light);
            found.add(self.section, self.passed.surfaces, light);
        }
    }
}

/// How an eye path asks for the image of a facet that it ran into over mirrors.
struct Asked {
    /// Density in m^-2 with which it does.
    pdf_m2: f64,
    /// One over the density in m^-2 with which its direction leads there.
    inverse_m2: f64,
}

impl<S: Spectrum> MirroredFrom<S> {
    fn new(context: &Context<'_, S>, vertex: &Vertex<'_, S>, pdf_sr: f64) -> Option<Self> {
        let way = MirroredWay::new(context)?;
        Some(Self { way, asked_from: Asking::at(vertex), pdf_sr })
    }

    fn past(
        self,
        context: &Context<'_, S>,
        at: &Interaction,
        bsdf: &Bsdf<S>,
        cos: f64,
    ) -> Option<Self> {
        let way = self.way.past(context, at, bsdf, cos)?;
        Some(Self { way, ..self })
    }

    /// `None` where no image shows it, or nothing mirrors.
    fn asked(&self, context: &Context<'_, S>, at: &Interaction, cos: f64) -> Option<Asked> {
        let Self { way, asked_from, pdf_sr } = self;
        let asked = EmitterPlace { facet: at.facet, position: at.position };
        let (world, planes) = (&context.world, way.planes.iter().rev().copied());
        let pdf_m2 = context.images.asked_over_m2(world, planes, *asked_from, asked)?;
        let distance_m = way.distance_m(at.distance_m);
        let inverse_m2 = distance_m * distance_m / (cos * pdf_sr * way.kept());
        Some(Asked { pdf_m2, inverse_m2 })
    }
}
