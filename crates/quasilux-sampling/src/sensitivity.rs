//! Points that differ from others in some dimensions only: what a value owes to its coordinates.
//!
//! The share of the variance of f that hangs on the coordinates u of a point, alone or together
//! with others, is `E (f(x) - f(x'))^2 / (2 Var f)`, where x' has independent coordinates in u and
//! those of x elsewhere (Jansen 1999; Saltelli et al. 2010, table 2(f)). How (f(x) - f(x'))^2 falls
//! when x' is moved by little tells jumps from slopes.

use crate::point_set::{Generator, PointSet};
use crate::variation::{Change, Variation};
use std::ops::Range;

impl PointSet {
    /// The same points, but with the coordinates in `dimensions` of the point set under another
    /// key. All other coordinates keep their bits. Point sets that ignore their key stay as they
    /// are. Of points that are varied already it varies the original.
    ///
    /// ```
    /// use quasilux_sampling::{PointSet, Randomization, Sequence};
    /// let points = PointSet::new(Sequence::Sobol, Randomization::Owen, 1);
    /// let others = PointSet::new(Sequence::Sobol, Randomization::Owen, 2);
    /// let mixed = points.exchanged(1..3, 2);
    /// let from = [&points, &others, &others, &points];
    /// for (dimension, from) in (0..).zip(from) {
    ///     assert_eq!(mixed.coordinate(7, dimension), from.coordinate(7, dimension));
    /// }
    /// ```
    #[must_use]
    pub fn exchanged(self, dimensions: Range<u32>, key: u64) -> Self {
        self.varied(dimensions, Change::Exchange { key })
    }

    /// The same points, but with the coordinates in `dimensions` moved up by a step in (0, 1/2),
    /// and down where that leads out of [0, 1).
    ///
    /// ```
    /// use quasilux_sampling::{PointSet, Randomization, Sequence};
    /// let points = PointSet::new(Sequence::Sobol, Randomization::None, 0);
    /// let moved = points.moved(1..2, 0.25);
    /// assert_eq!([1, 2].map(|index| points.coordinate(index, 1)), [0.5, 0.75]);
    /// assert_eq!([1, 2].map(|index| moved.coordinate(index, 1)), [0.75, 0.5]);
    /// assert_eq!(moved.coordinate(1, 0), points.coordinate(1, 0));
    /// ```
    #[must_use]
    pub fn moved(self, dimensions: Range<u32>, by: f64) -> Self {
        self.varied(dimensions, Change::Move { by })
    }

    fn varied(mut self, dimensions: Range<u32>, change: Change) -> Self {
        let Range { start: first, end } = dimensions;
        self.generator = Generator::Varied(Variation { first, end, change });
        self
    }
}
