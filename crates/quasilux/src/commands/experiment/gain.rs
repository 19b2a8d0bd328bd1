//! How many times smaller one root mean square is than another, and how surely.
//!
//! Each comes from the squared errors of independent runs. By the central limit theorem the logarithm of a mean
//! square is normal, its standard error the relative one of the mean.

/// Standard errors that a one-sided test at 1 % needs.
const ONE_PERCENT: f64 = 2.326;
/// Standard errors on either side of a 95 % interval.
const TWO_SIDED: f64 = 1.96;

/// A ratio of root mean squares.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Gain {
    /// The first over the second.
    pub(super) ratio: f64,
    /// Standard error of its logarithm.
    log_error: f64,
}

impl Gain {
    /// From squared errors, one a run.
    pub(super) fn of_squares(worse: &[f64], better: &[f64]) -> Self {
        let [a, b] = [worse, better].map(mean_with_relative_error);
        Self {
            ratio: (a[0] / b[0]).sqrt(),
            // A root has half the relative error.
            log_error: 0.5 * libm::hypot(a[1], b[1]),
        }
    }

    /// The same for a ratio of cost as well, which is known without error: how many times as efficient.
    pub(super) fn efficiency(self, cost_ratio: f64) -> Self {
        Self { ratio: self.ratio * self.ratio * cost_ratio, log_error: 2.0 * self.log_error }
    }

    /// Logarithm over its standard error.
    pub(super) fn standard_errors(self) -> f64 {
        libm::log(self.ratio) / self.log_error
    }

    /// Whether it is above 1, at a significance of 1 %.
    pub(super) fn is_sure(self) -> bool {
        self.standard_errors() > ONE_PERCENT
    }

    /// The ends of the 95 % interval.
    pub(super) fn interval(self) -> [f64; 2] {
        let factor = libm::exp(TWO_SIDED * self.log_error);
        [self.ratio / factor, self.ratio * factor]
    }

    /// `2.5 (2.1 to 3.0)`.
    pub(super) fn text(self) -> String {
        let [low, high] = self.interval();
        format!("{:.2} ({low:.2} to {high:.2})", self.ratio)
    }
}

fn mean_with_relative_error(values: &[f64]) -> [f64; 2] {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|x| (x - mean) * (x - mean)).sum();
    [mean, (squares / (n * (n - 1.0))).sqrt() / mean]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ratio_and_its_error_follow_from_the_squares() {
        // Means 4 and 1, their standard errors 1/2 and 1/8 of them.
        let gain = Gain::of_squares(&[2.0, 6.0], &[0.875, 1.125]);
        assert!((gain.ratio - 2.0).abs() < 1e-12);
        assert!((gain.log_error - 0.5 * libm::hypot(0.5, 0.125)).abs() < 1e-12);
        assert!(gain.is_sure() && !Gain::of_squares(&[0.5, 1.5], &[0.5, 1.5]).is_sure());
        assert!((gain.efficiency(0.5).ratio - 2.0).abs() < 1e-12);
    }
}
