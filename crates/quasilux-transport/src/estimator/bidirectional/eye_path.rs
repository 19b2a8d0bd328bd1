//! Eye paths: from the targets, with next-event estimation at each surface, connected to the
//! vertices of a light subpath.

use super::engine::Engine;
use super::light_subpath::{LightSubpaths, LightVertex, is_narrow};
use super::plan::{FoundBy, Receiver};
use super::sums::TargetSums;
use crate::bsdf::TransportMode;
use crate::cutoff::MAX_EVENTS;
use crate::lights::{Asking, Choice, ChoiceWork, EmitterPlace, EmitterPoint};
use crate::path::sections::WorkCounts;
use crate::path::subpath_weights::{SubpathWeights, of_connection, product};
use crate::spectrum::Spectrum;
use crate::stats::tally::Quantum;
use crate::stats::targets::Target;
use crate::world::frame::Frame;
use crate::world::vertex::{Surface, Vertex};
use crate::world::visibility::{LightSample, ShadowQueue};
use crate::world::{Interaction, RayOrigin};
use glam::DVec3;
use quasilux_bvh::{Hit, RayQuery};
use quasilux_sampling::warp::sample_cosine_hemisphere;
use quasilux_sampling::{Sampler, choose_weights};
use std::f64::consts::{FRAC_1_PI, PI};

/// Light vertices that are looked at from an eye vertex.
const CANDIDATES: usize = 4;

/// Where an eye path starts, and who gets what it finds.
pub(super) struct Start<'p, S> {
    /// Number of its sums.
    pub(super) section: usize,
    pub(super) receiver: &'p Receiver,
    pub(super) light: &'p LightSubpaths<S>,
    /// That of the light subpaths which it is connected to.
    pub(super) subpath: usize,
    pub(super) sampler: Sampler<'p>,
}

/// Working space of eye paths that travel together.
pub(super) struct EyePaths<S> {
    shadows: ShadowQueue<S>,
    choice: ChoiceWork,
    queries: Vec<RayQuery>,
    hits: Vec<Option<Hit>>,
    arrivals: Vec<Option<Interaction>>,
    pub(super) work: WorkCounts,
}

/// An eye path on its way.
struct EyePath<'p, S> {
    number: u32,
    section: usize,
    receiver: &'p Receiver,
    light: &'p LightSubpaths<S>,
    subpath: usize,
    sampler: Sampler<'p>,
    from: RayOrigin,
    /// Unit direction in which it goes on.
    direction: DVec3,
    /// Since its last vertex, before the last pane, in m.
    distance_m: f64,
    /// Factors from radiance along the path to illuminance at its start.
    beta: S,
    /// Surfaces and panes so far.
    bounces: u32,
    /// Those of them that are vertices.
    vertices: u32,
    /// Having left its last vertex.
    weights: EyeWeights,
    /// Where it last asked for light; `None` since it was mirrored or refracted.
    asked_from: Option<Asking>,
    /// Bounces behind the light that it last asked for.
    bounces_asked: u32,
}

/// What is asked at a vertex.
struct Asker<'v, 'w, S> {
    vertex: &'v Vertex<'w, S>,
    weights: EyeWeights,
}

/// What an eye path weighs, by who finds a light past narrow surfaces ([`FoundBy`]).
#[derive(Clone, Copy)]
struct EyeWeights([SubpathWeights; 2]);

impl EyeWeights {
    fn of(self, found: FoundBy) -> SubpathWeights {
        match found {
            FoundBy::EyePaths => self.0[0],
            FoundBy::Photons => self.0[1],
        }
    }

    fn map(self, change: impl Fn(SubpathWeights) -> SubpathWeights) -> Self {
        Self(self.0.map(change))
    }
}

impl<S> Default for EyePaths<S> {
    fn default() -> Self {
        Self {
            shadows: ShadowQueue::default(),
            choice: ChoiceWork::default(),
            queries: Vec::new(),
            hits: Vec::new(),
            arrivals: Vec::new(),
            work: WorkCounts::default(),
        }
    }
}

