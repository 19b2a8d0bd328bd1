//! What is counted over many runs.

use super::trial::{Judged, Trial};
use quasilux_transport::EstimatorKind;

/// Runs of one estimator, in one family or in all.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Count {
    pub(super) runs: u32,
    /// Runs that were refused.
    pub(super) refused: u32,
    pub(super) reached: u32,
    pub(super) points: u32,
    pub(super) withdrawn: u32,
    pub(super) covered: u32,
    /// Intervals that are more than 5 standard errors off, and more than 6.
    pub(super) lies: [u32; 2],
    pub(super) largest_sigmas: f64,
    pub(super) seconds: f64,
}

impl Count {
    /// Counts the runs of an estimator, of one family unless it is `None`.
    pub(super) fn new(trials: &[Trial], estimator: EstimatorKind, family: Option<&str>) -> Self {
        let is_own = |trial: &&Trial| {
            trial.estimator == estimator && family.is_none_or(|family| trial.family == family)
        };
        let mut count = Self::default();
        for trial in trials.iter().filter(is_own) {
            let Some(run) = trial.done() else {
                count.refused += 1;
                continue;
            };
            count.runs += 1;
            count.reached += u32::from(run.tolerance_reached);
            count.seconds += run.seconds;
            for point in &run.points {
                count.points += 1;
                match point.interval {
                    Some(judged) => count.add(judged),
                    None => count.withdrawn += 1,
                }
            }
        }
        count
    }

    fn add(&mut self, judged: Judged) {
        self.covered += u32::from(judged.covers);
        for (lies, limit) in self.lies.iter_mut().zip([5.0, 6.0]) {
            *lies += u32::from(judged.sigmas > limit);
        }
        self.largest_sigmas = self.largest_sigmas.max(judged.sigmas);
    }

    /// Points that have an interval.
    pub(super) fn intervals(&self) -> u32 {
        self.points - self.withdrawn
    }

    /// Of the intervals, the share that covers the reference.
    pub(super) fn coverage(&self) -> f64 {
        f64::from(self.covered) / f64::from(self.intervals())
    }

    /// Of the points, the share that has no interval.
    pub(super) fn withdrawn_share(&self) -> f64 {
        f64::from(self.withdrawn) / f64::from(self.points)
    }
}
