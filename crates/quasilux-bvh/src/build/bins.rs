//! Object splits: each triangle goes to one side (Wald 2007, "On fast Construction of SAH-based
//! Bounding Volume Hierarchies", IEEE Symposium on Interactive Ray Tracing).

use super::grid::{BINS, Grid};
use super::reference::{Bounds, Extent, Reference, in_parts};
use crate::node::WIDTH;

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

/// How many references were moved to the front, and the extents of these and of the others.
pub(crate) struct Partition {
    pub(crate) left: usize,
    pub(crate) extents: [Extent; 2],
}

/// How many blocks this many triangles fill.
pub(crate) fn blocks(count: u32) -> f32 {
    count.div_ceil(WIDTH as u32) as f32
}

#[derive(Clone, Copy)]
struct Bin {
    bounds: Bounds,
    count: u32,
}

type Histogram = [[Bin; BINS]; 3];

impl Bin {
    const EMPTY: Self = Self { bounds: Bounds::EMPTY, count: 0 };

    #[inline(always)]
    fn union(self, other: Self) -> Self {
        Self { bounds: self.bounds.union(other.bounds), count: self.count + other.count }
    }

    fn cost(self) -> f32 {
        self.bounds.half_area() * blocks(self.count)
    }
}

impl ObjectSplit {
    /// The best split between bins; `None` where all centres are the same.
    pub(crate) fn best(references: &[Reference], extent: &Extent) -> Option<Self> {
        let grid = Grid::new(extent.middles, 0.0, BINS);
        let histogram = in_parts(references, |part| histogram(&grid, part), merge);
        let mut best: Option<Self> = None;
        for (axis, bins) in histogram.iter().enumerate().filter(|&(axis, _)| grid.divides(axis)) {
            let mut right = [Bin::EMPTY; BINS + 1];
            for bin in (0..grid.count).rev() {
                right[bin] = right[bin + 1].union(bins[bin]);
            }
            let mut left = Bin::EMPTY;
            for bin in 1..grid.count {
                left = left.union(bins[bin - 1]);
                let right = right[bin];
                if left.count == 0 || right.count == 0 {
                    continue;
                }
                let cost = left.cost() + right.cost();
                if best.is_none_or(|best| cost < best.cost) {
                    let bounds = [left.bounds, right.bounds];
                    best = Some(Self { cost, bounds, axis, bin, grid });
                }
            }
        }
        best
    }

    /// Moves the references of the left side to the front.
    pub(crate) fn partition(&self, references: &mut [Reference]) -> Partition {
        let [mut lefts, mut rights] = [Bounds::EMPTY; 2];
        let mut left_of = |reference: &Reference| {
            let middle = reference.middle();
            let is_left = self.grid.bins(middle)[self.axis] < self.bin;
            let side = if is_left { &mut lefts } else { &mut rights };
            *side = side.and(middle);
            is_left
        };
        let (mut left, mut right) = (0, references.len());
        'all: loop {
            while left < right && left_of(&references[left]) {
                left += 1;
            }
            // The one at `left`, where there is one, belongs to the right.
            loop {
                if left + 1 >= right {
                    break 'all;
                }
                right -= 1;
                if left_of(&references[right]) {
                    break;
                }
            }
            references.swap(left, right);
            left += 1;
        }
        let [left_bounds, right_bounds] = self.bounds;
        let extents = [
            Extent { bounds: left_bounds, middles: lefts },
            Extent { bounds: right_bounds, middles: rights },
        ];
        Partition { left, extents }
    }
}

fn histogram(grid: &Grid, references: &[Reference]) -> Histogram {
    let mut histogram = [[Bin::EMPTY; BINS]; 3];
    for reference in references {
        let bounds = reference.bounds();
        for (bins, bin) in histogram.iter_mut().zip(grid.bins(reference.middle())) {
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
