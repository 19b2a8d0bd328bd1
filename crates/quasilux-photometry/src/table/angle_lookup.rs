//! An axis of angles that is read by directions in its plane, without their arc tangents.
//!
//! The angle itself is not needed: which cell holds a direction is a question of signs, and the
//! place in the cell needs the small angle from a mark to the direction, whose sine is a cross
//! product. The search starts from a guide table (H.-C. Chen and Y. Asau, 1974) over the
//! *pseudo-angle*, which grows with the angle from 0 to 4 over a turn: `1 - q` in the upper half
//! plane and `3 + q` in the lower one, `q = x / (|x| + |y|)`.
//!
//! The angle that a place stands for is within 3e-16 rad of the true one; with arc tangents it is
//! within 3e-16 up to half a turn and 1e-15 up to a whole one, whose last digits are worth more.

use super::axis::{Axis, CellPosition};

/// Marks are at most this far apart, for [`small_arc_sine`].
const WIDEST_RAD: f64 = 1.0 / 16.0;
/// Buckets of the guide table for each mark: most hold none, so that the search ends where it
/// starts.
const BUCKETS_PER_MARK: usize = 8;
/// Directions that are off the axis by rounding only are on it.
const SLACK: f64 = 8.0 * f64::EPSILON;

/// The nodes of an axis, and marks between those that are far apart.
#[derive(Clone, Debug)]
pub(super) struct AngleLookup {
    marks: Vec<Mark>,
    /// For each bucket of pseudo-angles, the last mark that comes before it.
    guide: Vec<u32>,
    /// Pseudo-angles of both ends.
    ends: [f64; 2],
    buckets_per_unit: f64,
}

/// A direction of the plane from which small angles are measured.
#[derive(Clone, Copy, Debug)]
struct Mark {
    cos: f64,
    sin: f64,
    /// From the cell's first node to the mark.
    offset_rad: f64,
    cells_per_rad: f64,
    cell: u32,
}

impl AngleLookup {
    /// The lookup of an axis within [0, one turn].
    pub(super) fn new(axis: &Axis) -> Self {
        let mut marks = Vec::with_capacity(axis.nodes().len());
        for (cell, ends) in axis.nodes().windows(2).enumerate() {
            let width_rad = ends[1] - ends[0];
            // Of the narrowest cells the reciprocal overflows.
            let cells_per_rad = width_rad.recip().min(f64::MAX);
            let parts = (width_rad / WIDEST_RAD).ceil().max(1.0);
            for part in 0..parts as u32 {
                let offset_rad = width_rad * (f64::from(part) / parts);
                let (sin, cos) = libm::sincos(ends[0] + offset_rad);
                marks.push(Mark { cos, sin, offset_rad, cells_per_rad, cell: cell as u32 });
            }
        }
        let ends = [axis.first(), axis.last()].map(pseudo_angle_of);
        let buckets = BUCKETS_PER_MARK * marks.len();
        let buckets_per_unit = buckets as f64 / (ends[1] - ends[0]).max(SLACK);
        let guide = Vec::with_capacity(buckets);
        let mut lookup = Self { marks, guide, ends, buckets_per_unit };
        let mut mark = 0;
        for bucket in 0..buckets {
            let is_before = |mark: &Mark| lookup.bucket(pseudo_angle(mark.cos, mark.sin)) < bucket;
            while lookup.marks.get(mark + 1).is_some_and(is_before) {
                mark += 1;
            }
            lookup.guide.push(mark as u32);
        }
        lookup
    }

    /// The place of the direction whose cosine and sine are `x / length` and `y / length`; `None`
    /// off the axis.
    #[inline]
    pub(super) fn place(&self, x: f64, y: f64, length: f64) -> Option<CellPosition> {
        let axis = self.ends[0] - SLACK..=self.ends[1] + SLACK;
        let mut pseudo_angle = pseudo_angle(x, y);
        if !axis.contains(&pseudo_angle) {
            // Just below the angle 0 is just below a whole turn.
            pseudo_angle -= 4.0;
            if !axis.contains(&pseudo_angle) {
                return None;
            }
        }
        let bucket = self.bucket(pseudo_angle).min(self.guide.len() - 1);
        let mut number = self.guide[bucket] as usize;
        while self.marks.get(number + 1).is_some_and(|next| next.cross(x, y) >= 0.0) {
            number += 1;
        }
        let mark = &self.marks[number];
        let angle_rad = mark.offset_rad + small_arc_sine(mark.cross(x, y) / length);
        let fraction = (angle_rad * mark.cells_per_rad).clamp(0.0, 1.0);
        Some(CellPosition { cell: mark.cell as usize, fraction })
    }

    #[inline]
    fn bucket(&self, pseudo_angle: f64) -> usize {
        ((pseudo_angle - self.ends[0]) * self.buckets_per_unit) as usize
    }
}

