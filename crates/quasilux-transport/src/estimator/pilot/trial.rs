//! Trials: means and variances of a few samples in a few replicates, at some of the targets.

use crate::context::{Context, Stream};
use crate::estimator::exact::Exact;
use crate::path::end::Rest;
use crate::path::partition::Partition;
use crate::path::sections::{Piece, Section, trace_and_visit};
use crate::path::trace::PathResult;
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
/// What a path costs beside its rays, in rays of paths: its start, its sums, and what becomes of it
/// where it ends. Measured on the office and the cube.
const RAYS_OF_A_PATH: f64 = 1.5;
/// Targets that are looked at, spread over all.
const TARGETS: usize = 64;

/// The targets that are looked at.
pub(crate) struct Sample {
    /// Number of all targets.
    pub(crate) all: usize,
    /// Stride of the sample in all targets.
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

    /// What the paths of a trial cost beside their rays, in rays.
    pub(crate) fn beside_rays(&self) -> f64 {
        RAYS_OF_A_PATH * (self.targets.len() * REPLICATES.len()) as f64 * SAMPLES as f64
    }

    /// Values of the sample, out of those of all targets.
    pub(crate) fn select(&self, all: &[f64]) -> Vec<f64> {
        all.iter().step_by(self.step).copied().collect()
    }
}

impl Trial {
    /// Of paths to their ends, which may leave to photons what is theirs.
    pub(crate) fn of_paths<S: Spectrum>(
        context: &Context<'_, S>,
        sample: &Sample,
        partition: Option<&Partition>,
        quantum: Quantum,
    ) -> Self {
        let (targets, replicates, is_recorded) = (&*sample.targets, REPLICATES.len(), false);
        let paths = TrialPaths { targets, replicates, is_recorded, partition, quantum };
        Self::without_records(context, &paths)
    }

    /// Of paths to their ends from all these targets, in one replicate.
    pub(crate) fn of_one_replicate<S: Spectrum>(
        context: &Context<'_, S>,
        targets: &[Target],
        quantum: Quantum,
    ) -> Self {
        let (replicates, is_recorded, partition) = (1, false, None);
        let paths = TrialPaths { targets, replicates, is_recorded, partition, quantum };
        Self::without_records(context, &paths)
    }

    /// A trial whose paths record nothing.
    fn without_records<S: Spectrum>(context: &Context<'_, S>, paths: &TrialPaths<'_>) -> Self {
        let pieces = trace(context, paths, |(), _, _| {});
        Self::from_pieces(pieces.iter().map(|traced| &traced.piece), paths.quantum)
    }

    /// Values and rays of what was traced.
    pub(crate) fn from_pieces<'p>(
        pieces: impl Iterator<Item = &'p Piece> + Clone,
        quantum: Quantum,
    ) -> Self {
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

/// What a trial traces.
pub(crate) struct TrialPaths<'t> {
    pub(crate) targets: &'t [Target],
    /// Replicates of each target.
    pub(crate) replicates: usize,
    /// Whether paths record the vertices where they might have ended.
    pub(crate) is_recorded: bool,
    /// What they leave to photons.
    pub(crate) partition: Option<&'t Partition>,
    pub(crate) quantum: Quantum,
}

/// The paths of one target in one replicate.
pub(crate) struct Traced<R> {
    pub(crate) piece: Piece,
    pub(crate) records: R,
}

/// Traces the paths of a trial; `record` gets each with the number of its target. Results are in
/// the order of [`Trial::lx`].
pub(crate) fn trace<S: Spectrum, R: Default + Send>(
    context: &Context<'_, S>,
    paths: &TrialPaths<'_>,
    record: impl Fn(&mut R, usize, &mut PathResult<S>) + Sync,
) -> Vec<Traced<R>> {
    let trace = |wave: &mut PathWave<S>, number: usize| -> Traced<R> {
        let target = number / paths.replicates;
        let replicate = REPLICATES.start + (number % paths.replicates) as u32;
        let section = Section {
            number,
            target: paths.targets[target],
            points: context.points_of_trial(replicate, Stream::Paths(target as u64)),
            rest: if paths.is_recorded { Rest::Recorded } else { Rest::Path },
            caustics: None,
            partition: paths.partition,
            indices: 0..SAMPLES,
        };
        let mut records = R::default();
        let piece = trace_and_visit(context, &[section], paths.quantum, wave, |path| {
            record(&mut records, target, path);
        });
        Traced { piece, records }
    };
    let numbers = (0..paths.targets.len() * paths.replicates).into_par_iter();
    numbers.map_init(PathWave::default, trace).collect()
}
