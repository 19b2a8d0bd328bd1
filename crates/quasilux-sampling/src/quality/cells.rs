//! How many points are in each cell of a square grid: what figures of point sets show.

use super::points_view::PointsView;

/// The points of one projection to two dimensions, counted in equal square cells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CellCounts {
    /// The number of cells along each side.
    pub per_side: usize,
    /// The number of points in each cell, the first dimension running fastest.
    pub counts: Vec<u64>,
}

impl CellCounts {
    /// At most this many cells along a side.
    pub const MAX_PER_SIDE: usize = 1 << 11;

    /// The number of cells without a point.
    #[must_use]
    pub fn empty(&self) -> usize {
        self.counts.iter().filter(|count| **count == 0).count()
    }

    /// The smallest number of points in a cell.
    #[must_use]
    pub fn least(&self) -> u64 {
        self.counts.iter().copied().min().unwrap_or(0)
    }

    /// The largest number of points in a cell.
    #[must_use]
    pub fn most(&self) -> u64 {
        self.counts.iter().copied().max().unwrap_or(0)
    }

    /// The number of empty cells to expect of as many random points: c (1 - 1/c)^N.
    #[must_use]
    pub fn empty_if_random(&self) -> f64 {
        let cells = self.counts.len() as f64;
        let points: u64 = self.counts.iter().sum();
        cells * libm::exp(points as f64 * libm::log1p(-1.0 / cells))
    }
}

/// Counts the points of a projection in `per_side` x `per_side` cells; what lies at 1 is in the
/// last cell.
///
/// # Panics
/// When there is no such dimension, or `per_side` is 0 or above [`CellCounts::MAX_PER_SIDE`].
#[must_use]
pub fn cell_counts(points: PointsView<'_>, pair: [usize; 2], per_side: usize) -> CellCounts {
    let sides = 1..=CellCounts::MAX_PER_SIDE;
    assert!(sides.contains(&per_side), "{per_side} cells a side");
    let place = |u: f64| ((u * per_side as f64) as usize).min(per_side - 1);
    let mut counts = vec![0; per_side * per_side];
    for (x, y) in points.column(pair[0]).zip(points.column(pair[1])) {
        counts[place(y) * per_side + place(x)] += 1;
    }
    CellCounts { per_side, counts }
}
