//! Random rotation (R. Cranley and T. N. L. Patterson, "Randomization of number theoretic methods
//! for multiple integration", SIAM J. Numer. Anal. 13, 1976): one random number a dimension is
//! added modulo 1. Made for lattices; a net keeps its discrepancy up to a constant, but its cells
//! move off the grid, so that up to 2^s of them share what one held.

use crate::hash::dimension_key;
use crate::unit::unit_from_word;

/// The rotated form of a fraction of 2^64.
#[inline(always)]
pub(crate) const fn rotate_word(word: u64, key: u64, dimension: u32) -> u64 {
    word.wrapping_add(dimension_key(key, dimension))
}

/// The rotated form of a number in [0, 1).
#[inline]
pub(crate) fn rotate_unit(u: f64, key: u64, dimension: u32) -> f64 {
    let sum = u + unit_from_word(dimension_key(key, dimension));
    if sum < 1.0 { sum } else { sum - 1.0 }
}
