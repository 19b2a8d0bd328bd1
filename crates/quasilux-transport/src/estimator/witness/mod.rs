//! A witness of each run: plain photons, joined to every sensor, and plain paths, which share no
//! decision with the estimator and look for light that it misses.
//!
//! All replicates of a run share its surveys, its choice by pilots and its kind of paths. What none
//! of them can see makes no spread between them, so that their interval does not know of it. The
//! witness knows nothing of surveys and pilots. Its photons leave the lights by flux, go on by
//! albedo, and each landing on a diffuse surface is a virtual point light (Keller 1997) to every
//! target; its paths go to their ends by Russian roulette. Both have means of no more than the
//! light that there is, for each leaves some of it out: photons the light whose last surface is not
//! diffuse, paths that of caustics. So where one of them finds more light than the estimate does,
//! by more than chance allows, the estimate misses light, and its interval is withdrawn
//! ([`crate::stats::tolerance`]). That a witness finds less says nothing. Contributions of photons
//! near a sensor have a heavy tail to the right, which makes Student's t of their mean small rather
//! than large: the test errs on the side of silence.
//!
//! Photons take a twentieth of the rays of the run, as of each checkpoint, and paths as many. What
//! it finds is a function of scene, settings and that number of rays, and is computed anew where a
//! run goes on or parts are merged: it has no state of its own.

mod blocks;
mod receiver;

use crate::context::{Context, Stream};
use crate::estimator::connection::ReceiverElement;
use crate::path::end::Rest;
use crate::path::sections::{Piece, Section, trace_sections};
use crate::path::wave::{PathWave, WAVE};
use crate::photon::batch::{PhotonBatch, trace_photons};
use crate::photon::order::PhotonOrder;
use crate::photon::trace::{Lead, Source};
use crate::settings::{EstimatorKind, Settings};
use crate::spectrum::Spectrum;
use crate::stats::estimates::SensorEstimates;
use crate::stats::interval::{Interval, t_quantile_for};
use crate::stats::tally::{Quantum, Sum};
use crate::stats::targets::{Target, targets};
use crate::stats::watch::Watch;
use quasilux_scene::Scene;
use rayon::prelude::*;
use receiver::WitnessReceiver;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Part of the rays of a run that its witness may take.
pub(crate) const SHARE: f64 = 0.1;
/// Independent randomisations, whose spread tells what chance allows.
const BATCHES: u32 = 32;
/// Indices of each batch before its mean says anything.
const MIN_INDICES: u64 = 4;
/// Indices of each batch after which a witness knows enough: 2^21 photons, or paths of a target.
const MAX_INDICES: u64 = 1 << 16;
/// Probability that the witness contradicts any target of a run at one look by chance.
const FALSE_ALARM: f64 = 1e-3;

/// Memory of a sensor point: sums of photons, those of paths, and those of a wave of photons.
pub(crate) const POINT_BYTES: u64 = 3 * BATCHES as u64 * size_of::<Sum>() as u64;

/// What looks for light that a run misses.
pub(crate) struct Witness<'a, S> {
    context: &'a Context<'a, S>,
    targets: Vec<Target>,
    elements: Vec<ReceiverElement>,
    quantum: Quantum,
    photons: Testimony,
    /// `None` where the estimator is made of such paths itself.
    paths: Option<Testimony>,
}

/// Sums of one kind of samples.
#[derive(Default)]
struct Testimony {
    /// Of target t in batch b at `t * BATCHES + b`.
    sums: Vec<Sum>,
    /// Indices of each batch.
    indices: u64,
    rays: u64,
}

impl<'a, S: Spectrum> Witness<'a, S> {
    /// `None` where there is nothing to look for, or no interval to contradict.
    pub(crate) fn new(
        context: &'a Context<'a, S>,
        scene: &Scene,
        settings: &Settings,
    ) -> Option<Self> {
        let targets = targets(scene);
        let is_of_use = !targets.is_empty()
            && settings.max_bounces != Some(0)
            && settings.effective_replicates() > 1
            // Has a bound on what it does not see.
            && !settings.estimator.is_bounded();
        if !is_of_use {
            return None;
        }
        let has_paths = settings.estimator == EstimatorKind::Path;
        let element = |target: &Target| ReceiverElement::new(&context.world, target);
        let none = || Testimony {
            sums: vec![Sum::default(); targets.len() * BATCHES as usize],
            ..Testimony::default()
        };
        Some(Self {
            elements: targets.iter().map(element).collect(),
            quantum: Quantum::for_reference(context.lights.reference_lx(&context.world)),
            photons: none(),
            paths: (!has_paths).then(none),
            context,
            targets,
        })
    }

