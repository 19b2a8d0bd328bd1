//! When to look, and how much a look costs.
//!
//! Checkpoints lie at powers of two, where nets are balanced. At some of them, the looks, the run
//! may stop because the tolerance is reached. Looking several times and stopping at the first good
//! look would make the interval miss too often, so the looks share one budget of miss probability
//! (Bonferroni): the first look gets three quarters of it, each later one a quarter of the one
//! before, which adds up to the whole. Checkpoints that are no looks only plan: from their
//! half-widths follows where the next look pays. The bound holds for looks fixed ahead; that it also
//! holds for looks planned from half-widths is measured by the coverage test.

use crate::state::{Reader, StateError, Writer};

/// Share of the miss probability that the first look spends; each later one a quarter of the one
/// before.
const FIRST_LOOK_SHARE: f64 = 0.75;
/// Looks are planned as if half-widths shrank like one over the square root of N, for half-widths
/// that reach the tolerance when multiplied by this: they mostly shrink faster, and a look in vain
/// costs less than twice the samples.
const OPTIMISM: f64 = 0.9;
/// No run goes past this many indices per replicate.
const MOST_SAMPLES: u64 = 1 << 48;

/// The plan of checkpoints and looks of one run: a function of counts and estimates alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Schedule {
    budget: f64,
    limit: u64,
    looks_done: i32,
    next_look: Option<u64>,
    next_checkpoint: u64,
}

impl Schedule {
    /// `miss_probability` is the whole budget; the first checkpoint is at `first` or the limit.
    pub(crate) fn new(miss_probability: f64, first: u64, limit: Option<u64>) -> Self {
        let limit = limit.unwrap_or(MOST_SAMPLES).clamp(1, MOST_SAMPLES);
        Self {
            budget: miss_probability,
            limit,
            looks_done: 0,
            next_look: None,
            next_checkpoint: first.min(limit),
        }
    }

    /// Puts out how far it has come; budget and limit belong to the settings.
    pub(crate) fn put(&self, out: &mut Writer) {
        let Self { budget: _, limit: _, looks_done, next_look, next_checkpoint } = self;
        out.u32(looks_done.cast_unsigned());
        out.u64(next_look.unwrap_or(0));
        out.u64(*next_checkpoint);
    }

    /// Comes as far as another of the same run has come.
    pub(crate) fn read(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        self.looks_done = from.u32()?.cast_signed();
        let (next_look, next_checkpoint) = (from.u64()?, from.u64()?);
        let is_fine = (0..=64).contains(&self.looks_done)
            && (1..=self.limit).contains(&next_checkpoint)
            && next_look <= self.limit;
        self.next_look = Some(next_look).filter(|look| *look > 0);
        self.next_checkpoint = next_checkpoint;
        if is_fine { Ok(()) } else { Err(StateError::Unfit("the schedule")) }
    }

    /// Indices per replicate at the next checkpoint.
    pub(crate) fn next_checkpoint(&self) -> u64 {
        self.next_checkpoint
    }

    /// What the coming look may spend.
    pub(crate) fn miss_probability(&self) -> f64 {
        self.budget * FIRST_LOOK_SHARE * libm::ldexp(1.0, -2 * self.looks_done)
    }

    /// The number of indices where the run is expected to end; `None` before the first checkpoint.
    pub(crate) fn expected_end(&self) -> Option<u64> {
        self.next_look
    }

    /// Records a completed checkpoint and says whether the run is over. `excess` is the largest
    /// half-width over its tolerance; `None` where there is no tolerance to reach.
    pub(crate) fn complete(&mut self, excess: Option<f64>) -> bool {
        let samples = self.next_checkpoint;
        let reached = excess.is_some_and(|excess| excess <= 1.0);
        let is_look = self.next_look.is_some_and(|look| samples >= look);
        if samples == self.limit || (is_look && reached) {
            return true;
        }
        self.looks_done += i32::from(is_look);
        self.next_look = Some(self.plan_look(samples, excess));
        self.next_checkpoint = following_power_of_two(samples).min(self.limit);
        false
    }

    /// Where the next look pays, given the half-widths after `samples`.
    fn plan_look(&self, samples: u64, excess: Option<f64>) -> u64 {
        let wanted = excess.map_or(f64::INFINITY, |excess| {
            let shrink = (excess * OPTIMISM).max(1.0);
            samples as f64 * shrink * shrink
        });
        let wanted = wanted.min(self.limit as f64) as u64;
        wanted.max(samples + 1).next_power_of_two().min(self.limit)
    }
}

fn following_power_of_two(samples: u64) -> u64 {
    (samples + 1).next_power_of_two()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Runs a schedule whose excess after n samples is `excess(n)`; returns checkpoints, and the
    /// miss probabilities of looks.
    fn run(limit: Option<u64>, excess: impl Fn(u64) -> Option<f64>) -> (Vec<u64>, Vec<f64>) {
        let mut schedule = Schedule::new(0.05, 16, limit);
        let (mut checkpoints, mut spent) = (Vec::new(), Vec::new());
        loop {
            let samples = schedule.next_checkpoint();
            checkpoints.push(samples);
            let before = schedule;
            let over = schedule.complete(excess(samples));
            if over || schedule.looks_done > before.looks_done {
                spent.push(before.miss_probability());
            }
            if over {
                return (checkpoints, spent);
            }
        }
    }

    #[test]
    fn a_run_ends_at_the_planned_look() {
        let (checkpoints, spent) = run(None, |n| Some(40.0 / (n as f64).sqrt()));
        assert_eq!(checkpoints.first(), Some(&16));
        assert_eq!(checkpoints.last(), Some(&2048));
        assert!(spent.len() == 1 && (spent[0] - 0.0375).abs() < 1e-12, "{spent:?}");
    }

    #[test]
    fn looks_never_spend_more_than_the_budget() {
        let (_, spent) = run(Some(1 << 40), |_| Some(1.01));
        assert!(spent.len() > 10 && spent.iter().sum::<f64>() <= 0.05, "{spent:?}");
    }

    #[test]
    fn the_limit_is_the_last_checkpoint() {
        assert_eq!(run(Some(100), |_| Some(9.0)).0, [16, 32, 64, 100]);
        assert_eq!(run(Some(3), |_| None).0, [3]);
        assert_eq!(run(Some(64), |_| None).0, [16, 32, 64]);
    }

    /// A run that is limited to one of the checkpoints sees the same checkpoints and budgets.
    #[test]
    fn a_limit_does_not_change_what_comes_before() {
        let excess = |n: u64| Some(40.0 / (n as f64).sqrt());
        let (all, _) = run(None, excess);
        for (i, &limit) in all.iter().enumerate() {
            assert_eq!(run(Some(limit), excess).0, all[..=i]);
        }
    }
}
