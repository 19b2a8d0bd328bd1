//! Replay of recorded paths on a map: the variance and rays of a trial with any survival
//! probability.

use super::path_record::{Ending, PathRecord, Price, Step};
use crate::context::Context;
use crate::estimator::pilot::{ErrorTarget, MUCH_MORE, SAMPLES};
use crate::path::frozen_map::bounces_left;
use crate::path::frozen_map::survival::{Finding, Survival};
use crate::path::trace::PathResult;
use crate::path::vertex_record::VertexRecord;
use crate::photon::map::{IlluminationMap, MapLayout};
use crate::spectrum::Spectrum;
use rayon::prelude::*;

/// At most this part of how far a map is off is taken for noise, which more photons would mend.
const MAX_NOISE: f64 = 0.75;

/// Paths of a trial.
#[derive(Debug, Default)]
pub(crate) struct PathRecords<S> {
    paths: Vec<Path<S>>,
    rays: RayCounts,
}

/// What the paths of a trial took.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct RayCounts {
    /// In all.
    pub(crate) all: f64,
    /// Of these, rays by which they asked for light where they started.
    pub(crate) at_start: f64,
    /// Rays of one path more, if it had ended on a map.
    pub(crate) at_end: f64,
}

/// One of them.
#[derive(Debug)]
struct Path<S> {
    target: usize,
    records: Vec<VertexRecord<S>>,
    flights: u32,
}

/// The same paths on a map.
pub(super) struct Replay {
    paths: Vec<ReplayedPath>,
    rays: RayCounts,
    /// For each that a path takes itself, those that ask for light on its way included.
    rays_for_flight: f64,
}

struct ReplayedPath {
    target: usize,
    /// Of a unit at its start.
    importance: f64,
    record: PathRecord,
    /// Variance of the map by the noise of its photons, by what it counts at the start.
    noise: f64,
}

/// What a trial would have been with paths that end by chance.
pub(crate) struct Outcome {
    /// Added by Russian roulette, of each target that gets light.
    pub(crate) variances: Vec<f64>,
    pub(crate) rays: f64,
}

impl<S: Spectrum> PathRecords<S> {
    /// Remembers a path of one of the targets.
    pub(crate) fn add(&mut self, target: usize, path: &mut PathResult<S>) {
        let records = std::mem::take(&mut path.records);
        self.paths.push(Path { target, records, flights: path.flights });
    }

    /// All of them together.
    pub(crate) fn all(parts: Vec<Self>, rays: RayCounts) -> Self {
        let paths = parts.into_iter().flat_map(|part| part.paths).collect();
        Self { paths, rays }
    }

    /// With no map.
    pub(crate) fn alone(&self, wanted: &ErrorTarget) -> Outcome {
        self.replay(wanted, |_| None).outcome(Ending::Alone, wanted)
    }

    /// On a map.
    pub(super) fn on(
        &self,
        context: &Context<'_, S>,
        layout: &MapLayout,
        map: &IlluminationMap<'_, S>,
        wanted: &ErrorTarget,
    ) -> Replay {
        self.replay(wanted, |record| {
            let weight = record.weight?;
            let sides = layout.len() as u64;
            let max_bounces = bounces_left(context.max_bounces, record.bounces, sides)?;
            let place = layout.locate(&record.at);
            let light = (weight * map.illuminance_lx(&place, max_bounces)).luminance();
            let noise = (weight * map.noise_lx(&place, max_bounces)).luminance();
            Some(Reading { element: place.element, light, noise })
        })
    }

    fn replay(
        &self,
        wanted: &ErrorTarget,
        read: impl Fn(&VertexRecord<S>) -> Option<Reading> + Sync,
    ) -> Replay {
        let replayed = |path: &Path<S>| path.replay(wanted.importance_per_lx(path.target), &read);
        let flights: u64 = self.paths.iter().map(|path| u64::from(path.flights)).sum();
        let flights = flights.max(1) as f64;
        let RayCounts { all, at_start, .. } = self.rays;
        // Not all lights that may be asked for are before a start.
        let at_start = at_start.min(all - flights).max(0.0);
        Replay {
            paths: self.paths.par_iter().map(replayed).collect(),
            rays: RayCounts { at_start, ..self.rays },
            rays_for_flight: (all - at_start) / flights,
        }
    }
}

/// What a map says at a record, by what it counts at the start.
struct Reading {
    element: usize,
    light: f64,
    /// Standard deviation of that.
    noise: f64,
}

