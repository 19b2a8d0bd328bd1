//! Spatial splits: triangles across a plane go to both sides, each with the box of its part
//! (Stich, Friedrich and Dietrich 2009, "Spatial Splits in Bounding Volume Hierarchies", High
//! Performance Graphics).
//!
//! Every point of a triangle stays in the box of one of its parts, up to the rounding of a box to
//! single precision.

use super::bins::blocks;
use super::reference::{Bounds, Reference};
use crate::frame::Frame;
use glam::{DVec3, Vec3A};

/// At most this many copies are made for each triangle.
pub(crate) const MOST_COPIES: f64 = 1.0;

/// A spatial split must cost less than this share of the object split: copies make blocks fuller, which
/// the costs of both halves do not show.
pub(crate) const WORTHWHILE: f32 = 0.95;

/// Tried where the halves of an object split overlap by this share of the whole surface.
pub(crate) const LEAST_OVERLAP: f32 = 1e-4;

const BINS: usize = 16;

/// A plane that divides space, and what lies on its sides.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SpatialSplit {
    /// Areas times blocks on both sides.
    pub(crate) cost: f32,
    axis: usize,
    plane: f32,
    sides: [Side; 2],
}

/// One side of a plane.
#[derive(Clone, Copy, Debug)]
struct Side {
    bounds: Bounds,
    count: usize,
}

/// References on both sides, with their boxes.
pub(crate) struct Sides {
    pub(crate) references: [Vec<Reference>; 2],
    pub(crate) bounds: [Bounds; 2],
}

#[derive(Clone, Copy)]
struct Bin {
    bounds: Bounds,
    entering: usize,
    leaving: usize,
}

/// Where triangles are.
#[derive(Clone, Copy)]
pub(crate) struct Triangles<'a> {
    pub(crate) corners: &'a [[DVec3; 3]],
    pub(crate) frame: Frame,
}

