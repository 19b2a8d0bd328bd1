//! Where checkpoints lie: at powers of two, where nets are balanced, and at the limit.
//!
//! The first ones only plan; at each of the others a run may end ([`crate::stats::sequential`]).

use crate::codec::StateError;
use serde::{Deserialize, Serialize};

/// No run goes past this many indices per replicate.
pub(crate) const MAX_SAMPLES: u64 = 1 << 48;

/// Before this many indices nothing is called done, not even where a limit ends the run. Light that
/// few paths find, such as that of a lamp in a mirror, makes means of fewer so skew that Student's
/// t is worth nothing, and a lucky spread would end them: with 4 paths in each of 16 replicates,
/// intervals far from a mirror may cover 60 % (`tests/it/few.rs`).
pub(crate) const MIN_SAMPLES: u64 = 128;

/// The checkpoints of one run: a function of counts alone.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Schedule {
    /// This and the limit belong to the run.
    #[serde(skip)]
    first: u64,
    #[serde(skip)]
    limit: u64,
    next: u64,
}

impl Schedule {
    /// The first checkpoint is at `first` or the limit.
    pub(crate) fn new(first: u64, limit: Option<u64>) -> Self {
        let limit = limit.unwrap_or(MAX_SAMPLES).clamp(1, MAX_SAMPLES);
        let first = first.min(limit);
        Self { first, limit, next: first }
    }

    /// The checkpoints of a figure that nothing is planned for: the first is the first where it may
    /// be called done, or the limit.
    pub(crate) fn of_looks(limit: u64) -> Self {
        let schedule = Self::new(1, Some(limit));
        Self { next: schedule.at_or_after(MIN_SAMPLES), ..schedule }
    }

    /// The only checkpoint is at the limit.
    pub(crate) fn of_one_look(limit: u64) -> Self {
        let schedule = Self::new(1, Some(limit));
        Self { next: schedule.limit, ..schedule }
    }

    /// Advances to where the stored schedule of the same run stands.
    pub(crate) fn advance_to(&mut self, stored: Self) -> Result<(), StateError> {
        let next = stored.next;
        if next == 0 || self.at_or_after(next) != next {
            return Err(StateError::Unfit("the schedule"));
        }
        self.next = next;
        Ok(())
    }

    /// Indices per replicate at the next checkpoint.
    pub(crate) fn next_checkpoint(&self) -> u64 {
        self.next
    }

    /// Whether a figure may be called done there.
    pub(crate) fn is_look(&self) -> bool {
        self.next > self.first && self.next >= MIN_SAMPLES
    }

    /// Goes on to the checkpoint after it; `false` where the limit is reached.
    pub(crate) fn advance(&mut self) -> bool {
        let is_before_limit = self.next < self.limit;
        self.next = self.at_or_after(self.next + 1);
        is_before_limit
    }

    /// The first checkpoint with as many indices, or the last.
    pub(crate) fn at_or_after(&self, samples: u64) -> u64 {
        self.without_limit(samples).min(self.limit)
    }

    /// The first one of a run without a limit where a figure may be called done that needs as many.
    pub(crate) fn look_at_or_after(&self, samples: u64) -> u64 {
        self.without_limit(samples.max(MIN_SAMPLES))
    }

    fn without_limit(&self, samples: u64) -> u64 {
        samples.min(MAX_SAMPLES).next_power_of_two().max(self.first)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checkpoints(first: u64, limit: Option<u64>) -> Vec<u64> {
        let mut schedule = Schedule::new(first, limit);
        let mut all = vec![schedule.next_checkpoint()];
        while all.len() < 5 && schedule.advance() {
            all.push(schedule.next_checkpoint());
        }
        all
    }

    #[test]
    fn checkpoints_double_up_to_the_limit() {
        assert_eq!(checkpoints(16, None), [16, 32, 64, 128, 256]);
        assert_eq!(checkpoints(16, Some(100)), [16, 32, 64, 100]);
        assert_eq!(checkpoints(16, Some(64)), [16, 32, 64]);
        assert_eq!(checkpoints(16, Some(3)), [3]);
    }

    /// Too few samples are no look, not even where a limit ends the run.
    #[test]
    fn without_a_plan_the_first_checkpoint_is_a_look() {
        for (limit, first, is_look) in [(64, 64, false), (200, 128, true), (1 << 20, 128, true)] {
            let schedule = Schedule::of_looks(limit);
            assert_eq!((schedule.next_checkpoint(), schedule.is_look()), (first, is_look));
            let mut one = Schedule::of_one_look(limit);
            assert_eq!((one.next_checkpoint(), one.is_look()), (limit, limit >= MIN_SAMPLES));
            assert!(!one.advance());
        }
    }

    #[test]
    fn the_first_checkpoints_are_no_looks() {
        for (first, planning) in [(16, 3), (64, 1), (1024, 1)] {
            let mut schedule = Schedule::new(first, None);
            for _ in 0..planning {
                assert!(!schedule.is_look());
                schedule.advance();
            }
            assert!(schedule.is_look());
        }
        assert_eq!(Schedule::new(16, None).at_or_after(1000), 1024);
    }
}
