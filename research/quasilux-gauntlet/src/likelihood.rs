//! How often chance alone does what is counted.

use quasilux_transport::interval::t_quantile_for;

/// Replicates behind intervals.
const REPLICATES: usize = 16;
/// Half-widths of 95 % over standard errors, as they are counted.
pub const HALF_WIDTH_PER_ERROR: f64 = 1.96;
/// An interval that is farther from the truth, in standard errors, is false.
pub const FALSE_FROM: f64 = 5.0;
/// Of the unseen light that may be above a value, this many times what is said of it with 95 %.
pub const UNSEEN_FROM: f64 = 3.2;
/// Light above `UNSEEN_FROM` times what is unseen is promised in no more than this share.
pub const UNSEEN_MISSED: f64 = 1e-4;
/// What is rarer by chance is told.
pub const RARE: f64 = 1e-3;

/// The probability that an interval is false by chance: that a value of 15 degrees of freedom is
/// off by `FALSE_FROM` times its half-width over 1.96.
#[must_use]
pub fn false_interval() -> f64 {
    let half_width = t_quantile_for(REPLICATES, 0.05).unwrap_or(f64::NAN);
    tail(FALSE_FROM * half_width / HALF_WIDTH_PER_ERROR)
}

/// The probability that both numbers together are false: below as an interval, above as promised.
#[must_use]
pub fn false_with_bound() -> f64 {
    0.5 * false_interval() + UNSEEN_MISSED
}

/// P(|T| > t) of Student's t with 15 degrees of freedom: the inverse of its quantile, which falls.
fn tail(t: f64) -> f64 {
    // In logarithms: what is looked for is small.
    let (mut low, mut high) = (libm::log(1e-14), 0.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let quantile = t_quantile_for(REPLICATES, libm::exp(middle).min(1.0 - 1e-15));
        if quantile.is_some_and(|quantile| quantile > t) { low = middle } else { high = middle }
    }
    libm::exp(0.5 * (low + high))
}

/// The probability that `trials` of probability `p` give `count` or more.
#[must_use]
pub fn at_least(count: u32, trials: u32, p: f64) -> f64 {
    if count == 0 || p >= 1.0 {
        return 1.0;
    }
    if p <= 0.0 || count > trials {
        return 0.0;
    }
    let n = f64::from(trials);
    let log_choose =
        |k: f64| libm::lgamma(n + 1.0) - libm::lgamma(k + 1.0) - libm::lgamma(n - k + 1.0);
    let term = |k: u32| {
        let k = f64::from(k);
        libm::exp(log_choose(k) + k * libm::log(p) + (n - k) * libm::log1p(-p))
    };
    (count..=trials).map(term).sum::<f64>().min(1.0)
}

/// The standard deviation of a share of this many trials of probability `p`.
#[must_use]
pub fn deviation(p: f64, trials: u32) -> f64 {
    (p * (1.0 - p) / f64::from(trials.max(1))).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tails_are_those_of_the_printed_table() {
        // Abramowitz and Stegun (1964), table 26.10: 15 degrees of freedom.
        for (t, p) in [(2.131, 0.05), (2.947, 0.01), (4.073, 0.001)] {
            assert!((tail(t) / p - 1.0).abs() < 3e-3, "{t}: {}", tail(t));
        }
        let p = false_interval();
        assert!((6e-5..8e-5).contains(&p), "{p}");
    }

    #[test]
    fn binomial_tails_are_sums() {
        // 1 - 0.9^10 and 0.5^3.
        assert!((at_least(1, 10, 0.1) - 0.651_321_559_9).abs() < 1e-9);
        assert!((at_least(3, 3, 0.5) - 0.125).abs() < 1e-12);
        assert_eq!(at_least(0, 5, 0.1), 1.0);
        assert_eq!(at_least(6, 5, 0.1), 0.0);
    }
}
