//! Light subpaths: photons from all lights that are traced once and serve all targets. They leave
//! a vertex at each surface that is not specular, and pass the targets that their flights cross.
//!
//! Flat panes that let light straight through are no vertices: they lie on the edges between them.

mod scattered;

use super::arrival::{Arrival, Asks};
use super::departure::Departure;
use super::engine::Engine;
use super::flux_tally::FluxTally;
use super::join_places::{JoinPlace, JoinPlaces};
use super::leading::{Led, WayOut};
use super::light_weights::LightWeights;
use super::mirrored_way::MirroredWay;
use super::plan::{CONNECTED, FoundBy};
use super::sources::Photon;
use super::subpath_weights::SubpathWeights;
use crate::bsdf::{Bsdf, BsdfSample, TransportMode};
use crate::cutoff::{Gain, MAX_EVENTS};
use crate::lights::images::LightPathClass;
use crate::lights::{Asking, LightKind};
use crate::spectrum::Spectrum;
use crate::world::flight::Flight;
use crate::world::frame::Frame;
use crate::world::{Interaction, RayOrigin};
use glam::DVec3;
use quasilux_bvh::{Hit, RayQuery};
use quasilux_sampling::Sampler;
use std::ops::Range;

/// A surface that a light subpath came to and that scatters into more than finitely many
/// directions.
pub(super) struct LightVertex<S> {
    pub(super) at: Interaction,
    pub(super) frame: Frame,
    /// Unit direction that the light came from, in that frame.
    pub(super) wo: DVec3,
    /// Flux that arrives, in lm, were its subpath the only one.
    pub(super) flux_lm: S,
    /// Surfaces and panes before this one.
    pub(super) bounces: u32,
    pub(super) weights: LightWeights,
    pub(super) is_narrow: bool,
    pub(super) found_by: FoundBy,
    /// Eye paths that are led to where it came from.
    pub(super) led: Led,
    /// Copies of its subpath that leave it, on average, and of each that comes.
    pub(super) copies: f64,
    pub(super) split: f64,
}

/// A vertex with the number of its subpath.
struct FoundVertex<S> {
    subpath: usize,
    vertex: LightVertex<S>,
}

/// A light subpath on its way.
#[derive(Clone)]
struct LightSubpath<'p, S> {
    /// Its number among those that travel together.
    number: usize,
    sampler: Sampler<'p>,
    photon: Photon,
    from: RayOrigin,
    direction: DVec3,
    flux_lm: S,
    /// Surfaces and panes so far.
    bounces: u32,
    gain: Gain,
    /// Copies that left its last vertex, on average.
    copies: f64,
    leg: Leg<S>,
}

/// The way of a subpath since its last vertex.
#[derive(Clone)]
pub(super) struct Leg<S> {
    /// Weights after it left its last vertex; unknown before the first.
    weights: LightWeights,
    /// Before the last pane, in m.
    distance_m: f64,
    pub(super) last: LastVertex,
    /// As those who gather see its way.
    pub(super) class: LightPathClass,
    /// From an emitting facet over mirrors alone.
    mirrored: Option<MirroredWay<S>>,
}

/// Vertex that a leg begins at.
#[derive(Clone, Copy)]
pub(super) enum LastVertex {
    Light,
    Surface {
        /// Cosine at which it left.
        cos: f64,
        is_narrow: bool,
    },
}

/// A flight of a subpath, shown to the targets that it may cross.
pub(super) struct Passing<'s, S> {
    /// Of its subpath, among those that travel together.
    pub(super) number: usize,
    pub(super) flight: Flight,
    pub(super) flux_lm: S,
    pub(super) bounces: u32,
    pub(super) leg: &'s Leg<S>,
    photon: &'s Photon,
}

/// A flight that is kept.
pub(super) struct KeptFlight<S> {
    number: usize,
    flight: Flight,
    flux_lm: S,
    bounces: u32,
    leg: Leg<S>,
    photon: Photon,
}

impl<S: Spectrum> KeptFlight<S> {
    pub(super) fn new(passing: &Passing<'_, S>) -> Self {
        let &Passing { number, flight, flux_lm, bounces, leg, photon } = passing;
        Self { number, flight, flux_lm, bounces, leg: leg.clone(), photon: photon.clone() }
    }

    pub(super) fn passing(&self) -> Passing<'_, S> {
        let Self { number, flight, flux_lm, bounces, leg, photon } = self;
        Passing {
            number: *number,
            flight: *flight,
            flux_lm: *flux_lm,
            bounces: *bounces,
            leg,
            photon,
        }
    }
}