/// The sums of all sections, with their unit.
pub(super) struct Found<'f> {
    pub(super) sums: &'f mut [TargetSums],
    pub(super) quantum: Quantum,
}

impl Found<'_> {
    fn add<S: Spectrum>(&mut self, section: usize, bounces: u32, light: S) {
        self.sums[section].add(bounces, light.luminance(), self.quantum);
    }
}

impl<S: Spectrum> EyePaths<S> {
    /// Traces paths to their ends.
    pub(super) fn trace<'p>(
        &mut self,
        engine: &Engine<'_, '_, S>,
        starts: impl Iterator<Item = Start<'p, S>>,
        found: &mut Found<'_>,
    ) where
        S: 'p,
    {
        let context = engine.context;
        let mut paths: Vec<EyePath<'p, S>> = Vec::new();
        for (number, start) in (0..).zip(starts) {
            paths.push(EyePath::start(engine, number, start, self));
        }
        let mut travelling: Vec<u32> = (0..paths.len() as u32).collect();
        for _ in 0..MAX_EVENTS {
            let answer = |who: u32, light: S, bounces: u32| {
                let path = &paths[who as usize];
                found.add(path.section, path.bounces_asked + bounces, light);
            };
            self.shadows.answer(&context.world, answer);
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
        self.shadows.answer(&context.world, |who: u32, light: S, bounces: u32| {
            let path = &paths[who as usize];
            found.add(path.section, path.bounces_asked + bounces, light);
        });
        self.work.rays += std::mem::take(&mut self.shadows.rays);
        self.work.endless += travelling.len() as u64;
        self.work.paths += paths.len() as u64;
        paths.iter().for_each(|path| self.work.dimensions.record(path.sampler.used()));
    }
}

impl<'p, S: Spectrum> EyePath<'p, S> {
    fn start(
        engine: &Engine<'_, '_, S>,
        number: u32,
        start: Start<'p, S>,
        work: &mut EyePaths<S>,
    ) -> Self {
        let Start { section, receiver, light, subpath, mut sampler } = start;
        let context = engine.context;
        let (position, n) = match receiver.target {
            Target::Point { position, normal } => (position, normal),
            Target::Cell { grid, cell } => {
                (grid.point_in_cell(cell, sampler.next_2d()), grid.normal)
            }
        };
        let from = context.world.ray_origin_of_sensor(position, n);
        let local = DVec3::from_array(sample_cosine_hemisphere(sampler.next_2d()));
        let (direction, pdf_sr) = (Frame::around(n).to_world(local), local.z * FRAC_1_PI);
        let vertex = &Vertex::sensor(from, n);
        let mut path = Self {
            number,
            section,
            receiver,
            light,
            subpath,
            sampler,
            from,
            direction,
            distance_m: 0.0,
            beta: S::white() * PI,
            bounces: 0,
            vertices: 0,
            weights: EyeWeights([SubpathWeights::new(1.0 / pdf_sr, local.z / pdf_sr); 2]),
            asked_from: Some(Asking::at(vertex)),
            bounces_asked: 0,
        };
        // Photons that come straight.
        let photons = engine.plan.photons(receiver, false, FoundBy::Photons);
        let weights = EyeWeights([SubpathWeights::new(photons, 0.0); 2]);
        work.shadows.max_bounces = context.max_bounces.unwrap_or(u32::MAX);
        let asker = &Asker { vertex, weights };
        if receiver.is_cell() {
            path.ask_all_pointlikes(engine, asker, work);
        }
        path.ask_areas(engine, asker, work);
        path
    }

