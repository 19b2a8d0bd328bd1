//! Distribution of scores, the contributions of single samples: whether their spread tells the
//! error of their mean.
//!
//! Scores are counted in half octaves, by integers that add up in any order. Particle transport
//! codes test so whether a tail of rare large scores was seen: the relative variance of the
//! variance,
//!
//! ```text
//! VOV = sum (x - mean)^4 / (sum (x - mean)^2)^2 - 1 / n,
//! ```
//!
//! is about one over the number of scores that make the variance. Below 0.1 intervals cover as they
//! should (S. P. Pederson, R. A. Forster, T. E. Booth, "Confidence interval procedures for Monte
//! Carlo transport simulations", Nuclear Science and Engineering 127, 1997; MCNP manual, ten
//! statistical checks).

use crate::codec::Sums;
use crate::stats::tally::Quantum;
use serde::{Deserialize, Serialize};

/// Half octaves; smaller scores count as 0, larger ones as the largest.
const BINS: usize = 128;
/// Octaves of them below the reference of the quantum.
const OCTAVES_BELOW: i32 = 40;
/// Least spread of the mean by a tail that matters, over the standard error.
const MATTERS: f64 = 1.0 / 3.0;
/// Largest relative variance of the variance of scores whose spread can be trusted.
const MAX_VOV: f64 = 0.1;

/// How many scores lie in each half octave, from the smallest that counts to the largest seen.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Scores {
    counts: Vec<u64>,
}

impl Scores {
    /// Adds a score; zeros and NaN are left out.
    #[inline]
    pub(crate) fn add(&mut self, score: f64, quantum: Quantum) {
        let bin = bin(score / quantum.reference());
        if let Some(bin) = bin {
            if bin >= self.counts.len() {
                self.counts.resize(bin + 1, 0);
            }
            self.counts[bin] += 1;
        }
    }

    /// Adds those of others.
    pub(crate) fn merge(&mut self, other: &Self) {
        if other.counts.len() > self.counts.len() {
            self.counts.resize(other.counts.len(), 0);
        }
        self.counts.iter_mut().zip(&other.counts).for_each(|(sum, more)| *sum += more);
    }

    /// Whether too few scores make the variance of this many samples, zeros among them, and the
    /// spread of their mean is not small beside this standard error, over the reference.
    pub(crate) fn hide_their_tail(&self, samples: u64, standard_error: f64) -> bool {
        let n = samples as f64;
        let mean = self.sum_of(|x| x) / n;
        let zeros = (n - self.sum_of(|_| 1.0)).max(0.0);
        let (of_zeros, squared) = (mean * mean, |x: f64| (x - mean) * (x - mean));
        let square = zeros * of_zeros + self.sum_of(squared);
        let fourth = zeros * of_zeros * of_zeros + self.sum_of(|x| squared(x) * squared(x));
        let matters = square.sqrt() / n > MATTERS * standard_error;
        square > 0.0 && matters && fourth / (square * square) - 1.0 / n > MAX_VOV
    }

    fn sum_of(&self, of: impl Fn(f64) -> f64) -> f64 {
        let filled = self.counts.iter().enumerate().filter(|(_, count)| **count > 0);
        filled.map(|(bin, count)| *count as f64 * of(middle(bin))).sum()
    }
}

/// The half octave of a score over the reference.
#[inline]
fn bin(score: f64) -> Option<usize> {
    if !(score > 0.0 && score < f64::INFINITY) {
        return None;
    }
    let exponent = libm::ilogb(score);
    let is_upper = libm::ldexp(score, -exponent) >= std::f64::consts::SQRT_2;
    let bin = 2 * (exponent + OCTAVES_BELOW) + i32::from(is_upper);
    (bin >= 0).then_some((bin as usize).min(BINS - 1))
}

/// The geometric middle of a half octave, over the reference.
fn middle(bin: usize) -> f64 {
    libm::exp2(0.5 * bin as f64 + 0.25 - f64::from(OCTAVES_BELOW))
}

impl Sums for Scores {
    fn checked_add(&mut self, other: &Self) -> Option<()> {
        let most = self.counts.len().max(other.counts.len());
        if most > BINS {
            return None;
        }
        self.counts.resize(most, 0);
        let mut pairs = self.counts.iter_mut().zip(&other.counts);
        pairs.try_for_each(|(sum, more)| crate::codec::add_count(sum, *more))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scores(of: impl Iterator<Item = f64>) -> Scores {
        let quantum = Quantum::for_reference(1.0);
        let mut scores = Scores::default();
        of.for_each(|score| scores.add(score, quantum));
        scores
    }

    #[test]
    fn few_large_scores_among_many_are_told() {
        let even = || (0..4096).map(|i| f64::from(i % 64));
        assert!(!scores(even()).hide_their_tail(4096, 0.0));
        let rare = scores(even().chain([1e4]));
        // Its mean has a spread of 10^4 / 4097.
        assert!(rare.hide_their_tail(4097, 6.0) && !rare.hide_their_tail(4097, 8.0));
        assert!(!scores(even().chain((0..20).map(|_| 1e4))).hide_their_tail(4116, 0.0));
        // A tenth of all are equal, the others 0: the spread is well known.
        assert!(!scores((0..400).map(|_| 1.0)).hide_their_tail(4000, 0.0));
        assert!(scores((0..4).map(|_| 1.0)).hide_their_tail(4000, 0.0));
        assert!(!Scores::default().hide_their_tail(1000, 0.0));
    }

    #[test]
    fn order_does_not_matter_and_nothing_overflows() {
        let all = [1e-30, 0.0, f64::NAN, f64::INFINITY, 3.0, 1e30];
        let forward = scores(all.into_iter());
        assert_eq!(forward, scores(all.into_iter().rev()));
        assert_eq!(forward.counts.iter().sum::<u64>(), 2);
        let mut sum = forward.clone();
        assert!(sum.checked_add(&Scores { counts: vec![u64::MAX; 3] }).is_some());
        assert!(sum.checked_add(&Scores { counts: vec![u64::MAX; 3] }).is_none());
        assert!(sum.checked_add(&Scores { counts: vec![0; BINS + 1] }).is_none());
    }
}