/// Vertices of subpaths that were traced together.
pub(super) struct LightSubpaths<S> {
    /// Subpath by subpath, in the order in which each met them.
    pub(super) vertices: Vec<LightVertex<S>>,
    /// Of the same vertices.
    pub(super) places: JoinPlaces,
    /// Number of the first vertex of each subpath, and of all vertices.
    begins: Vec<usize>,
    pub(super) rays: u64,
    /// Cut on their way.
    pub(super) endless: u64,
    pub(super) flux: FluxTally,
}

impl<S> LightSubpaths<S> {
    /// Vertices of one subpath.
    pub(super) fn vertices_of(&self, subpath: usize) -> &[LightVertex<S>] {
        &self.vertices[self.numbers_of(subpath..subpath + 1)]
    }

    /// Numbers of the vertices of some subpaths.
    pub(super) fn numbers_of(&self, subpaths: Range<usize>) -> Range<usize> {
        self.begins[subpaths.start]..self.begins[subpaths.end]
    }
}

impl<S: Spectrum> LightSubpaths<S> {
    /// Traces a subpath for each sampler to its end, and shows all flights.
    pub(super) fn trace<'p>(
        engine: &Engine<'_, '_, S>,
        samplers: impl Iterator<Item = Sampler<'p>>,
        mut pass: impl FnMut(&Passing<'_, S>),
    ) -> Self {
        let world = &engine.context.world;
        let mut travelling: Vec<LightSubpath<'_, S>> = Vec::new();
        let (mut count, mut flux) = (0, FluxTally::default());
        for (number, sampler) in samplers.enumerate() {
            count = number + 1;
            let subpath = LightSubpath::new(engine, number, sampler);
            subpath.iter().for_each(|it| flux.emit(it.lm(), engine.flux_quantum));
            travelling.extend(subpath);
        }
        let mut found: Vec<FoundVertex<S>> = Vec::new();
        let (mut queries, mut hits, mut arrivals) =
            (Vec::new(), Vec::<Option<Hit>>::new(), Vec::new());
        let (mut rays, mut cut) = (0, 0);
        let mut born = Vec::new();
        for _ in 0..MAX_EVENTS {
            if travelling.is_empty() {
                break;
            }
            queries.clear();
            let query = |it: &LightSubpath<'_, S>| -> RayQuery { it.from.query(it.direction) };
            queries.extend(travelling.iter().map(query));
            world.trace_all(&queries, &mut hits, &mut arrivals);
            rays += queries.len() as u64;
            let mut arrivals = arrivals.iter();
            travelling.retain_mut(|subpath| {
                let at = arrivals.next().and_then(Option::as_ref);
                pass(&subpath.passing(at));
                match at {
                    Some(at) => {
                        let goes_on = subpath.arrive(engine, at, &mut found, &mut born, &mut flux);
                        cut += u64::from(!goes_on && subpath.gain.is_cut());
                        goes_on
                    }
                    None => {
                        flux.lose(subpath.lm(), engine.flux_quantum);
                        false
                    }
                }
            });
            travelling.append(&mut born);
        }
        for subpath in &travelling {
            flux.absorb(subpath.lm(), engine.flux_quantum);
        }
        let endless = cut + travelling.len() as u64;
        Self { rays, endless, flux, ..Self::by_subpath(found, count) }
    }

    /// Vertices of this many subpaths.
    fn by_subpath(mut found: Vec<FoundVertex<S>>, count: usize) -> Self {
        found.sort_by_key(|it| it.subpath);
        let begin = |subpath: usize| found.partition_point(|it| it.subpath < subpath);
        let begins = (0..=count).map(begin).collect();
        let mut places = JoinPlaces::default();
        for FoundVertex { vertex: LightVertex { at, is_narrow, .. }, .. } in &found {
            places.push(JoinPlace { position: at.position, n: at.n, is_narrow: *is_narrow });
        }
        let vertices = found.into_iter().map(|it| it.vertex).collect();
        Self { vertices, places, begins, rays: 0, endless: 0, flux: FluxTally::default() }
    }
}

impl<'p, S: Spectrum> LightSubpath<'p, S> {
    fn new(engine: &Engine<'_, '_, S>, number: usize, mut sampler: Sampler<'p>) -> Option<Self> {
        let photon = engine.sources.emit(&engine.context.world, &mut sampler)?;
        let class = match photon.kind {
            LightKind::Pointlike(light) => LightPathClass::Shown(light as u32),
            LightKind::Luminaire(_) => LightPathClass::Straight,
            LightKind::Emitters => LightPathClass::Found,
            LightKind::WayIn(_) => LightPathClass::Outside,
        };
        let leg = Leg {
            weights: LightWeights::default(),
            distance_m: 0.0,
            last: LastVertex::Light,
            class,
            mirrored: photon.emission.from.facet().and_then(|_| MirroredWay::new(engine.context)),
        };
        let flux_lm = S::white() * photon.flux_lm;
        let (from, direction) = (photon.emission.from, photon.emission.direction);
        Some(Self {
            number,
            sampler,
            photon,
            from,
            direction,
            flux_lm,
            bounces: 0,
            gain: Gain::NONE,
            copies: 1.0,
            leg,
        })
    }