    /// What happens where its ray ends; whether it goes on.
    fn arrive(
        &mut self,
        engine: &Engine<'_, '_, S>,
        at: Option<&Interaction>,
        work: &mut EyePaths<S>,
        found: &mut Found<'_>,
    ) -> bool {
        let context = engine.context;
        let Some(at) = at else {
            self.add_outside(engine, found);
            return false;
        };
        let surface = &Surface::new(&context.world, at, self.direction);
        let &Surface { bsdf, frame, wo, .. } = surface;
        let distance_m = self.distance_m + at.distance_m;
        let arrived = self.weights.map(|it| it.arrived(distance_m, wo.z));
        self.add_emitted(engine, at, arrived, found);
        if context.max_bounces.is_some_and(|most| self.bounces >= most) {
            return false;
        }
        let next =
            |sampler: &mut Sampler<'_>| bsdf.sample(wo, at.front, TransportMode::Radiance, sampler);
        if bsdf.is_specular() {
            let Some(next) = next(&mut self.sampler) else { return false };
            let goes_straight = next.wi.z < 0.0 && bsdf.straight_transmittance(1.0).is_some();
            if goes_straight {
                self.distance_m = distance_m;
            } else {
                let here = self.first_surface(engine, arrived, bsdf, 0.0);
                self.weights = here.map(|it| it.mirrored(next.wi.z.abs()));
                self.distance_m = 0.0;
                self.vertices += 1;
                self.asked_from = None;
            }
            return self.go_on(engine, at, &frame, next.wi, next.weight);
        }
        let geometry_m2 = || {
            let cos = self.receiver.n.dot(self.direction_from_start());
            cos * wo.z / (distance_m * distance_m)
        };
        let geometry_m2 = if self.vertices == 0 { geometry_m2() } else { 0.0 };
        let here = self.first_surface(engine, arrived, bsdf, geometry_m2);
        self.vertices += 1;
        let vertex = &Vertex::on(&context.world, at, surface, self.beta);
        self.bounces_asked = self.bounces + 1;
        work.shadows.max_bounces =
            context.max_bounces.map_or(u32::MAX, |most| most - self.bounces_asked);
        let asker = &Asker { vertex, weights: here };
        self.ask_pointlike(engine, asker, work);
        self.ask_areas(engine, asker, work);
        self.connect(engine, asker, work);
        let Some(next) = next(&mut self.sampler) else { return false };
        let pdfs_sr = [bsdf.survival_pdf_sr(wo, next.wi), bsdf.survival_pdf_sr(next.wi, wo)];
        let cos = next.wi.z.abs();
        self.weights = here.map(|it| it.scattered(cos, pdfs_sr[0], pdfs_sr[1]));
        self.distance_m = 0.0;
        self.asked_from = Some(Asking::at(vertex));
        self.go_on(engine, at, &frame, next.wi, next.weight)
    }

    /// Of a path that has met no vertex yet: panes bend nothing.
    fn direction_from_start(&self) -> DVec3 {
        self.direction
    }

    /// What it weighs at its first surface, where joins and photons take part; elsewhere as it is.
    fn first_surface(
        &self,
        engine: &Engine<'_, '_, S>,
        arrived: EyeWeights,
        bsdf: &crate::bsdf::Bsdf<S>,
        geometry_m2: f64,
    ) -> EyeWeights {
        if self.vertices > 0 {
            return arrived;
        }
        let Engine { plan, .. } = engine;
        let joins = plan.joins(self.receiver, geometry_m2);
        EyeWeights(FoundBy::BOTH.map(|found| {
            let photons = plan.photons(self.receiver, is_narrow(bsdf), found);
            arrived.of(found).times(joins, photons)
        }))
    }

    /// Survives as its weight says, and leaves.
    fn go_on(
        &mut self,
        engine: &Engine<'_, '_, S>,
        at: &Interaction,
        frame: &Frame,
        wi: DVec3,
        weight: S,
    ) -> bool {
        let world = &engine.context.world;
        let survival = weight.max_channel().min(1.0);
        // Not where it is no number.
        let survives = survival > 0.0 && self.sampler.choose_bool(survival);
        if !survives {
            return false;
        }
        self.beta = self.beta * weight * survival.recip();
        self.bounces += 1;
        self.from = if wi.z > 0.0 { world.ray_origin(at) } else { world.ray_origin_behind(at) };
        self.direction = frame.to_world(wi);
        true
    }

