//! What the path estimator has ahead of it and behind it, target by target.

use super::PathEstimator;
use crate::spectrum::Spectrum;

impl<S: Spectrum> PathEstimator<'_, S> {
    /// Photons and paths from here to this many indices.
    pub(super) fn work_up_to(&self, samples: u64) -> u64 {
        let paths =
            (self.progress.growing().len() as u64).saturating_mul(u64::from(self.replicates));
        let photons = self.shared.end.photons_of_an_index(self.replicates);
        let each = paths.saturating_add(photons);
        each.saturating_mul(samples.saturating_sub(self.progress.samples))
    }

    /// Paths of a target, of all replicates.
    pub(crate) fn paths_of(&self, target: usize) -> u64 {
        self.progress.samples_of(target) * u64::from(self.replicates)
    }
}