impl<S: Spectrum> Path<S> {
    fn replay(
        &self,
        importance: f64,
        read: impl Fn(&VertexRecord<S>) -> Option<Reading>,
    ) -> ReplayedPath {
        let mut variance = 0.0;
        let ends = self.records.iter().skip(1).map(|record| record.flights).chain([self.flights]);
        let step = |(record, end): (&VertexRecord<S>, u32)| {
            let read = read(record);
            let is_on_map = read.is_some();
            let none = Reading { element: 0, light: 0.0, noise: 0.0 };
            let Reading { element, light, noise } = read.unwrap_or(none);
            variance += noise * noise;
            let [beyond_alone, beyond] = record.beyond;
            let [weight, missed, beyond] =
                [record.weight.unwrap_or_default(), beyond_alone, beyond]
                    .map(|light| light.luminance())
                    // The run counts and reports what is no number.
                    .map(|lx| if lx.is_finite() { lx } else { 0.0 });
            let finding = Finding { element, weight, light, beyond };
            Step { finding, is_on_map, missed, flights: end - record.flights, alone: record.alone }
        };
        let steps: Vec<Step> = self.records.iter().zip(ends).map(step).collect();
        let flights = self.records.first().map_or(self.flights, |record| record.flights);
        ReplayedPath {
            target: self.target,
            importance,
            record: PathRecord { flights, steps },
            noise: variance,
        }
    }
}

impl ReplayedPath {
    /// Where it might have ended on the map.
    fn findings(&self) -> impl Iterator<Item = Finding> {
        self.record.steps.iter().filter(|step| step.is_on_map).map(|step| step.finding)
    }
}

impl Replay {
    /// How far off the map is.
    pub(super) fn survival(&self) -> Survival {
        let paths = self.paths.iter();
        Survival::new(paths.flat_map(|path| path.findings().map(|f| f.importance(path.importance))))
    }

    /// What ending on the map at their first surface would cost the paths on average.
    pub(super) fn usual_loss(&self, survival: &Survival) -> f64 {
        let loss = |path: &ReplayedPath| {
            let Finding { element, weight, light, .. } = path.findings().next()?;
            Some(survival.loss(element, path.importance * weight, path.importance * light))
        };
        let losses: Vec<f64> = self.paths.iter().filter_map(loss).collect();
        losses.iter().sum::<f64>() / losses.len().max(1) as f64
    }

    /// The part of how far it is off that more photons would mend.
    pub(super) fn noise_share(&self) -> f64 {
        let sums = self.paths.iter().fold([0.0, 0.0], |[noise, off], path| {
            let square = path.importance * path.importance;
            let squares = path.findings().map(|f| (f.beyond - f.light) * (f.beyond - f.light));
            [noise + square * path.noise, off + square * squares.sum::<f64>()]
        });
        if sums[1] > 0.0 { (sums[0] / sums[1]).min(MAX_NOISE) } else { 0.0 }
    }

    /// Whether the map has much more light for some target than its paths found: light that is hard
    /// for them.
    pub(super) fn miss_light(&self, wanted: &ErrorTarget) -> bool {
        let mut sums = vec![[0.0; 2]; wanted.targets()];
        for path in &self.paths {
            if let Some(first) = path.findings().next() {
                let [on_map, found] = &mut sums[path.target];
                *on_map += first.light;
                *found += first.beyond;
            }
        }
        sums.iter().any(|[on_map, found]| *on_map > MUCH_MORE * found)
    }

    /// With these chances.
    pub(super) fn outcome(&self, ending: Ending<'_>, wanted: &ErrorTarget) -> Outcome {
        let at_end = self.rays.at_end / self.rays_for_flight;
        let price = |path: &ReplayedPath| path.record.price(ending, path.importance, at_end);
        let prices: Vec<Price> = self.paths.par_iter().map(price).collect();
        let mut sums = vec![(0.0, 0.0); wanted.targets()];
        for (path, price) in self.paths.iter().zip(&prices) {
            let (sum, count) = &mut sums[path.target];
            *sum += price.variance;
            *count += 1.0;
        }
        // Of the mean of the samples of a trial.
        let variances =
            wanted.seen().map(|target| sums[target].0 / sums[target].1 / SAMPLES as f64);
        let flights: f64 = prices.iter().map(|price| price.flights).sum();
        let rays = self.rays.at_start + flights * self.rays_for_flight;
        Outcome { variances: variances.collect(), rays }
    }
}
