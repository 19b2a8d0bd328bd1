//! Coordinates of consecutive points at once.
//!
//! In an aligned block of 256 indices the digits of a coordinate differ from those of the first
//! index by a table of the dimension, since the matrices are linear. What follows is the same
//! arithmetic on each element, which the compiler turns into vectors: `fearless_simd` picks the
//! widest instruction set of the machine and compiles the loop for each. Integers and one exact
//! subtraction: the result is the same in all.

mod rows;

pub use rows::RowRandomizer;

use fearless_simd::{Level, Simd, dispatch};

use crate::point_set::{Generator, PointSet};
use crate::randomization::{Randomization, digital_shift, rotate_word, shuffle_index};
use crate::sequence::{BinaryMatrices, independent_digits};
use crate::unit::{unit_from_digits, unit_from_word};

/// Shorter fills do not repay the table.
const SHORTEST: usize = 32;

impl PointSet {
    /// Coordinate `dimension` of the points `first_index`, `first_index` + 1, ..: what
    /// [`coordinate`](Self::coordinate) gives, bit for bit; for Sobol', the base-4 sequence and
    /// pseudo-random points several times faster, for Halton's and Hammersley's points no faster.
    ///
    /// ```
    /// use quasilux_sampling::{PointSet, Randomization, Sequence, stream_key};
    /// let points = PointSet::new(Sequence::Sobol, Randomization::Owen, stream_key(1, 0, 0));
    /// let mut coordinates = [0.0; 1000];
    /// points.fill(3, 1 << 40, &mut coordinates);
    /// assert_eq!(coordinates[7], points.coordinate((1 << 40) + 7, 3));
    /// ```
    pub fn fill(&self, dimension: u32, first_index: u64, coordinates: &mut [f64]) {
        let (level, key) = (Level::new(), self.key);
        match self.generator {
            Generator::Binary(matrices) if coordinates.len() >= SHORTEST => {
                self.fill_binary(level, matrices, dimension, first_index, coordinates);
            }
            Generator::Independent => map_indices(
                level,
                first_index,
                coordinates,
                #[inline(always)]
                move |index| unit_from_word(independent_digits(key, index, dimension)),
            ),
            Generator::Binary(_) | Generator::Radical { .. } | Generator::Varied(_) => {
                for (offset, coordinate) in (0..).zip(coordinates) {
                    *coordinate = self.coordinate(first_index.wrapping_add(offset), dimension);
                }
            }
        }
    }

    /// Coordinate `dimension` of the points of these indices, as many as there is room for: what
    /// [`coordinate`](Self::coordinate) gives, bit for bit; faster for dimensions of Sobol' and of
    /// the base-4 sequence, whose digits are randomised in vectors.
    ///
    /// ```
    /// use quasilux_sampling::{PointSet, Randomization, Sequence, stream_key};
    /// let points = PointSet::new(Sequence::Sobol, Randomization::Owen, stream_key(1, 0, 0));
    /// let mut coordinates = [0.0; 2];
    /// points.fill_at(3, &[7, 1 << 40], &mut coordinates);
    /// assert_eq!(coordinates, [7, 1 << 40].map(|index| points.coordinate(index, 3)));
    /// ```
    pub fn fill_at(&self, dimension: u32, indices: &[u64], coordinates: &mut [f64]) {
        match self.generator {
            Generator::Binary(matrices) if dimension < matrices.dimensions() => {
                let level = Level::new();
                let mut digits = [0; 256];
                for (indices, block) in indices.chunks(256).zip(coordinates.chunks_mut(256)) {
                    for (digits, index) in digits.iter_mut().zip(indices) {
                        *digits = matrices.digits(*index, dimension);
                    }
                    self.randomize_block(level, &digits[..indices.len()], 0, dimension, block);
                }
            }
            Generator::Binary(_)
            | Generator::Radical { .. }
            | Generator::Independent
            | Generator::Varied(_) => {
                for (coordinate, index) in coordinates.iter_mut().zip(indices) {
                    *coordinate = self.coordinate(*index, dimension);
                }
            }
        }
    }

    /// Coordinates from binary digits of one's own, the first (1/2) in bit 0, randomised as those
    /// of a dimension of this point set are: for digital sequences in base 2 that are not among
    /// [`Sequence`](crate::Sequence), and for Sobol' past 1024 dimensions without copies.
    ///
    /// Each coordinate is made from one element of `digits`, exclusive or `common`: matrices are
    /// linear, so the digits of an aligned block of indices differ from those of its first by a
    /// table. As many as the shorter slice has.
    ///
    /// ```
    /// use quasilux_sampling::{PointSet, Randomization, Sequence, sobol_columns, stream_key};
    /// let points = PointSet::new(Sequence::Sobol, Randomization::Owen, stream_key(1, 0, 0));
    /// let columns = sobol_columns(0, &[1]);
    /// let digits = [0, columns[0], columns[1], columns[0] ^ columns[1]];
    /// let mut coordinates = [0.0; 4];
    /// points.randomize_digits(1, &digits, 0, &mut coordinates);
    /// assert_eq!(coordinates, [0, 1, 2, 3].map(|index| points.coordinate(index, 1)));
    /// ```
    pub fn randomize_digits(
        &self,
        dimension: u32,
        digits: &[u64],
        common: u64,
        coordinates: &mut [f64],
    ) {
        self.randomize_block(Level::new(), digits, common, dimension, coordinates);
    }

    /// Whether [`fill_at`](Self::fill_at) is faster than one coordinate at a time, so that some
    /// made in vain do not matter.
    #[must_use]
    pub fn fills_lists_fast(&self) -> bool {
        matches!(self.generator, Generator::Binary(_))
    }

