//! Spatial splits: triangles across a plane go to both sides, each with the box of its part
//! (Stich, Friedrich and Dietrich 2009, "Spatial Splits in Bounding Volume Hierarchies", High
//! Performance Graphics).
//!
//! Every point of a triangle stays in the box of one of its parts, up to the rounding of a box to
//! single precision.

use super::bins::blocks;
use super::clip::{ClippedTriangle, Triangles};
use super::grid::{BINS, Grid};
use super::reference::{Bounds, Reference, in_parts};

/// Shorter axes are not divided.
const SHORTEST: f32 = 1.6e-5;

/// Fewer references are cut into half as many bins: they cross more of them each, and there is less
/// to gain.
const FEW: usize = 4096;

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
    count: u32,
}

/// References of the left side, followed by those of the right one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Division {
    pub(crate) left: usize,
    pub(crate) both: usize,
}

#[derive(Clone, Copy)]
struct Bin {
    bounds: Bounds,
    entering: u32,
    leaving: u32,
}

type Histogram = [[Bin; BINS]; 3];

const EMPTY: Histogram = [[Bin { bounds: Bounds::EMPTY, entering: 0, leaving: 0 }; BINS]; 3];

impl SpatialSplit {
    /// The best plane between bins of equal width.
    pub(crate) fn best(
        triangles: Triangles<'_>,
        references: &[Reference],
        bounds: Bounds,
    ) -> Option<Self> {
        let bins = if references.len() < FEW { BINS / 2 } else { BINS };
        let grid = Grid::new(bounds, SHORTEST, bins);
        let part = |references: &[Reference]| histogram(triangles, &grid, references);
        let histogram = in_parts(references, part, merge);
        let count = references.len() as u32;
        let mut best: Option<Self> = None;
        for (axis, bins) in histogram.iter().enumerate().filter(|&(axis, _)| grid.divides(axis)) {
            let mut right = [Side { bounds: Bounds::EMPTY, count: 0 }; BINS + 1];
            for bin in (0..grid.count).rev() {
                right[bin] = Side {
                    bounds: right[bin + 1].bounds.union(bins[bin].bounds),
                    count: right[bin + 1].count + bins[bin].leaving,
                };
            }
            let mut left = Side { bounds: Bounds::EMPTY, count: 0 };
            for bin in 1..grid.count {
                left.bounds = left.bounds.union(bins[bin - 1].bounds);
                left.count += bins[bin - 1].entering;
                let sides = [left, right[bin]];
                let cost = sides.iter().map(|side| side.cost(0)).sum();
                let divides = sides.iter().all(|side| 0 < side.count && side.count < count);
                if divides && best.is_none_or(|best| cost < best.cost) {
                    best = Some(Self { cost, axis, plane: grid.plane(axis, bin), sides });
                }
            }
        }
        best
    }

    /// How many more references there are after the split, about.
    pub(crate) fn copies(&self, references: usize) -> usize {
        (self.sides[0].count + self.sides[1].count) as usize - references
    }

    /// Shares out the first `count` references, with room for copies behind them; one across the
    /// plane goes to one side if that costs less, or if there is no room for a copy.
    pub(crate) fn divide(
        &self,
        triangles: Triangles<'_>,
        references: &mut [Reference],
        count: usize,
    ) -> Division {
        let mut sides = self.sides;
        let (mut left, mut across, mut right) = (0, 0, count);
        while across < right {
            let Bounds { low, high } = references[across].bounds();
            if high[self.axis] <= self.plane {
                references.swap(left, across);
                left += 1;
                across += 1;
            } else if low[self.axis] >= self.plane {
                right -= 1;
                references.swap(across, right);
            } else {
                across += 1;
            }
        }
        let mut both = count;
        while left < right {
            let reference = references[left];
            let bounds = reference.bounds();
            let whole =
                |side: usize| Side { bounds: sides[side].bounds.union(bounds), ..sides[side] };
            let left_only = whole(0).cost(0) + sides[1].cost(1);
            let right_only = sides[0].cost(1) + whole(1).cost(0);
            let least = left_only.min(right_only);
            let is_copied = both < references.len() && sides[0].cost(0) + sides[1].cost(0) < least;
            if is_copied {
                let parts = triangles.split(&reference, self.axis, self.plane);
                let [below, above] = parts.map(|part| Reference::new(reference.triangle(), part));
                (references[left], references[both]) = (below, above);
                both += 1;
                left += 1;
            } else if least == left_only {
                sides[0] = whole(0);
                sides[1].count = sides[1].count.saturating_sub(1);
                left += 1;
            } else {
                sides[1] = whole(1);
                sides[0].count = sides[0].count.saturating_sub(1);
                right -= 1;
                references.swap(left, right);
            }
        }
        Division { left, both }
    }
}

impl Side {
    /// The cost of this side with this many references fewer.
    fn cost(&self, fewer: u32) -> f32 {
        self.bounds.half_area() * blocks(self.count.saturating_sub(fewer))
    }
}

fn histogram(triangles: Triangles<'_>, grid: &Grid, references: &[Reference]) -> Histogram {
    let mut histogram = EMPTY;
    let mut parts = [Bounds::EMPTY; BINS];
    for reference in references {
        let whole = reference.bounds();
        let (first, last) = (grid.bins(whole.low), grid.bins(whole.high));
        let mut clipped = None;
        for (axis, bins) in histogram.iter_mut().enumerate() {
            let (first, last) = (first[axis], last[axis]);
            bins[first].entering += 1;
            bins[last].leaving += 1;
            if first == last {
                bins[first].bounds = bins[first].bounds.union(whole);
                continue;
            }
            let clipped = clipped.get_or_insert_with(|| {
                ClippedTriangle::new(grid, triangles.single(reference.triangle()))
            });
            clipped.parts(axis, first..=last, &mut parts);
            for (bin, part) in bins[first..=last].iter_mut().zip(&parts[first..=last]) {
                let part = part.intersection(whole);
                if part.low.cmple(part.high).all() {
                    bin.bounds = bin.bounds.union(part);
                }
            }
        }
    }
    histogram
}

fn merge(mut one: Histogram, other: Histogram) -> Histogram {
    for (bin, other) in one.as_flattened_mut().iter_mut().zip(other.as_flattened()) {
        bin.bounds = bin.bounds.union(other.bounds);
        bin.entering += other.entering;
        bin.leaving += other.leaving;
    }
    one
}
