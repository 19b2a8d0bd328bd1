//! Directions over a hemisphere: samples, sets of incident directions, lattices of projected solid
//! angle.

use glam::DVec3;
use quasilux_sampling::warp::sample_disk;

/// Samples nearer to the edge of a cell, in parts of it, are moved inside: rounding must not carry
/// a direction into the next cell.
pub(super) const INSIDE: f64 = 1e-9;

/// A scattered direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScatterSample {
    /// Away from the surface, `z` positive on its own side.
    pub wo: DVec3,
    /// Density with respect to solid angle, in sr^-1. Positive.
    pub pdf_sr: f64,
}

/// An incident direction that stands for a part of diffuse light.
#[derive(Clone, Copy, Debug)]
pub(super) struct Incident {
    pub(super) wi: DVec3,
    /// Parts add up to 1.
    pub(super) part: f64,
}

/// The unit direction with that projection.
pub(super) fn upwards([x, y]: [f64; 2]) -> DVec3 {
    DVec3::new(x, y, (1.0 - x * x - y * y).max(0.0).sqrt())
}

/// A step of cumulative sums that a coordinate fell into.
#[derive(Clone, Copy, Debug)]
pub(super) struct PickedStep {
    pub(super) index: usize,
    /// The coordinate within the step, stretched to [0, 1].
    pub(super) u_remapped: f64,
}

/// The step that `u` falls into, of the non-decreasing sums `before(0)` to `before(count)`. Never a
/// step of height zero.
pub(super) fn pick(count: usize, u: f64, before: impl Fn(usize) -> f64) -> PickedStep {
    let (start, end) = (before(0), before(count));
    let target = start + u * (end - start);
    let (mut low, mut high) = (0, count);
    while low < high {
        let middle = low.midpoint(high);
        if before(middle + 1) > target {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    // Rounding, or u = 1: the last step that rises.
    while low == count || before(low + 1) <= before(low) {
        low -= 1;
    }
    let u_remapped = (target - before(low)) / (before(low + 1) - before(low));
    PickedStep { index: low, u_remapped: u_remapped.clamp(0.0, 1.0) }
}

/// Point `index` of `count` in the unit square: a lattice of rank 1, its generator the golden
/// section (Roberts 2018), moved by `shift`.
pub(super) fn lattice(index: usize, count: usize, shift: f64) -> [f64; 2] {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let turns = index as f64 * GOLDEN + shift;
    [(index as f64 + 0.5) / count as f64, turns - turns.floor()]
}

/// Well-spread directions that stand for equal projected solid angles.
pub(super) fn spread(count: usize) -> impl Iterator<Item = DVec3> {
    (0..count).map(move |index| upwards(sample_disk(lattice(index, count, 0.0))))
}
