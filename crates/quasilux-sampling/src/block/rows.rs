//! Randomised coordinates point after point, from digits in the same order.
//!
//! In a row the dimensions follow each other, so neighbouring coordinates have different keys, in
//! a pattern that repeats after the least common multiple of the number of dimensions and the width
//! of a vector. The keys of the pattern are laid out once, in vectors.

use fearless_simd::{Level, Simd, dispatch};

use crate::point_set::PointSet;
use crate::randomization::{OwenKey, OwenLanes, Randomization, digital_shift, rotate_word};
use crate::unit::{unit_from_digits, unit_from_word};

/// This many coordinates are made at once.
const LANES: usize = 8;
/// Patterns of words have at least this many coordinates.
const MIN_PATTERN: usize = 64;

/// Randomises binary digits of consecutive dimensions, point after point.
///
/// Made by [`PointSet::row_randomizer`].
#[derive(Clone)]
pub struct RowRandomizer {
    dimensions: usize,
    pattern: Pattern,
}

/// What differs between the dimensions.
#[derive(Clone)]
enum Pattern {
    /// Digits that are added without carry.
    Digits(Vec<u64>),
    /// Words that are added to the fractions.
    Words(Vec<u64>),
    /// Nested scrambles.
    Scrambles(Vec<OwenLanes<LANES>>),
}

impl PointSet {
    /// Makes ready to randomise binary digits of one's own, as
    /// [`randomize_digits`](Self::randomize_digits) does, in rows: of `dimensions` dimensions from
    /// `first_dimension` on, all coordinates of a point and then those of the next.
    ///
    /// ```
    /// use quasilux_sampling::{PointSet, Randomization, Sequence, stream_key};
    /// let points = PointSet::new(Sequence::Sobol, Randomization::Owen, stream_key(1, 0, 0));
    /// let mut coordinates = [0.0; 6];
    /// // The digits of points 0 and 1 of Sobol's sequence: 0 and 1/2 in each dimension.
    /// points.row_randomizer(4, 3).randomize(&[0, 0, 0, 1, 1, 1], &[0; 3], &mut coordinates);
    /// assert_eq!(coordinates[2], points.coordinate(0, 6));
    /// assert_eq!(coordinates[3..], [4, 5, 6].map(|dimension| points.coordinate(1, dimension)));
    /// ```
    #[must_use]
    pub fn row_randomizer(&self, first_dimension: u32, dimensions: usize) -> RowRandomizer {
        let numbers = |length| (first_dimension..).take(dimensions).cycle().take(length);
        let words = |word: &dyn Fn(u32) -> u64| {
            let repetitions = MIN_PATTERN.div_ceil(period(dimensions).max(1));
            numbers(period(dimensions) * repetitions).map(word).collect()
        };
        let pattern = match self.randomization() {
            Randomization::None => Pattern::Digits(words(&|_| 0)),
            Randomization::DigitalShift => {
                Pattern::Digits(words(&|dimension| digital_shift(0, self.key, dimension)))
            }
            Randomization::CranleyPattersonRotation => {
                Pattern::Words(words(&|dimension| rotate_word(0, self.key, dimension)))
            }
            Randomization::Owen => {
                let keys: Vec<OwenKey> =
                    numbers(period(dimensions)).map(|dimension| self.owen(dimension)).collect();
                let vectors = keys.as_chunks().0.iter();
                Pattern::Scrambles(vectors.map(|keys| OwenLanes::new(*keys)).collect())
            }
        };
        RowRandomizer { dimensions, pattern }
    }
}

/// After this many coordinates dimensions and vectors begin together again.
fn period(dimensions: usize) -> usize {
    let shared = 1 << dimensions.trailing_zeros().min(LANES.trailing_zeros());
    dimensions * (LANES / shared)
}