    /// Adds the light of an emitting facet that it runs into.
    fn add_emitted(
        &self,
        engine: &Engine<'_, '_, S>,
        at: &Interaction,
        arrived: EyeWeights,
        found: &mut Found<'_>,
    ) {
        let context = engine.context;
        let emitted_cd_m2 = context.world.emitted_cd_m2(at);
        let emitters = context.lights.emitters.as_ref().filter(|_| emitted_cd_m2 > 0.0);
        let Some(emitters) = emitters else { return };
        let asked = EmitterPlace { facet: at.facet, position: at.position };
        let pdf_m2 =
            self.asked_from.map_or(0.0, |place| emitters.pdf_m2(&context.world, place, asked));
        let cos = at.n.dot(self.direction).abs();
        let emission = engine.sources.of_emitters_per_lm() * emitted_cd_m2 * cos;
        let weights = self.straight(engine, arrived).of(engine.emitters_found_by);
        let weight = weights.of_hit(pdf_m2, emission);
        found.add(self.section, self.bounces, self.beta * (emitted_cd_m2 * weight));
    }

    /// What it weighs where it runs into a light: straight from the start photons take part.
    fn straight(&self, engine: &Engine<'_, '_, S>, weights: EyeWeights) -> EyeWeights {
        let photons = engine.plan.photons(self.receiver, false, FoundBy::Photons);
        match self.vertices {
            0 => weights.map(|it| it.times(1.0, photons)),
            _ => weights,
        }
    }

    /// Adds what it finds where it leaves the scene.
    fn add_outside(&self, engine: &Engine<'_, '_, S>, found: &mut Found<'_>) {
        let Some(outside) = &engine.context.lights.outside else { return };
        let (direction, position) = (self.direction, self.from.position());
        let weights = self.straight(engine, self.weights);
        let share = |asked_sr: f64, of_sun: bool| {
            let found_by = if of_sun { FoundBy::Photons } else { engine.sky_found_by };
            weights
                .of(found_by)
                .of_hit(asked_sr, engine.sources.pdf_line(position, -direction, of_sun))
        };
        let sky_cd_m2 = outside.luminance_cd_m2(direction);
        if sky_cd_m2 != 0.0 {
            let asked_sr = self.asked_from.map_or(0.0, |place| outside.pdf_sr(place, direction));
            let light = self.beta * (sky_cd_m2 * share(asked_sr, false));
            found.add(self.section, self.bounces, light);
        }
        let sun_cd_m2 = outside.sun_cd_m2(direction);
        if sun_cd_m2 != 0.0 {
            let asked_sr = self.asked_from.map_or(0.0, |_| outside.sun_pdf_sr(direction));
            let light = self.beta * (sun_cd_m2 * share(asked_sr, true));
            found.add(self.section, self.bounces, light);
        }
    }

    /// Asks for the light of every light without extent.
    fn ask_all_pointlikes(
        &self,
        engine: &Engine<'_, '_, S>,
        asker: &Asker<'_, '_, S>,
        work: &mut EyePaths<S>,
    ) {
        let pointlikes = &engine.context.lights.pointlikes;
        for number in 0..pointlikes.len() {
            let sample = pointlikes.light_sample_of(number, asker.vertex);
            let per_lm = engine.sources.per_lm(number);
            self.ask(sample.map(|it| asker.beside_landings(it, per_lm, 1.0)), asker, work);
        }
    }

