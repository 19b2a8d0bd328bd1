//! Object splits: each triangle goes to one side (Wald 2007, "On fast Construction of SAH-based
//! Bounding Volume Hierarchies", IEEE Symposium on Interactive Ray Tracing).

use super::reference::{Bounds, Reference};
use crate::node::WIDTH;
use glam::Vec3A;
use rayon::prelude::*;

pub(crate) const BINS: usize = 16;

/// Nodes with more references are binned on all threads.
const PARALLEL: usize = 1 << 16;

/// References on either side of a plane, by the bin of their centres.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ObjectSplit {
    /// Areas times blocks on both sides.
    pub(crate) cost: f32,
    pub(crate) bounds: [Bounds; 2],
    axis: usize,
    /// The first bin of the right side.
    bin: usize,
    grid: Grid,
}

/// How many blocks this many triangles fill.
pub(crate) fn blocks(count: usize) -> f32 {
    count.div_ceil(WIDTH) as f32
}

/// The map from centres to bins.
#[derive(Clone, Copy, Debug)]
struct Grid {
    low: Vec3A,
    scale: Vec3A,
}

#[derive(Clone, Copy)]
struct Bin {
    bounds: Bounds,
    count: usize,
}

type Histogram = [[Bin; BINS]; 3];

impl Bin {
    const EMPTY: Self = Self { bounds: Bounds::EMPTY, count: 0 };

    #[inline(always)]
    fn union(self, other: Self) -> Self {
        Self { bounds: self.bounds.union(other.bounds), count: self.count + other.count }
    }
}

impl Grid {
    fn new(references: &[Reference]) -> Self {
        let span = |references: &[Reference]| {
            references.iter().fold(Bounds::EMPTY, |span, reference| {
                let middle = reference.middle();
                Bounds { low: span.low.min(middle), high: span.high.max(middle) }
            })
        };
        let span = if references.len() > PARALLEL {
            let parts = references.par_chunks(PARALLEL / 4).map(span);
            parts.reduce(|| Bounds::EMPTY, Bounds::union)
        } else {
            span(references)
        };
        let extent = span.high - span.low;
        // Rounded so that the highest centre falls into the last bin.
        let scale = (extent.recip() * (BINS as f32 * (1.0 - 1e-6))).min(Vec3A::splat(1e30));
        Self { low: span.low, scale: Vec3A::select(extent.cmpgt(Vec3A::ZERO), scale, Vec3A::ZERO) }
    }

    #[inline(always)]
    fn bins(&self, reference: &Reference) -> [usize; 3] {
        let at = (reference.middle() - self.low) * self.scale;
        at.to_array().map(|x| (x as i32 as usize).min(BINS - 1))
    }
}

impl ObjectSplit {
    /// The best split between bins; `None` where all centres are the same.
    pub(crate) fn best(references: &[Reference]) -> Option<Self> {
        let grid = Grid::new(references);
        let histogram = if references.len() > PARALLEL {
            let parts = references.par_chunks(PARALLEL / 4).map(|part| histogram(&grid, part));
            parts.reduce(|| [[Bin::EMPTY; BINS]; 3], merge)
        } else {
            histogram(&grid, references)
        };
        let mut best: Option<Self> = None;
        for (axis, bins) in histogram.iter().enumerate() {
            if grid.scale[axis] == 0.0 {
                continue;
            }
            let mut right = [Bin::EMPTY; BINS + 1];
            for bin in (0..BINS).rev() {
                right[bin] = right[bin + 1].union(bins[bin]);
            }
            let mut left = Bin::EMPTY;
            for bin in 1..BINS {
                left = left.union(bins[bin - 1]);
                let right = right[bin];
                if left.count == 0 || right.count == 0 {
                    continue;
                }
                let side = |side: Bin| side.bounds.half_area() * blocks(side.count);
                let cost = side(left) + side(right);
                if best.is_none_or(|best| cost < best.cost) {
                    let bounds = [left.bounds, right.bounds];
                    best = Some(Self { cost, bounds, axis, bin, grid });
                }
            }
        }
        best
    }

    /// Moves the references of the left side to the front and returns their number.
    pub(crate) fn partition(&self, references: &mut [Reference]) -> usize {
        let is_left = |reference: &Reference| self.grid.bins(reference)[self.axis] < self.bin;
        let (mut left, mut right) = (0, references.len());
        loop {
            while left < right && is_left(&references[left]) {
                left += 1;
            }
            while left < right && !is_left(&references[right - 1]) {
                right -= 1;
            }
            if left == right {
                return left;
            }
            right -= 1;
            references.swap(left, right);
            left += 1;
        }
    }
}

fn histogram(grid: &Grid, references: &[Reference]) -> Histogram {
    let mut histogram = [[Bin::EMPTY; BINS]; 3];
    for reference in references {
        let bounds = reference.bounds();
        for (bins, bin) in histogram.iter_mut().zip(grid.bins(reference)) {
            let bin = &mut bins[bin];
            *bin = bin.union(Bin { bounds, count: 1 });
        }
    }
    histogram
}

fn merge(mut one: Histogram, other: Histogram) -> Histogram {
    for (bin, other) in one.as_flattened_mut().iter_mut().zip(other.as_flattened()) {
        *bin = bin.union(*other);
    }
    one
}
