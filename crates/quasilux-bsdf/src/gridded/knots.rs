//! Places between knots.

use std::f64::consts::{FRAC_PI_2, TAU};

/// The two knots around a place of an axis and their weights; beyond its ends the last knot.
pub(crate) fn bracket(knots: &[f64], x: f64) -> [(usize, f64); 2] {
    let above = knots.partition_point(|&knot| knot <= x);
    if above == 0 || above == knots.len() {
        let end = above.saturating_sub(1);
        return [(end, 1.0), (end, 0.0)];
    }
    let t = (x - knots[above - 1]) / (knots[above] - knots[above - 1]);
    [(above - 1, 1.0 - t), (above, t)]
}

/// The same around a turn.
pub(crate) fn around(knots: &[f64], phi_rad: f64) -> [(usize, f64); 2] {
    let first = knots[0];
    let offset = (phi_rad - first).rem_euclid(TAU);
    let last = knots.len() - 1;
    if offset < knots[last] - first {
        return bracket(knots, first + offset);
    }
    let t = (offset - (knots[last] - first)) / (TAU - (knots[last] - first));
    [(last, 1.0 - t), (0, t)]
}

/// What each knot stands for of the mean over projected solid angle, 2 sin cos, of a function that
/// is linear between polar angles and constant beyond the ends.
pub(super) fn parts_of_polar_angles(knots: &[f64]) -> Vec<f64> {
    let sin2 = |theta_rad: f64| {
        let sin = libm::sin(theta_rad);
        sin * sin
    };
    // The mean of sin^2 between two knots: by parts, the upper one stands for its own sin^2 less
    // that.
    let mean = |low: f64, high: f64| {
        let sines = libm::sin(high - low) * libm::cos(high + low);
        0.5 * (1.0 - sines / (high - low))
    };
    let mut parts = vec![0.0; knots.len()];
    for (index, pair) in knots.windows(2).enumerate() {
        let mean = mean(pair[0], pair[1]);
        parts[index] += mean - sin2(pair[0]);
        parts[index + 1] += sin2(pair[1]) - mean;
    }
    parts[0] += sin2(knots[0]);
    let last = knots.len() - 1;
    parts[last] += sin2(FRAC_PI_2) - sin2(knots[last]);
    parts
}

/// The same around a turn.
pub(super) fn parts_of_azimuths(knots: &[f64]) -> Vec<f64> {
    let next = |i: usize| if i + 1 < knots.len() { knots[i + 1] } else { knots[0] + TAU };
    let gap = |i: usize| next(i) - knots[i];
    let part = |i: usize| {
        let before = if i > 0 { i - 1 } else { knots.len() - 1 };
        0.5 * (gap(i) + gap(before)) / TAU
    };
    (0..knots.len()).map(part).collect()
}