    /// Asks for the light of one light without extent.
    fn ask_pointlike(
        &mut self,
        engine: &Engine<'_, '_, S>,
        asker: &Asker<'_, '_, S>,
        work: &mut EyePaths<S>,
    ) {
        let pointlikes = &engine.context.lights.pointlikes;
        if pointlikes.is_empty() {
            return;
        }
        let u = if pointlikes.len() > 1 { self.sampler.next_1d() } else { 0.0 };
        let place = Asking::at(asker.vertex);
        let Some(Choice { number, pdf }) = pointlikes.choose(place, u, &mut work.choice) else {
            let sample = LightSample::without_choice(work.choice.total());
            self.ask(sample, asker, work);
            return;
        };
        let sample = pointlikes.light_sample_of(number, asker.vertex);
        let per_lm = engine.sources.per_lm(number);
        self.ask(sample.map(|it| asker.beside_landings(it, per_lm, pdf)), asker, work);
    }

    /// Asks for the light of lights with an extent, and from outside.
    fn ask_areas(
        &mut self,
        engine: &Engine<'_, '_, S>,
        asker: &Asker<'_, '_, S>,
        work: &mut EyePaths<S>,
    ) {
        self.ask_luminaire(engine, asker, work);
        self.ask_emitter(engine, asker, work);
        self.ask_outside(engine, asker, work);
    }

    fn ask_luminaire(
        &mut self,
        engine: &Engine<'_, '_, S>,
        asker: &Asker<'_, '_, S>,
        work: &mut EyePaths<S>,
    ) {
        let luminaires = &engine.context.lights.area_luminaires;
        if luminaires.is_empty() {
            return;
        }
        let u = self.sampler.next_2d();
        let vertex = asker.vertex;
        let chosen = luminaires.choose(Asking::at(vertex), u, &mut work.choice);
        let Some((Choice { number, pdf }, place)) = chosen else { return };
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
        self.ask(sample.map(|it| asker.beside_landings(it, per_lm, pdf)), asker, work);
    }

    fn ask_emitter(
        &mut self,
        engine: &Engine<'_, '_, S>,
        asker: &Asker<'_, '_, S>,
        work: &mut EyePaths<S>,
    ) {
        let Some(emitters) = &engine.context.lights.emitters else { return };
        let u = self.sampler.next_2d();
        let per_lm = engine.sources.of_emitters_per_lm();
        let beside_sr = |point: &EmitterPoint| {
            let to_eye = asker.to_eye(point.direction, engine.emitters_found_by);
            let landed = product(per_lm * point.lx_sr, to_eye);
            asker.vertex.survival_pdf_sr(point.direction) + landed
        };
        let sample = emitters.light_sample(
            &engine.context.world,
            asker.vertex,
            u,
            beside_sr,
            &mut work.choice,
        );
        self.ask(sample, asker, work);
    }

    fn ask_outside(
        &mut self,
        engine: &Engine<'_, '_, S>,
        asker: &Asker<'_, '_, S>,
        work: &mut EyePaths<S>,
    ) {
        let Some(outside) = &engine.context.lights.outside else { return };
        let vertex = asker.vertex;
        let sample = |direction: DVec3, pdf_sr: f64, cd_m2: f64, of_sun: bool| {
            let cos = vertex.cos(direction);
            if cos <= 0.0 {
                return None;
            }
            let line = engine.sources.pdf_line(vertex.position(), -direction, of_sun);
            let found_by = if of_sun { FoundBy::Photons } else { engine.sky_found_by };
            let landed = product(line * cos / pdf_sr, asker.to_eye(direction, found_by));
            let hit = vertex.survival_pdf_sr(direction) / pdf_sr;
            let lx = cd_m2 * cos / pdf_sr * of_connection(landed, hit);
            let light = vertex.weight(direction) * lx;
            let sample = LightSample::unless_dark(direction, outside.beyond_m(), light, lx)?;
            Some(LightSample { is_from_outside: true, ..sample })
        };
        if outside.is_asked_for() {
            let u = self.sampler.next_2d();
            let asked = outside.sample_asked(Asking::at(vertex), u);
            let found = asked.and_then(|(direction, pdf_sr)| {
                sample(direction, pdf_sr, outside.luminance_cd_m2(direction), false)
            });
            self.ask(found, asker, work);
        }
        if outside.has_sun() {
            let u = self.sampler.next_2d();
            let [cd_m2, lx] = outside.sun_brightness();
            let found = outside
                .sample_sun(u)
                .and_then(|direction| sample(direction, cd_m2 / lx, cd_m2, true));
            self.ask(found, asker, work);
        }
    }