    fn passing(&self, at: Option<&Interaction>) -> Passing<'_, S> {
        let length_m = at.map_or(f64::INFINITY, |at| at.distance_m);
        let flight = Flight { from: self.from.position(), direction: self.direction, length_m };
        let Self { number, flux_lm, bounces, leg, photon, .. } = self;
        Passing { number: *number, flight, flux_lm: *flux_lm, bounces: *bounces, leg, photon }
    }

    /// Handles the end of its flight; returns whether it goes on.
    fn arrive(
        &mut self,
        engine: &Engine<'_, '_, S>,
        at: &Interaction,
        found: &mut Vec<FoundVertex<S>>,
        born: &mut Vec<Self>,
        flux: &mut FluxTally,
    ) -> bool {
        let context = engine.context;
        let (bsdf, frame) = (context.world.bsdf(at), context.world.frame(at));
        let wo = frame.to_local(-self.direction);
        flux.absorb(self.lm(), engine.flux_quantum);
        if context.max_bounces.is_some_and(|most| self.bounces >= most) {
            let kept = bsdf.albedo(wo, at.front, TransportMode::Importance);
            flux.cut((self.flux_lm * kept).luminance(), engine.flux_quantum);
            return false;
        }
        let left = self.flux_lm.max_channel();
        // What is not a number is left to the eye subpaths, which show it.
        if !(left > 0.0 && left.is_finite()) {
            return false;
        }
        if !engine.grow(&mut self.gain, at, wo, TransportMode::Importance, self.bounces) {
            return false;
        }
        if bsdf.is_specular() {
            let next = bsdf.sample(wo, at.front, TransportMode::Importance, &mut self.sampler);
            let Some(next) = next else { return false };
            self.pass_specular(engine, at, wo.z, &next);
            return self.go_on(engine, at, &frame, &next, flux);
        }
        let way_out = way_out(engine, at, bsdf);
        let vertex = self.vertex(engine, at, frame, wo, &way_out);
        let goes_on = self.scatter_in_copies(engine, &vertex, born, flux);
        found.push(FoundVertex { subpath: self.number, vertex });
        goes_on
    }

    /// Goes on from a specular surface: straight through a pane, or with a leg of its own.
    fn pass_specular(
        &mut self,
        engine: &Engine<'_, '_, S>,
        at: &Interaction,
        cos_wo: f64,
        next: &BsdfSample<S>,
    ) {
        let context = engine.context;
        let bsdf = context.world.bsdf(at);
        let goes_straight = next.wi.z < 0.0 && bsdf.straight_transmittance(1.0).is_some();
        if goes_straight {
            self.leg.distance_m += at.distance_m;
            self.leg.mirrored = None;
        } else {
            let weights = self.weights_at(engine, at, &way_out(engine, at, bsdf), bsdf, cos_wo);
            let last = LastVertex::Surface { cos: next.wi.z.abs(), is_narrow: true };
            let scale = bsdf.radiance_scale(next.wi, at.front);
            let weights = weights.mirrored(cos_wo.abs(), scale);
            let class = self.leg.class;
            let mirrored = self.leg.mirrored.take().filter(|_| next.wi.z > 0.0);
            let mirrored = mirrored.and_then(|way| way.past(context, at, bsdf, cos_wo));
            self.leg = Leg { weights, distance_m: 0.0, last, class, mirrored };
        }
        self.leg.class = self.leg.class.after(&context.images, bsdf, at.facet, next.wi.z > 0.0);
    }

    /// Leaves a surface, if it survives.
    fn go_on(
        &mut self,
        engine: &Engine<'_, '_, S>,
        at: &Interaction,
        frame: &Frame,
        next: &BsdfSample<S>,
        flux: &mut FluxTally,
    ) -> bool {
        let world = &engine.context.world;
        let departure = Departure::survive(world, at, frame, next, 1.0, &mut self.sampler);
        let Some(Departure { from, direction, factor }) = departure else { return false };
        (self.from, self.direction) = (from, direction);
        self.flux_lm = self.flux_lm * factor;
        self.bounces += 1;
        flux.leave(self.lm(), engine.flux_quantum);
        true
    }

    /// The flux that it carries, in lm.
    fn lm(&self) -> f64 {
        self.flux_lm.luminance()
    }

    /// Weights where it arrives at a vertex.
    fn weights_at(
        &self,
        engine: &Engine<'_, '_, S>,
        at: &Interaction,
        way_out: &WayOut,
        bsdf: &Bsdf<S>,
        cos: f64,
    ) -> LightWeights {
        if let Some(landings_m2) = self.mirrored_landings_m2(engine, at, bsdf) {
            return SubpathWeights::of_landing(Some(landings_m2)).into();
        }
        let arrival = Arrival {
            way_out: *way_out,
            n: at.n,
            along_m: at.distance_m,
            direction: self.direction,
            cos,
            asks: if bsdf.is_specular() { Asks::Nothing } else { Asks::One },
        };
        let weights = self.leg.weights_at(engine, &self.photon, &arrival);
        match self.leg.last {
            LastVertex::Surface { .. } if !self.leg.is_asked_for() => {
                weights.map(|it| it.times(CONNECTED, 1.0))
            }
            LastVertex::Light | LastVertex::Surface { .. } => weights,
        }
    }

    /// The density in m^-2 with which light lands here by mirrors that show it, where eye paths ask
    /// for their images.
    fn mirrored_landings_m2(
        &self,
        engine: &Engine<'_, '_, S>,
        at: &Interaction,
        bsdf: &Bsdf<S>,
    ) -> Option<f64> {
        let LightPathClass::Shown(image) = self.leg.class else { return None };
        if image as usize == self.photon.number || bsdf.is_specular() {
            return None;
        }
        let lx = engine.context.landing_of_image_lx(image, at, self.direction)?;
        Some(engine.sources.per_lm(self.photon.number) * lx)
    }
}

