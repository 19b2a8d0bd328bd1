//! Trials: what a few samples in a few replicates find at some of the targets.

use crate::correction::Walks;
use crate::gathering::Exact;
use crate::join::Joining;
use crate::path_end::Rest;
use crate::path_wave::PathWave;
use crate::sections::{Piece, Section, trace_and_look};
use crate::spectrum::Spectrum;
use crate::stage::{Stage, Stream};
use crate::tally::Quantum;
use crate::targets::Target;
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

/// Of what the replicates found at one target.
pub(crate) struct Moments {
    pub(crate) mean: f64,
    pub(crate) variance: f64,
}

impl Sample {
    pub(crate) fn new(targets: &[Target], exact: &[Exact]) -> Self {
        let step = targets.len().div_ceil(TARGETS).max(1);
        let exact_lx = exact.iter().step_by(step).map(Exact::sum_lx).collect();
        Self { step, targets: targets.iter().step_by(step).copied().collect(), exact_lx }
    }

    /// Those that are looked at of all.
    pub(crate) fn of(&self, all: &[f64]) -> Vec<f64> {
        all.iter().step_by(self.step).copied().collect()
    }
}

impl Trial {
    /// Of paths that leave to photons what is theirs.
    pub(crate) fn of_paths_beside<S: Spectrum>(
        stage: &Stage<'_, S>,
        sample: &Sample,
        joining: &Joining,
        quantum: Quantum,
    ) -> Self {
        Self::of_paths(stage, sample, (Some(joining), quantum)).0
    }

    /// Of paths that go alone to their ends, and where they might have ended on a map.
    pub(crate) fn of_noted_paths<S: Spectrum>(
        stage: &Stage<'_, S>,
        sample: &Sample,
        quantum: Quantum,
    ) -> (Self, Walks<S>) {
        Self::of_paths(stage, sample, (None, quantum))
    }

    fn of_paths<S: Spectrum>(
        stage: &Stage<'_, S>,
        sample: &Sample,
        (joining, quantum): (Option<&Joining>, Quantum),
    ) -> (Self, Walks<S>) {
        let each = REPLICATES.len();
        let trace = |wave: &mut PathWave<S>, number: usize| -> (Piece, Walks<S>) {
            let target = number / each;
            let replicate = REPLICATES.start + (number % each) as u32;
            let section = Section {
                number,
                target: sample.targets[target],
                points: stage.points(replicate, Stream::Paths(target as u64)),
                rest: if joining.is_some() { Rest::Path } else { Rest::Noted },
                hidden: None,
                joining,
                indices: 0..SAMPLES,
            };
            let mut walks = Walks::default();
            let piece =
                trace_and_look(stage, &[section], quantum, wave, |path| walks.add(target, path));
            (piece, walks)
        };
        let numbers = (0..sample.targets.len() * each).into_par_iter();
        let (pieces, walks): (Vec<Piece>, Vec<Walks<S>>) =
            numbers.map_init(PathWave::default, trace).unzip();
        let value_lx = |piece: &Piece| -> f64 {
            let sums = &piece.sums[0];
            (quantum.value(sums.direct) + quantum.value(sums.indirect)) / SAMPLES as f64
        };
        let rays: u64 = pieces.iter().map(|piece| piece.work.rays).sum();
        let trial = Self { lx: pieces.iter().map(value_lx).collect(), rays: rays as f64 };
        (trial, Walks::all(walks))
    }

    pub(crate) fn moments(&self, target: usize) -> Moments {
        let values = self.values(target);
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let squares = values.iter().map(|value| (value - mean) * (value - mean));
        Moments { mean, variance: squares.sum::<f64>() / (values.len() - 1) as f64 }
    }

    /// In each replicate.
    fn values(&self, target: usize) -> &[f64] {
        let each = REPLICATES.len();
        &self.lx[target * each..(target + 1) * each]
    }

    /// Whether most replicates found something at every target: a spread says nothing of what is hardly ever found.
    pub(crate) fn finds_light(&self) -> bool {
        (0..self.lx.len() / REPLICATES.len()).all(|target| {
            let values = self.values(target);
            2 * values.iter().filter(|lx| **lx != 0.0).count() > values.len()
        })
    }
}
