//! The bootstrap t: quantiles of the studentised mean from replicates drawn again (B. Efron and R.
//! Tibshirani, An Introduction to the Bootstrap, 1993, chapter 12).

use super::{Limits, mean, standard_deviation};
use quasilux_sampling::{PointSet, Randomization, Sequence};

/// How often the replicates are drawn again: one less than a multiple of 40, so that quantiles of
/// 2.5 % are among the numbers.
const DRAWS: u32 = 999;

pub(super) fn limits(replicates: &[f64], miss: f64, run: u32) -> Limits {
    let n = replicates.len();
    let root = (n as f64).sqrt();
    let (centre, spread) = (mean(replicates), standard_deviation(replicates) / root);
    let uniforms = PointSet::new(Sequence::Independent, Randomization::None, u64::from(run));
    let again = |draw: u32| -> Option<f64> {
        let place =
            |number: u32| (uniforms.coordinate(number.into(), draw + 1) * n as f64) as usize;
        let drawn: Vec<f64> =
            (0..n as u32).map(|number| replicates[place(number).min(n - 1)]).collect();
        let own = standard_deviation(&drawn) / root;
        (own > 0.0).then(|| (mean(&drawn) - centre) / own)
    };
    let mut all: Vec<f64> = (0..DRAWS).filter_map(again).collect();
    all.sort_by(f64::total_cmp);
    // Where all that is drawn is equal nothing is known.
    let Some(last) = all.len().checked_sub(1) else {
        return Limits { lower: centre - spread, upper: centre + spread };
    };
    let quantile = |p: f64| all[((p * (last + 2) as f64) as usize).clamp(1, last + 1) - 1];
    let [low, high] = [0.5 * miss, 1.0 - 0.5 * miss].map(quantile);
    Limits { lower: centre - high * spread, upper: centre - low * spread }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of 400 even numbers from -1 to 1 the mean is about normal: 1.96 standard errors, to 10 %.
    #[test]
    fn of_many_it_is_normal() {
        let values: Vec<f64> = (0..400).map(|i| (f64::from(i) - 199.5) / 199.5).collect();
        let wanted = 1.96 * standard_deviation(&values) / 20.0;
        let Limits { lower, upper } = limits(&values, 0.05, 1);
        assert!((upper / wanted - 1.0).abs() < 0.1 && (lower / wanted + 1.0).abs() < 0.1);
    }

    /// A long tail above: the interval reaches farther up than down.
    #[test]
    fn it_is_skew_where_values_are() {
        let values: Vec<f64> = (1..=16).map(|i| libm::exp(0.25 * f64::from(i))).collect();
        let Limits { lower, upper } = limits(&values, 0.05, 1);
        assert!(upper - mean(&values) > 1.3 * (mean(&values) - lower));
    }
}
