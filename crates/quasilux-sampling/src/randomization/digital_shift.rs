//! Random digital shift in base 2 (P. L'Ecuyer and C. Lemieux, "Recent advances in randomized
//! quasi-Monte Carlo methods", 2002): an exclusive or with one random word a dimension. It keeps
//! every net and its defects alike.

use crate::hash::dimension_key;

/// The shifted digits of a coordinate.
#[inline(always)]
pub(crate) fn digital_shift(digits: u64, key: u64, dimension: u32) -> u64 {
    digits ^ dimension_key(key, dimension)
}
