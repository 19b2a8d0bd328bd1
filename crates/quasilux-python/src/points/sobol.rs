//! The Sobol' sequence in the order of Gray's code, in all dimensions that Joe and Kuo have numbers
//! for.
//!
//! I. A. Antonov and V. M. Saleev, "An economic method of computing LP-tau-sequences" (USSR Comput.
//! Math. Math. Phys. 19, 1979): point i is the one with index i ^ (i >> 1) in natural order, so
//! that two successive points differ by one column of each matrix. Aligned blocks of 2^m points are
//! the same in both orders. Gray's code is linear, so the digits of the points of any aligned block
//! differ from those of its first point as those of the first block do from zero.

use super::rows::{Part, Sequence};
use quasilux_sampling::{PointSet, RowRandomizer, sobol_columns, stream_key};
use std::ops::Range;

/// The rows of the table: `d s a m_1 .. m_s`, d from 2 on.
const DIRECTION_NUMBERS: &str = include_str!("joe_kuo_21201.txt");

/// How many dimensions there are.
pub(super) const DIMENSIONS: usize = 21_201;

/// This many points at least are made at once: an aligned block of indices.
const BLOCK: usize = 256;
/// This many coordinates at least are made at once.
const COORDINATES: usize = 2048;
/// This many dimensions at most are made at once: the digits of a block stay in the cache.
const TILE: usize = 64;
/// This many points at most are made of a tile before the next, where there are several.
const POINTS_OF_TILE: usize = 16 * BLOCK;

/// A Sobol' sequence of some dimensions.
pub(super) struct Sobol {
    dimensions: usize,
    /// Column k of the matrices of all dimensions: the digits of index 2^k, first digit in bit 0.
    columns: [Vec<u64>; 64],
    /// Randomises the digits.
    points: PointSet,
}

impl Sobol {
    /// The first dimensions of the table, at most [`DIMENSIONS`], randomised as `points` are.
    pub(super) fn new(dimensions: usize, points: PointSet) -> Self {
        Self::from_matrices(matrices(dimensions), points)
    }

    /// The same with each matrix multiplied from the left by a random lower triangular one, before
    /// the points are randomised: J. Matousek, "On the L2-discrepancy for anchored boxes" (J.
    /// Complexity 14, 1998), with a digital shift. Pairs of points, and so the variances of
    /// estimates, are distributed as under nested scrambling.
    pub(super) fn with_linear_scrambling(dimensions: usize, points: PointSet, key: u64) -> Self {
        let scrambled = matrices(dimensions).zip(0_u32..).map(|(matrix, dimension)| {
            let triangular: [u64; 64] =
                std::array::from_fn(|k| (stream_key(key, dimension, k as u64) | 1) << k);
            matrix.map(|column| product(&triangular, column))
        });
        Self::from_matrices(scrambled, points)
    }

    fn from_matrices(matrices: impl Iterator<Item = [u64; 64]>, points: PointSet) -> Self {
        let matrices: Vec<[u64; 64]> = matrices.collect();
        let columns = std::array::from_fn(|k| matrices.iter().map(|matrix| matrix[k]).collect());
        Self { dimensions: matrices.len(), columns, points }
    }
}

/// Some dimensions of a sequence.
struct Tile<'a> {
    sobol: &'a Sobol,
    dimensions: Range<usize>,
    randomizer: RowRandomizer,
}

impl<'a> Tile<'a> {
    fn new(sobol: &'a Sobol, dimensions: Range<usize>) -> Self {
        let first = dimensions.start as u32;
        let randomizer = sobol.points.row_randomizer(first, dimensions.len());
        Self { sobol, dimensions, randomizer }
    }

    /// Adds a column of each matrix.
    fn add_column(&self, k: u32, sum: &mut [u64]) {
        for (sum, digits) in sum.iter_mut().zip(&self.sobol.columns[k as usize][self.range()]) {
            *sum ^= digits;
        }
    }

    fn range(&self) -> Range<usize> {
        self.dimensions.clone()
    }

