//! Discrepancies in the mean square: how far the share of points in a box is from its volume, on
//! average over the boxes of a family. O(N^2 d).
//!
//! T. T. Warnock, "Computational investigations of low-discrepancy point sets" (1972): boxes
//! anchored at the origin. F. J. Hickernell, "A generalized discrepancy and quadrature error
//! bound", Math. Comp. 67 (1998), and "Lattice rules: how well do they measure up?" (1998): boxes
//! anchored at the nearest corner, and boxes that wrap around. Y.-D. Zhou, K.-T. Fang, J.-H. Ning,
//! "Mixture discrepancy for quasi-random point sets", J. Complexity 29 (2013). Hickernell's and the
//! mixture count the boxes of all projections to fewer dimensions too.
//!
//! Of `scipy.stats.qmc.discrepancy`, the methods `CD`, `WD` and `MD` are the *squares*
//! ([`squared_l2_discrepancy`]), and `L2-star` is the discrepancy itself ([`l2_discrepancy`]).

use super::points_view::PointsView;

/// Which boxes are looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum L2Measure {
    /// Boxes from the origin (Warnock). In many dimensions it measures little but a neighbourhood
    /// of the corner (1, .., 1).
    Star,
    /// Boxes from the nearest corner: unchanged by reflections x -> 1 - x (Hickernell).
    Centred,
    /// Boxes that wrap around: unchanged by shifts modulo 1 (Hickernell).
    WrapAround,
    /// A mixture of the two that weighs small and large boxes evenly (Zhou, Fang and Ning).
    Mixture,
}

/// The discrepancy. Of N random points it falls like N^-1/2, of good ones like N^-1 (log
/// N)^(d-1)/2.
///
/// As the root of a difference of sums near 1 it has an absolute error of about 1e-8 where it is
/// zero, of 1e-16 over itself elsewhere.
#[must_use]
pub fn l2_discrepancy(points: PointsView<'_>, measure: L2Measure) -> f64 {
    squared_l2_discrepancy(points, measure).max(0.0).sqrt()
}

/// The square of the discrepancy; rounding can make it negative where it is all but zero.
#[must_use]
pub fn squared_l2_discrepancy(points: PointsView<'_>, measure: L2Measure) -> f64 {
    match measure {
        L2Measure::Star => sum::<Star>(points),
        L2Measure::Centred => sum::<Centred>(points),
        L2Measure::WrapAround => sum::<WrapAround>(points),
        L2Measure::Mixture => sum::<Mixture>(points),
    }
}

/// A discrepancy's square is the mean over all pairs (x, y) of points, minus 2 times the mean over
/// all points, plus the integral: of K(x, y) = prod `pair`, of its integral over y = prod `single`,
/// and of that over x = `whole`^d.
trait DiscrepancyKernel {
    fn pair(x: f64, y: f64) -> f64;
    fn single(x: f64) -> f64;
    const WHOLE: f64;
}

fn sum<K: DiscrepancyKernel>(points: PointsView<'_>) -> f64 {
    let (n, dimensions) = (points.count(), points.dimensions());
    let columns: Vec<Vec<f64>> = (0..dimensions).map(|j| points.column(j).collect()).collect();
    let whole: f64 = (0..dimensions).map(|_| K::WHOLE).product();
    let (mut single, mut pairs, mut diagonal) = (0.0, 0.0, 0.0);
    let mut products = vec![0.0; n];
    for (i, point) in points.points().enumerate() {
        single += point.iter().map(|x| K::single(*x)).product::<f64>();
        diagonal += point.iter().map(|x| K::pair(*x, *x)).product::<f64>();
        let row = &mut products[..i];
        row.fill(1.0);
        for (x, column) in point.iter().zip(&columns) {
            for (product, y) in row.iter_mut().zip(column) {
                *product *= K::pair(*x, *y);
            }
        }
        pairs += row.iter().sum::<f64>();
    }
    let n = n as f64;
    whole - 2.0 * single / n + (2.0 * pairs + diagonal) / (n * n)
}

struct Star;

impl DiscrepancyKernel for Star {
    const WHOLE: f64 = 1.0 / 3.0;
    fn pair(x: f64, y: f64) -> f64 {
        1.0 - x.max(y)
    }
    fn single(x: f64) -> f64 {
        0.5 * (1.0 - x * x)
    }
}

struct Centred;

impl DiscrepancyKernel for Centred {
    const WHOLE: f64 = 13.0 / 12.0;
    fn pair(x: f64, y: f64) -> f64 {
        1.0 + 0.5 * ((x - 0.5).abs() + (y - 0.5).abs() - (x - y).abs())
    }
    fn single(x: f64) -> f64 {
        let z = (x - 0.5).abs();
        1.0 + 0.5 * (z - z * z)
    }
}

struct WrapAround;

impl DiscrepancyKernel for WrapAround {
    const WHOLE: f64 = 4.0 / 3.0;
    fn pair(x: f64, y: f64) -> f64 {
        let distance = (x - y).abs();
        1.5 - distance * (1.0 - distance)
    }
    fn single(_: f64) -> f64 {
        4.0 / 3.0
    }
}

struct Mixture;

impl DiscrepancyKernel for Mixture {
    const WHOLE: f64 = 19.0 / 12.0;
    fn pair(x: f64, y: f64) -> f64 {
        let distance = (x - y).abs();
        let centre = (x - 0.5).abs() + (y - 0.5).abs();
        1.875 - 0.25 * centre - 0.75 * distance + 0.5 * distance * distance
    }
    fn single(x: f64) -> f64 {
        let z = (x - 0.5).abs();
        5.0 / 3.0 - 0.25 * (z + z * z)
    }
}