    fn ask(
        &self,
        sample: Option<LightSample<S>>,
        asker: &Asker<'_, '_, S>,
        work: &mut EyePaths<S>,
    ) {
        if let Some(sample) = sample {
            work.shadows.ask(self.number, asker.vertex, &sample);
        }
    }

    /// Asks for the light of its light subpath by one of the vertices. Of many some are looked at,
    /// evenly spaced, and one of these is chosen in proportion to what each would give: choices are
    /// no part of weights.
    fn connect(
        &mut self,
        engine: &Engine<'_, '_, S>,
        asker: &Asker<'_, '_, S>,
        work: &mut EyePaths<S>,
    ) {
        let most = engine.context.max_bounces.unwrap_or(u32::MAX);
        let bounces = self.bounces_asked;
        let own = self.light.of(self.subpath).take_while(|it| bounces + it.bounces < most);
        let count = own.clone().count();
        if count == 0 {
            return;
        }
        let u = self.sampler.next_1d();
        let stride = count.div_ceil(CANDIDATES);
        let first = ((u * stride as f64) as usize).min(stride - 1);
        let u = u * stride as f64 - first as f64;
        let candidates = own.skip(first).step_by(stride);
        let connections = candidates.filter_map(|it| asker.connection(engine, it));
        let connections: Vec<Connection<'_, S>> = connections.collect();
        let Some(choice) = choose_weights(u, connections.iter().map(|it| it.light.luminance()))
        else {
            return;
        };
        let &Connection { vertex, direction, distance_m, light } = &connections[choice.index];
        let light = light * stride as f64;
        let from = asker.vertex.ray_origin(direction);
        let ray = from.shadow_ray(direction, distance_m, vertex.at.facet);
        let (light, bounces) = (light * choice.pdf.recip(), vertex.bounces + 1);
        work.shadows.max_bounces = most - self.bounces_asked;
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

impl<S: Spectrum> Asker<'_, '_, S> {
    /// The techniques that leave this vertex and more to light subpaths, over the density with
    /// which light that comes from `direction` makes it.
    fn to_eye(&self, direction: DVec3, found: FoundBy) -> f64 {
        self.weights.of(found).towards(self.vertex.reverse_survival_pdf_sr(direction))
    }

    /// The part of the light of a lamp that photons leave, where it is asked with this probability.
    fn beside_landings(&self, sample: LightSample<S>, per_lm: f64, pdf: f64) -> LightSample<S> {
        let landings = per_lm * sample.illuminance_lx / pdf;
        let to_eye = self.to_eye(sample.direction, FoundBy::Photons);
        let share = of_connection(product(landings, to_eye), 0.0);
        LightSample { light: sample.light * (share / pdf), ..sample }
    }

    /// `None` where one of the two turns its back on the other.
    fn connection<'l>(
        &self,
        engine: &Engine<'_, '_, S>,
        light_vertex: &'l LightVertex<S>,
    ) -> Option<Connection<'l, S>> {
        let LightVertex { at, frame, wo, flux_lm, weights, found_by, .. } = light_vertex;
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
            self.vertex.survival_pdf_sr(direction) * cos_there / square_m2,
            weights.towards(bsdf.survival_pdf_sr(wi, *wo)),
        );
        let to_eye = product(
            bsdf.survival_pdf_sr(*wo, wi) * cos / square_m2,
            self.to_eye(direction, *found_by),
        );
        let lx = cos * cos_there / square_m2 * of_connection(to_eye, to_light);
        let light = self.vertex.weight(direction) * *flux_lm * scattered * lx;
        let is_something = light.luminance() > 0.0 && light.luminance().is_finite();
        is_something.then_some(Connection { vertex: light_vertex, direction, distance_m, light })
    }
}
