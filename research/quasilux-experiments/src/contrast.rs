//! Ratios of root mean squares that come from randomisations, and how sure they are: the one way in
//! which errors are compared here.
//!
//! Replicate r of all setups belongs together: it may have the same randomisation. Each setup has a
//! sum S of squared errors, and replicate r the share s_r of it. What is tested is the logarithm of
//! a product of powers of root mean squares, its standard error by leaving out one replicate after
//! the other (the jackknife, J. W. Tukey 1958):
//!
//! ```text
//! l_r = sum over setups of power / 2 * log((R - 1) / R * S - s_r)
//! ```
//!
//! over R replicates. Without replicate r that is the sum about the mean of the others, where s_r
//! is the squared distance from the mean of all times R / (R - 1); for squared distances from a
//! known truth it is a little less than what is left, which is careful. The logarithm over this
//! error is compared with Student's t of R - 1 degrees of freedom. That holds its level from 8
//! randomisations of one place on, as the tests here show; with fewer no ratio is significant.

use quasilux_transport::interval::t_quantile_for;

/// With fewer randomisations nothing is significant.
const FEWEST: usize = 8;

/// A product of powers of root mean squares, as one setup's over another's.
#[derive(Clone, Copy)]
pub(super) struct Contrast {
    pub(super) ratio: f64,
    /// Standard error of its logarithm.
    log_error: f64,
    replicates: usize,
}

/// A power of one setup's root mean square.
#[derive(Clone, Copy)]
pub(super) struct Factor<'a> {
    pub(super) power: f64,
    /// Squared errors, one a replicate.
    pub(super) squares: &'a [f64],
}

