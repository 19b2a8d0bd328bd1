//! Certified intervals: valid for any number of samples, and whatever spreads them.
//!
//! Student's t asks that means of replicates are about normal. Two limits do not (`docs/unseen.md`
//! has the proofs), each of which misses with half of the probability that is allowed.
//!
//! - **Lower**: replicates are independent, have the mean that is looked for, and are never
//!   negative. A player who bets a part h of all money on each replicate Y against a mean of m has
//!   `prod (1 + h (Y / m - 1))` times as much at the end. Were the mean m or less, this would be 1
//!   on average at most, and would pass 1 / d with a probability of d at most, by Markov's
//!   inequality (I. Waudby-Smith and A. Ramdas, "Estimating means of bounded random variables by
//!   betting", Journal of the Royal Statistical Society B 86, 2024). The limit is the largest m
//!   that is passed so. Any sequence will do.
//! - **Upper**: with independent indices, whose totals are expected to grow by B at most from
//!   anywhere on, the square root of a mean lies below that of the truth by more than
//!   `sqrt(B ln(1 / d) / n)` with a probability of d at most ([`IndexTotals`]).
//!
//! Runs that may end at several checkpoints spend `d / (k (k + 1))` on the k-th of them, which is
//! d over all.

use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Parts h of the money of those who bet, the k-th 2^-k, and how much each begins with: half of
/// what is left.
const BETS: i32 = 24;
/// Halvings of the range in which a limit lies.
const STEPS: u32 = 60;

/// Limits that hold with the confidence of the run, whatever the samples are like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CertifiedInterval {
    /// The illuminance in lx is this at least.
    pub lower_lx: f64,
    /// And this at most, in lx; infinite where nothing certain is known.
    pub upper_lx: f64,
}

/// Bounds on the totals of indices at each point of a sensor, where indices are independent.
///
/// Let T be the total of an index, in which what is still to come is B at most on average whenever
/// a part of it is known. Then `E exp(-s T) <= 1 - s E T / (1 + s B)`, and the mean of n of them is
/// below y < E T with a probability of `exp(-n (sqrt(E T) - sqrt(y))^2 / B)` at most.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct IndexTotals {
    /// Illuminance in lx that is computed without samples.
    pub computed_lx: Vec<f64>,
    /// B in lx; infinite where it is not known.
    pub most_lx: Vec<f64>,
    /// Light in lx at most, on average, of indices that B does not hold for.
    pub beyond_lx: Vec<f64>,
}

/// Figures that a limit is computed from.
#[derive(Clone, Copy)]
pub(crate) struct Measured<'r> {
    /// Illuminance in lx that each replicate found, without `computed_lx`.
    pub(crate) replicates_lx: &'r [f64],
    /// Illuminance in lx that is computed without samples.
    pub(crate) computed_lx: f64,
    /// B in lx, and the light at most that it does not hold for.
    pub(crate) most_lx: f64,
    pub(crate) beyond_lx: f64,
    /// Indices of each replicate.
    pub(crate) samples: u64,
}

impl IndexTotals {
    /// Nothing is known of any point.
    #[must_use]
    pub fn unknown(points: usize) -> Self {
        Self {
            computed_lx: vec![0.0; points],
            most_lx: vec![f64::INFINITY; points],
            beyond_lx: vec![0.0; points],
        }
    }

    /// Whether it has a row for each point.
    pub(crate) fn has_points(&self, points: usize) -> bool {
        let Self { computed_lx, most_lx, beyond_lx } = self;
        [computed_lx, most_lx, beyond_lx].iter().all(|row| row.len() == points)
    }

    /// Totals of some of its points.
    pub(crate) fn part(&self, points: Range<usize>) -> Self {
        Self {
            computed_lx: self.computed_lx[points.clone()].to_vec(),
            most_lx: self.most_lx[points.clone()].to_vec(),
            beyond_lx: self.beyond_lx[points].to_vec(),
        }
    }
}

impl CertifiedInterval {
    /// `miss` is the probability that each of the limits may miss with.
    pub(crate) fn new(measured: &Measured<'_>, miss: f64) -> Self {
        let &Measured { replicates_lx, computed_lx, most_lx, beyond_lx, samples } = measured;
        let mean_lx = replicates_lx.iter().sum::<f64>() / replicates_lx.len() as f64;
        let trials = replicates_lx.len() as f64 * samples as f64;
        let upper_lx = upper_limit(mean_lx, most_lx, trials, miss) + beyond_lx;
        Self {
            lower_lx: computed_lx + lower_limit(replicates_lx, miss),
            upper_lx: computed_lx + if upper_lx.is_nan() { f64::INFINITY } else { upper_lx },
        }
    }
}

/// Probability that one limit may miss with after `samples` indices, so that those at all
/// checkpoints before and this one together miss with `miss`: checkpoints are powers of two and a
/// last one between them.
pub(crate) fn miss_at_a_checkpoint(miss: f64, samples: u64) -> f64 {
    let number = 1.0 + f64::from(samples.max(1).next_power_of_two().trailing_zeros());
    miss / (number * (number + 1.0))
}

