//! One randomised point set with random access.

use crate::hash::{GOLDEN, dimension_key, mix};
use crate::randomization::{
    OwenKey, Randomization, digital_shift, nested_radical_inverse, rotate_unit, rotate_word,
    shifted_radical_inverse, shuffle_index,
};
use crate::sequence::{
    BinaryMatrices, Radix, Sequence, faure4, halton, hammersley, independent_digits, sobol,
};
use crate::unit::{unit_from_digits, unit_from_word};
use crate::variation::{Change, Variation};

/// One randomised sequence: a pure function (index, dimension) -> [0, 1).
///
/// Small and `Copy`; point sets with the same arguments are the same on every machine.
#[derive(Clone, Copy)]
pub struct PointSet {
    sequence: Sequence,
    pub(crate) generator: Generator,
    randomization: Randomization,
    pub(crate) key: u64,
}

/// How coordinates are made.
#[derive(Clone, Copy)]
pub(crate) enum Generator {
    /// A matrix over bits for each dimension.
    Binary(&'static BinaryMatrices),
    /// A base for each dimension, after `steps` dimensions of equal steps (none or one).
    Radical { bases: &'static [Radix], steps: Option<u64> },
    /// A hash.
    Independent,
    /// Other coordinates in some dimensions.
    Varied(Variation),
}

/// Stands in for the key where an unrandomised sequence is padded.
const PADDING_KEY: u64 = 0x7061_6464_696e_6721;

impl PointSet {
    /// A sequence, randomised under a key from [`stream_key`](crate::stream_key).
    ///
    /// [`Randomization::None`] ignores the key. [`Sequence::Independent`] is random already: it
    /// uses the key and ignores the randomisation.
    #[must_use]
    pub fn new(sequence: Sequence, randomization: Randomization, key: u64) -> Self {
        let radical = |steps| Generator::Radical { bases: halton::bases(), steps };
        let generator = match sequence {
            Sequence::Sobol => Generator::Binary(sobol::matrices()),
            Sequence::Faure4 => Generator::Binary(faure4::matrices()),
            Sequence::Halton => radical(None),
            Sequence::Hammersley { points } => radical(Some(points)),
            Sequence::Independent => Generator::Independent,
        };
        Self { sequence, generator, randomization, key }
    }

    /// The sequence.
    #[must_use]
    pub const fn sequence(&self) -> Sequence {
        self.sequence
    }

    /// The randomisation.
    #[must_use]
    pub const fn randomization(&self) -> Randomization {
        self.randomization
    }

    /// The same sequence, randomised independently: what a child of a split sample takes its
    /// coordinates from. `branch` is the key of the way that leads to it.
    ///
    /// Where the sequence itself is not randomised the branch is, by Owen's scrambling: there is no
    /// other copy of an unrandomised sequence.
    #[inline]
    #[must_use]
    pub fn branch(&self, branch: u64) -> Self {
        let randomization = match self.randomization {
            Randomization::None => Randomization::Owen,
            chosen => chosen,
        };
        let key = mix(mix(self.key ^ GOLDEN) ^ mix(branch));
        match self.generator {
            Generator::Varied(_) => Self::new(self.sequence, randomization, key),
            _ => Self { randomization, key, ..*self },
        }
    }

    /// A coordinate in [0, 1) of 53 bits (Halton under shift or scrambling: of 51 or more); both
    /// numbers count from 0.
    ///
    /// Past the last dimension of Sobol' (1024) and of the base-4 sequence (4) come their
    /// dimensions again, each time with the indices shuffled in aligned blocks of 2^m and the
    /// digits scrambled, independently of all that came before, also where the sequence itself is
    /// not randomised. Halton's and Hammersley's dimensions past the first 1024 bases (2 to 8161)
    /// are pseudo-random.
    #[inline]
    #[must_use]
    pub fn coordinate(&self, index: u64, dimension: u32) -> f64 {
        match self.generator {
            Generator::Binary(matrices) if dimension < matrices.dimensions() => {
                let digits = matrices.digits(index, dimension);
                match self.randomization {
                    Randomization::None => unit_from_digits(digits),
                    Randomization::CranleyPattersonRotation => {
                        unit_from_word(rotate_word(digits.reverse_bits(), self.key, dimension))
                    }
                    Randomization::DigitalShift => {
                        unit_from_digits(digital_shift(digits, self.key, dimension))
                    }
                    Randomization::Owen => unit_from_digits(self.owen(dimension).scramble(digits)),
                }
            }
            Generator::Binary(matrices) => self.padded_coordinate(matrices, index, dimension),
            Generator::Radical { bases, steps } => {
                self.radical_coordinate(bases, steps, index, dimension)
            }
            Generator::Independent => {
                unit_from_word(independent_digits(self.key, index, dimension))
            }
            Generator::Varied(variation) => self.varied_coordinate(variation, index, dimension),
        }
    }

    /// The base in which a dimension of the sequence itself has digits.
    pub(crate) fn digit_base(&self, dimension: u32) -> Option<u32> {
        match self.generator {
            Generator::Binary(matrices) => (dimension < matrices.dimensions()).then_some(2),
            Generator::Radical { bases, steps: None } => {
                bases.get(dimension as usize).map(Radix::base)
            }
            Generator::Radical { bases, .. } => {
                bases.get(dimension.checked_sub(1)? as usize).map(Radix::base)
            }
            Generator::Independent | Generator::Varied(_) => None,
        }
    }

    /// The scramble of one dimension.
    #[inline(always)]
    pub(crate) fn owen(&self, dimension: u32) -> OwenKey {
        let key = dimension_key(self.padding_key(), dimension);
        OwenKey::new(key)
    }

    /// The key of the shuffle of the indices before copy `copy` of the dimensions of a sequence.
    pub(crate) fn shuffle_key(&self, copy: u32) -> u64 {
        dimension_key(mix(!self.padding_key()), copy)
    }

    #[inline(always)]
    const fn padding_key(&self) -> u64 {
        match self.randomization {
            Randomization::None => PADDING_KEY,
            Randomization::CranleyPattersonRotation
            | Randomization::DigitalShift
            | Randomization::Owen => self.key,
        }
    }

    /// Without the shuffle, dimensions j and j + 1024 would share their digits up to flips: a
    /// diagonal.
    #[inline(never)]
    fn padded_coordinate(&self, matrices: &BinaryMatrices, index: u64, dimension: u32) -> f64 {
        let (copy, original) =
            (dimension / matrices.dimensions(), dimension % matrices.dimensions());
        let digits = matrices.digits(shuffle_index(index, self.shuffle_key(copy)), original);
        unit_from_digits(self.owen(dimension).scramble(digits))
    }

    #[inline(never)]
    fn radical_coordinate(
        &self,
        bases: &[Radix],
        steps: Option<u64>,
        index: u64,
        dimension: u32,
    ) -> f64 {
        let place = match steps {
            Some(points) if dimension == 0 => {
                return hammersley::step(points, index, self.randomization, self.key);
            }
            Some(_) => dimension - 1,
            None => dimension,
        };
        let Some(radix) = bases.get(place as usize) else {
            return unit_from_word(independent_digits(self.padding_key(), index, dimension));
        };
        let (base, key) = (radix.base(), dimension_key(self.key, dimension));
        match self.randomization {
            Randomization::None => radix.inverse(index),
            Randomization::CranleyPattersonRotation => {
                rotate_unit(radix.inverse(index), self.key, dimension)
            }
            // In base 2 the index is its own row of digits.
            Randomization::DigitalShift if base == 2 => unit_from_digits(index ^ key),
            Randomization::Owen if base == 2 => unit_from_digits(OwenKey::new(key).scramble(index)),
            Randomization::DigitalShift => shifted_radical_inverse(base, index, key),
            Randomization::Owen => nested_radical_inverse(base, index, key),
        }
    }

    /// A coordinate of varied points.
    #[inline(never)]
    pub(crate) fn varied_coordinate(
        &self,
        variation: Variation,
        index: u64,
        dimension: u32,
    ) -> f64 {
        let under = |key| Self::new(self.sequence(), self.randomization(), key);
        let own = || under(self.key).coordinate(index, dimension);
        if !(variation.first..variation.end).contains(&dimension) {
            return own();
        }
        match variation.change {
            Change::Exchange { key } => under(key).coordinate(index, dimension),
            Change::Move { by } => {
                let coordinate = own();
                if coordinate + by < 1.0 { coordinate + by } else { coordinate - by }
            }
        }
    }
}

impl std::fmt::Debug for PointSet {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("PointSet")
            .field("sequence", &self.sequence())
            .field("randomization", &self.randomization)
            .field("key", &self.key)
            .finish()
    }
}
