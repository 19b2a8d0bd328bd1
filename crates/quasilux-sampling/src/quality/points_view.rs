//! Points that have been written down.

/// Points of the unit cube, point after point: coordinate j of point i is at `i * dimensions + j`.
#[derive(Clone, Copy, Debug)]
pub struct PointsView<'a> {
    coordinates: &'a [f64],
    dimensions: usize,
}

impl<'a> PointsView<'a> {
    /// At least one point of at least one dimension, all coordinates in [0, 1]; `None` for anything
    /// else, and for a last point that is incomplete.
    #[must_use]
    pub fn new(coordinates: &'a [f64], dimensions: usize) -> Option<Self> {
        let whole = dimensions > 0 && coordinates.len().is_multiple_of(dimensions);
        let inside = || coordinates.iter().all(|u| (0.0..=1.0).contains(u));
        (whole && !coordinates.is_empty() && inside()).then_some(Self { coordinates, dimensions })
    }

    /// The number of points.
    #[must_use]
    pub const fn count(&self) -> usize {
        self.coordinates.len() / self.dimensions
    }

    /// The number of dimensions.
    #[must_use]
    pub const fn dimensions(&self) -> usize {
        self.dimensions
    }

    /// The points, each a slice of its coordinates.
    pub fn points(&self) -> impl ExactSizeIterator<Item = &'a [f64]> {
        self.coordinates.chunks_exact(self.dimensions)
    }

    /// One coordinate of all points.
    ///
    /// # Panics
    /// When there is no such dimension.
    pub fn column(&self, dimension: usize) -> impl ExactSizeIterator<Item = f64> {
        assert!(dimension < self.dimensions, "no dimension {dimension}");
        self.points().map(move |point| point[dimension])
    }
}
