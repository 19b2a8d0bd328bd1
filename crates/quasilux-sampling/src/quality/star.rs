//! The star discrepancy, exactly: the largest difference, over all boxes [0, a), between the share
//! of the points in the box and its volume.
//!
//! H. Niederreiter, "Discrepancy and convex programming" (1972): only boxes whose faces touch
//! points (or the far faces of the cube) need be looked at. All but the last dimension are
//! enumerated; the points, sorted along the last, are then swept once.

use super::points_view::PointsView;

/// The sweeps may visit this many points in all: some seconds.
const MAX_VISITS: u64 = 1 << 30;

/// The star discrepancy, in [1/2N, 1]; `None` where the points are too many for it, which is above
/// 2^30 for n (n + 1)^(d - 1): 32 767 points in two dimensions, 1023 in three, 180 in four. No
/// algorithm is known whose time does not grow exponentially with the dimension.
#[must_use]
pub fn star_discrepancy(points: PointsView<'_>) -> Option<f64> {
    let n = points.count() as u64;
    let mut visits = n;
    for _ in 1..points.dimensions() {
        visits = visits.checked_mul(n + 1).filter(|visits| *visits <= MAX_VISITS)?;
    }
    let last = points.dimensions() - 1;
    let mut sorted: Vec<&[f64]> = points.points().collect();
    sorted.sort_by(|a, b| a[last].total_cmp(&b[last]));
    let share = 1.0 / n as f64;
    let sides = [Side::Empty, Side::Full];
    let largest = sides.map(|side| side.largest(&sorted, 0, last, 1.0, share));
    Some(largest[0].max(largest[1]))
}

/// From which side the supremum is approached.
#[derive(Clone, Copy, PartialEq)]
enum Side {
    /// Volume minus share: boxes without the points on their faces.
    Empty,
    /// Share minus volume: boxes with the points on their faces.
    Full,
}

impl Side {
    /// The largest difference over the boxes whose first `dimension` edges are chosen, with product
    /// `volume`, and hold the points `inside`, sorted along dimension `last`.
    fn largest(
        self,
        inside: &[&[f64]],
        dimension: usize,
        last: usize,
        volume: f64,
        share: f64,
    ) -> f64 {
        if dimension == last {
            return self.sweep(inside, last, volume, share);
        }
        let mut largest = 0.0_f64;
        let mut chosen = Vec::with_capacity(inside.len());
        for edge in inside.iter().map(|point| point[dimension]).chain([1.0]) {
            chosen.clear();
            let keeps = |x: f64| match self {
                Self::Empty => x < edge,
                Self::Full => x <= edge,
            };
            chosen.extend(inside.iter().filter(|point| keeps(point[dimension])));
            largest = largest.max(self.largest(&chosen, dimension + 1, last, volume * edge, share));
        }
        largest
    }

    fn sweep(self, inside: &[&[f64]], last: usize, volume: f64, share: f64) -> f64 {
        let edges = inside.iter().map(|point| point[last]).enumerate();
        match self {
            Self::Empty => edges
                .map(|(below, edge)| volume * edge - below as f64 * share)
                .fold(volume - inside.len() as f64 * share, f64::max),
            Self::Full => edges
                .map(|(below, edge)| (below + 1) as f64 * share - volume * edge)
                .fold(0.0, f64::max),
        }
    }
}
