//! Shares of the variance, from samples whose coordinates are exchanged in part.
//!
//! With f(A) and f(B) of independent points, and f(AB) of points with the block from B and the rest
//! from A, the block's share of the variance V alone is `E f(B) (f(AB) - f(A)) / V`, and with all
//! that depends on it `E (f(A) - f(AB))^2 / 2 V` (Saltelli et al. 2010, table 2, (b) and (f)).
//! Several targets are taken together, each in units of its mean, or of all the light there.
//! Standard errors are those of ratios of means, to first order.

use super::Share;

/// Relative variances below this are rounding.
const ROUNDING: f64 = 1e-20;

/// How the values of two independent pilots spread; by target, then by index.
pub(super) struct Spread<'v> {
    a: &'v [Vec<f64>],
    b: &'v [Vec<f64>],
    means: Vec<f64>,
    /// One over the square of the mean, or of the whole; 0 for targets without light.
    weights: Vec<f64>,
    /// Weighted squares of the deviations, by index, mean of both pilots.
    squares: Vec<f64>,
}

impl<'v> Spread<'v> {
    /// Of two pilots, in units of these wholes or else of the means.
    pub(super) fn new([a, b]: [&'v [Vec<f64>]; 2], wholes: Option<&[f64]>) -> Self {
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let means: Vec<f64> = a.iter().zip(b).map(|(a, b)| 0.5 * (mean(a) + mean(b))).collect();
        let weight = |mean: &f64| if *mean > 0.0 { 1.0 / (mean * mean) } else { 0.0 };
        let weights = wholes.unwrap_or(&means).iter().map(weight).collect();
        let samples = a.first().map_or(0, Vec::len);
        let mut spread = Self { a, b, means, weights, squares: vec![0.0; samples] };
        spread.squares = spread.by_index(|target, index| {
            let from_mean = |values: &[Vec<f64>]| values[target][index] - spread.means[target];
            let (a, b) = (from_mean(a), from_mean(b));
            0.5 * (a * a + b * b)
        });
        spread
    }

    /// How many targets there are.
    pub(super) fn targets(&self) -> usize {
        self.means.len()
    }

    /// Whether there is any variance.
    pub(super) fn varies(&self) -> bool {
        let deviation = self.relative_deviation();
        deviation * deviation > ROUNDING
    }

    /// Standard deviation over mean or whole, root mean square over the targets with light.
    pub(super) fn relative_deviation(&self) -> f64 {
        let lit = self.weights.iter().filter(|weight| **weight > 0.0).count();
        let values = (lit * self.squares.len()).max(1);
        (self.squares.iter().sum::<f64>() / values as f64).sqrt()
    }

    /// The relative variance of one sample, sum over the targets.
    pub(super) fn variance(&self) -> f64 {
        self.squares.iter().sum::<f64>() / self.squares.len().max(1) as f64
    }

    /// The relative variance between rows of values of the targets, sum over the targets.
    pub(super) fn variance_between(&self, rows: &[Vec<f64>]) -> f64 {
        let n = rows.len() as f64;
        let of_target = |target: usize| {
            let mean = rows.iter().map(|row| row[target]).sum::<f64>() / n;
            let from_mean = |row: &Vec<f64>| (row[target] - mean) * (row[target] - mean);
            self.weights[target] * rows.iter().map(from_mean).sum::<f64>() / (n - 1.0)
        };
        (0..self.weights.len()).map(of_target).sum()
    }

    /// The share that a block carries alone, from values with it exchanged.
    pub(super) fn alone(&self, exchanged: &[Vec<f64>]) -> Option<Share> {
        self.share(|target, index| {
            let other = self.b[target][index] - self.means[target];
            other * (exchanged[target][index] - self.a[target][index])
        })
    }

    /// The share that depends on a block, from values with it exchanged.
    pub(super) fn total(&self, exchanged: &[Vec<f64>]) -> Option<Share> {
        self.share(|target, index| {
            let difference = self.a[target][index] - exchanged[target][index];
            0.5 * difference * difference
        })
    }

    /// The mean of a figure over the variance.
    fn share(&self, figure: impl Fn(usize, usize) -> f64) -> Option<Share> {
        let figures = self.by_index(figure);
        let variance: f64 = self.squares.iter().sum();
        let value = figures.iter().sum::<f64>() / variance;
        let residual = |(figure, square): (&f64, &f64)| figure - value * square;
        let residuals = figures.iter().zip(&self.squares).map(residual);
        let standard_error = residuals.map(|r| r * r).sum::<f64>().sqrt() / variance;
        self.varies().then_some(Share { value, standard_error })
    }

    /// A figure of each index, its weighted sum over the targets: one photon serves many.
    fn by_index(&self, figure: impl Fn(usize, usize) -> f64) -> Vec<f64> {
        let of_index = |index: usize| {
            let weights = self.weights.iter().enumerate();
            weights.map(|(target, weight)| weight * figure(target, index)).sum()
        };
        (0..self.squares.len()).map(of_index).collect()
    }
}

/// The power with which `values` fall from the first step to the second.
pub(super) fn power(values: [f64; 2], steps: [f64; 2]) -> Option<f64> {
    let falls = values[0] > 0.0 && values[1] > 0.0;
    falls.then(|| libm::log(values[0] / values[1]) / libm::log(steps[0] / steps[1]))
}