    /// The digits of a point.
    fn digits(&self, index: u64) -> Vec<u64> {
        let mut digits = vec![0; self.dimensions.len()];
        let mut rest = index ^ (index >> 1);
        while rest != 0 {
            self.add_column(rest.trailing_zeros(), &mut digits);
            rest &= rest - 1;
        }
        digits
    }

    /// The digits of `count` successive points, point after point.
    fn walk(&self, first_index: u64, count: usize) -> Vec<u64> {
        let mut current = self.digits(first_index);
        let mut digits = Vec::with_capacity(count * current.len());
        for step in 1..=count as u64 {
            digits.extend_from_slice(&current);
            // The lowest bit of the next index is the one in which its Gray code differs.
            let next = first_index.wrapping_add(step);
            if next != 0 {
                self.add_column(next.trailing_zeros(), &mut current);
            }
        }
        digits
    }

    fn fill(&self, part: Part<'_>) {
        let width = self.dimensions.len();
        let count = part.points.len() / self.sobol.dimensions;
        let block = BLOCK.max((COORDINATES / width).next_power_of_two());
        if count < block {
            let digits = self.walk(part.first_index, count);
            return self.write(&digits, &vec![0; width], part.points);
        }
        let digits = self.walk(0, block);
        let (mut index, mut rest) = (part.first_index, part.points);
        while !rest.is_empty() {
            let offset = (index % block as u64) as usize;
            let length = (block - offset).min(rest.len() / self.sobol.dimensions);
            let (points, after) = rest.split_at_mut(length * self.sobol.dimensions);
            let common = self.digits(index - offset as u64);
            self.write(&digits[offset * width..], &common, points);
            (index, rest) = (index.wrapping_add(length as u64), after);
        }
    }

    /// Writes the coordinates of these dimensions into the rows of some points.
    fn write(&self, digits: &[u64], common: &[u64], points: &mut [f64]) {
        let (width, row_width) = (self.dimensions.len(), self.sobol.dimensions);
        if width == row_width {
            return self.randomizer.randomize(digits, common, points);
        }
        let mut coordinates = vec![0.0; points.len() / row_width * width];
        self.randomizer.randomize(digits, common, &mut coordinates);
        let rows = points.chunks_exact_mut(row_width);
        for (row, coordinates) in rows.zip(coordinates.chunks_exact(width)) {
            row[self.range()].copy_from_slice(coordinates);
        }
    }
}

impl Sequence for Sobol {
    fn fill(&self, first_index: u64, points: &mut [f64]) {
        let count = if self.dimensions <= TILE { usize::MAX } else { POINTS_OF_TILE };
        let all = Part { first_index, points };
        for Part { first_index, points } in all.split(self.dimensions, count) {
            for first in (0..self.dimensions).step_by(TILE) {
                let tile = Tile::new(self, first..self.dimensions.min(first + TILE));
                tile.fill(Part { first_index, points: &mut *points });
            }
        }
    }
}

/// A matrix times a vector of digits.
fn product(columns: &[u64; 64], digits: u64) -> u64 {
    let (mut rest, mut sum) = (digits, 0);
    while rest != 0 {
        sum ^= columns[rest.trailing_zeros() as usize];
        rest &= rest - 1;
    }
    sum
}

/// The matrices of the first dimensions.
fn matrices(dimensions: usize) -> impl Iterator<Item = [u64; 64]> {
    let rows = DIRECTION_NUMBERS.lines().filter(|line| !line.starts_with('#')).map(matrix);
    std::iter::once(sobol_columns(0, &[1; 64])).chain(rows).take(dimensions)
}

/// The matrix of a row of the table.
fn matrix(row: &str) -> [u64; 64] {
    let mut numbers = row.split(' ').map(|field| field.parse().expect("integers"));
    let mut next = || numbers.next().expect("d s a m_1 .. m_s");
    let (_dimension, degree, inner_coefficients) = (next(), next() as usize, next());
    let mut initial = [0; 64];
    initial[..degree].fill_with(next);
    sobol_columns(inner_coefficients, &initial[..degree])
}
