//! One randomised sequence.

use crate::hash::{dimension_key, mix};
use crate::randomization::{OwenKey, shift, shuffle_index};
use crate::sequence::{SobolMatrices, random_digits};
use crate::{Randomization, Sequence};

/// One randomised sequence: a pure function (index, dimension) -> [0, 1).
///
/// Small and `Copy`; point sets with the same arguments are the same on every machine.
#[derive(Clone, Copy)]
pub struct PointSet {
    generator: Generator,
    randomization: Randomization,
    key: u64,
}

#[derive(Clone, Copy)]
enum Generator {
    Sobol(&'static SobolMatrices),
    Random,
}

/// Stands in for the key where an unrandomised sequence is padded.
const PADDING_KEY: u64 = 0x7061_6464_696e_6721;

impl PointSet {
    /// A sequence, randomised under a key from [`stream_key`](crate::stream_key).
    ///
    /// [`Randomization::None`] ignores the key. [`Sequence::Random`] is random already: it uses the
    /// key and ignores the randomisation.
    #[must_use]
    pub fn new(sequence: Sequence, randomization: Randomization, key: u64) -> Self {
        let generator = match sequence {
            Sequence::Sobol => Generator::Sobol(SobolMatrices::get()),
            Sequence::Random => Generator::Random,
        };
        Self { generator, randomization, key }
    }

    /// The sequence.
    #[must_use]
    pub const fn sequence(&self) -> Sequence {
        match self.generator {
            Generator::Sobol(_) => Sequence::Sobol,
            Generator::Random => Sequence::Random,
        }
    }

    /// The randomisation.
    #[must_use]
    pub const fn randomization(&self) -> Randomization {
        self.randomization
    }

    /// A coordinate in [0, 1) of 53 bits; both numbers count from 0.
    ///
    /// Past the last dimension of the sequence (Sobol': 1024) come its dimensions again, each time
    /// with the indices shuffled in aligned blocks of 2^m and the digits scrambled, independently
    /// of all that came before, also where the sequence itself is not randomised.
    #[inline]
    #[must_use]
    pub fn coordinate(&self, index: u64, dimension: u32) -> f64 {
        let digits = match self.generator {
            Generator::Sobol(matrices) if dimension < SobolMatrices::DIMENSIONS => {
                self.randomize(matrices.digits(index, dimension), dimension)
            }
            Generator::Sobol(matrices) => self.padded_sobol_digits(matrices, index, dimension),
            Generator::Random => random_digits(self.key, index, dimension),
        };
        unit_from_digits(digits)
    }

    #[inline]
    fn randomize(&self, digits: u64, dimension: u32) -> u64 {
        match self.randomization {
            Randomization::None => digits,
            Randomization::Shift => shift(digits, self.key, dimension),
            Randomization::Owen => owen(digits, self.key, dimension),
        }
    }

    /// Without the shuffle, dimensions j and j + 1024 would share their digits up to flips: a
    /// diagonal.
    #[cold]
    fn padded_sobol_digits(&self, matrices: &SobolMatrices, index: u64, dimension: u32) -> u64 {
        let copy = dimension / SobolMatrices::DIMENSIONS;
        let key = match self.randomization {
            Randomization::None => PADDING_KEY,
            Randomization::Shift | Randomization::Owen => self.key,
        };
        let shuffled = shuffle_index(index, dimension_key(mix(!key), copy));
        owen(matrices.digits(shuffled, dimension % SobolMatrices::DIMENSIONS), key, dimension)
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

#[inline]
fn owen(digits: u64, key: u64, dimension: u32) -> u64 {
    OwenKey::new(dimension_key(key, dimension)).scramble(digits)
}

/// The number 0.d1 d2 d3 .. in base 2, cut after 53 digits; d1 is in bit 0.
#[inline]
fn unit_from_digits(digits: u64) -> f64 {
    const STEP: f64 = 1.0 / (1_u64 << 53) as f64;
    (digits.reverse_bits() >> 11) as f64 * STEP
}
