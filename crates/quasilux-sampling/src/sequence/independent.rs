//! Pseudo-random points with random access: a counter-based generator.
//!
//! Coordinate (i, j) is a keyed bijection of the counter i, its key a hash of the point set's key
//! and j. As in J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw, "Parallel random numbers: as
//! easy as 1, 2, 3" (SC 2011) there is no state. Two rounds of mixing, with another key before
//! each: one round is SplitMix, whose streams are shifts of one another.

use crate::hash::{GOLDEN, dimension_key, mix};

/// 64 random bits of one coordinate.
#[inline(always)]
pub(crate) fn independent_digits(key: u64, index: u64, dimension: u32) -> u64 {
    let key = dimension_key(key, dimension);
    let word = mix(index.wrapping_mul(GOLDEN).wrapping_add(key));
    mix(word ^ key.rotate_left(32))
}
