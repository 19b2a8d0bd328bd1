//! What paths and photons have summed so far, for checkpoints and for parts.

use super::{Costs, Gathering};
use crate::codec::{Reader, StateError, Stored, Writer, digest};
use crate::spectrum::Spectrum;
use crate::stats::decisions::Decisions;

impl<S: Spectrum> Gathering<'_, S> {
    /// What was decided before the first path.
    pub(super) fn decided(&self) -> Decisions {
        let joining = self.joined.as_ref().map(|joined| &joined.joining);
        let caustic_photons = self.hidden.as_ref().map(|hidden| hidden.photons_per_path());
        let facts = self.end.facts();
        Decisions {
            connected_photons: joining.map(|joining| joining.photons()),
            uses_importance: facts.uses_importance
                || joining.is_some_and(|joining| joining.uses_importance()),
            first_shot: facts.first_shot,
            map_elements: facts.elements,
            caustic_photons,
            digest: digest(|out| {
                self.quantum.put(out);
                out.f64s(&self.exact.iter().map(|exact| exact.sum_lx()).collect::<Vec<_>>());
                self.joined.iter().for_each(|joined| joined.put_decisions(out));
                self.end.put_decisions(out);
                out.u64(caustic_photons.unwrap_or(0));
                self.prepared.put(out);
            }),
        }
    }

    /// Everything, at any time between two pieces.
    pub(super) fn put_all(&self, out: &mut Writer) {
        out.u64(self.samples);
        out.u64(self.done);
        out.u64(self.joined.as_ref().map_or(0, |joined| joined.samples()));
        self.ends.iter().for_each(|end| out.u64(end.unwrap_or(0)));
        self.served.put(out);
        self.end.put(out);
        self.hidden.iter().for_each(|hidden| hidden.put(out));
        self.put_own(out);
    }

    /// Takes that in, before the first sample; `coming` is the next checkpoint.
    pub(super) fn take_in_all(
        &mut self,
        coming: u64,
        from: &mut Reader<'_>,
    ) -> Result<(), StateError> {
        self.samples = from.u64()?;
        self.done = from.u64()?;
        let joined = from.u64()?;
        for end in &mut self.ends {
            *end = Some(from.u64()?).filter(|end| *end > 0);
        }
        self.served.take_in(from)?;
        self.end.take_in(from)?;
        self.hidden.iter_mut().try_for_each(|hidden| hidden.take_in(from))?;
        self.take_in_own(from)?;
        let is_fine = self.samples.max(joined) <= coming
            && self.end.photons(coming).is_none_or(|left| left.start <= left.end)
            && self.ends.iter().flatten().all(|end| *end <= self.samples)
            && self.hidden.as_ref().is_none_or(|h| h.photons() <= h.photons_for(coming));
        if !is_fine {
            return Err(StateError::Unfit("the number of samples"));
        }
        if let Some(own) = &mut self.joined {
            own.go_to(joined);
        }
        self.keep_to_ends();
        Ok(())
    }

    /// What is the same in all parts of one run: of the photons that serve all paths, what the estimate
    /// itself needs.
    pub(super) fn put_shared(&self, out: &mut Writer) {
        self.served.put(out);
        self.hidden.iter().for_each(|hidden| hidden.put_targets(out));
    }

    /// Takes that in.
    pub(super) fn take_in_shared(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        self.served.take_in(from)?;
        self.hidden.iter_mut().try_for_each(|hidden| hidden.take_targets(from))
    }

    /// What belongs to the indices of a part alone.
    pub(super) fn put_own(&self, out: &mut Writer) {
        self.gathered.put(out);
        self.sums.as_slice().put(out);
        self.joined.iter().for_each(|joined| joined.put(out));
    }

    /// Adds that.
    pub(super) fn take_in_own(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        self.gathered.take_in(from)?;
        self.sums.as_mut_slice().take_in(from)?;
        self.joined.iter_mut().try_for_each(|joined| joined.take_in(from))
    }

    /// Takes it that the sums are those of all indices before this one.
    pub(super) fn complete(&mut self, samples: u64) {
        self.samples = samples;
        if let Some(joined) = &mut self.joined {
            joined.go_to(samples);
        }
    }
}

impl Stored for Costs {
    fn put(&self, out: &mut Writer) {
        self.work.put(out);
        self.photons.put(out);
    }

    fn take_in(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        self.work.take_in(from)?;
        self.photons.take_in(from)
    }
}
