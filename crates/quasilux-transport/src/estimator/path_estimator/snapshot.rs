//! Snapshots of the path estimator between two checkpoints, for observers.
//!
//! The sums of all replicates are taken together, over all paths that they stand for: part of the
//! paths of a replicate is a part of its sequence from the start, so nothing is left out but the
//! rest.

use super::PathEstimator;
use crate::control::observer::Snapshot;
use crate::path::end::GrowingMaps;
use crate::path::path_batch::PathSums;
use crate::sensors::snapshot;
use crate::spectrum::Spectrum;
use crate::stats::tally::Sum;
use std::ops::Range;

/// Illuminance of a target after some paths, in lx; `None` where there were none to tell.
#[derive(Clone, Copy)]
pub(super) struct Moment {
    /// Straight from the lights, and what only mirrors and lenses lead there.
    straight_lx: Option<f64>,
    pub(super) all_lx: Option<f64>,
}

/// Illuminances of all targets before their maps changed.
pub(super) struct Before<'g, 'a, S> {
    gathering: &'g PathEstimator<'a, S>,
    moments: Vec<Moment>,
}

impl<'a, S: Spectrum> PathEstimator<'a, S> {
    /// Illuminances of the targets at the last checkpoint.
    pub(super) fn before(&self) -> Before<'_, 'a, S> {
        let paths = |target: usize| self.paths_of(target);
        let targets = 0..self.targets.len();
        let moments = targets.map(|target| self.moment(target, paths(target))).collect();
        Before { gathering: self, moments }
    }

    /// Illuminances of the sensors when `done` of the paths `indices` of all growing targets and
    /// replicates are over, in the order of [`PathEstimator::sums`].
    pub(super) fn snapshot(&self, indices: &Range<u64>, done: u64) -> Snapshot {
        let replicates = u64::from(self.replicates);
        let each = (indices.end - indices.start) * replicates;
        let value_lx = |target: usize| {
            let paths = match self.progress.growing().binary_search(&target) {
                Ok(rank) => {
                    let own = done.saturating_sub(rank as u64 * each).min(each);
                    indices.start * replicates + own
                }
                Err(_) => self.paths_of(target),
            };
            self.moment(target, paths).all_lx.or(self.shared.last_lx[target])
        };
        snapshot(self.scene, (0..self.targets.len()).map(value_lx))
    }

    /// Estimate at a target after `paths` of all replicates together.
    pub(super) fn moment(&self, target: usize, paths: u64) -> Moment {
        let replicates = self.replicates as usize;
        let own = &self.sums[target * replicates..][..replicates];
        let sum_lx = |sum: fn(&PathSums) -> Sum| -> f64 {
            own.iter().map(|sums| self.quantum.value(sum(sums))).sum()
        };
        let caustic_lx = self.shared.caustics.as_ref().map_or(0.0, |caustics| {
            (0..replicates).map(|r| caustics.target_lx(r, target)).sum::<f64>() / replicates as f64
        });
        let computed_lx = self.computed.of_targets[target].sum_lx() + caustic_lx;
        if paths == 0 {
            let is_all_computed = !self.samples_direct[target];
            return Moment { straight_lx: is_all_computed.then_some(computed_lx), all_lx: None };
        }
        let straight_lx = computed_lx + sum_lx(|sums| sums.direct) / paths as f64;
        let all_lx = straight_lx + sum_lx(|sums| sums.indirect) / paths as f64;
        Moment { straight_lx: Some(straight_lx), all_lx: Some(all_lx) }
    }
}

impl<S: Spectrum> Before<'_, '_, S> {
    /// Illuminances of the sensors with what growing maps have under the targets, in place of what
    /// paths read from them.
    pub(super) fn snapshot(&self, maps: &GrowingMaps<'_, S>) -> Snapshot {
        let PathEstimator { context, scene, targets, .. } = self.gathering;
        let value_lx = |(target, before): (_, &Moment)| {
            let from_map = before.straight_lx.zip(maps.illuminance_lx(context, target));
            from_map.map(|(straight_lx, lx)| straight_lx + lx).or(before.all_lx)
        };
        snapshot(scene, targets.iter().zip(&self.moments).map(value_lx))
    }

    /// Illuminance of each target, in lx.
    pub(super) fn into_lx(self) -> Vec<Option<f64>> {
        self.moments.into_iter().map(|moment| moment.all_lx).collect()
    }
}