impl<S: Spectrum> Leg<S> {
    /// Whether it comes from an emitting facet whose image is asked for.
    pub(super) fn is_asked_for(&self) -> bool {
        self.mirrored.is_some()
    }

    /// Weights of its subpath where it ends.
    fn weights_at(
        &self,
        engine: &Engine<'_, '_, S>,
        photon: &Photon,
        arrival: &Arrival,
    ) -> LightWeights {
        let distance_m = self.distance_m + arrival.along_m;
        match self.last {
            LastVertex::Light => arrival.of_photon(engine, photon, distance_m).into(),
            LastVertex::Surface { .. } => {
                let weights = self.weights.map(|it| it.arrived(distance_m, arrival.cos));
                let vcm = self.mirrored.as_ref().filter(|_| arrival.asks != Asks::Nothing);
                let vcm = vcm.and_then(|way| arrival.of_image(engine, photon, way));
                vcm.map_or(weights, |vcm| weights.map(|it| it.asked(vcm)))
            }
        }
    }
}

impl<S: Spectrum> Passing<'_, S> {
    /// Who finds its light past narrow surfaces: over plane mirrors alone, who asks for images.
    pub(super) fn found_by(&self, engine: &Engine<'_, '_, S>) -> FoundBy {
        if self.leg.is_asked_for() { FoundBy::EyePaths } else { engine.found_by(self.photon) }
    }

    /// Whether it comes straight from a light without an extent, perhaps by mirrors that show it.
    pub(super) fn is_computed_at_points(&self) -> bool {
        matches!(self.leg.class, LightPathClass::Shown(_))
    }

    /// Whether it comes from a narrow surface, with light that eye paths hardly find.
    pub(super) fn is_hardly_found(&self, engine: &Engine<'_, '_, S>) -> bool {
        let is_narrow = matches!(self.leg.last, LastVertex::Surface { is_narrow: true, .. });
        is_narrow && self.found_by(engine) == FoundBy::Photons
    }

    /// Whether it comes straight from a light with an area.
    pub(super) fn is_straight_from_area(&self) -> bool {
        let has_area = matches!(self.photon.kind, LightKind::Emitters | LightKind::Luminaire(_));
        has_area && matches!(self.leg.last, LastVertex::Light)
    }

    /// The distance in m since the last vertex, after this part of the flight.
    pub(super) fn distance_m(&self, along_m: f64) -> f64 {
        self.leg.distance_m + along_m
    }

    /// Weights of its subpath where it crosses a place that measures.
    pub(super) fn weights_at(
        &self,
        engine: &Engine<'_, '_, S>,
        arrival: &Arrival,
    ) -> SubpathWeights {
        self.leg.weights_at(engine, self.photon, arrival).numbered(0)
    }
}

/// The way out of a surface where a subpath arrived.
pub(super) fn way_out<S: Spectrum>(
    engine: &Engine<'_, '_, S>,
    at: &Interaction,
    bsdf: &Bsdf<S>,
) -> WayOut {
    let side = (!bsdf.transmits()).then_some(at.n);
    let place = Asking { position: at.position, side, own: Some(at.facet) };
    engine.way_out(place, engine.context.world.ray_origin(at), bsdf)
}

/// Whether a surface sends much of the light of a direction into few others, so that only photons
/// are sure to find it.
pub(super) fn is_narrow<S: Spectrum>(bsdf: &Bsdf<S>) -> bool {
    !matches!(bsdf, Bsdf::Diffuse(_) | Bsdf::Translucent(_))
}