impl RowRandomizer {
    /// Coordinates from digits, the first (1/2) in bit 0: each from one element of `digits`,
    /// exclusive or the element of `common` of its dimension. As many as both slices have.
    ///
    /// # Panics
    /// When `common` has not one element for each dimension.
    pub fn randomize(&self, digits: &[u64], common: &[u64], coordinates: &mut [f64]) {
        assert_eq!(common.len(), self.dimensions, "one word for each dimension");
        if common.is_empty() {
            return;
        }
        let mut repeated = vec![0; self.pattern.length()];
        for row in repeated.chunks_exact_mut(common.len()) {
            row.copy_from_slice(common);
        }
        let count = digits.len().min(coordinates.len());
        let (digits, coordinates) = (&digits[..count], &mut coordinates[..count]);
        let rows = Rows { digits, common: &repeated, coordinates };
        let level = Level::new();
        match &self.pattern {
            Pattern::Digits(words) => rows.map(
                level,
                words,
                #[inline(always)]
                |digits, word| unit_from_digits(digits ^ word),
            ),
            Pattern::Words(words) => rows.map(
                level,
                words,
                #[inline(always)]
                |digits, word| unit_from_word(digits.reverse_bits().wrapping_add(word)),
            ),
            Pattern::Scrambles(scrambles) => match &**scrambles {
                // The keys stay in registers.
                [scramble] => {
                    let scramble = [*scramble];
                    dispatch!(level, simd => simd.vectorize(
                        #[inline(always)]
                        move || rows.scramble(&scramble)
                    ));
                }
                scrambles => dispatch!(level, simd => simd.vectorize(
                    #[inline(always)]
                    move || rows.scramble(scrambles)
                )),
            },
        }
    }
}

impl Pattern {
    /// For how many coordinates there are keys.
    fn length(&self) -> usize {
        match self {
            Self::Digits(words) | Self::Words(words) => words.len(),
            Self::Scrambles(scrambles) => scrambles.len() * LANES,
        }
    }
}

/// The common digits are as long as the pattern.
struct Rows<'a> {
    digits: &'a [u64],
    common: &'a [u64],
    coordinates: &'a mut [f64],
}

impl Rows<'_> {
    #[inline(always)]
    fn map(self, level: Level, words: &[u64], coordinate: impl Fn(u64, u64) -> f64 + Copy) {
        let Self { digits, common, coordinates } = self;
        #[inline(always)]
        fn run(
            digits: &[u64],
            common: &[u64],
            words: &[u64],
            coordinates: &mut [f64],
            coordinate: impl Fn(u64, u64) -> f64,
        ) {
            let digits = digits.chunks(words.len());
            for (digits, places) in digits.zip(coordinates.chunks_mut(words.len())) {
                let keys = common.iter().zip(words);
                for ((place, digits), (common, word)) in places.iter_mut().zip(digits).zip(keys) {
                    *place = coordinate(digits ^ common, *word);
                }
            }
        }
        dispatch!(level, simd => simd.vectorize(
            #[inline(always)]
            move || run(digits, common, words, coordinates, coordinate)
        ));
    }

    #[inline(always)]
    fn scramble(self, scrambles: &[OwenLanes<LANES>]) {
        let common = self.common.as_chunks::<LANES>().0;
        let digits = self.digits.chunks(self.common.len());
        for (digits, places) in digits.zip(self.coordinates.chunks_mut(self.common.len())) {
            let (vectors, rest) = digits.as_chunks::<LANES>();
            let (place_vectors, rest_places) = places.as_chunks_mut::<LANES>();
            let mut keys = scrambles.iter().zip(common);
            for ((digits, places), (scrambles, common)) in
                vectors.iter().zip(place_vectors).zip(&mut keys)
            {
                // Written as a whole: the compiler then knows that no key changes in between.
                let mut made = [0.0; LANES];
                for lane in 0..LANES {
                    let digits = digits[lane] ^ common[lane];
                    made[lane] = unit_from_digits(scrambles.scramble(lane, digits));
                }
                *places = made;
            }
            for (lane, (digits, place)) in rest.iter().zip(rest_places).enumerate() {
                if let Some((scrambles, common)) = keys.clone().next() {
                    let digits = digits ^ common[lane];
                    *place = unit_from_digits(scrambles.scramble(lane, digits));
                }
            }
        }
    }
}
