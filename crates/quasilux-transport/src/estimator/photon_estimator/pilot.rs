//! Pilot photons that confirm or refuse weight windows where sensors count photons.
//!
//! The survey predicts the importance of photons where they land. Sensors count them in flight, and
//! a flight through a cell is a chance that the survey does not weigh: after the last surface
//! before a sensor it may thin photons out.
//!
//! With s_i the contribution of the i-th of N photons to a counter, the relative variance of their
//! mean is at most `sum s_i^2 / (sum s_i)^2` (Kish 1965); a counter without photons has 1. Photons
//! with and without windows take about as many rays; the efficiency over all counters decides.

use super::Receivers;
use crate::context::{Context, Stream};
use crate::importance::{self, Plan, WeightWindows};
use crate::photon::counts::PhotonCounts;
use crate::photon::receiver::{PhotonReceiver, SeenPhoton};
use crate::photon::trace::{PhotonSetup, Source, trace_photon};
use crate::sensors::targets;
use crate::settings::{Settings, Switch};
use crate::spectrum::Spectrum;
use crate::stats::efficiency::{Performance, WeightSums};
use crate::world::Interaction;
use crate::world::flight::Flight;
use quasilux_sampling::Sampler;
use quasilux_scene::Scene;
use rayon::prelude::*;
use std::ops::Range;

/// Guided pilot photons, and the most that are not.
const PILOTS: u64 = 1 << 11;
const MAX_PLAIN: u64 = 1 << 18;
/// How many a thread takes at once.
const PIECE: u64 = 1 << 6;

/// How to guide photons that sensors count.
pub(crate) fn plan<S: Spectrum>(
    context: &Context<'_, S>,
    scene: &Scene,
    receivers: &Receivers,
    settings: &Settings,
) -> Plan {
    let mut plan = importance::plan(context, &targets(scene), settings.importance);
    if settings.importance == Switch::Auto && plan.windows.is_some() {
        let trace = |windows, photons| Pilots::trace(context, receivers, windows, photons);
        let guided = trace(plan.windows.as_ref(), 0..PILOTS);
        let mut plain = trace(None, 0..PILOTS);
        let as_many = PILOTS * guided.rays / plain.rays.max(1);
        plain.merge(&trace(None, PILOTS..as_many.min(MAX_PLAIN)));
        plan.rays += plain.rays + guided.rays;
        let [plain, guided] = [plain, guided].map(|pilots| pilots.performance().cost_of_error());
        if plain <= guided {
            plan.windows = None;
        }
    }
    plan
}

/// Weights that photons left in each counter, and the rays of all.
struct Pilots {
    /// By photon.
    sums: Vec<WeightSums>,
    rays: u64,
}

impl Pilots {
    fn trace<S: Spectrum>(
        context: &Context<'_, S>,
        receivers: &Receivers,
        windows: Option<&WeightWindows>,
        photons: Range<u64>,
    ) -> Self {
        let points = context.points(0, Stream::WindowPilots);
        let setup = PhotonSetup::by_chance(Source::Lights, windows);
        let piece = |first: u64| {
            let mut counts = PhotonCounts::default();
            let mut weights = Vec::new();
            for index in first..(first + PIECE).min(photons.end) {
                let mut receiver = CounterWeights { receivers, weights: Vec::new() };
                let sampler = Sampler::new(&points, index);
                trace_photon(context, setup, sampler, &mut receiver, &mut counts);
                weights.extend(receiver.by_counter());
            }
            (weights, counts.rays)
        };
        let firsts: Vec<u64> = photons.clone().step_by(PIECE as usize).collect();
        let pieces: Vec<(Vec<CounterWeight>, u64)> = firsts.into_par_iter().map(piece).collect();
        let mut pilots = Self { sums: vec![WeightSums::default(); receivers.counters], rays: 0 };
        for (weights, rays) in pieces {
            pilots.rays += rays;
            weights.iter().for_each(|own| pilots.sums[own.counter].add(own.weight));
        }
        pilots
    }

    fn merge(&mut self, more: &Self) {
        self.rays += more.rays;
        self.sums.iter_mut().zip(&more.sums).for_each(|(own, more)| own.merge(*more));
    }

    /// With the sum of the relative variances over the counters.
    fn performance(&self) -> Performance {
        let of_counter = |sums: &WeightSums| sums.relative_variance().unwrap_or(1.0);
        let variance = self.sums.iter().map(of_counter).sum();
        Performance { rays: self.rays as f64, variance }
    }
}

/// Weight that one photon leaves in one counter.
struct CounterWeight {
    counter: usize,
    weight: f64,
}

/// Weights that one photon leaves in counters, contribution by contribution.
struct CounterWeights<'r> {
    receivers: &'r Receivers,
    weights: Vec<CounterWeight>,
}

impl CounterWeights<'_> {
    /// Each counter once.
    fn by_counter(mut self) -> Vec<CounterWeight> {
        self.weights.sort_by_key(|own| own.counter);
        self.weights.dedup_by(|next, kept| {
            let is_same = next.counter == kept.counter;
            if is_same {
                kept.weight += next.weight;
            }
            is_same
        });
        self.weights
    }

    fn add(&mut self, counters: impl Iterator<Item = usize>, weight: f64) {
        self.weights.extend(counters.map(|counter| CounterWeight { counter, weight }));
    }
}

impl<S: Spectrum> PhotonReceiver<S> for CounterWeights<'_> {
    fn flight(&mut self, flight: &Flight, photon: &SeenPhoton<S>) {
        let &SeenPhoton { weight, .. } = photon;
        let receivers = self.receivers;
        self.add(receivers.passed(flight), weight.luminance());
    }

    fn landing(&mut self, at: &Interaction, photon: &SeenPhoton<S>) {
        let &SeenPhoton { weight, .. } = photon;
        let receivers = self.receivers;
        self.add(receivers.landed_on(at).into_iter(), weight.luminance());
    }
}
