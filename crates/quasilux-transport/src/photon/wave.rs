//! Wavefront light tracing: many photons are traced, shown to receivers and scattered together.
//!
//! All photons of a wave leave their lights, then fly together, then land, then scatter, and those
//! that go on close ranks. So each step is a short loop over neighbours in memory, and the ray
//! kernel sees many rays together. Photons that are split bring their children in; what makes a
//! wave too long waits until the rest has ended, so that memory is bounded. What becomes of a
//! photon depends on its index and its ancestors alone, never on its company: a wave gives what
//! [`crate::photon::trace::trace_photon`] gives.

use crate::context::{Context, Step};
use crate::cutoff::MAX_EVENTS;
use crate::photon::counts::PhotonCounts;
use crate::photon::receiver::{Arrival, PhotonReceiver};
use crate::photon::trace::{Beginning, Photon, PhotonSetup};
use crate::spectrum::Spectrum;
use crate::world::Interaction;
use quasilux_bvh::{Hit, RayQuery};
use quasilux_sampling::{PointSet, Sampler};

/// Photons that fly together are cut in two when there are more.
const LONGEST: usize = 1 << 14;

/// Photons that leave their lights together.
pub(crate) struct Wave<'p, 'w, I> {
    pub(crate) points: &'p PointSet,
    pub(crate) indices: I,
    /// Where from, and what guides them.
    pub(crate) setup: PhotonSetup<'w>,
}

/// Working space for one wave after the other.
#[derive(Default)]
pub(crate) struct PhotonWave<'p, S> {
    photons: Vec<Photon<'p, S>>,
    /// The ray of each photon.
    queries: Vec<RayQuery>,
    /// Photons that have scattered, and their rays.
    departed: (Vec<Photon<'p, S>>, Vec<RayQuery>),
    waiting: Vec<Waiting<'p, S>>,
    hits: Vec<Option<Hit>>,
    /// Where it meets a surface.
    found: Vec<Option<Interaction>>,
    /// How each photon begins, and which of the places that some leave from light comes to.
    beginnings: Vec<Beginning>,
    is_lit: Vec<bool>,
    indices: Vec<u64>,
    /// The next two coordinates of each photon.
    ahead: [Vec<f64>; 2],
}

/// Photons that wait for their flight after `bounces` reflections.
struct Waiting<'p, S> {
    bounces: u32,
    photons: Vec<Photon<'p, S>>,
    queries: Vec<RayQuery>,
}

impl<'p, S: Spectrum> PhotonWave<'p, S> {
    /// Traces photons, and what they are split into, to their ends.
    pub(crate) fn trace(
        &mut self,
        context: &Context<'_, S>,
        wave: Wave<'p, '_, impl Iterator<Item = u64>>,
        receiver: &mut impl PhotonReceiver<S>,
        counts: &mut PhotonCounts,
    ) {
        let lap = |step| context.stopwatch.iter().for_each(|stopwatch| stopwatch.lap(step));
        let Wave { points, indices, setup } = wave;
        self.photons.clear();
        self.photons.extend(
            indices.map(|index| Photon::new(Sampler::new(points, index)).for_receiver(receiver)),
        );
        self.supply(points);
        lap(Step::Sampling);
        counts.emitted += self.photons.len() as u64;
        counts.begun += self.photons.len() as u64;
        self.begin(context, setup, counts);
        self.trace_shadow_rays(context, points, counts);
        self.depart(context, setup, counts);
        lap(Step::Emission);
        let mut bounces = 0;
        while let Some(reached) = self.next_batch(bounces) {
            bounces = reached;
            if bounces == MAX_EVENTS {
                self.photons.drain(..).for_each(|photon| counts.give_up(&photon));
                continue;
            }
            counts.rays += self.queries.len() as u64;
            context.world.trace_all(&self.queries, &mut self.hits, &mut self.found);
            lap(Step::Traversal);
            self.show(context, bounces, receiver);
            lap(Step::Tally);
            self.supply(points);
            lap(Step::Sampling);
            self.scatter(context, setup, bounces, counts);
            bounces += 1;
            lap(Step::Scattering);
        }
    }

    /// Makes sure that there are photons to fly, not too many; after how many bounces. `None` where
    /// none are left.
    fn next_batch(&mut self, bounces: u32) -> Option<u32> {
        while self.photons.len() > LONGEST {
            let rest = self.photons.len() - LONGEST;
            let photons = self.photons.split_off(rest);
            let queries = self.queries.split_off(rest);
            self.waiting.push(Waiting { bounces, photons, queries });
        }
        if !self.photons.is_empty() {
            return Some(bounces);
        }
        let Waiting { bounces, photons, queries } = self.waiting.pop()?;
        (self.photons, self.queries) = (photons, queries);
        Some(bounces)
    }

