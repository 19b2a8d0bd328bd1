//! The lowest of several noisy values, and how sure it is.
//!
//! The lowest of noisy means is too low: among many that are equal in truth, one always seems
//! lower. No estimate without bias exists. The jackknife takes only a part of it, and its intervals
//! cover 90 % in place of 95 where two points are equal, 56 % where a hundred are. So the two ends
//! of the interval are found apart, each by what it claims:
//!
//! ```text
//! lower end   min over all points of mean - t s
//! upper end   min over all points of mean + k s
//! ```
//!
//! with the means and standard errors s over replicates. The true minimum is below the lower end
//! only if the mean of the point where it is attained is too high by t s, whichever point seems
//! lowest. It is above the upper end only if at one of the points where it is attained the mean is
//! too low by k s. How many points these can be is estimated: those whose intervals begin below the
//! upper ends of all intervals. For m of them k is the one-sided quantile of 1 - (1 - b)^(1/m)
//! (Sidak 1967). This is the confidence region for intersection bounds of V. Chernozhukov, S. Lee
//! and A. M. Rosen (Econometrica 81, 2013), with its selection of points that may be binding.
//! Points with common noise count for fewer: `m = 1 + (n - 1) (1 - r^2)` for n points with a mean
//! square r^2 of correlations (D. R. Nyholt, American Journal of Human Genetics 74, 2004, in the
//! form of the mean square). The lower end errs only if all of these m are too high at once, so of
//! the miss probability a the upper end gets `b = a - (a / 2)^m`: half of it for one point, nearly
//! all for many.
//!
//! Where light is rare, the points that seem lowest met little of it, and have small errors for the
//! same reason. So for the upper end no error counts for less than the root mean square of those of
//! the points that may be lowest: among 400 equal points, each of which met about 600 samples of a
//! rare light, the interval covers 95 % in place of 85.
//!
//! Between the clear cases (one point far below the others; points with equal values) the interval
//! is cautious: with points one standard error above the lowest, or thirty equal ones, it covers 99
//! % in place of 95, and where some points are known much worse than others it begins below what
//! these say. Value and half-width are the middle of the interval and half its width.

use crate::stats::interval::{Interval, t_quantile_for};

/// Correlations are found from this many replicates at most.
const MAX_ROWS: usize = 256;

/// Mean and standard error of one point.
#[derive(Clone, Copy)]
struct PointMean {
    mean: f64,
    error: f64,
}

/// The interval of the smallest of several means; `rows` has one row of values a replicate. Not a
/// number where a value is none, or there are no values.
pub(crate) fn interval_of_minimum(rows: &[Vec<f64>], miss_probability: f64) -> Interval {
    let columns = rows.first().map_or(0, Vec::len);
    let points: Vec<PointMean> =
        (0..columns).map(|column| PointMean::from_column(rows, column)).collect();
    let is_number = points.iter().all(|point| !point.mean.is_nan());
    let seeming = points.iter().copied().reduce(|a, b| if b.mean < a.mean { b } else { a });
    let Some(seeming) = seeming.filter(|_| is_number) else {
        return Interval { value: f64::NAN, half_width: None };
    };
    let Some(t) = t_quantile_for(rows.len(), miss_probability) else {
        return Interval { value: seeming.mean, half_width: None };
    };
    // The lowest of all points k errors up, each error at least this; below zero, down.
    let end = |k: f64, least_error: f64| {
        let at = |point: &PointMean| point.mean + k * point.error.max(least_error);
        points.iter().map(at).fold(f64::INFINITY, f64::min)
    };
    let ends = end(t, 0.0);
    let may_be_lowest: Vec<usize> =
        (0..columns).filter(|&p| points[p].mean - t * points[p].error <= ends).collect();
    let m = independent(rows, &points, &may_be_lowest);
    let of_upper = miss_probability - libm::pow(0.5 * miss_probability, m);
    let of_each = -libm::expm1(libm::log1p(-of_upper) / m);
    let k = t_quantile_for(rows.len(), 2.0 * of_each).unwrap_or(t);
    let square = |&p: &usize| points[p].error * points[p].error;
    let usual_error =
        (may_be_lowest.iter().map(square).sum::<f64>() / may_be_lowest.len() as f64).sqrt();
    let (low, high) = (end(-t, 0.0), end(k, usual_error));
    Interval { value: 0.5 * (low + high), half_width: Some(0.5 * (high - low)) }
}

