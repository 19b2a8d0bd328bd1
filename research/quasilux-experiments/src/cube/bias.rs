//! What is left of the error after very many replicates: the floor under one replicate's error.
//!
//! The mean of R replicates with variance v at a place is off the truth by the bias b, and by v / R
//! more on average of squares; so the squared error of the mean less v / R estimates b^2 without
//! bias, summed over the places. How sure it is, is found by leaving out one replicate after the
//! other (the jackknife, J. W. Tukey 1958).

use super::task::Task;
use crate::claim::largest;

/// The squared relative L2 norm of the bias.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bias {
    /// May be negative where there is next to none.
    pub(super) squared: f64,
    pub(super) standard_error: f64,
}

impl Bias {
    /// From the values in lx, one row a replicate.
    pub(super) fn new(rows: &[Vec<f64>], task: &Task) -> Self {
        let replicates = rows.len() as f64;
        let without: Vec<f64> = (0..rows.len()).map(|out| squared(rows, Some(out), task)).collect();
        let mean = without.iter().sum::<f64>() / replicates;
        let squares: f64 = without.iter().map(|x| (x - mean) * (x - mean)).sum();
        let standard_error = ((replicates - 1.0) / replicates * squares).sqrt();
        Self { squared: squared(rows, None, task), standard_error }
    }

    /// The norm itself, 0 where nothing is left.
    pub(super) fn norm(self) -> f64 {
        // No number stays none.
        self.squared.clamp(0.0, f64::INFINITY).sqrt()
    }

    /// The standard error of the norm.
    pub(super) fn error_of_norm(self) -> f64 {
        0.5 * self.standard_error / largest([self.norm(), self.standard_error.sqrt()])
    }
}

/// The estimate without one of the replicates.
fn squared(rows: &[Vec<f64>], out: Option<usize>, task: &Task) -> f64 {
    let mut sums = [0.0; 2];
    for (k, (truth, place)) in task.truth_lx.iter().zip(task.places.iter()).enumerate() {
        let (mut n, mut mean, mut squares) = (0.0, 0.0, 0.0);
        for (_, row) in rows.iter().enumerate().filter(|(number, _)| Some(*number) != out) {
            // B. P. Welford, Technometrics 4, 1962.
            n += 1.0;
            let step = row[k] - mean;
            mean += step / n;
            squares += step * (row[k] - mean);
        }
        let variance_of_mean = squares / (n * (n - 1.0));
        sums[0] += place.weight * ((mean - truth) * (mean - truth) - variance_of_mean);
        sums[1] += place.weight * truth * truth;
    }
    sums[0] / sums[1]
}