    /// Several dimensions of the same points, one slice each: `first_dimension` into the first,
    /// the next into the second, ..
    ///
    /// ```
    /// use quasilux_sampling::{PointSet, Randomization, Sequence};
    /// let points = PointSet::new(Sequence::Halton, Randomization::None, 0);
    /// let mut columns = [0.0; 3 * 8];
    /// points.fill_dimensions(0, 0, columns.chunks_mut(8));
    /// let second = [columns[1], columns[8 + 1], columns[16 + 1]];
    /// assert_eq!(second, [1.0 / 2.0, 1.0 / 3.0, 1.0 / 5.0]);
    /// ```
    pub fn fill_dimensions<'a>(
        &self,
        first_dimension: u32,
        first_index: u64,
        columns: impl IntoIterator<Item = &'a mut [f64]>,
    ) {
        for (dimension, column) in (first_dimension..=u32::MAX).zip(columns) {
            self.fill(dimension, first_index, column);
        }
    }

    fn fill_binary(
        &self,
        level: Level,
        matrices: &BinaryMatrices,
        dimension: u32,
        first_index: u64,
        coordinates: &mut [f64],
    ) {
        let original = dimension % matrices.dimensions();
        let table = matrices.block_digits(original);
        let shuffle = (dimension >= matrices.dimensions())
            .then(|| self.shuffle_key(dimension / matrices.dimensions()));
        let (mut index, mut rest) = (first_index, coordinates);
        while !rest.is_empty() {
            let offset = (index % 256) as usize;
            let (block, after) = rest.split_at_mut(rest.len().min(256 - offset));
            rest = after;
            match shuffle {
                None => {
                    let digits = &table[offset..][..block.len()];
                    let base = matrices.digits(index & !255, original);
                    self.randomize_block(level, digits, base, dimension, block);
                }
                Some(key) => {
                    // The shuffle maps aligned blocks to aligned blocks.
                    let mut digits = [0; 256];
                    let digits = &mut digits[..block.len()];
                    shuffled_digits(level, &table, index, key, digits);
                    let base = matrices.digits(shuffle_index(index, key) & !255, original);
                    self.scramble_block(level, digits, base, dimension, block);
                }
            }
            index = index.wrapping_add(block.len() as u64);
        }
    }

    #[inline]
    fn randomize_block(
        &self,
        level: Level,
        digits: &[u64],
        base: u64,
        dimension: u32,
        block: &mut [f64],
    ) {
        let key = self.key;
        match self.randomization() {
            Randomization::None => {
                map_digits(
                    level,
                    digits,
                    block,
                    #[inline(always)]
                    move |digits| unit_from_digits(digits ^ base),
                );
            }
            Randomization::CranleyPattersonRotation => map_digits(
                level,
                digits,
                block,
                #[inline(always)]
                move |digits| {
                    let word = (digits ^ base).reverse_bits();
                    unit_from_word(rotate_word(word, key, dimension))
                },
            ),
            Randomization::DigitalShift => map_digits(
                level,
                digits,
                block,
                #[inline(always)]
                move |digits| unit_from_digits(digital_shift(digits ^ base, key, dimension)),
            ),
            Randomization::Owen => self.scramble_block(level, digits, base, dimension, block),
        }
    }

    #[inline]
    fn scramble_block(
        &self,
        level: Level,
        digits: &[u64],
        base: u64,
        dimension: u32,
        block: &mut [f64],
    ) {
        let owen = self.owen(dimension);
        map_digits(
            level,
            digits,
            block,
            #[inline(always)]
            move |digits| unit_from_digits(owen.scramble(digits ^ base)),
        );
    }
}

/// The digits of the shuffled indices from `first_index` on, without those that the block shares.
fn shuffled_digits(
    level: Level,
    table: &[u64; 256],
    first_index: u64,
    key: u64,
    digits: &mut [u64],
) {
    #[inline(always)]
    fn shuffle(first_index: u64, key: u64, digits: &mut [u64]) {
        for (offset, digit) in (0..).zip(digits) {
            *digit = shuffle_index(first_index.wrapping_add(offset), key) & 255;
        }
    }
    dispatch!(level, simd => simd.vectorize(
        #[inline(always)]
        || shuffle(first_index, key, digits)
    ));
    for digit in digits {
        *digit = table[*digit as usize];
    }
}

/// `coordinate` owns what it needs: through references the compiler could not tell that writing
/// the block leaves it as it is.
#[inline(always)]
fn map_digits(
    level: Level,
    digits: &[u64],
    block: &mut [f64],
    coordinate: impl Fn(u64) -> f64 + Copy,
) {
    #[inline(always)]
    fn run(digits: &[u64], block: &mut [f64], coordinate: impl Fn(u64) -> f64) {
        for (digits, place) in digits.iter().zip(block) {
            *place = coordinate(*digits);
        }
    }
    dispatch!(level, simd => simd.vectorize(
        #[inline(always)]
        move || run(digits, block, coordinate)
    ));
}

#[inline(always)]
fn map_indices(
    level: Level,
    first_index: u64,
    block: &mut [f64],
    coordinate: impl Fn(u64) -> f64 + Copy,
) {
    #[inline(always)]
    fn run(first_index: u64, block: &mut [f64], coordinate: impl Fn(u64) -> f64) {
        for (offset, place) in (0..).zip(block) {
            *place = coordinate(first_index.wrapping_add(offset));
        }
    }
    dispatch!(level, simd => simd.vectorize(
        #[inline(always)]
        move || run(first_index, block, coordinate)
    ));
}