impl Mark {
    /// The length of (x, y) times the sine of the angle from the mark to it.
    #[inline]
    fn cross(&self, x: f64, y: f64) -> f64 {
        self.cos * y - self.sin * x
    }
}

/// The pseudo-angle of an angle in [0, one turn].
fn pseudo_angle_of(angle_rad: f64) -> f64 {
    let (sin, cos) = libm::sincos(angle_rad);
    // A whole turn is not the angle 0, whatever the rounding.
    if angle_rad > 1.0 && sin.abs() < SLACK && cos > 0.0 { 4.0 } else { pseudo_angle(cos, sin) }
}

/// NaN where both are 0.
#[inline]
fn pseudo_angle(x: f64, y: f64) -> f64 {
    // A negative zero is in the upper half plane.
    let half = 1.0_f64.copysign(y + 0.0);
    2.0 - half * (1.0 + x / (x.abs() + y.abs()))
}

/// The arc sine by its series, for arguments up to sin [`WIDEST_RAD`]: the terms left out are below
/// 1e-16 of the sum.
#[inline]
fn small_arc_sine(x: f64) -> f64 {
    let s = x * x;
    let tail = 5.0 / 112.0 + s * (35.0 / 1152.0 + s * (63.0 / 2816.0));
    x + x * s * (1.0 / 6.0 + s * (3.0 / 40.0 + s * tail))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    fn even(first: f64, last: f64, cells: u32) -> Vec<f64> {
        let part = |i: u32| first + (last - first) * (f64::from(i) / f64::from(cells));
        (0..=cells).map(part).collect()
    }

    /// Against the arc tangent; places are compared as angles, so that a node may belong to either
    /// of its cells. Both roundings of an angle up to one turn together are below 2e-15.
    #[test]
    fn places_are_those_of_the_arc_tangent() {
        let axes = [
            even(0.0, PI, 180),
            even(0.0, TAU, 24),
            even(0.0, TAU, 1),
            even(0.0, TAU, 4),
            even(0.3, 1.2, 7),
            even(0.0, 1.5 * PI, 3),
            vec![0.0, 1e-300, 1e-12, 0.5, 0.5000000001, 3.0],
        ];
        for nodes in axes {
            let axis = Axis::new(nodes);
            let lookup = AngleLookup::new(&axis);
            let angle = |place: CellPosition| {
                let ends = [0, 1].map(|end| axis.nodes()[place.cell + end]);
                ends[0] + (ends[1] - ends[0]) * place.fraction
            };
            let near_nodes = axis.nodes().iter().flat_map(|&k| [k.next_down(), k, k.next_up()]);
            for probe in even(0.0, TAU, 7919).into_iter().chain(near_nodes) {
                let (y, x) = libm::sincos(probe);
                let seen = libm::atan2(y, x);
                let seen = if seen < 0.0 { seen + TAU } else { seen };
                let apart = |end: f64| (seen - end).abs().min(TAU - (seen - end).abs());
                match lookup.place(x, y, 1.0) {
                    Some(place) => {
                        let off = (angle(place) - seen).abs();
                        assert!(off < 2e-15 || (TAU - off) < 2e-15, "{probe}: off by {off}");
                    }
                    None => assert!(
                        (seen < axis.first() || seen > axis.last())
                            && apart(axis.first()) > 1e-15
                            && apart(axis.last()) > 1e-15,
                        "{probe}"
                    ),
                }
            }
        }
    }

    #[test]
    fn ends_are_on_the_axis() {
        let lookup = AngleLookup::new(&Axis::new(vec![0.0, PI / 2.0]));
        assert_eq!(lookup.place(1.0, 0.0, 1.0), Some(CellPosition { cell: 0, fraction: 0.0 }));
        assert_eq!(lookup.place(0.0, 1.0, 1.0), Some(CellPosition { cell: 0, fraction: 1.0 }));
        let by_rounding = Some(CellPosition { cell: 0, fraction: 0.0 });
        assert_eq!(lookup.place(1.0, -1e-16, 1.0), by_rounding);
        assert_eq!(lookup.place(1.0, -1e-12, 1.0), None);
        assert_eq!(lookup.place(-1e-16, 1.0, 1.0), Some(CellPosition { cell: 0, fraction: 1.0 }));
        assert_eq!(lookup.place(-1e-12, 1.0, 1.0), None);
        assert_eq!(lookup.place(f64::NAN, 1.0, 1.0), None);
        assert_eq!(lookup.place(0.0, 0.0, 0.0), None);
        assert_eq!(lookup.place(1.0, -0.0, 1.0), lookup.place(1.0, 0.0, 1.0));
    }

    #[test]
    fn the_series_is_the_arc_sine() {
        for angle_rad in even(-WIDEST_RAD, WIDEST_RAD, 1000) {
            let off = small_arc_sine(libm::sin(angle_rad)) - angle_rad;
            assert!(off.abs() <= 2.0 * f64::EPSILON * angle_rad.abs(), "{angle_rad}: {off}");
        }
    }
}
