//! Intervals of means from replicates, by Student's t.
//!
//! The error of a quasi-Monte Carlo mean comes from independent randomisations of the whole point
//! set, never from the spread of its points (L'Ecuyer, Nakayama, Owen and Tuffin 2023). Read on at
//! `stats::minimum` for figures that are not means, and at `stats::sequential` for what it costs to
//! look at them while a run goes.

/// A value and how sure it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The estimate.
    pub value: f64,
    /// Half the width of its confidence interval; `None` where there are fewer than two replicates.
    pub half_width: Option<f64>,
}

impl Interval {
    /// The interval of a mean: `t` is the two-sided quantile ([`t_quantile_for`]), `None` for fewer
    /// than two values.
    #[must_use]
    pub fn of_mean(values: impl ExactSizeIterator<Item = f64> + Clone, t: Option<f64>) -> Self {
        let n = values.len() as f64;
        let value = values.clone().sum::<f64>() / n;
        let half_width = t.map(|t| {
            let squares: f64 = values.map(|x| (x - value) * (x - value)).sum();
            t * (squares / ((n - 1.0) * n)).sqrt()
        });
        Self { value, half_width }
    }

    /// The interval of light, which is never negative: where all replicates found nothing, their
    /// spread says nothing, and a bound on light that no sample met stands for the half-width.
    #[must_use]
    pub fn or_unseen(self, unseen_lx: f64) -> Self {
        let is_dark = self.value == 0.0;
        let half_width = self.half_width.map(|spread| if is_dark { unseen_lx } else { spread });
        Self { half_width, ..self }
    }

    /// Half-width over value; `None` without a half-width, 0 where the half-width is 0.
    #[must_use]
    pub fn relative_half_width(&self) -> Option<f64> {
        self.half_width.map(|h| if h == 0.0 { 0.0 } else { h / self.value.abs() })
    }
}

/// The two-sided quantile of Student's t for `replicates` values; `None` for fewer than two.
///
/// `miss_probability` is the probability that the interval misses, in (0, 1).
#[must_use]
pub fn t_quantile_for(replicates: usize, miss_probability: f64) -> Option<f64> {
    (replicates >= 2).then(|| student_t_quantile((replicates - 1) as f64, miss_probability))
}

/// The value that |T| exceeds with probability `miss_probability`, T having Student's t
/// distribution with `degrees` degrees of freedom (at least 1).
fn student_t_quantile(degrees: f64, miss_probability: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    while two_sided_tail(high, degrees) > miss_probability && high < 1e12 {
        high *= 2.0;
    }
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if two_sided_tail(middle, degrees) > miss_probability {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// P(|T| > t): the regularised incomplete beta function I_x(degrees / 2, 1 / 2) at
/// x = degrees / (degrees + t^2) (Abramowitz and Stegun 1964, 26.7.1).
fn two_sided_tail(t: f64, degrees: f64) -> f64 {
    incomplete_beta(0.5 * degrees, 0.5, degrees / (degrees + t * t))
}

/// The regularised incomplete beta function, by its continued fraction (Abramowitz and Stegun
/// 1964, 26.5.8) evaluated with Lentz's method, to about 1e-14.
fn incomplete_beta(a: f64, b: f64, x: f64) -> f64 {
    if x <= 0.0 || x >= 1.0 {
        return x.clamp(0.0, 1.0);
    }
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - incomplete_beta(b, a, 1.0 - x);
    }
    let log_front = libm::lgamma(a + b) - libm::lgamma(a) - libm::lgamma(b)
        + a * libm::log(x)
        + b * libm::log1p(-x);
    let away_from_zero = |v: f64| if v.abs() < 1e-300 { 1e-300 } else { v };
    let (mut c, mut d, mut fraction) = (1.0, 0.0, 1.0);
    for i in 0..1000 {
        let m = f64::from(i / 2);
        let term = match i {
            0 => 1.0,
            i if i % 2 == 0 => m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m)),
            _ => -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0)),
        };
        d = 1.0 / away_from_zero(1.0 + term * d);
        c = away_from_zero(1.0 + term / c);
        if i == 0 {
            // The fraction starts with 1 / (1 + ...): nothing stands before it.
            (c, fraction) = (f64::INFINITY, d);
            continue;
        }
        fraction *= c * d;
        if (c * d - 1.0).abs() < 1e-15 {
            break;
        }
    }
    libm::exp(log_front) * fraction / a
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One value above zero is light that was found.
    #[test]
    fn of_zeros_alone_the_bound_is_the_half_width() {
        let t = t_quantile_for(4, 0.05);
        let of = |values: [f64; 4], t| Interval::of_mean(values.into_iter(), t);
        let dark = of([0.0; 4], t).or_unseen(0.3);
        assert_eq!(dark, Interval { value: 0.0, half_width: Some(0.3) });
        assert_eq!(of([0.0; 4], None).or_unseen(0.3).half_width, None);
        let found = of([0.0, 0.0, 1e-9, 0.0], t);
        assert_eq!(found.or_unseen(0.3), found);
    }

    /// Two-sided quantiles as printed in Abramowitz and Stegun (1964), table 26.10.
    #[test]
    fn quantiles_of_the_printed_table() {
        for (degrees, miss, wanted) in [
            (1.0, 0.05, 12.706),
            (1.0, 0.5, 1.000),
            (4.0, 0.01, 4.604),
            (15.0, 0.05, 2.131),
            (15.0, 0.01, 2.947),
            (30.0, 0.001, 3.646),
            (120.0, 0.1, 1.658),
        ] {
            let got = student_t_quantile(degrees, miss);
            assert!((got - wanted).abs() < 6e-4, "{degrees} degrees, {miss}: {got}");
        }
    }
}
