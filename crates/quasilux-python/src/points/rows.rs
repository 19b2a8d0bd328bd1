//! Arrays of points, one row a point, made by several threads.

use std::thread;

/// Each thread gets at least this many coordinates, to repay its start.
const MIN_WORK: usize = 1 << 17;

/// A sequence that writes points into rows.
pub(super) trait Sequence: Sync {
    /// Writes the points from `first_index` on, point after point.
    fn fill(&self, first_index: u64, points: &mut [f64]);
}

/// Some of the points of an array.
pub(super) struct Part<'a> {
    /// The index of the first point.
    pub(super) first_index: u64,
    /// The points, one after the other.
    pub(super) points: &'a mut [f64],
}

impl<'a> Part<'a> {
    /// Parts of `count` points of this many dimensions.
    pub(super) fn split(
        self,
        dimensions: usize,
        count: usize,
    ) -> impl Iterator<Item = Self> + use<'a> {
        let parts = self.points.chunks_mut(count.saturating_mul(dimensions)).zip(0_u64..);
        parts.map(move |(points, number)| Self {
            first_index: self.first_index.wrapping_add(number * count as u64),
            points,
        })
    }

    /// Writes the points, by at most this many threads.
    pub(super) fn fill(self, sequence: &impl Sequence, dimensions: usize, workers: usize) {
        if dimensions == 0 {
            return;
        }
        let workers = workers.min(self.points.len() / MIN_WORK).max(1);
        let count = (self.points.len() / dimensions).div_ceil(workers).max(1);
        thread::scope(|scope| {
            let mut parts = self.split(dimensions, count);
            let own = parts.next();
            for Part { first_index, points } in parts {
                scope.spawn(move || sequence.fill(first_index, points));
            }
            if let Some(Part { first_index, points }) = own {
                sequence.fill(first_index, points);
            }
        });
    }
}
