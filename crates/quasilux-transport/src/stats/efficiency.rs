//! Efficiency of estimators, the reciprocal of variance times cost (Hammersley and Handscomb 1964),
//! by which surveys and pilots choose: the cost is the number of rays.

/// Rays and variance of one sample, or of one photon.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Performance {
    pub(crate) rays: f64,
    pub(crate) variance: f64,
}

impl Performance {
    /// Rays to a squared error of one: the reciprocal of the efficiency.
    pub(crate) fn cost_of_error(self) -> f64 {
        self.rays * self.variance
    }
}

/// Sum and sum of squares of the weights w of samples.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct WeightSums {
    sum: f64,
    squares: f64,
}

impl WeightSums {
    pub(crate) fn add(&mut self, weight: f64) {
        self.sum += weight;
        self.squares += weight * weight;
    }

    pub(crate) fn merge(&mut self, other: Self) {
        self.sum += other.sum;
        self.squares += other.squares;
    }

    /// `(sum w^2) / (sum w)^2`, the relative variance of the sum of independent samples, as far as
    /// their number is large (Kish 1965); `None` where no sample has a weight.
    pub(crate) fn relative_variance(self) -> Option<f64> {
        (self.sum > 0.0).then(|| self.squares / (self.sum * self.sum))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Equal weights have the relative variance 1 / n; no weight has none.
    #[test]
    fn equal_weights_count_fully() {
        let mut sums = WeightSums::default();
        assert_eq!(sums.relative_variance(), None);
        (0..8).for_each(|_| sums.add(0.5));
        assert_eq!(sums.relative_variance(), Some(0.125));
        sums.merge(sums);
        assert_eq!(sums.relative_variance(), Some(0.0625));
    }
}
