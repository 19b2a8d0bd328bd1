//! Student's t over replicates.

use super::Limits;
use quasilux_transport::interval::{Interval, t_quantile_for};

pub(in super::super) fn limits(replicates: &[f64], miss: f64) -> Limits {
    let t = t_quantile_for(replicates.len(), miss);
    let Interval { value, half_width } = Interval::of_mean(replicates.iter().copied(), t);
    let half_width = half_width.unwrap_or(f64::INFINITY);
    Limits { lower: value - half_width, upper: value + half_width }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mean 3, standard deviation sqrt(2.5), t = 2.776 for 4 degrees of freedom.
    #[test]
    fn five_numbers() {
        let Limits { lower, upper } = limits(&[1.0, 2.0, 3.0, 4.0, 5.0], 0.05);
        let half_width = 2.776 * (2.5_f64 / 5.0).sqrt();
        assert!((lower - 3.0 + half_width).abs() < 1e-3 && (upper - 3.0 - half_width).abs() < 1e-3);
    }
}
