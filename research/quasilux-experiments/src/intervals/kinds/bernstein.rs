//! The empirical Bernstein bound (A. Maurer and M. Pontil, "Empirical Bernstein bounds and sample
//! variance penalization", 22nd Conference on Learning Theory, 2009, theorem 4), on both sides.

use super::{Limits, mean, standard_deviation};

/// Of n independent values in `[0, range]`: larger ones count as `range`.
pub(in super::super) fn limits(values: &[f64], range: f64, miss: f64) -> Limits {
    let values: Vec<f64> = values.iter().map(|value| value.min(range)).collect();
    let n = values.len() as f64;
    let log = libm::log(4.0 / miss);
    let deviation = standard_deviation(&values) * (2.0 * log / n).sqrt();
    let half_width = deviation + 7.0 * range * log / (3.0 * (n - 1.0));
    let mean = mean(&values);
    Limits { lower: (mean - half_width).max(0.0), upper: (mean + half_width).min(range) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half of 100 values are 0, half 1: `sqrt(2 (25 / 99) ln 80 / 100) + 7 ln 80 / 297`.
    #[test]
    fn of_coins() {
        let values: Vec<f64> = (0..100).map(|i| f64::from(i % 2)).collect();
        let Limits { lower, upper } = limits(&values, 1.0, 0.05);
        assert!((upper - 0.5 - 0.252_05).abs() < 1e-4, "{upper}");
        assert!((lower + upper - 1.0).abs() < 1e-12);
    }
}