impl Contrast {
    /// The product of powers of root mean squares, their replicates in the same order.
    pub(super) fn product(factors: &[Factor<'_>]) -> Self {
        let replicates = factors.iter().map(|factor| factor.squares.len()).min().unwrap_or(0);
        let n = replicates as f64;
        let sums: Vec<(f64, f64, &[f64])> = factors
            .iter()
            .map(|&Factor { power, squares }| (0.5 * power, squares.iter().sum(), squares))
            .collect();
        let log_ratio = sums.iter().map(|(half, sum, _)| half * libm::log(sum / n)).sum();
        let without = |r: usize| -> f64 {
            let left = |sum: f64, square: f64| (n - 1.0) / n * sum - square;
            sums.iter().map(|(half, sum, x)| half * libm::log(left(*sum, x[r]))).sum()
        };
        let logs: Vec<f64> = (0..replicates).map(without).collect();
        let mean = logs.iter().sum::<f64>() / n;
        let squares: f64 = logs.iter().map(|log| (log - mean) * (log - mean)).sum();
        Self {
            ratio: libm::exp(log_ratio),
            log_error: ((n - 1.0) / n * squares).sqrt(),
            replicates,
        }
    }

    /// How many times smaller the second root mean square is than the first.
    pub(super) fn gain(worse: &[f64], better: &[f64]) -> Self {
        Self::product(&[
            Factor { power: 1.0, squares: worse },
            Factor { power: -1.0, squares: better },
        ])
    }

    /// The same for a ratio of cost as well, which is taken as known: how many times as efficient,
    /// one over squared error times cost.
    pub(super) fn efficiency(self, cost_ratio: f64) -> Self {
        let ratio = self.ratio * self.ratio * cost_ratio;
        Self { ratio, log_error: 2.0 * self.log_error, ..self }
    }

    /// Student's t of the logarithm.
    pub(super) fn t(self) -> f64 {
        libm::log(self.ratio) / self.log_error
    }

    /// Whether it is above `bound`, at a one-sided significance.
    pub(super) fn is_above(self, bound: f64, significance: f64) -> bool {
        let [low, _] = self.interval(2.0 * significance);
        self.is_testable() && low > bound
    }

    /// Whether it is below, likewise.
    pub(super) fn is_below(self, bound: f64, significance: f64) -> bool {
        let [_, high] = self.interval(2.0 * significance);
        self.is_testable() && high < bound
    }

    /// Whether it is within this factor of 1: two tests, of which chance can pass one at most.
    pub(super) fn is_within(self, factor: f64, significance: f64) -> bool {
        self.is_above(factor.recip(), significance) && self.is_below(factor, significance)
    }

    fn is_testable(self) -> bool {
        self.replicates >= FEWEST
    }

    /// The ends of an interval that misses with a probability.
    fn interval(self, miss_probability: f64) -> [f64; 2] {
        let t = t_quantile_for(self.replicates, miss_probability).unwrap_or(f64::INFINITY);
        let factor = libm::exp(t * self.log_error);
        [self.ratio / factor, self.ratio * factor]
    }

    /// `2.5 (2.1 to 3.0)`, at 95 %.
    pub(super) fn text(self) -> String {
        let [low, high] = self.interval(0.05);
        match self.is_testable() {
            true => format!("{:.2} ({low:.2} to {high:.2})", self.ratio),
            false => format!("{:.2} (too few randomisations)", self.ratio),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasilux_sampling::{PointSet, Randomization, Sequence};

    #[test]
    fn ratios_and_their_errors_follow_from_the_squares() {
        // Sums 15 and 15/4; two thirds of the first less each square are 9, 6 and 0.5 of ten.
        let worse = [1.0, 4.0, 9.5];
        let gain = Contrast::product(&[Factor { power: 1.0, squares: &worse }]);
        assert!((gain.ratio - (14.5_f64 / 3.0).sqrt()).abs() < 1e-12);
        let logs = worse.map(|square| 0.5 * libm::log(2.0 / 3.0 * 14.5 - square));
        let mean = logs.iter().sum::<f64>() / 3.0;
        let squares: f64 = logs.iter().map(|log| (log - mean) * (log - mean)).sum();
        assert!((gain.log_error - (2.0 / 3.0 * squares).sqrt()).abs() < 1e-12);
        // What is common to both is no error of their ratio.
        let paired = Contrast::gain(&worse, &worse.map(|square| 0.25 * square));
        assert!((paired.ratio - 2.0).abs() < 1e-12 && paired.log_error < 1e-12);
        assert!((paired.efficiency(0.5).ratio - 2.0).abs() < 1e-12);
        let of_gains = Contrast::product(&[
            Factor { power: 1.0, squares: &[4.0; 3] },
            Factor { power: -1.0, squares: &[1.0; 3] },
            Factor { power: -1.0, squares: &[9.0; 3] },
            Factor { power: 1.0, squares: &[4.0; 3] },
        ]);
        assert!((of_gains.ratio - 4.0 / 3.0).abs() < 1e-12);
    }

    #[test]
    fn few_randomisations_prove_nothing() {
        let [worse, better] = [[4.0; 7], [1.0; 7]];
        let gain = Contrast::gain(&worse, &better);
        assert!(!gain.is_above(1.0, 0.01) && !gain.is_within(3.0, 0.01), "{}", gain.text());
        assert_eq!(gain.text(), "2.00 (too few randomisations)");
        let [worse, better] = [[4.0; 8], [1.0; 8]];
        let gain = Contrast::gain(&worse, &better);
        assert!(gain.is_above(1.0, 0.01) && gain.is_within(3.0, 0.01), "{}", gain.text());
        assert!(!Contrast::gain(&worse, &[f64::NAN; 8]).is_above(1.0, 0.01));
    }

    /// Mean squares of twelve uniform errors each, half of them common to both setups: where none
    /// is better, a test at 5 % finds one in 5 % of 4000 cases, which these know to 0.35 %.
    #[test]
    fn chance_is_taken_for_a_gain_as_often_as_stated() {
        let points = PointSet::new(Sequence::Independent, Randomization::None, 5);
        let share = share_found(|run| {
            let squares = |first: u32| -> Vec<f64> {
                let square = |r: u32, d: u32| {
                    let u = points.coordinate(run, 64 * r + d) - 0.5;
                    u * u
                };
                let sum = |r: u32| (0..6).chain(first..first + 6).map(|d| square(r, d)).sum();
                (0..32).map(sum).collect()
            };
            [squares(6), squares(12)]
        });
        assert!((share - 0.05).abs() < 4.0 * 0.0035, "{share}");
    }

    /// The hardest case: a single place, its errors the distances from the mean of few
    /// randomisations, each a sum of twelve uniform numbers. The same cases, which are known as
    /// well.
    #[test]
    fn errors_about_their_own_mean_at_one_place_are_no_exception() {
        let points = PointSet::new(Sequence::Independent, Randomization::None, 6);
        for replicates in [8, 16, 32] {
            let share = share_found(|run| {
                let squares = |setup: u32| -> Vec<f64> {
                    let value = |r: u32| -> f64 {
                        let first = 12 * (32 * setup + r);
                        (first..first + 12).map(|d| points.coordinate(run, d)).sum()
                    };
                    let values: Vec<f64> = (0..replicates).map(value).collect();
                    let n = f64::from(replicates);
                    let mean = values.iter().sum::<f64>() / n;
                    values.iter().map(|x| (x - mean) * (x - mean) * n / (n - 1.0)).collect()
                };
                [squares(0), squares(1)]
            });
            assert!((share - 0.05).abs() < 4.0 * 0.0035, "{replicates}: {share}");
        }
    }

    /// Of 4000 cases, where the first is found to be worse at 5 %.
    fn share_found(case: impl Fn(u64) -> [Vec<f64>; 2]) -> f64 {
        let is_found = |run: &u64| {
            let [worse, better] = case(*run);
            Contrast::gain(&worse, &better).is_above(1.0, 0.05)
        };
        (0..4000).filter(is_found).count() as f64 / 4000.0
    }
}
