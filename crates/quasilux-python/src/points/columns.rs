//! Sequences in the order of their indices: one coordinate of many points at a time.

use super::rows::{Part, Sequence};
use quasilux_sampling::PointSet;

/// This many points are made at once.
const POINTS: usize = 256;
/// This many dimensions at most are made before they are written: their columns stay in the cache.
const TILE: usize = 64;
/// This many coordinates of a row are gathered at once.
const LINE: usize = 8;

/// One coordinate of some points, and a cache line that is not used: columns at distances of a
/// power of 2 would share few sets of the cache.
type Column = [f64; POINTS + LINE];

/// Some dimensions of a point set.
pub(super) struct Columns {
    /// How many dimensions.
    pub(super) dimensions: usize,
    /// The points.
    pub(super) points: PointSet,
}

impl Sequence for Columns {
    fn fill(&self, first_index: u64, points: &mut [f64]) {
        let mut columns = vec![[0.0; POINTS + LINE]; self.dimensions.min(TILE)];
        for Part { first_index, points } in
            (Part { first_index, points }).split(self.dimensions, POINTS)
        {
            let count = points.len() / self.dimensions;
            for first in (0..self.dimensions).step_by(TILE) {
                let columns = &mut columns[..TILE.min(self.dimensions - first)];
                for (dimension, column) in (first as u32..).zip(&mut *columns) {
                    self.points.fill(dimension, first_index, &mut column[..count]);
                }
                let end = first + columns.len();
                for (row, place) in points.chunks_exact_mut(self.dimensions).zip(0..POINTS) {
                    gather(columns, place, &mut row[first..end]);
                }
            }
        }
    }
}

/// Writes one place of each column into a row.
#[inline(always)]
fn gather(columns: &[Column], place: usize, row: &mut [f64]) {
    let (lines, rest) = row.as_chunks_mut::<LINE>();
    let (line_columns, rest_columns) = columns.as_chunks::<LINE>();
    for (line, columns) in lines.iter_mut().zip(line_columns) {
        *line = columns.each_ref().map(|column| column[place]);
    }
    for (coordinate, column) in rest.iter_mut().zip(rest_columns) {
        *coordinate = column[place];
    }
}
