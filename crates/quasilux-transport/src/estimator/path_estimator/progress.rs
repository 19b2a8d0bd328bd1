//! Progress of the path estimator by target, for an estimator that watches over several: which
//! targets begin and end, what they cost, and what single paths gave them.

use super::{Costs, PathEstimator};
use crate::path::sections::PathScores;
use crate::spectrum::Spectrum;

impl<S: Spectrum> PathEstimator<'_, S> {
    /// Lets some targets begin with the next index.
    pub(crate) fn begin(&mut self, targets: &[bool]) {
        for (begin, _) in self.begins.iter_mut().zip(targets).filter(|(_, begins)| **begins) {
            begin.get_or_insert(self.samples);
        }
        self.keep_to_ends();
    }

    /// Photons and paths from here to so many indices.
    pub(super) fn work_up_to(&self, samples: u64) -> u64 {
        let joined = self.light_vertices.as_ref().map_or(0, |it| it.photons_of_an_index());
        let paths = (self.growing.len() as u64).saturating_mul(u64::from(self.replicates));
        let photons = self.end.photons_of_an_index(self.replicates);
        let each = paths.saturating_add(photons).saturating_add(joined);
        each.saturating_mul(samples.saturating_sub(self.samples))
    }

    /// Whether each target has begun.
    pub(crate) fn begun(&self) -> Vec<bool> {
        self.begins.iter().map(Option::is_some).collect()
    }

    /// Indices that each target has.
    pub(crate) fn samples_of_all(&self) -> Vec<u64> {
        (0..self.targets.len()).map(|target| self.samples_of(target)).collect()
    }

    /// Whether each target gets no more.
    pub(crate) fn are_over(&self) -> Vec<bool> {
        self.ends.iter().map(Option::is_some).collect()
    }

    /// Whether few connections of photons make the variance of each target.
    pub(crate) fn photons_hide_tails(&self) -> Vec<bool> {
        let photons = self.light_vertices.as_ref();
        let hides = |target| photons.is_some_and(|own| own.hides_its_tail(target));
        (0..self.targets.len()).map(hides).collect()
    }

    /// Single contributions to a target.
    pub(crate) fn scores_of(&self, target: usize) -> &PathScores {
        &self.scores[target]
    }

    /// Paths of a target, of all replicates.
    pub(crate) fn paths_of(&self, target: usize) -> u64 {
        self.samples_of(target) * u64::from(self.replicates)
    }

    /// Paths of one index, of all targets and replicates.
    pub(crate) fn paths_of_an_index(&self) -> u64 {
        (self.sums.len() as u64).max(1)
    }

    /// What scores are told in, in lx.
    pub(crate) fn reference_lx(&self) -> f64 {
        self.quantum.reference()
    }

    /// Indices so far.
    pub(crate) fn samples(&self) -> u64 {
        self.samples
    }

    /// All rays, those of surveys and pilots too.
    pub(crate) fn all_rays(&self) -> u64 {
        let Costs { work, photons } = self.costs();
        work.rays + photons.rays
    }

    /// Rays of the paths and of the photons that come with them.
    pub(crate) fn sampling_rays(&self) -> u64 {
        self.contribution.work.rays + self.contribution.photons.rays + self.shared.work.rays
    }
}