/// A mean that independent values, never negative, lie above with a probability of at least `1 -
/// miss`.
#[must_use]
pub fn lower_limit(values: &[f64], miss: f64) -> f64 {
    let wanted = -libm::log(miss);
    let (mut low, mut high) = (0.0, values.iter().copied().fold(0.0, f64::max));
    if !(high > 0.0 && high.is_finite()) {
        return 0.0;
    }
    for _ in 0..STEPS {
        let middle = 0.5 * (low + high);
        match log_capital(values, middle) >= wanted {
            true => low = middle,
            false => high = middle,
        }
    }
    low
}

/// The logarithm of what all bets against a mean of m have made of 1.
fn log_capital(values: &[f64], m: f64) -> f64 {
    let of_bet = |k: i32| {
        let part = libm::ldexp(1.0, -k);
        let log_product: f64 =
            values.iter().map(|value| libm::log1p(part * (value / m - 1.0))).sum();
        log_product + f64::from(-1 - k) * std::f64::consts::LN_2
    };
    let logs: Vec<f64> = (0..BETS).map(of_bet).collect();
    let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if !most.is_finite() {
        return most;
    }
    most + libm::log(logs.iter().map(|log| libm::exp(log - most)).sum::<f64>())
}

/// A mean that this many independent values with this mean lie below with a probability of at least
/// `1 - miss`: see [`IndexTotals`].
#[must_use]
pub fn upper_limit(mean: f64, most: f64, trials: f64, miss: f64) -> f64 {
    let root = mean.max(0.0).sqrt() + (-libm::log(miss) * most / trials).sqrt();
    root * root
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasilux_sampling::{PointSet, Randomization, Sequence};

    /// Bets of everything on R equal values y make `(y / m)^R / 2`: the limit is between that and
    /// what all bets together could make of it, twice as much.
    #[test]
    fn the_lower_limit_of_equal_values() {
        for replicates in [4, 16, 256] {
            let values = vec![3.0; replicates];
            let limit = |capital: f64| 3.0 * libm::pow(capital, -1.0 / replicates as f64);
            let got = lower_limit(&values, 0.025);
            assert!(limit(80.0) <= got && got <= limit(40.0), "{replicates}: {got}");
        }
        assert_eq!([lower_limit(&[0.0; 16], 0.025), lower_limit(&[], 0.025)], [0.0; 2]);
        // One value of n is known to nothing.
        assert!(lower_limit(&[0.0, 0.0, 0.0, 1.0], 0.025) < 0.01);
    }

    /// At nothing found the upper limit is `B ln(1 / d) / n`, as of light that no sample met: for
    /// 5 % the rule of three.
    #[test]
    fn the_upper_limit_of_nothing_is_the_rule_of_three() {
        assert!((upper_limit(0.0, 10.0, 100.0, 0.05) - 0.299_57).abs() < 1e-5);
        assert!((upper_limit(2.0, 0.0, 100.0, 0.05) - 2.0).abs() < 1e-12);
    }

    /// The looks of a run share one budget, whatever its limit is.
    #[test]
    fn all_checkpoints_together_spend_what_one_may() {
        let looks = (0..40).map(|k| 1_u64 << k).chain([(1 << 40) - 5]);
        let spent: f64 = looks.map(|samples| miss_at_a_checkpoint(0.025, samples)).sum();
        assert!(spent <= 0.025 && spent > 0.024, "{spent}");
    }

    /// Sums of which B is to come at any time on average, and for which no smaller limit holds: a
    /// walk that has one sample of w with probability p, and goes on with s, has B = w / (1 - s).
    /// 4000 means of 50, seed 3: each limit may miss 100 of them, and does so in fewer than that.
    /// Were B four times smaller, the upper one would miss more than 300.
    #[test]
    fn walks_that_go_on_are_covered() {
        const RUNS: u64 = 4000;
        let points = PointSet::new(Sequence::Independent, Randomization::None, 3);
        let (begins, s, trials) = (0.2, 0.7, 50);
        let (most, truth) = (1.0 / (1.0 - s), begins / (1.0 - s));
        let mut misses = [0; 3];
        for run in 0..RUNS {
            let total = |trial: u64| {
                let u = |dimension| points.coordinate(run * trials + trial, dimension);
                let begins = u(0) < begins;
                if begins { 1.0 + libm::floor(libm::log(1.0 - u(1)) / libm::log(s)) } else { 0.0 }
            };
            let totals: Vec<f64> = (0..trials).map(total).collect();
            let mean = totals.iter().sum::<f64>() / trials as f64;
            let upper = |most| upper_limit(mean, most, trials as f64, 0.025);
            misses[0] += u32::from(lower_limit(&totals, 0.025) > truth);
            misses[1] += u32::from(upper(most) < truth);
            misses[2] += u32::from(upper(0.25 * most) < truth);
        }
        assert!(misses[0] <= 100 && misses[1] <= 100, "{misses:?}");
        assert!(misses[2] > 300, "the test has lost its power: {misses:?}");
    }
}
