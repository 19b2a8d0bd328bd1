//! How far an estimator is that ends target by target.

use crate::codec::{Reader, StateError, Writer};
use crate::estimator::block::PathProgress;

/// Indices of all targets, and where those end that get no more.
pub(crate) struct TargetProgress {
    /// The first index.
    pub(crate) first: u64,
    /// Indices of the last checkpoint.
    pub(crate) samples: u64,
    /// Work that is over since then, in the units of its estimator.
    pub(crate) done: u64,
    /// Targets that get more paths, in order.
    growing: Vec<usize>,
    /// Of each target that gets no more, the index that it ends before.
    ends: Vec<Option<u64>>,
}

impl TargetProgress {
    /// Of this many targets, before the first index.
    pub(crate) fn new(targets: usize) -> Self {
        Self {
            first: 0,
            samples: 0,
            done: 0,
            growing: (0..targets).collect(),
            ends: vec![None; targets],
        }
    }

    /// Number of targets.
    pub(crate) fn targets(&self) -> usize {
        self.ends.len()
    }

    /// Targets that get more paths, in order.
    pub(crate) fn growing(&self) -> &[usize] {
        &self.growing
    }

    /// Of each target that gets no more, the index that it ends before.
    pub(crate) fn ends(&self) -> &[Option<u64>] {
        &self.ends
    }

    /// Indices that a target has.
    pub(crate) fn samples_of(&self, target: usize) -> u64 {
        self.ends[target].unwrap_or(self.samples)
    }

    /// Has a part of the indices begin here.
    pub(crate) fn begin_at(&mut self, first: u64) {
        (self.first, self.samples) = (first, first);
    }

    /// Comes to a checkpoint.
    pub(crate) fn complete(&mut self, samples: u64) {
        (self.samples, self.done) = (samples, 0);
    }

    /// Ends these targets at the last checkpoint, but for those that ended before.
    pub(crate) fn freeze(&mut self, is_converged: &[bool]) {
        for (end, _) in self.ends.iter_mut().zip(is_converged).filter(|(_, done)| **done) {
            end.get_or_insert(self.samples);
        }
        self.find_growing();
    }

    /// Progress that another process needs to trace a block of the work up to the checkpoint
    /// `coming`.
    pub(crate) fn frame(&self, coming: u64) -> PathProgress {
        PathProgress { samples: self.samples, coming, ends: self.ends.clone() }
    }

    /// Checks what another process says of itself.
    ///
    /// # Errors
    /// Where that is of other targets, or not before its checkpoint.
    pub(crate) fn check(&self, other: &PathProgress) -> Result<(), StateError> {
        let fits = other.ends.len() == self.ends.len() && other.samples < other.coming;
        if fits { Ok(()) } else { Err(StateError::Unfit("the progress of the run")) }
    }

    /// Goes to where another process is; whether other targets grow now.
    ///
    /// # Errors
    /// As those of [`Self::check`].
    pub(crate) fn follow(&mut self, other: &PathProgress) -> Result<bool, StateError> {
        self.check(other)?;
        let PathProgress { samples, ends, .. } = other;
        self.samples = *samples;
        let is_other = self.ends != *ends;
        if is_other {
            self.ends.clone_from(ends);
            self.find_growing();
        }
        Ok(is_other)
    }

    /// Puts it out.
    pub(crate) fn put(&self, out: &mut Writer) {
        out.value(&self.samples);
        out.value(&self.done);
        out.value(&self.ends);
    }

    /// Takes in what [`Self::put`] put out, before the first sample; `coming` is the next
    /// checkpoint.
    ///
    /// # Errors
    /// Where it is no progress of as many targets before that checkpoint.
    pub(crate) fn read(&mut self, coming: u64, from: &mut Reader<'_>) -> Result<(), StateError> {
        self.samples = from.value()?;
        self.done = from.value()?;
        let ends: Vec<Option<u64>> = from.value()?;
        let are_past = ends.iter().flatten().all(|end| *end <= self.samples);
        if ends.len() != self.ends.len() || !are_past || self.samples > coming {
            return Err(StateError::Unfit("the ends of targets"));
        }
        self.ends = ends;
        self.find_growing();
        Ok(())
    }

    fn find_growing(&mut self) {
        self.growing = (0..self.ends.len()).filter(|it| self.ends[*it].is_none()).collect();
    }
}
