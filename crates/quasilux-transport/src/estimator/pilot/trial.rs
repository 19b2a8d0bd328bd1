//! Trials: what a few samples in a few replicates find at some of the targets.

use crate::context::{Context, Stream};
use crate::estimator::control_variate::{RayCounts, Walks};
use crate::estimator::exact::Exact;
use crate::path::end::Rest;
use crate::path::partition::Partition;
use crate::path::sections::{Piece, Section, trace_and_look};
use crate::path::wave::PathWave;
use crate::spectrum::Spectrum;
use crate::stats::tally::Quantum;
use crate::stats::targets::Target;
use rayon::prelude::*;
use std::ops::Range;

/// Numbers of the replicates that trials alone use.
pub(crate) const REPLICATES: Range<u32> = 1 << 24..(1 << 24) + 8;
/// Paths from each target.
pub(crate) const SAMPLES: u64 = 16;
/// Targets that are looked at, spread over all.
const TARGETS: usize = 64;

/// The targets that are looked at.
pub(crate) struct Sample {
    /// Of which there are so many.
    pub(crate) all: usize,
    /// Every so many of all.
    pub(crate) step: usize,
    pub(crate) targets: Vec<Target>,
    pub(crate) exact_lx: Vec<f64>,
}

/// Values of some targets by replicate, in lx, and rays.
pub(crate) struct Trial {
    /// Of target t in replicate r at `t * REPLICATES.len() + r`.
    pub(crate) lx: Vec<f64>,
    pub(crate) rays: f64,
}

/// A trial of paths that go alone, and hardly end.
pub(crate) struct PathTrial<S> {
    pub(crate) trial: Trial,
    pub(crate) walks: Walks<S>,
    /// Whether at every target most replicates whose paths came to surfaces that reflect found light that bounced: a
    /// spread says nothing of what is hardly ever found.
    pub(crate) finds_light: bool,
}

/// Of what the replicates found at one target.
pub(crate) struct Moments {
    pub(crate) mean: f64,
    pub(crate) variance: f64,
}

impl Sample {
    pub(crate) fn new(targets: &[Target], exact: &[Exact]) -> Self {
        let step = targets.len().div_ceil(TARGETS).max(1);
        let exact_lx = exact.iter().step_by(step).map(Exact::sum_lx).collect();
        let all = targets.len();
        Self { all, step, targets: targets.iter().step_by(step).copied().collect(), exact_lx }
    }

    /// How many there are for each that is looked at.
    pub(crate) fn targets_for_each(&self) -> f64 {
        self.all as f64 / self.targets.len().max(1) as f64
    }

    /// Those that are looked at of all.
    pub(crate) fn of(&self, all: &[f64]) -> Vec<f64> {
        all.iter().step_by(self.step).copied().collect()
    }
}

impl Trial {
    /// Of paths that leave to photons what is theirs.
    pub(crate) fn of_paths_beside<S: Spectrum>(
        context: &Context<'_, S>,
        sample: &Sample,
        partition: &Partition,
        quantum: Quantum,
    ) -> Self {
        let of_all = (&sample.targets[..], REPLICATES.len());
        let pieces = trace(context, of_all, false, (Some(partition), quantum));
        Self::of(pieces.iter().map(|(piece, _)| piece), quantum)
    }

    fn of<'p>(pieces: impl Iterator<Item = &'p Piece> + Clone, quantum: Quantum) -> Self {
        let value_lx = |piece: &Piece| -> f64 {
            let sums = &piece.sums[0];
            (quantum.value(sums.direct) + quantum.value(sums.indirect)) / SAMPLES as f64
        };
        let rays: u64 = pieces.clone().map(|piece| piece.work.rays).sum();
        Self { lx: pieces.map(value_lx).collect(), rays: rays as f64 }
    }

    pub(crate) fn moments(&self, target: usize) -> Moments {
        let each = REPLICATES.len();
        let values = &self.lx[target * each..(target + 1) * each];
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let squares = values.iter().map(|value| (value - mean) * (value - mean));
        Moments { mean, variance: squares.sum::<f64>() / (values.len() - 1) as f64 }
    }
}

impl<S: Spectrum> PathTrial<S> {
    pub(crate) fn new(context: &Context<'_, S>, sample: &Sample, quantum: Quantum) -> Self {
        let (pieces, walks): (Vec<Piece>, Vec<Walks<S>>) =
            trace(context, (&sample.targets, REPLICATES.len()), true, (None, quantum))
                .into_iter()
                .unzip();
        let finds_light = pieces.chunks(REPLICATES.len()).all(|of_target| {
            let sums = of_target.iter().map(|piece| &piece.sums[0]);
            let looked = sums.filter(|sums| sums.reflected > 0);
            let (found, all) = looked.fold((0, 0), |(found, all), sums| {
                (found + usize::from(!sums.indirect.is_zero()), all + 1)
            });
            2 * found >= all
        });
        let trial = Trial::of(pieces.iter(), quantum);
        let at_start: usize =
            sample.targets.iter().map(|target| asked_at_start(context, target)).sum();
        let rays = RayCounts {
            all: trial.rays,
            at_start: at_start as f64 * REPLICATES.len() as f64 * SAMPLES as f64,
            // It still looks for light that the next surface emits.
            at_end: if context.lights.emitters.is_some() { 1.0 } else { 0.0 },
        };
        Self { trial, walks: Walks::all(walks, rays), finds_light }
    }
}

/// What one short look finds at each target, in lx, by paths to their ends in one replicate; and its rays.
pub(crate) fn short_looks<S: Spectrum>(
    context: &Context<'_, S>,
    targets: &[Target],
    quantum: Quantum,
) -> (Vec<f64>, u64) {
    let pieces = trace(context, (targets, 1), false, (None, quantum));
    let Trial { lx, rays } = Trial::of(pieces.iter().map(|(piece, _)| piece), quantum);
    (lx, rays as u64)
}

/// Rays by which a path asks lights themselves where it starts, at most.
fn asked_at_start<S: Spectrum>(context: &Context<'_, S>, target: &Target) -> usize {
    let lights = &context.lights;
    let areas = [lights.emitters.is_some(), !lights.area_luminaires.is_empty()];
    let areas = areas.into_iter().filter(|is_there| *is_there).count();
    match target {
        Target::Point { .. } => areas,
        Target::Cell { .. } => areas + lights.pointlikes.len(),
    }
}

/// Paths from these targets in so many replicates of a trial, in the order of [`Trial::lx`], which leave to photons what is
/// theirs, and may note where they might have ended.
fn trace<S: Spectrum>(
    context: &Context<'_, S>,
    (targets, each): (&[Target], usize),
    is_noted: bool,
    (partition, quantum): (Option<&Partition>, Quantum),
) -> Vec<(Piece, Walks<S>)> {
    let trace = |wave: &mut PathWave<S>, number: usize| -> (Piece, Walks<S>) {
        let target = number / each;
        let replicate = REPLICATES.start + (number % each) as u32;
        let section = Section {
            number,
            target: targets[target],
            points: context.points_of_trial(replicate, Stream::Paths(target as u64)),
            rest: if is_noted { Rest::Noted } else { Rest::Path },
            caustics: None,
            partition,
            indices: 0..SAMPLES,
        };
        let mut walks = Walks::default();
        let piece =
            trace_and_look(context, &[section], quantum, wave, |path| walks.add(target, path));
        (piece, walks)
    };
    let numbers = (0..targets.len() * each).into_par_iter();
    numbers.map_init(PathWave::default, trace).collect()
}
