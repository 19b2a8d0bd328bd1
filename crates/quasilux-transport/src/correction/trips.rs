//! The paths of a trial, and what they say of a map.

use super::survival::Finding;
use super::walk::{Ending, Price, Step, Walk};
use super::{Note, Survival, bounces_left};
use crate::choice::{SAMPLES, Wanted};
use crate::map::{IlluminationMap, MapLayout};
use crate::path::Ended;
use crate::spectrum::Spectrum;
use crate::stage::Stage;
use rayon::prelude::*;

/// At most this part of how far a map is off is taken for noise, which more photons would mend.
const MOST_NOISE: f64 = 0.75;

/// Paths of a trial.
#[derive(Debug)]
pub(crate) struct Walks<S> {
    paths: Vec<Path<S>>,
}

/// One of them.
#[derive(Debug)]
struct Path<S> {
    target: usize,
    notes: Vec<Note<S>>,
    flights: u32,
}

/// The same paths on a map.
pub(super) struct Trips {
    /// With what a unit is worth where each starts.
    trips: Vec<(f64, Trip)>,
    /// Rays for each that a path takes itself, those that ask for light included.
    rays_for_flight: f64,
}

struct Trip {
    target: usize,
    walk: Walk,
    /// Variance of the map by the noise of its photons, by what it counts at the start.
    noise: f64,
}

/// What a trial would have been with paths that end by chance.
pub(crate) struct Outcome {
    /// What chances add to the variance, of each target that is seen.
    pub(crate) of_chances: Vec<f64>,
    pub(crate) rays: f64,
}

impl<S> Default for Walks<S> {
    fn default() -> Self {
        Self { paths: Vec::new() }
    }
}

impl<S: Spectrum> Walks<S> {
    /// Remembers a path of one of the targets.
    pub(crate) fn add(&mut self, target: usize, path: &mut Ended<S>) {
        let notes = std::mem::take(&mut path.notes);
        self.paths.push(Path { target, notes, flights: path.flights });
    }

    /// All of them together.
    pub(crate) fn all(parts: Vec<Self>) -> Self {
        Self { paths: parts.into_iter().flat_map(|part| part.paths).collect() }
    }

    /// With no map; they took so many rays in all.
    pub(crate) fn alone(&self, rays: f64, wanted: &Wanted) -> Outcome {
        let nothing = |_: &Note<S>| Some(Reading { element: 0, light: 0.0, noise: 0.0 });
        self.trips(rays, wanted, nothing).outcome(Ending::Alone, wanted)
    }

    /// On a map.
    pub(super) fn on(
        &self,
        stage: &Stage<'_, S>,
        (layout, map): (&MapLayout, &IlluminationMap<'_, S>),
        (rays, wanted): (f64, &Wanted),
    ) -> Trips {
        self.trips(rays, wanted, |note| {
            let most_bounces = bounces_left(stage.max_bounces, note.bounces)?;
            let place = layout.locate(&note.at);
            let light = (note.weight * map.illuminance_lx(&place, most_bounces)).luminance();
            let noise = (note.weight * map.noise_lx(&place)).luminance();
            Some(Reading { element: place.element, light, noise })
        })
    }

    fn trips(
        &self,
        rays: f64,
        wanted: &Wanted,
        read: impl Fn(&Note<S>) -> Option<Reading> + Sync,
    ) -> Trips {
        let trip = |path: &Path<S>| (wanted.worth_per_lx(path.target), path.trip(&read));
        let flights: u64 = self.paths.iter().map(|path| u64::from(path.flights)).sum();
        Trips {
            trips: self.paths.par_iter().map(trip).collect(),
            rays_for_flight: rays / flights.max(1) as f64,
        }
    }
}

/// What a map says at a note, by what it counts at the start.
struct Reading {
    element: usize,
    light: f64,
    /// Standard deviation of that.
    noise: f64,
}

impl<S: Spectrum> Path<S> {
    /// Up to where a map says nothing.
    fn trip(&self, read: impl Fn(&Note<S>) -> Option<Reading>) -> Trip {
        let mut variance = 0.0;
        let ends = self.notes.iter().skip(1).map(|note| note.flights).chain([self.flights]);
        let step = |(note, end): (&Note<S>, u32)| {
            let Reading { element, light, noise } = read(note)?;
            variance += noise * noise;
            let (weight, beyond) = (note.weight.luminance(), note.beyond());
            let finding = Finding { element, weight, light, beyond };
            Some(Step { finding, flights: end - note.flights, alone: note.alone })
        };
        let steps: Vec<Step> = self.notes.iter().zip(ends).map_while(step).collect();
        let flights = self.notes.first().map_or(self.flights, |note| note.flights);
        Trip { target: self.target, walk: Walk { flights, steps }, noise: variance }
    }
}

impl Trips {
    /// How far off the map is.
    pub(super) fn survival(&self) -> Survival {
        let findings = self.trips.iter().flat_map(|(worth, trip)| {
            trip.walk.steps.iter().map(move |step| step.finding.worth(*worth))
        });
        Survival::of(findings)
    }

    /// What ending on the map at their first surface would cost the trips on average.
    pub(super) fn usual_loss(&self, survival: &Survival) -> f64 {
        let loss = |(worth, trip): &(f64, Trip)| {
            let Finding { element, weight, light, .. } = trip.walk.steps.first()?.finding;
            Some(survival.loss(element, worth * weight, worth * light))
        };
        let losses: Vec<f64> = self.trips.iter().filter_map(loss).collect();
        losses.iter().sum::<f64>() / losses.len().max(1) as f64
    }

    /// The part of how far it is off that more photons would mend.
    pub(super) fn noise_share(&self) -> f64 {
        let sums = self.trips.iter().fold([0.0, 0.0], |[noise, off], (worth, trip)| {
            let steps = trip.walk.steps.iter().map(|step| step.finding);
            let squares = steps.map(|f| (f.beyond - f.light) * (f.beyond - f.light));
            [noise + worth * worth * trip.noise, off + worth * worth * squares.sum::<f64>()]
        });
        if sums[1] > 0.0 { (sums[0] / sums[1]).min(MOST_NOISE) } else { 0.0 }
    }

    /// With these chances.
    pub(super) fn outcome(&self, ending: Ending<'_>, wanted: &Wanted) -> Outcome {
        let price = |chances: &mut Vec<f64>, (worth, trip): &(f64, Trip)| {
            trip.walk.price(ending, *worth, chances)
        };
        let prices: Vec<Price> = self.trips.par_iter().map_init(Vec::new, price).collect();
        let mut sums = vec![(0.0, 0.0); wanted.targets()];
        for ((_, trip), price) in self.trips.iter().zip(&prices) {
            let (sum, count) = &mut sums[trip.target];
            *sum += price.variance;
            *count += 1.0;
        }
        // Of the mean of the samples of a trial.
        let of_chances =
            wanted.seen().map(|target| sums[target].0 / sums[target].1 / SAMPLES as f64);
        let flights: f64 = prices.iter().map(|price| price.flights).sum();
        Outcome { of_chances: of_chances.collect(), rays: flights * self.rays_for_flight }
    }
}
