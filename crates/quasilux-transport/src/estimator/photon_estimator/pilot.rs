//! Whether steering pays where sensors count photons: pilots of both kinds tell.
//!
//! The survey knows what photons are worth where they land. Sensors count them in flight, and a
//! flight through a cell is a chance that the survey does not weigh: after the last surface before
//! a sensor it may thin photons out. So what it predicts is tried before it is believed.
//!
//! With s_i what the i-th of N photons leaves in a counter, the relative variance of their mean is
//! at most `sum s_i^2 / (sum s_i)^2` (Kish 1965), and 1 is said where none came. Photons of both
//! kinds take as many rays; the mean over the counters decides.

use super::Receivers;
use crate::context::{Context, Stream};
use crate::importance::{self, Plan, WeightWindows};
use crate::photon::counts::PhotonCounts;
use crate::photon::receiver::PhotonReceiver;
use crate::photon::trace::{Lead, Source, trace_photon};
use crate::settings::{Settings, Switch};
use crate::spectrum::Spectrum;
use crate::stats::targets::targets;
use crate::world::Interaction;
use crate::world::flight::Flight;
use quasilux_sampling::Sampler;
use quasilux_scene::Scene;
use rayon::prelude::*;
use std::ops::Range;

/// Steered pilot photons, and the most that are not.
const PILOTS: u64 = 1 << 11;
const MAX_PLAIN: u64 = 1 << 18;
/// How many a thread takes at once.
const PIECE: u64 = 1 << 6;

/// How to steer photons that sensors count.
pub(crate) fn plan<S: Spectrum>(
    context: &Context<'_, S>,
    scene: &Scene,
    receivers: &Receivers,
    settings: &Settings,
) -> Plan {
    let mut plan = importance::plan(context, &targets(scene), settings.importance);
    if settings.importance == Switch::Auto && plan.windows.is_some() {
        let trace = |windows, photons| Pilots::trace(context, receivers, windows, photons);
        let steered = trace(plan.windows.as_ref(), 0..PILOTS);
        let mut plain = trace(None, 0..PILOTS);
        let as_many = PILOTS * steered.rays / plain.rays.max(1);
        plain.add(&trace(None, PILOTS..as_many.min(MAX_PLAIN)));
        plan.rays += plain.rays + steered.rays;
        if plain.relative_variance() <= steered.relative_variance() {
            plan.windows = None;
        }
    }
    plan
}

/// What photons left in each counter.
struct Pilots {
    /// Sums, and sums of squares by photon.
    sums: Vec<[f64; 2]>,
    rays: u64,
}

impl Pilots {
    fn trace<S: Spectrum>(
        context: &Context<'_, S>,
        receivers: &Receivers,
        windows: Option<&WeightWindows>,
        photons: Range<u64>,
    ) -> Self {
        let points = context.points(0, Stream::SteeringPilots);
        let lead = Lead::by_chance(Source::Lights, windows);
        let piece = |first: u64| {
            let mut counts = PhotonCounts::default();
            let mut left = Vec::new();
            for index in first..(first + PIECE).min(photons.end) {
                let mut found = Found { receivers, left: Vec::new() };
                let sampler = Sampler::new(&points, index);
                trace_photon(context, lead, sampler, &mut found, &mut counts);
                left.extend(found.by_counter());
            }
            (left, counts.rays)
        };
        let firsts: Vec<u64> = photons.clone().step_by(PIECE as usize).collect();
        let pieces: Vec<(Vec<(usize, f64)>, u64)> = firsts.into_par_iter().map(piece).collect();
        let mut pilots = Self { sums: vec![[0.0; 2]; receivers.counters], rays: 0 };
        for (left, rays) in pieces {
            pilots.rays += rays;
            for (counter, left) in left {
                let [sum, squares] = &mut pilots.sums[counter];
                *sum += left;
                *squares += left * left;
            }
        }
        pilots
    }

    fn add(&mut self, more: &Self) {
        self.rays += more.rays;
        for (own, more) in self.sums.iter_mut().flatten().zip(more.sums.iter().flatten()) {
            *own += more;
        }
    }

    /// Summed over the counters.
    fn relative_variance(&self) -> f64 {
        let of_counter = |[sum, squares]: &[f64; 2]| {
            if *sum > 0.0 { squares / (sum * sum) } else { 1.0 }
        };
        self.sums.iter().map(of_counter).sum()
    }
}

/// What one photon leaves in counters, entry by entry.
struct Found<'r> {
    receivers: &'r Receivers,
    left: Vec<(usize, f64)>,
}

impl Found<'_> {
    /// Each counter once.
    fn by_counter(mut self) -> Vec<(usize, f64)> {
        self.left.sort_by_key(|(counter, _)| *counter);
        self.left.dedup_by(|next, kept| {
            let is_same = next.0 == kept.0;
            if is_same {
                kept.1 += next.1;
            }
            is_same
        });
        self.left
    }
}

impl<S: Spectrum> PhotonReceiver<S> for Found<'_> {
    fn flight(&mut self, flight: &Flight, weight: S, _bounces: u32) {
        let passed = self.receivers.passed(flight);
        self.left.extend(passed.map(|counter| (counter, weight.luminance())));
    }

    fn landing(&mut self, at: &Interaction, weight: S, _bounces: u32) {
        let landed = self.receivers.landed_on(at);
        self.left.extend(landed.map(|counter| (counter, weight.luminance())));
    }
}
