//! State of the path estimator for checkpoints and parts of a run.

use super::{Costs, PathEstimator};
use crate::codec::{Reader, StateError, Stored, Sums, Writer, digest};
use crate::spectrum::Spectrum;
use crate::stats::decisions::Decisions;

impl<S: Spectrum> PathEstimator<'_, S> {
    /// What was decided before the first path.
    pub(super) fn decided(&self) -> Decisions {
        let caustic_photons = self.caustics.as_ref().map(|caustics| caustics.photons_per_path());
        let facts = self.end.facts();
        Decisions {
            connected_photons: None,
            uses_importance: facts.uses_importance,
            first_shot: facts.first_shot,
            map_elements: facts.elements,
            caustic_photons,
            digest: digest(|out| {
                out.value(&self.quantum);
                out.value(&self.exact.iter().map(|exact| exact.sum_lx()).collect::<Vec<_>>());
                self.end.put_decisions(out);
                out.value(&caustic_photons);
                self.prepared.put(out);
            }),
        }
    }

    /// Everything, at any time between two pieces.
    pub(super) fn put_all(&self, out: &mut Writer) {
        out.value(&self.samples);
        out.value(&self.done);
        out.value(&self.ends);
        self.shared.put(out);
        self.end.put(out);
        self.caustics.iter().for_each(|caustics| caustics.put(out));
        self.put_own(out);
    }

    /// Takes that in, before the first sample; `coming` is the next checkpoint.
    pub(super) fn take_in_all(
        &mut self,
        coming: u64,
        from: &mut Reader<'_>,
    ) -> Result<(), StateError> {
        self.samples = from.value()?;
        self.done = from.value()?;
        let ends: Vec<Option<u64>> = from.value()?;
        if ends.len() != self.targets.len() {
            return Err(StateError::Unfit("the ends of targets"));
        }
        self.ends = ends;
        self.shared.merge_from(from)?;
        self.end.merge_from(from)?;
        self.caustics.iter_mut().try_for_each(|caustics| caustics.merge_from(from))?;
        self.take_in_own(from)?;
        let is_fine = self.samples <= coming
            && self.end.photons(coming).is_none_or(|left| left.start <= left.end)
            && self.ends.iter().flatten().all(|end| *end <= self.samples)
            && self.caustics.as_ref().is_none_or(|h| h.photons() <= h.photons_for(coming));
        if !is_fine {
            return Err(StateError::Unfit("the number of samples"));
        }
        self.keep_to_ends();
        Ok(())
    }

    /// What is the same in all parts of one run: of the photons that serve all paths, what the
    /// estimate itself needs.
    pub(super) fn put_shared(&self, out: &mut Writer) {
        self.shared.put(out);
        self.caustics.iter().for_each(|caustics| caustics.put_targets(out));
    }

    /// Takes that in.
    pub(super) fn merge_shared(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        self.shared.merge_from(from)?;
        self.caustics.iter_mut().try_for_each(|caustics| caustics.take_targets(from))
    }

    /// What belongs to the indices of a part alone.
    pub(super) fn put_own(&self, out: &mut Writer) {
        self.contribution.put(out);
        self.sums.as_slice().put(out);
        self.scores.as_slice().put(out);
    }

    /// Adds that.
    pub(super) fn take_in_own(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        self.contribution.merge_from(from)?;
        self.sums.as_mut_slice().merge_from(from)?;
        self.scores.as_mut_slice().merge_from(from)
    }
}

impl Sums for Costs {
    fn checked_add(&mut self, other: &Self) -> Option<()> {
        self.work.checked_add(&other.work)?;
        self.photons.checked_add(&other.photons)
    }
}
