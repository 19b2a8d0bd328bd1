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
use std::ops::Range;

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
    discrepancy_terms(points, measure, 0..points.count()).squared_discrepancy(points.count())
}

/// The sums that a squared discrepancy is made of; those of disjoint ranges of points add up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiscrepancyTerms {
    /// The integral of the kernel over both of its points.
    pub whole: f64,
    /// The sum over the points of the kernel's integral over the other point.
    pub single: f64,
    /// The sum of the kernel over all ordered pairs of points, equal ones included.
    pub pairs: f64,
}

impl DiscrepancyTerms {
    /// The squared discrepancy as if there were `count` points: the means are over as many.
    #[must_use]
    pub fn squared_discrepancy(&self, count: usize) -> f64 {
        let n = count as f64;
        self.whole - 2.0 * self.single / n + self.pairs / (n * n)
    }
}

/// The sums over the points of a range, and over the pairs whose later point is in it.
///
/// # Panics
/// When the range ends after the last point.
#[must_use]
pub fn discrepancy_terms(
    points: PointsView<'_>,
    measure: L2Measure,
    range: Range<usize>,
) -> DiscrepancyTerms {
    assert!(range.end <= points.count(), "there is no point {}", range.end);
    match measure {
        L2Measure::Star => terms::<Star>(points, range),
        L2Measure::Centred => terms::<Centred>(points, range),
        L2Measure::WrapAround => terms::<WrapAround>(points, range),
        L2Measure::Mixture => terms::<Mixture>(points, range),
    }
}

/// Two points that exchange one coordinate. The projections to one dimension stay as they are, so a
/// Latin hypercube stays one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Exchange {
    /// The points.
    pub points: [usize; 2],
    /// The dimension.
    pub dimension: usize,
}

/// By how much an exchange changes the squared discrepancy, in O(N d): only the pairs with one of
/// the two points change (R. Jin, W. Chen and A. Sudjianto, "An efficient algorithm for
/// constructing optimal design of computer experiments", J. Stat. Plan. Inference 134, 2005).
///
/// Deviation: their quotients are products without the factor of the dimension, which may be zero.
///
/// # Panics
/// When there is no such point or dimension.
#[must_use]
pub fn change_by_exchange(points: PointsView<'_>, measure: L2Measure, exchange: Exchange) -> f64 {
    match measure {
        L2Measure::Star => exchange_terms::<Star>(points, exchange),
        L2Measure::Centred => exchange_terms::<Centred>(points, exchange),
        L2Measure::WrapAround => exchange_terms::<WrapAround>(points, exchange),
        L2Measure::Mixture => exchange_terms::<Mixture>(points, exchange),
    }
}

/// A discrepancy's square is the mean over all pairs (x, y) of points, minus 2 times the mean over
/// all points, plus the integral: of K(x, y) = prod `pair`, of its integral over y = prod `single`,
/// and of that over x = `whole`^d. K(x, y) = K(y, x).
trait DiscrepancyKernel {
    fn pair(x: f64, y: f64) -> f64;
    fn single(x: f64) -> f64;
    const WHOLE: f64;
}

fn terms<K: DiscrepancyKernel>(points: PointsView<'_>, range: Range<usize>) -> DiscrepancyTerms {
    let dimensions = points.dimensions();
    let columns: Vec<Vec<f64>> =
        (0..dimensions).map(|j| points.column(j).take(range.end).collect()).collect();
    let whole: f64 = (0..dimensions).map(|_| K::WHOLE).product();
    let (mut single, mut pairs, mut diagonal) = (0.0, 0.0, 0.0);
    let mut products = vec![0.0; range.end];
    for (i, point) in points.points().enumerate().take(range.end).skip(range.start) {
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
    DiscrepancyTerms { whole, single, pairs: 2.0 * pairs + diagonal }
}

/// Where a and b exchange the coordinate k, a term prod f(a_j) + prod f(b_j) becomes itself plus
/// (prod' f(a_j) - prod' f(b_j)) (f(b_k) - f(a_k)), with products over all j but k.
fn exchange_terms<K: DiscrepancyKernel>(points: PointsView<'_>, exchange: Exchange) -> f64 {
    let Exchange { points: [first, second], dimension: k } = exchange;
    let rows: Vec<&[f64]> = points.points().collect();
    let (a, b) = (rows[first], rows[second]);
    let product = |factor: &dyn Fn(usize) -> f64| -> f64 {
        (0..a.len()).filter(|j| *j != k).map(factor).product()
    };
    let change_of =
        |f: fn(f64) -> f64| (product(&|j| f(a[j])) - product(&|j| f(b[j]))) * (f(b[k]) - f(a[k]));
    let mut pairs = 0.0;
    for (i, other) in rows.iter().enumerate() {
        if i != first && i != second {
            let [with_a, with_b] = [a, b].map(|point| {
                let both = point.iter().zip(*other).enumerate().filter(|(j, _)| *j != k);
                both.map(|(_, (x, y))| K::pair(*x, *y)).product::<f64>()
            });
            pairs += (with_a - with_b) * (K::pair(b[k], other[k]) - K::pair(a[k], other[k]));
        }
    }
    let n = rows.len() as f64;
    let diagonal = change_of(|x| K::pair(x, x));
    (2.0 * pairs + diagonal) / (n * n) - 2.0 * change_of(K::single) / n
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
