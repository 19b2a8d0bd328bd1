//! Photons in flight, many at once.
//!
//! All photons of a wave leave their lights, then fly together, then land, then scatter, and those
//! that go on close ranks. So each step is a short loop over neighbours in memory, and the ray kernel
//! sees many rays together. What becomes of a photon depends on its index alone, never on its
//! company: a wave gives what [`crate::photon::trace_photon`] gives.

use crate::photon::{End, Fate, MOST_EVENTS, Photon, PhotonCounts, PhotonReceiver};
use crate::spectrum::Spectrum;
use crate::stage::Stage;
use crate::trial::Step;
use crate::world::Interaction;
use quasilux_bvh::{Hit, Shot};
use quasilux_sampling::{PointSet, SampleCursor};

/// Working space for one wave after the other.
pub(crate) struct PhotonWave<'p, S> {
    photons: Vec<Photon<'p, S>>,
    /// The ray of each photon.
    shots: Vec<Shot>,
    hits: Vec<Option<Hit>>,
    /// Where it meets a surface.
    found: Vec<Option<Interaction>>,
    indices: Vec<u64>,
    /// The next two coordinates of each photon.
    ahead: [Vec<f64>; 2],
}

impl<'p, S: Spectrum> PhotonWave<'p, S> {
    pub(crate) fn new() -> Self {
        Self {
            photons: Vec::new(),
            shots: Vec::new(),
            hits: Vec::new(),
            found: Vec::new(),
            indices: Vec::new(),
            ahead: [Vec::new(), Vec::new()],
        }
    }

    /// Traces the photons of these indices to their ends.
    pub(crate) fn trace(
        &mut self,
        stage: &Stage<'_, S>,
        points: &'p PointSet,
        indices: impl Iterator<Item = u64>,
        receiver: &mut impl PhotonReceiver<S>,
        counts: &mut PhotonCounts,
    ) {
        let lap = |step| stage.stopwatch.iter().for_each(|stopwatch| stopwatch.lap(step));
        self.photons.clear();
        self.photons.extend(
            indices
                .map(|index| Photon::new(SampleCursor::new(points, index)).for_receiver(receiver)),
        );
        self.supply(points);
        lap(Step::Sampling);
        self.emit(stage);
        lap(Step::Emission);
        counts.emitted += self.photons.len() as u64;
        for bounces in 0..MOST_EVENTS {
            if self.photons.is_empty() {
                return;
            }
            counts.rays += self.shots.len() as u64;
            stage.world.trace_all(&self.shots, &mut self.hits, &mut self.found);
            lap(Step::Traversal);
            self.show(stage, bounces, receiver);
            lap(Step::Tally);
            self.supply(points);
            lap(Step::Sampling);
            self.scatter(stage, bounces, counts);
            lap(Step::Scattering);
        }
        for photon in &self.photons {
            counts.end(photon, &End::Endless);
        }
    }

    fn emit(&mut self, stage: &Stage<'_, S>) {
        self.shots.clear();
        self.photons.retain_mut(|photon| {
            let emission = photon.emit(stage);
            self.shots.extend(emission.iter().map(|start| start.from.shot(start.direction)));
            emission.is_some()
        });
    }

    /// Makes the next two coordinates of all photons at once. Those that are elsewhere in their
    /// coordinates than the first make their own.
    fn supply(&mut self, points: &PointSet) {
        let Some(dimension) = self.photons.first().map(|photon| photon.cursor.dimension()) else {
            return;
        };
        if !points.fills_lists_fast() {
            return;
        }
        self.indices.clear();
        self.indices.extend(self.photons.iter().map(|photon| photon.cursor.index()));
        for (dimension, ahead) in (dimension..).zip(&mut self.ahead) {
            ahead.resize(self.indices.len(), 0.0);
            points.fill_at(dimension, &self.indices, ahead);
        }
        let [first, second] = &self.ahead;
        for ((photon, first), second) in self.photons.iter_mut().zip(first).zip(second) {
            photon.cursor.supply(dimension, [*first, *second]);
        }
    }

    fn show(&self, stage: &Stage<'_, S>, bounces: u32, receiver: &mut impl PhotonReceiver<S>) {
        for ((photon, shot), found) in self.photons.iter().zip(&self.shots).zip(&self.found) {
            let (from, direction) = (shot.ray.origin, shot.ray.direction);
            photon.show(stage, from, direction, found.as_ref(), bounces, receiver);
        }
    }

    /// Scatters all photons; those that go on keep their order.
    fn scatter(&mut self, stage: &Stage<'_, S>, bounces: u32, counts: &mut PhotonCounts) {
        let mut left = 0;
        for number in 0..self.photons.len() {
            let photon = &mut self.photons[number];
            let direction = self.shots[number].ray.direction;
            match photon.scatter(stage, direction, self.found[number].as_ref(), bounces) {
                Fate::Ends(end) => counts.end(photon, &end),
                Fate::GoesOn(next) => {
                    self.shots[left] = next.from.shot(next.direction);
                    self.photons.swap(left, number);
                    left += 1;
                }
            }
        }
        self.photons.truncate(left);
        self.shots.truncate(left);
    }
}
