//! A mean and its error.

/// What is known of one sensor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// The mean in lx.
    pub lx: f64,
    /// Its standard error in lx.
    pub standard_error_lx: f64,
    /// The largest contribution of a single path or walk over the sum of all: near 1 where chance
    /// rules.
    pub largest_share: f64,
    /// Paths or walks behind it.
    pub paths: u64,
}

/// The largest difference of two independent runs in standard errors of the difference, of all
/// sensors; infinite where values differ that are both said to be exact.
#[must_use]
pub fn largest_disagreement(one: &[Estimate], other: &[Estimate]) -> f64 {
    let disagreement = |(a, b): (&Estimate, &Estimate)| {
        let difference = (a.lx - b.lx).abs();
        let error = libm::hypot(a.standard_error_lx, b.standard_error_lx);
        if difference <= 1e-9 * a.lx.abs() { 0.0 } else { difference / error }
    };
    one.iter().zip(other).map(disagreement).fold(0.0, f64::max)
}

impl Estimate {
    /// The sum of two independent ones.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        let lx = self.lx + other.lx;
        let largest = |it: &Self| {
            if lx > 0.0 { it.largest_share * it.lx / lx } else { 0.0 }
        };
        Self {
            lx,
            standard_error_lx: libm::hypot(self.standard_error_lx, other.standard_error_lx),
            largest_share: largest(self).max(largest(other)),
            paths: self.paths + other.paths,
        }
    }

    /// The mean of two independent runs of the same scene by their paths; runs of one length have
    /// one half each, so that nothing is weighed by what was found.
    #[must_use]
    pub fn joined(&self, other: &Self) -> Self {
        let share = self.paths as f64 / (self.paths + other.paths).max(1) as f64;
        let scaled = |it: &Self, share: f64| Self {
            lx: share * it.lx,
            standard_error_lx: share * it.standard_error_lx,
            ..*it
        };
        scaled(self, share).plus(&scaled(other, 1.0 - share))
    }
}
