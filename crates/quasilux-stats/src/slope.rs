//! The order of convergence.

/// The slope of the straight line through `points` (x, y) with the least sum of squares; for an
/// order of convergence, give logarithms of the number of samples and of the error.
///
/// # Panics
/// With fewer than two points.
pub fn least_squares_slope(points: &[[f64; 2]]) -> f64 {
    assert!(points.len() > 1, "a slope needs two points");
    let n = points.len() as f64;
    let mean = |axis: usize| points.iter().map(|point| point[axis]).sum::<f64>() / n;
    let (mean_x, mean_y) = (mean(0), mean(1));
    let covariance: f64 = points.iter().map(|[x, y]| (x - mean_x) * (y - mean_y)).sum();
    let variance: f64 = points.iter().map(|[x, _]| (x - mean_x) * (x - mean_x)).sum();
    covariance / variance
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_has_its_slope() {
        let points: Vec<[f64; 2]> = (0..10).map(f64::from).map(|x| [x, 2.0 - 0.5 * x]).collect();
        assert!((least_squares_slope(&points) + 0.5).abs() < 1e-15);
        assert!((least_squares_slope(&[[0.0, 0.0], [1.0, 1.0], [2.0, 1.0]]) - 0.5).abs() < 1e-15);
    }
}
