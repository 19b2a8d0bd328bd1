//! Linear interpolation between the nodes of an axis of incident or exit angles.

use std::f64::consts::{FRAC_PI_2, TAU};

/// A node of an axis with its weight in a linear interpolation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WeightedNode {
    pub(crate) index: usize,
    pub(crate) weight: f64,
}

/// Two neighbours, the second one with weight `t`.
pub(crate) fn pair(first: usize, second: usize, t: f64) -> [WeightedNode; 2] {
    [WeightedNode { index: first, weight: 1.0 - t }, WeightedNode { index: second, weight: t }]
}

/// The two nodes around a place of an axis and their weights; beyond its ends the last node.
pub(crate) fn bracket(nodes: &[f64], x: f64) -> [WeightedNode; 2] {
    let above = nodes.partition_point(|&node| node <= x);
    if above == 0 || above == nodes.len() {
        let end = above.saturating_sub(1);
        return pair(end, end, 0.0);
    }
    let t = (x - nodes[above - 1]) / (nodes[above] - nodes[above - 1]);
    pair(above - 1, above, t)
}

/// The same around a turn.
pub(crate) fn around(nodes: &[f64], phi_rad: f64) -> [WeightedNode; 2] {
    let first = nodes[0];
    let offset = (phi_rad - first).rem_euclid(TAU);
    let last = nodes.len() - 1;
    if offset < nodes[last] - first {
        return bracket(nodes, first + offset);
    }
    let t = (offset - (nodes[last] - first)) / (TAU - (nodes[last] - first));
    pair(last, 0, t)
}

/// What each node stands for of the mean over projected solid angle, 2 sin cos, of a function that
/// is linear between polar angles and constant beyond the ends.
pub(super) fn parts_of_polar_angles(nodes: &[f64]) -> Vec<f64> {
    let sin2 = |theta_rad: f64| {
        let sin = libm::sin(theta_rad);
        sin * sin
    };
    // The mean of sin^2 between two nodes: by parts, the upper one stands for its own sin^2 less
    // that.
    let mean = |low: f64, high: f64| {
        let sines = libm::sin(high - low) * libm::cos(high + low);
        0.5 * (1.0 - sines / (high - low))
    };
    let mut parts = vec![0.0; nodes.len()];
    for (index, pair) in nodes.windows(2).enumerate() {
        let mean = mean(pair[0], pair[1]);
        parts[index] += mean - sin2(pair[0]);
        parts[index + 1] += sin2(pair[1]) - mean;
    }
    parts[0] += sin2(nodes[0]);
    let last = nodes.len() - 1;
    parts[last] += sin2(FRAC_PI_2) - sin2(nodes[last]);
    parts
}

/// The same around a turn.
pub(super) fn parts_of_azimuths(nodes: &[f64]) -> Vec<f64> {
    let next = |i: usize| if i + 1 < nodes.len() { nodes[i + 1] } else { nodes[0] + TAU };
    let gap = |i: usize| next(i) - nodes[i];
    let part = |i: usize| {
        let before = if i > 0 { i - 1 } else { nodes.len() - 1 };
        0.5 * (gap(i) + gap(before)) / TAU
    };
    (0..nodes.len()).map(part).collect()
}
