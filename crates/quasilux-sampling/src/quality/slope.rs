//! The order of convergence: a power of N fitted to errors.

/// error = `factor` * N^`exponent`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerLaw {
    /// The slope in a plot with logarithmic axes.
    pub exponent: f64,
    /// The error at N = 1.
    pub factor: f64,
}

/// The power law through points (N, error) with the least sum of squares of logarithms.
///
/// Points without a logarithm (an error of zero) are left out; `None` where fewer than two
/// different N remain.
#[must_use]
pub fn fit_power_law(points: &[[f64; 2]]) -> Option<PowerLaw> {
    let usable = |point: &&[f64; 2]| point.iter().all(|x| *x > 0.0 && x.is_finite());
    let logarithms: Vec<[f64; 2]> =
        points.iter().filter(usable).map(|point| point.map(libm::log)).collect();
    let n = logarithms.len() as f64;
    let mean = |axis: usize| logarithms.iter().map(|point| point[axis]).sum::<f64>() / n;
    let (mean_x, mean_y) = (mean(0), mean(1));
    let sum = |term: fn(f64, f64) -> f64| -> f64 {
        logarithms.iter().map(|[x, y]| term(x - mean_x, y - mean_y)).sum()
    };
    let (covariance, variance) = (sum(|x, y| x * y), sum(|x, _| x * x));
    (variance > 0.0).then(|| {
        let exponent = covariance / variance;
        let factor = libm::exp(mean_y - exponent * mean_x);
        PowerLaw { exponent, factor }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_is_found_and_zeros_are_left_out() {
        let mut points: Vec<[f64; 2]> =
            (0..10).map(|m| f64::from(1 << m)).map(|n| [n, 3.0 / (n * n.sqrt())]).collect();
        points.push([2048.0, 0.0]);
        let law = fit_power_law(&points).expect("ten points");
        assert!((law.exponent + 1.5).abs() < 1e-14 && (law.factor - 3.0).abs() < 1e-13);
    }

    #[test]
    fn one_point_has_no_slope() {
        assert_eq!(fit_power_law(&[]), None);
        assert_eq!(fit_power_law(&[[4.0, 1.0], [4.0, 2.0], [8.0, 0.0]]), None);
    }
}
