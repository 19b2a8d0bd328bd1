//! Places between knots.

use std::f64::consts::TAU;

/// The two knots around a place of an axis and their weights; beyond its ends the last knot.
pub(in crate::bsdf) fn bracket(knots: &[f64], x: f64) -> [(usize, f64); 2] {
    let above = knots.partition_point(|&knot| knot <= x);
    if above == 0 || above == knots.len() {
        let end = above.saturating_sub(1);
        return [(end, 1.0), (end, 0.0)];
    }
    let t = (x - knots[above - 1]) / (knots[above] - knots[above - 1]);
    [(above - 1, 1.0 - t), (above, t)]
}

/// The same around a turn.
pub(in crate::bsdf) fn around(knots: &[f64], phi_rad: f64) -> [(usize, f64); 2] {
    let first = knots[0];
    let offset = (phi_rad - first).rem_euclid(TAU);
    let last = knots.len() - 1;
    if offset < knots[last] - first {
        return bracket(knots, first + offset);
    }
    let t = (offset - (knots[last] - first)) / (TAU - (knots[last] - first));
    [(last, 1.0 - t), (0, t)]
}
