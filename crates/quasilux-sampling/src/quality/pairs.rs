//! Which pair of dimensions is the worst: a set can be even as a whole, and striped in two of its
//! dimensions.

use super::cells::cell_counts;
use super::discrepancy::{L2Measure, l2_discrepancy};
use super::points_view::PointsView;
use super::star::star_discrepancy;

/// What makes a pair of dimensions bad.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PairMeasure {
    /// The star discrepancy of the projection; infinite where there are too many points for it.
    Star,
    /// A mean-square discrepancy of the projection.
    L2(L2Measure),
    /// The share of empty cells of a grid with this many cells a side, 1 to
    /// [`CellCounts::MAX_PER_SIDE`](super::CellCounts::MAX_PER_SIDE).
    EmptyCells(usize),
}

/// One projection to two dimensions, and how bad it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairQuality {
    /// The two dimensions, the lower first.
    pub dimensions: [usize; 2],
    /// The measure; larger is worse.
    pub value: f64,
}

/// All pairs of dimensions, the worst first, equals by their numbers.
///
/// # Panics
/// When there is a pair and [`PairMeasure::EmptyCells`] has a number of cells out of its range.
#[must_use]
pub fn worst_pairs(points: PointsView<'_>, measure: PairMeasure) -> Vec<PairQuality> {
    let dimensions = points.dimensions();
    let mut pairs: Vec<PairQuality> = (0..dimensions)
        .flat_map(|first| (first + 1..dimensions).map(move |second| [first, second]))
        .map(|dimensions| PairQuality { dimensions, value: quality(points, dimensions, measure) })
        .collect();
    pairs.sort_by(|a, b| b.value.total_cmp(&a.value));
    pairs
}

fn quality(points: PointsView<'_>, pair: [usize; 2], measure: PairMeasure) -> f64 {
    if let PairMeasure::EmptyCells(per_side) = measure {
        let cells = cell_counts(points, pair, per_side);
        return cells.empty() as f64 / cells.counts.len() as f64;
    }
    let coordinates: Vec<f64> =
        points.points().flat_map(|point| pair.map(|dimension| point[dimension])).collect();
    let projection = PointsView::new(&coordinates, 2).expect("a part of a view is a view");
    match measure {
        PairMeasure::Star => star_discrepancy(projection).unwrap_or(f64::INFINITY),
        PairMeasure::L2(measure) => l2_discrepancy(projection, measure),
        PairMeasure::EmptyCells(_) => unreachable!("counted above"),
    }
}