    /// Looks for light until its rays are their share of `rays`, those of the run.
    pub(crate) fn look(&mut self, rays: u64, watch: &mut Watch<'_>) {
        let budget = 0.5 * SHARE * rays as f64;
        while let Some(indices) = self.photons.next(budget) {
            if !self.photons_by_workers(&indices, watch) {
                self.trace_photons(indices.clone());
            }
            self.photons.indices = indices.end;
        }
        while let Some(indices) = self.paths.as_ref().and_then(|paths| paths.next(budget)) {
            if !self.paths_by_workers(&indices, watch) {
                self.trace_paths(indices.clone());
            }
            self.paths.iter_mut().for_each(|paths| paths.indices = indices.end);
        }
    }

    /// All rays that it took.
    pub(crate) fn rays(&self) -> u64 {
        self.photons.rays + self.paths.as_ref().map_or(0, |paths| paths.rays)
    }

    /// Whether it contradicts each of the targets, whose figures are these, sensor by sensor.
    pub(crate) fn contradicts(&self, sensors: &[SensorEstimates]) -> Vec<bool> {
        let of_each = FALSE_ALARM / self.targets.len() as f64;
        let Some(t) = t_quantile_for(BATCHES as usize, 2.0 * of_each) else { return Vec::new() };
        let points = sensors.iter().flat_map(|sensor| {
            (0..sensor.direct_lx.len()).map(move |point| {
                let rows = sensor.replicate_lx.iter();
                // The direct light is no matter of the witness.
                Interval::of_mean(
                    rows.map(move |row| row[point] - sensor.direct_lx[point]),
                    Some(1.0),
                )
            })
        });
        let testimonies: Vec<&Testimony> =
            [&self.photons].into_iter().chain(&self.paths).filter(|it| it.is_enough()).collect();
        points
            .enumerate()
            .map(|(target, found)| {
                testimonies.iter().any(|testimony| {
                    let Interval { value, half_width } = testimony.mean(target, self.quantum);
                    let errors = half_width.zip(found.half_width);
                    errors.is_some_and(|(own, of_run)| {
                        value - found.value > t * libm::hypot(own, of_run)
                    })
                })
            })
            .collect()
    }

    fn trace_photons(&mut self, indices: Range<u64>) {
        let Self { context, elements, quantum, .. } = self;
        let sums: Vec<Mutex<Vec<Sum>>> = (0..BATCHES).map(|_| Mutex::default()).collect();
        let batch = PhotonBatch {
            stream: Stream::WitnessPhotons,
            replicates: 0..BATCHES,
            indices,
            order: PhotonOrder::CoherentWaves,
            lead: Lead::by_chance(Source::Lights, None),
        };
        let receiver = |batch: u32| {
            let places = context.points(batch, Stream::WitnessPlaces);
            WitnessReceiver::new(context, elements, places, *quantum, &sums[batch as usize])
        };
        let mut nobody = ();
        let counts = trace_photons(context, &batch, receiver, &mut Watch::new(&mut nobody));
        let own = &mut self.photons;
        for (batch, sums) in sums.into_iter().enumerate() {
            let sums = sums.into_inner().unwrap_or_else(PoisonError::into_inner);
            for (target, sum) in sums.into_iter().enumerate() {
                own.sums[target * BATCHES as usize + batch] += sum;
            }
        }
        own.rays += counts.map_or(0, |counts| counts.rays);
    }

    fn trace_paths(&mut self, indices: Range<u64>) {
        let Self { context, targets, quantum, paths: Some(own), .. } = self else { return };
        let length = indices.end - indices.start;
        let section = |number: usize| Section {
            number,
            target: targets[number / BATCHES as usize],
            points: context.points(
                number as u32 % BATCHES,
                Stream::WitnessPaths((number / BATCHES as usize) as u64),
            ),
            rest: Rest::Path,
            caustics: None,
            partition: None,
            indices: indices.clone(),
        };
        let sections = WAVE.div_ceil(length) as usize;
        let rays: u64 = own
            .sums
            .par_chunks_mut(sections)
            .enumerate()
            .map_init(PathWave::default, |wave, (chunk, sums)| {
                let numbers = chunk * sections..chunk * sections + sums.len();
                let sections: Vec<Section<'_, S>> = numbers.map(section).collect();
                let Piece { sums: found, work, .. } =
                    trace_sections(context, &sections, *quantum, wave);
                sums.iter_mut().zip(found).for_each(|(sum, found)| *sum += found.indirect);
                work.rays
            })
            .sum();
        own.rays += rays;
    }
}

impl Testimony {
    /// The indices that come next, if they and those before do not take more than `budget` rays.
    fn next(&self, budget: f64) -> Option<Range<u64>> {
        let next = (2 * self.indices).max(1);
        let fits = 2.0 * self.rays as f64 <= budget && next <= MAX_INDICES;
        fits.then_some(self.indices..next)
    }

    fn is_enough(&self) -> bool {
        self.indices >= MIN_INDICES
    }

    /// The mean at a target with its standard error, in lx.
    fn mean(&self, target: usize, quantum: Quantum) -> Interval {
        let own = self.sums.iter().skip(target * BATCHES as usize).take(BATCHES as usize);
        let means = own.map(|sum| quantum.value(*sum) / self.indices as f64);
        Interval::of_mean(means, Some(1.0))
    }
}