    /// Draws all beginnings.
    fn begin(
        &mut self,
        context: &Context<'_, S>,
        setup: PhotonSetup<'_>,
        counts: &mut PhotonCounts,
    ) {
        self.beginnings.clear();
        self.photons.retain_mut(|photon| {
            let beginning = photon.begin(context, setup.source, counts);
            if beginning.is_none() {
                counts.end(photon);
            }
            let begins = beginning.is_some();
            self.beginnings.extend(beginning);
            begins
        });
    }

    /// Finds out to which of the places that photons begin at light comes.
    fn trace_shadow_rays(
        &mut self,
        context: &Context<'_, S>,
        points: &PointSet,
        counts: &mut PhotonCounts,
    ) {
        self.queries.clear();
        self.queries.extend(self.beginnings.iter().filter_map(|beginning| match beginning {
            Beginning::Flies(_) => None,
            Beginning::IfLit(place) => Some(place.shadow_ray(context)),
        }));
        counts.rays += self.queries.len() as u64;
        context.world.are_visible(&self.queries, &mut self.is_lit);
        if !self.queries.is_empty() {
            self.supply(points);
        }
        self.queries.clear();
    }

    /// Lets all photons fly that leave a light, or a place that light comes to.
    fn depart(
        &mut self,
        context: &Context<'_, S>,
        setup: PhotonSetup<'_>,
        counts: &mut PhotonCounts,
    ) {
        let (photons, queries) = &mut self.departed;
        let mut is_lit = self.is_lit.iter();
        for (mut photon, beginning) in self.photons.drain(..).zip(&self.beginnings) {
            match beginning {
                Beginning::Flies(start) => {
                    queries.push(start.from.query(start.direction));
                    photons.push(photon);
                }
                Beginning::IfLit(place) if is_lit.next() == Some(&true) => {
                    photon.receive(place);
                    photon.scatter(context, setup, &place.arrival(), counts, |departure| {
                        queries.push(departure.start.from.query(departure.start.direction));
                        photons.push(departure.photon);
                    });
                }
                Beginning::IfLit(_) => counts.end(&photon),
            }
        }
        std::mem::swap(&mut self.photons, photons);
        std::mem::swap(&mut self.queries, queries);
    }

    /// Makes the next two coordinates of all photons at once. Those that are elsewhere in their
    /// coordinates than the first make their own.
    fn supply(&mut self, points: &PointSet) {
        let Some(dimension) = self.photons.first().map(|photon| photon.sampler.dimension()) else {
            return;
        };
        if !points.fills_lists_fast() {
            return;
        }
        self.indices.clear();
        self.indices.extend(self.photons.iter().map(|photon| photon.sampler.index()));
        for (dimension, ahead) in (dimension..).zip(&mut self.ahead) {
            ahead.resize(self.indices.len(), 0.0);
            points.fill_at(dimension, &self.indices, ahead);
        }
        let [first, second] = &self.ahead;
        for ((photon, first), second) in self.photons.iter_mut().zip(first).zip(second) {
            photon.sampler.supply(dimension, [*first, *second]);
        }
    }

    fn show(&self, context: &Context<'_, S>, bounces: u32, receiver: &mut impl PhotonReceiver<S>) {
        for ((photon, query), found) in self.photons.iter().zip(&self.queries).zip(&self.found) {
            let (from, direction) = (query.ray.origin, query.ray.direction);
            photon.show(context, from, direction, found.as_ref(), bounces, receiver);
        }
    }

    /// Scatters all photons; those that go on keep their order, children come after their elders.
    fn scatter(
        &mut self,
        context: &Context<'_, S>,
        setup: PhotonSetup<'_>,
        bounces: u32,
        counts: &mut PhotonCounts,
    ) {
        let (photons, queries) = &mut self.departed;
        let arrivals = self.queries.iter().zip(&self.found);
        for (photon, (query, found)) in self.photons.drain(..).zip(arrivals) {
            let arrival = Arrival {
                direction: query.ray.direction,
                found: found.as_ref(),
                bounces,
                is_drawn: false,
            };
            photon.scatter(context, setup, &arrival, counts, |departure| {
                queries.push(departure.start.from.query(departure.start.direction));
                photons.push(departure.photon);
            });
        }
        self.queries.clear();
        std::mem::swap(&mut self.photons, photons);
        std::mem::swap(&mut self.queries, queries);
    }
}
