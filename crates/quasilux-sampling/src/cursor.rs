//! Handing out the coordinates of one sample.

use crate::PointSet;

/// Hands out the coordinates of one sample in order and counts them.
///
/// The count is the sample's *constructive dimension*: how many coordinates it consumed until it
/// ended.
/// ```
/// use quasilux_sampling::{PointSet, Randomization, SampleCursor, Sequence};
/// let points = PointSet::new(Sequence::Sobol, Randomization::None, 0);
/// let mut cursor = SampleCursor::new(&points, 1);
/// assert_eq!(cursor.next_1d(), 0.5);
/// assert_eq!(cursor.next_2d(), [0.5, 0.5]);
/// assert_eq!(cursor.used(), 3);
/// ```
#[derive(Clone, Debug)]
pub struct SampleCursor<'a> {
    points: &'a PointSet,
    index: u64,
    dimension: u32,
    used: u32,
}

impl<'a> SampleCursor<'a> {
    /// Starts at the first coordinate of point `index`.
    #[inline]
    #[must_use]
    pub const fn new(points: &'a PointSet, index: u64) -> Self {
        Self { points, index, dimension: 0, used: 0 }
    }

    /// The next coordinate.
    #[inline]
    pub fn next_1d(&mut self) -> f64 {
        let coordinate = self.points.coordinate(self.index, self.dimension);
        self.dimension = self.dimension.saturating_add(1);
        self.used = self.used.saturating_add(1);
        coordinate
    }

    /// The next two coordinates.
    #[inline]
    pub fn next_2d(&mut self) -> [f64; 2] {
        [self.next_1d(), self.next_1d()]
    }

    /// Goes on at `dimension`, for an assignment of coordinates to decisions that is fixed ahead;
    /// what is skipped does not count as used. It never goes back, so that no coordinate serves
    /// twice.
    #[inline]
    pub fn skip_to(&mut self, dimension: u32) {
        self.dimension = self.dimension.max(dimension);
    }

    /// The dimension of the next coordinate.
    #[inline]
    #[must_use]
    pub const fn dimension(&self) -> u32 {
        self.dimension
    }

    /// How many coordinates were handed out.
    #[inline]
    #[must_use]
    pub const fn used(&self) -> u32 {
        self.used
    }
}
