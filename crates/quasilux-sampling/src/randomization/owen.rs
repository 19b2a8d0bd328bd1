//! Owen's nested uniform scrambling by hashing, on whole 64-bit words.
//!
//! A. B. Owen, "Randomly permuted (t, m, s)-nets and (t, s)-sequences" (1995): digit k is flipped
//! by a random bit that is drawn anew for each value of the digits 1 .. k - 1. S. Laine and T.
//! Karras, "Stratified sampling for stochastic transparency" (EGSR 2011): with the first digit in
//! bit 0, sums, products and `x ^= x * even`, in which no bit depends on a higher one, are such
//! scrambles. B. Burley, "Practical hash-based Owen scrambling" (JCGT 9, 2020).
//!
//! Deviation: their multipliers are constants and the key enters by sums alone, which binds the
//! flips of the first levels to each other (of the 8 ways to flip two levels such a sum reaches 4).
//! Here the multipliers come from the key as well, and between them each digit is flipped by a sum
//! of all products of the three digits before it, each term with a key bit of its own. The tests
//! find all 2^15 ways to flip four levels equally likely, and all joint positions of two points;
//! the variance of an estimate depends on pairs alone (J. Matousek, "On the L2-discrepancy for
//! anchored boxes", J. Complexity 14, 1998).

use crate::hash::{GOLDEN, mix};

/// One scramble: a uniform random element of a family close to all nested flips.
#[derive(Clone, Copy)]
pub(crate) struct OwenKey {
    pub(super) first: u64,
    pub(super) second: u64,
}

impl OwenKey {
    /// The scramble of a key; `key` must be well mixed.
    #[inline(always)]
    pub(crate) const fn new(key: u64) -> Self {
        Self { first: key, second: mix(key.wrapping_add(GOLDEN)) }
    }

    /// The scrambled digits; digit 1 is in bit 0 before and after.
    #[inline(always)]
    pub(crate) const fn scramble(self, digits: u64) -> u64 {
        let Self { first, second } = self;
        let mut x = digits.wrapping_add(first);
        x ^= x.wrapping_mul(short_even(second));
        x = x.wrapping_mul(first.rotate_right(32) | 1);
        x ^= self.flips_by_three_digits(x);
        x ^= x.wrapping_mul(short_even(first.rotate_right(48)));
        x ^ second.rotate_right(56)
    }

    /// For each digit, a random Boolean function of the three before it, in algebraic normal form;
    /// its constant is in the last step of the scramble.
    #[inline(always)]
    const fn flips_by_three_digits(self, x: u64) -> u64 {
        let Self { first, second } = self;
        let (p, q, r) = (x << 1, x << 2, x << 3);
        let with_p = second.rotate_right(16)
            ^ (q & (second.rotate_right(32) ^ (r & second.rotate_right(48))))
            ^ (r & first.rotate_right(20));
        let with_q = first.rotate_right(8) ^ (r & first.rotate_right(40));
        (p & with_p) ^ (q & with_q) ^ (r & second.rotate_right(8))
    }
}

/// An even multiplier of 32 bits: vector units multiply by it at two thirds of the cost.
#[inline(always)]
pub(super) const fn short_even(word: u64) -> u64 {
    word & 0xffff_fffe
}

/// A permutation of the indices that maps each aligned block of 2^m onto an aligned block of 2^m:
/// the nested scramble of the index, most significant bit first.
#[inline(always)]
pub(crate) const fn shuffle_index(index: u64, key: u64) -> u64 {
    OwenKey::new(key).scramble(index.reverse_bits()).reverse_bits()
}
