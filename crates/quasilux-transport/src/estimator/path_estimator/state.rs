//! State of the path estimator for checkpoints and parts of a run.

use super::{Costs, PathEstimator, SharedLight};
use crate::codec::{Reader, StateError, Stored, Sums, Writer, digest};
use crate::estimator::exact::Exact;
use crate::spectrum::Spectrum;
use crate::stats::decisions::Decisions;

impl<S: Spectrum> PathEstimator<'_, S> {
    /// Decisions made before the first path.
    pub(super) fn decided(&self) -> Decisions {
        let SharedLight { end, caustics, .. } = &self.shared;
        let caustic_photons = caustics.as_ref().map(|caustics| caustics.photons_per_path());
        let facts = end.facts();
        Decisions {
            connected_photons: None,
            uses_importance: facts.uses_importance,
            first_shot: facts.first_shot,
            map_elements: facts.elements,
            caustic_photons,
            digest: digest(|out| {
                out.value(&self.quantum);
                let exact = self.computed.of_targets.iter();
                out.value(&exact.map(Exact::sum_lx).collect::<Vec<f64>>());
                end.put_decisions(out);
                out.value(&caustic_photons);
                self.costs.prepared.put(out);
            }),
        }
    }

    /// Everything, at any time between two pieces.
    pub(super) fn put_all(&self, out: &mut Writer) {
        self.progress.put(out);
        self.costs.shared.put(out);
        self.shared.end.put(out);
        self.shared.caustics.iter().for_each(|caustics| caustics.put(out));
        self.put_own(out);
    }

    /// Takes in what [`Self::put_all`] put out, before the first sample; `coming` is the next
    /// checkpoint.
    pub(super) fn take_in_all(
        &mut self,
        coming: u64,
        from: &mut Reader<'_>,
    ) -> Result<(), StateError> {
        self.progress.read(coming, from)?;
        self.costs.shared.merge_from(from)?;
        let SharedLight { end, caustics, .. } = &mut self.shared;
        end.merge_from(from)?;
        caustics.iter_mut().try_for_each(|caustics| caustics.merge_from(from))?;
        let is_fine = end.photons(coming).is_none_or(|left| left.start <= left.end)
            && caustics.as_ref().is_none_or(|it| it.photons() <= it.photons_for(coming));
        self.take_in_own(from)?;
        if !is_fine {
            return Err(StateError::Unfit("the number of samples"));
        }
        self.freeze_caustics();
        Ok(())
    }

    /// Puts out what is the same in all parts of one run: of the photons that serve all paths, what
    /// the estimate itself needs.
    pub(super) fn put_shared(&self, out: &mut Writer) {
        self.costs.shared.put(out);
        self.shared.caustics.iter().for_each(|caustics| caustics.put_targets(out));
    }

    /// Takes in what [`Self::put_shared`] put out.
    pub(super) fn merge_shared(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        self.costs.shared.merge_from(from)?;
        self.shared.caustics.iter_mut().try_for_each(|caustics| caustics.take_targets(from))
    }

    /// Puts out what belongs to the indices of a part alone.
    pub(super) fn put_own(&self, out: &mut Writer) {
        self.costs.paths.put(out);
        self.sums.as_slice().put(out);
        self.scores.as_slice().put(out);
    }

    /// Adds what [`Self::put_own`] put out.
    pub(super) fn take_in_own(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        self.costs.paths.merge_from(from)?;
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