/// Rows whose means are the points' means over an average of which `averages` has a value for each
/// row, and whose spread is that of these ratios to first order (the delta method).
pub(crate) fn ratios(rows: &[Vec<f64>], averages: &[f64]) -> Vec<Vec<f64>> {
    let columns = rows.first().map_or(0, Vec::len);
    let n = rows.len() as f64;
    let mean = |column: usize| rows.iter().map(|row| row[column]).sum::<f64>() / n;
    let average = averages.iter().sum::<f64>() / n;
    let ratio: Vec<f64> = (0..columns).map(|column| mean(column) / average).collect();
    let linear = |(row, own): (&Vec<f64>, &f64)| {
        let of_point = |(x, ratio): (&f64, &f64)| ratio + (x - ratio * own) / average;
        row.iter().zip(&ratio).map(of_point).collect()
    };
    rows.iter().zip(averages).map(linear).collect()
}

impl PointMean {
    fn from_column(rows: &[Vec<f64>], column: usize) -> Self {
        let values = rows.iter().map(|row| row[column]);
        let interval = Interval::of_mean(values, (rows.len() >= 2).then_some(1.0));
        Self { mean: interval.value, error: interval.half_width.unwrap_or(0.0) }
    }
}

/// To how many independent points some points amount.
fn independent(rows: &[Vec<f64>], points: &[PointMean], chosen: &[usize]) -> f64 {
    let n = chosen.len() as f64;
    let rows = &rows[..rows.len().min(MAX_ROWS)];
    let degrees = rows.len() as f64 - 1.0;
    if chosen.len() < 2 || degrees < 2.0 {
        return n.max(1.0);
    }
    // The correlations' squares, from the products of replicates instead of those of points: there
    // are fewer.
    let mut products = vec![0.0; rows.len() * rows.len()];
    let mut own = vec![0.0; rows.len()];
    for &p in chosen {
        let values = rows.iter().map(|row| row[p] - points[p].mean);
        let length = values.clone().map(|x| x * x).sum::<f64>().sqrt();
        if length == 0.0 {
            continue;
        }
        own.iter_mut().zip(values).for_each(|(own, x)| *own = x / length);
        for (row, a) in products.chunks_exact_mut(own.len()).zip(&own) {
            row.iter_mut().zip(&own).for_each(|(sum, b)| *sum += a * b);
        }
    }
    let squares = products.iter().map(|x| x * x).sum::<f64>();
    let mean_square = ((squares - n) / (n * (n - 1.0))).max(0.0);
    // Independent noise has a mean square of one over its degrees of freedom.
    let common = ((mean_square - 1.0 / degrees) * degrees / (degrees - 1.0)).clamp(0.0, 1.0);
    1.0 + (n - 1.0) * (1.0 - common)
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasilux_sampling::{PointSet, Randomization, Sequence};

    const REPLICATES: usize = 16;

    /// How often the interval covers the minimum of `truth`, 0, over 2000 runs; `common` is the
    /// share of the noise's variance that all points have together. Noise is the sum of four
    /// uniform numbers, with unit variance, times `scale` at each point.
    fn coverage(truth: &[f64], scale: &[f64], common: f64) -> f64 {
        let points = PointSet::new(Sequence::Independent, Randomization::None, 11);
        let noise = |index: usize, replicate: usize, point: usize| -> f64 {
            let u = |d: u32| {
                let dimension = 4 * (point * REPLICATES + replicate) as u32 + d;
                points.coordinate(index as u64, dimension)
            };
            ((0..4).map(u).sum::<f64>() - 2.0) * 3.0_f64.sqrt()
        };
        let runs = 2000;
        let covered = (0..runs).filter(|&run| {
            let row = |replicate: usize| -> Vec<f64> {
                let all = noise(run, replicate, truth.len());
                let value = |(point, truth): (usize, &f64)| {
                    let own = noise(run, replicate, point);
                    truth + scale[point] * (common.sqrt() * all + (1.0 - common).sqrt() * own)
                };
                truth.iter().enumerate().map(value).collect()
            };
            let rows: Vec<Vec<f64>> = (0..REPLICATES).map(row).collect();
            let interval = interval_of_minimum(&rows, 0.05);
            interval.value.abs() <= interval.half_width.unwrap()
        });
        covered.count() as f64 / runs as f64
    }

    /// Points apart and points alike, in standard errors of their means: 95 % where it is clear
    /// which are lowest, up to 99.5 % where it is not. 2000 runs know it to 0.5 %.
    #[test]
    fn the_true_minimum_is_covered() {
        let error = (REPLICATES as f64).sqrt().recip();
        let steps =
            |n: usize, step: f64| -> Vec<f64> { (0..n).map(|i| i as f64 * step * error).collect() };
        for (truth, common) in [
            (steps(1, 0.0), 0.0),
            (steps(2, 0.0), 0.0),
            (steps(4, 0.0), 0.0),
            (steps(30, 0.0), 0.0),
            (steps(10, 6.0), 0.0),
            (steps(10, 0.0), 0.95),
        ] {
            let got = coverage(&truth, &[1.0; 30], common);
            assert!((0.935..=0.995).contains(&got), "{truth:?} {common}: {got}");
        }
        for step in [0.3, 1.0, 2.0] {
            let got = coverage(&steps(10, step), &[1.0; 10], 0.0);
            assert!((0.94..=0.998).contains(&got), "{step}: {got}");
        }
    }

    /// The lowest point is known worse than one above it, which often seems lower: the distances
    /// are in standard errors of the mean of the worse one.
    #[test]
    fn a_minimum_that_is_known_badly_is_covered() {
        let error = (REPLICATES as f64).sqrt().recip();
        for (above, scale) in [(1.0, 0.1), (0.5, 0.1), (1.0, 0.3), (0.3, 0.01), (3.0, 0.1)] {
            let got = coverage(&[0.0, above * error], &[1.0, scale], 0.0);
            assert!((0.935..=0.98).contains(&got), "{above} {scale}: {got}");
        }
    }

    /// A hundred values, all 10: the lowest mean is at 10 less 2.5 standard errors.
    #[test]
    fn one_point_has_the_interval_of_its_mean() {
        let rows: Vec<Vec<f64>> = [3.0, 5.0, 4.0, 8.0].map(|x| vec![x]).to_vec();
        let t = t_quantile_for(4, 0.05);
        let wanted = Interval::of_mean([3.0, 5.0, 4.0, 8.0].into_iter(), t);
        let got = interval_of_minimum(&rows, 0.05);
        assert!((got.value - wanted.value).abs() < 1e-12);
        assert!((got.half_width.unwrap() - wanted.half_width.unwrap()).abs() < 1e-9);
    }

    #[test]
    fn ratios_have_the_right_means_and_no_common_noise() {
        let rows = [[1.0, 3.0], [2.0, 6.0], [4.0, 12.0]].map(|row| row.to_vec());
        for row in ratios(&rows, &[2.0, 4.0, 8.0]) {
            assert!((row[0] - 0.5).abs() < 1e-15 && (row[1] - 1.5).abs() < 1e-15, "{row:?}");
        }
    }

    #[test]
    fn what_is_no_number_is_no_minimum() {
        assert!(interval_of_minimum(&[vec![1.0, f64::NAN], vec![1.0, 2.0]], 0.05).value.is_nan());
        assert!(interval_of_minimum(&[Vec::new(), Vec::new()], 0.05).value.is_nan());
        let alone = Interval { value: 1.0, half_width: None };
        assert_eq!(interval_of_minimum(&[vec![1.0, 2.0]], 0.05), alone);
    }
}
