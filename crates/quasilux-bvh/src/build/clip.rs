//! Clipping of triangles to slabs between axis-aligned planes.

use super::grid::{BINS, Grid};
use super::reference::{Bounds, Reference};
use crate::frame::Frame;
use glam::{DVec3, Vec3A};
use std::ops::RangeInclusive;

/// Where triangles are.
#[derive(Clone, Copy)]
pub(crate) struct Triangles<'a> {
    pub(crate) corners: &'a [[DVec3; 3]],
    pub(crate) frame: Frame,
}

impl Triangles<'_> {
    /// The corners of a triangle in the frame, in single precision.
    #[inline(always)]
    pub(crate) fn single(&self, triangle: u32) -> [Vec3A; 3] {
        self.corners[triangle as usize].map(|p| self.frame.point(p).as_vec3a())
    }

    /// The boxes of the parts of a reference below and above a plane across it.
    pub(crate) fn split(&self, reference: &Reference, axis: usize, plane: f32) -> [Bounds; 2] {
        let corners = self.corners[reference.triangle() as usize].map(|p| self.frame.point(p));
        let at = f64::from(plane);
        let mut sides = [Bounds::EMPTY; 2];
        for i in 0..3 {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            let mut grow = |side: usize, p: DVec3| sides[side] = sides[side].and(p.as_vec3a());
            if a[axis] <= at {
                grow(0, a);
            }
            if a[axis] >= at {
                grow(1, a);
            }
            if (a[axis] < at && at < b[axis]) || (b[axis] < at && at < a[axis]) {
                let p = a + (b - a) * ((at - a[axis]) / (b[axis] - a[axis]));
                grow(0, p);
                grow(1, p);
            }
        }
        let [mut below, mut above] = sides;
        below.high[axis] = below.high[axis].min(plane);
        above.low[axis] = above.low[axis].max(plane);
        let whole = reference.bounds();
        [below.intersection(whole), above.intersection(whole)]
    }
}

/// A triangle on a grid. Boxes of its parts are rounded to nearest: good enough to choose a plane
/// by.
pub(crate) struct ClippedTriangle<'a> {
    grid: &'a Grid,
    corners: [Vec3A; 3],
    /// The bins of the corners.
    bins: [[usize; 3]; 3],
}

impl<'a> ClippedTriangle<'a> {
    #[inline(always)]
    pub(crate) fn new(grid: &'a Grid, corners: [Vec3A; 3]) -> Self {
        Self { grid, corners, bins: corners.map(|corner| grid.bins(corner)) }
    }

    /// Writes the boxes of the parts in some bins along an axis to the places of these bins.
    #[inline(always)]
    pub(crate) fn parts(
        &self,
        axis: usize,
        bins: RangeInclusive<usize>,
        parts: &mut [Bounds; BINS],
    ) {
        let (first, last) = (*bins.start(), *bins.end());
        parts[bins].fill(Bounds::EMPTY);
        let mut grow = |bin: usize, p: Vec3A| parts[bin] = parts[bin].and(p);
        for (corner, bins) in self.corners.into_iter().zip(self.bins) {
            if first <= bins[axis] && bins[axis] <= last {
                grow(bins[axis], corner);
            }
        }
        for i in 0..3 {
            let (mut one, mut other) = (i, (i + 1) % 3);
            if self.bins[one][axis] > self.bins[other][axis] {
                (one, other) = (other, one);
            }
            let (from, to) = (self.bins[one][axis], self.bins[other][axis]);
            let crossed = (from + 1).max(first)..=to.min(last + 1);
            if crossed.is_empty() {
                continue;
            }
            let (a, b) = (self.corners[one], self.corners[other]);
            let slope = (b - a) / (b[axis] - a[axis]);
            for bin in crossed {
                let p = a + slope * (self.grid.plane(axis, bin) - a[axis]);
                if bin > first {
                    grow(bin - 1, p);
                }
                if bin <= last {
                    grow(bin, p);
                }
            }
        }
    }
}
