//! What it costs to look: the miss probability of intervals that a run may stop at.
//!
//! At every checkpoint but the first ones, a figure whose half-width has reached its tolerance is
//! done. So an interval is taken where it happens to be narrow, and with Student's t for one look
//! it would miss too often: R replicates say what the spread is only to one in sqrt(2 (R - 1)),
//! however long they run. Stopping rules with consistent estimates of the spread need no correction
//! as the tolerance goes to zero (P. W. Glynn and W. Whitt, The Annals of Applied Probability 2,
//! 1992); with an estimate that stays noisy, the interval has to be scaled by what the same rule
//! does to the limit process (J. Dong and P. W. Glynn, Winter Simulation Conference 2019). Here
//! that process is R means of normal values, looked at after 1, 2, 4, .. of these. If each look is
//! made for the miss probability
//!
//! ```text
//! a' = a^(1 + 1.25 / (R - 1))
//! ```
//!
//! then what is reported at the moment of stopping misses with probability a. The exponent is
//! fitted to simulations of that process with a of 10, 5 and 1 % and R from 3 to 64. For 16
//! replicates and 5 % it gives 3.9 %; half-widths that shrink faster than one over the square root
//! of N come to between 4.5 and 5 %, for fewer looks are near.
//!
//! A budget that all looks share (Bonferroni) would be safe too, and too safe: most runs end at
//! their first good look, and the rest of the budget is left over.

use crate::settings::Settings;
use crate::stats::schedule::Schedule;

/// See above.
const EXPONENT: f64 = 1.25;

/// The miss probability of the intervals at each of many looks, so that those where a figure is
/// done miss with `miss_probability`.
pub(crate) fn miss_probability_of_a_look(miss_probability: f64, replicates: u32) -> f64 {
    let degrees = f64::from(replicates.max(2) - 1);
    libm::pow(miss_probability, 1.0 + EXPONENT / degrees)
}

/// When a run may end, and what its intervals are to miss.
#[derive(Clone, Copy)]
pub(crate) struct Stopping {
    /// Whether it may end before its limit.
    pub(crate) may_end: bool,
    /// Of the interval of each target at each look.
    pub(crate) miss_probability: f64,
}

impl Stopping {
    pub(crate) fn new(settings: &Settings) -> Self {
        // Part of a set whose number of points is fixed would leave part of its lights out.
        let may_end = settings.sequence.points().is_none();
        let mut miss_probability = 1.0 - settings.confidence;
        if may_end && settings.has_tolerance() {
            let replicates = settings.effective_replicates();
            miss_probability = miss_probability_of_a_look(miss_probability, replicates);
        }
        Self { may_end, miss_probability }
    }

    /// The checkpoints, up to a limit, of a figure that nothing is planned for.
    pub(crate) fn looks(self, limit: u64) -> Schedule {
        if self.may_end { Schedule::of_looks(limit) } else { Schedule::of_one_look(limit) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::interval::{Interval, t_quantile_for};
    use quasilux_sampling::{PointSet, Randomization, Sequence};
    use std::f64::consts::TAU;

    /// Doublings, and the one by which the tolerance is about reached.
    const CHECKPOINTS: usize = 11;
    const GOAL: f64 = 6.0;

    /// Independent normal numbers from random points (Box and Muller 1958).
    struct Normals(PointSet);

    impl Normals {
        fn value(&self, run: u32, dimension: u32) -> f64 {
            let u = |d| self.0.coordinate(u64::from(run), 2 * dimension + d);
            (-2.0 * libm::log(1.0 - u(0))).sqrt() * libm::cos(TAU * u(1))
        }
    }

    /// The share of runs whose interval covers the mean, 0, where they stop.
    ///
    /// A replicate's error after the next doubling is half of the last one and as much new: exactly
    /// what happens to means of independent values.
    fn coverage(replicates: u32, (miss, look_miss): (f64, f64), runs: u32) -> f64 {
        let normals = Normals(PointSet::new(Sequence::Independent, Randomization::None, 7));
        let [t, t_far] = [(replicates, look_miss), (1000, miss)]
            .map(|(r, miss)| t_quantile_for(r as usize, miss));
        let root = f64::from(replicates).sqrt();
        let covered = (0..runs).filter(|&run| {
            let phase = f64::from(run) / f64::from(runs);
            let tolerance = t_far.unwrap() / root * libm::exp2(-0.5 * (GOAL - phase));
            let mut errors: Vec<f64> = (0..replicates).map(|r| normals.value(run, r)).collect();
            let mut spread = 1.0_f64;
            for k in 1..CHECKPOINTS {
                for (r, error) in (0..).zip(&mut errors) {
                    let fresh = normals.value(run, k as u32 * replicates + r);
                    *error = 0.5 * *error + 0.5 * spread * fresh;
                }
                spread *= std::f64::consts::FRAC_1_SQRT_2;
                let interval = Interval::of_mean(errors.iter().copied(), t);
                let half_width = interval.half_width.unwrap();
                if half_width <= tolerance || k + 1 == CHECKPOINTS {
                    return interval.value.abs() <= half_width;
                }
            }
            unreachable!("the last checkpoint ends it")
        });
        covered.count() as f64 / f64::from(runs)
    }

    /// 20 000 runs know 95 % to 0.15 % and 99 % to 0.07 % (one standard error). With what one look
    /// may miss, runs of 8 replicates would cover 92 %.
    #[test]
    fn what_is_reported_where_a_run_stops_is_covered() {
        for (replicates, miss) in [(4, 0.05), (8, 0.05), (16, 0.05), (16, 0.01), (32, 0.05)] {
            let look = miss_probability_of_a_look(miss, replicates);
            let got = coverage(replicates, (miss, look), 20_000);
            let allowed = 0.15 * miss + 4.0 * (miss / 20_000.0).sqrt();
            assert!((1.0 - got - miss).abs() < allowed, "{replicates} {miss}: {got}");
        }
        let naive = coverage(8, (0.05, 0.05), 20_000);
        assert!(naive < 0.93, "the test has lost its power: {naive}");
    }
}