impl Triangles<'_> {
    /// The corners of a triangle in the frame, in single precision.
    fn single(&self, triangle: u32) -> [Vec3A; 3] {
        self.corners[triangle as usize].map(|p| self.frame.point(p).as_vec3a())
    }

    /// The boxes of the parts of a reference below and above a plane across it.
    fn split(&self, reference: &Reference, axis: usize, plane: f32) -> [Bounds; 2] {
        let corners = self.corners[reference.triangle() as usize].map(|p| self.frame.point(p));
        let at = f64::from(plane);
        let mut sides = [Bounds::EMPTY; 2];
        for i in 0..3 {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            let mut grow = |side: usize, p: DVec3| {
                let p = p.as_vec3a();
                sides[side] = sides[side].union(Bounds { low: p, high: p });
            };
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

/// Bins of equal width along each axis.
struct Grid {
    low: Vec3A,
    width: Vec3A,
    /// 0 along axes that are too short to be split.
    scale: Vec3A,
}

impl Bin {
    const EMPTY: Self = Self { bounds: Bounds::EMPTY, entering: 0, leaving: 0 };
}

impl Grid {
    fn new(bounds: Bounds) -> Self {
        let width = (bounds.high - bounds.low) / BINS as f32;
        let splits = width.cmpgt(Vec3A::splat(1e-6));
        let scale = Vec3A::select(splits, width.recip(), Vec3A::ZERO);
        Self { low: bounds.low, width, scale }
    }

    fn plane(&self, axis: usize, bin: usize) -> f32 {
        self.low[axis] + self.width[axis] * bin as f32
    }

    fn bin(&self, axis: usize, x: f32) -> usize {
        (((x - self.low[axis]) * self.scale[axis]) as i32).clamp(0, BINS as i32 - 1) as usize
    }

    /// Enters the parts of a reference into the bins along an axis. Their boxes are rounded to nearest:
    /// good enough to choose a plane by.
    fn enter(&self, axis: usize, whole: Bounds, corners: [Vec3A; 3], bins: &mut [Bin; BINS]) {
        let (first, last) = (self.bin(axis, whole.low[axis]), self.bin(axis, whole.high[axis]));
        bins[first].entering += 1;
        bins[last].leaving += 1;
        if first == last {
            bins[first].bounds = bins[first].bounds.union(whole);
            return;
        }
        let mut parts = [Bounds::EMPTY; BINS];
        let mut grow =
            |bin: usize, p: Vec3A| parts[bin] = parts[bin].union(Bounds { low: p, high: p });
        for i in 0..3 {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            let (a, b) = if a[axis] <= b[axis] { (a, b) } else { (b, a) };
            let (from, to) = (self.bin(axis, a[axis]), self.bin(axis, b[axis]));
            grow(from, a);
            grow(to, b);
            if from < to {
                let slope = (b - a) / (b[axis] - a[axis]);
                for bin in from.max(first)..to.min(last) {
                    let p = a + slope * (self.plane(axis, bin + 1) - a[axis]);
                    grow(bin, p);
                    grow(bin + 1, p);
                }
            }
        }
        for bin in first..=last {
            let part = parts[bin].intersection(whole);
            if part.low.cmple(part.high).all() {
                bins[bin].bounds = bins[bin].bounds.union(part);
            }
        }
    }
}

impl SpatialSplit {
    /// The best plane between bins of equal width.
    pub(crate) fn best(
        triangles: Triangles<'_>,
        references: &[Reference],
        bounds: Bounds,
    ) -> Option<Self> {
        let grid = Grid::new(bounds);
        let mut histogram = [[Bin::EMPTY; BINS]; 3];
        for reference in references {
            let corners = triangles.single(reference.triangle());
            for (axis, bins) in histogram.iter_mut().enumerate() {
                grid.enter(axis, reference.bounds(), corners, bins);
            }
        }
        let mut best: Option<Self> = None;
        for (axis, bins) in histogram.iter().enumerate() {
            if grid.scale[axis] == 0.0 {
                continue;
            }
            let mut right = [Side { bounds: Bounds::EMPTY, count: 0 }; BINS + 1];
            for bin in (0..BINS).rev() {
                right[bin] = Side {
                    bounds: right[bin + 1].bounds.union(bins[bin].bounds),
                    count: right[bin + 1].count + bins[bin].leaving,
                };
            }
            let mut left = Side { bounds: Bounds::EMPTY, count: 0 };
            for bin in 1..BINS {
                left.bounds = left.bounds.union(bins[bin - 1].bounds);
                left.count += bins[bin - 1].entering;
                let sides = [left, right[bin]];
                let cost = sides.iter().map(|side| side.cost(0)).sum();
                let divides =
                    sides.iter().all(|side| 0 < side.count && side.count < references.len());
                if divides && best.is_none_or(|best| cost < best.cost) {
                    best = Some(Self { cost, axis, plane: grid.plane(axis, bin), sides });
                }
            }
        }
        best
    }

    /// How many more references there are after the split, at most.
    pub(crate) fn copies(&self, references: usize) -> usize {
        self.sides[0].count + self.sides[1].count - references
    }

    /// Shares out the references; one across the plane goes to one side if that costs less.
    pub(crate) fn divide(&self, triangles: Triangles<'_>, references: Vec<Reference>) -> Sides {
        let mut sides = self.sides;
        let mut shares = [const { Vec::new() }; 2];
        let mut across = Vec::new();
        for reference in references {
            let Bounds { low, high } = reference.bounds();
            if high[self.axis] <= self.plane {
                shares[0].push(reference);
            } else if low[self.axis] >= self.plane {
                shares[1].push(reference);
            } else {
                across.push(reference);
            }
        }
        for reference in across {
            let bounds = reference.bounds();
            let parts = triangles.split(&reference, self.axis, self.plane);
            let whole =
                |side: usize| Side { bounds: sides[side].bounds.union(bounds), ..sides[side] };
            let both = sides[0].cost(0) + sides[1].cost(0);
            let left_only = whole(0).cost(0) + sides[1].cost(1);
            let right_only = sides[0].cost(1) + whole(1).cost(0);
            let least = both.min(left_only).min(right_only);
            if least == left_only && sides[1].count > 1 {
                sides[0] = whole(0);
                sides[1].count -= 1;
                shares[0].push(reference);
            } else if least == right_only && sides[0].count > 1 {
                sides[1] = whole(1);
                sides[0].count -= 1;
                shares[1].push(reference);
            } else {
                for (share, part) in shares.iter_mut().zip(parts) {
                    share.push(Reference::new(reference.triangle(), part));
                }
            }
        }
        let bounds = [0, 1].map(|side| {
            shares[side].iter().map(Reference::bounds).fold(Bounds::EMPTY, Bounds::union)
        });
        Sides { references: shares, bounds }
    }
}

impl Side {
    /// The cost of this side with so many references fewer.
    fn cost(&self, fewer: usize) -> f32 {
        self.bounds.half_area() * blocks(self.count - fewer.min(self.count))
    }
}
