//! Normal and Student distributions, and the correction for a family of tests.

use crate::special::incomplete_beta;

/// The standard normal distribution function.
pub fn normal_cdf(z: f64) -> f64 {
    0.5 * libm::erfc(-z * std::f64::consts::FRAC_1_SQRT_2)
}

/// The `z` below which lies the probability `p`, 0 < p < 1.
///
/// # Panics
/// Where the probability is 0, 1 or not between them.
pub fn normal_quantile(p: f64) -> f64 {
    assert!(p > 0.0 && p < 1.0, "normal_quantile({p})");
    bisect(-40.0, 40.0, |z| normal_cdf(z) < p)
}

/// Student's distribution function with `degrees_of_freedom` > 0.
pub fn student_t_cdf(t: f64, degrees_of_freedom: f64) -> f64 {
    let x = degrees_of_freedom / (degrees_of_freedom + t * t);
    let tail = 0.5 * incomplete_beta(0.5 * degrees_of_freedom, 0.5, x);
    if t > 0.0 { 1.0 - tail } else { tail }
}

/// The two-sided quantile: |t| exceeds it with probability `1 - confidence`.
///
/// # Panics
/// Where the confidence is 0, 1 or not between them.
pub fn student_t_quantile(confidence: f64, degrees_of_freedom: f64) -> f64 {
    assert!(confidence > 0.0 && confidence < 1.0, "student_t_quantile({confidence})");
    let tail = 0.5 * (1.0 - confidence);
    // The lower tail keeps its digits, where the upper one would be a difference from 1.
    -bisect(-1e12, 0.0, |t| student_t_cdf(t, degrees_of_freedom) < tail)
}

/// The probability that samples as far from `expected` arise by chance if that is their mean
/// (two-sided, one less degree of freedom than samples).
///
/// # Panics
/// With fewer than two samples.
pub fn student_t_test(samples: &[f64], expected: f64) -> f64 {
    let n = samples.len() as f64;
    assert!(samples.len() > 1, "a t-test needs two samples");
    let mean = samples.iter().sum::<f64>() / n;
    let variance = samples.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0);
    if variance == 0.0 {
        return if mean == expected { 1.0 } else { 0.0 };
    }
    let t = (mean - expected) / (variance / n).sqrt();
    2.0 * student_t_cdf(-t.abs(), n - 1.0)
}

/// The significance of each of `family` independent tests that together have `significance` (Sidak
/// 1967).
pub fn sidak(significance: f64, family: usize) -> f64 {
    -libm::expm1(libm::log1p(-significance) / family as f64)
}

/// The border between arguments that are `below` and those that are not.
fn bisect(mut low: f64, mut high: f64, below: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if below(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_quantiles_are_those_of_the_tables() {
        for (p, z) in
            [(0.5, 0.0), (0.975, 1.959_963_984_540_054), (0.001, -3.090_232_306_167_813_5)]
        {
            assert!((normal_quantile(p) - z).abs() < 1e-12, "{p}");
        }
    }

    #[test]
    fn student_quantiles_are_those_of_the_tables() {
        // Abramowitz and Stegun (1964), table 26.10.
        let table = [
            (0.95, 1.0, 12.706),
            (0.95, 4.0, 2.776),
            (0.95, 15.0, 2.131),
            (0.99, 7.0, 3.499),
            (0.90, 30.0, 1.697),
            (0.95, 120.0, 1.980),
        ];
        for (confidence, degrees_of_freedom, t) in table {
            let quantile = student_t_quantile(confidence, degrees_of_freedom);
            assert!((quantile - t).abs() < 5.1e-4, "{confidence} {degrees_of_freedom} {quantile}");
        }
    }

    #[test]
    fn one_degree_of_freedom_is_cauchy() {
        for t in [-30.0, -1.0, 0.0, 0.3, 5.0] {
            let cauchy = 0.5 + libm::atan(t) / std::f64::consts::PI;
            assert!((student_t_cdf(t, 1.0) - cauchy).abs() < 1e-13, "{t}");
        }
    }

    #[test]
    fn t_test_sees_a_shifted_mean() {
        let samples = [1.01, 0.99, 1.02, 0.98];
        assert!(student_t_test(&samples, 1.0) > 0.99);
        assert!(student_t_test(&samples, 1.2) < 1e-3);
    }

    #[test]
    fn sidak_splits_a_significance() {
        let each = sidak(0.05, 10);
        assert!((each - 0.005_116_196_891_823_7).abs() < 1e-15);
        assert_eq!(sidak(0.05, 1), 0.05);
    }
}
