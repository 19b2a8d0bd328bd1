//! The radical inverse in any base (J. G. van der Corput, "Verteilungsfunktionen", 1935).

use crate::unit::ONE_BELOW;

/// The digits of `index` in a base, mirrored at the point: d0 + d1 b + d2 b^2 + .. becomes d0 / b +
/// d1 / b^2 + d2 / b^3 + ..
///
/// Correctly rounded where `index` times `base` is below 2^53, else to 2^-52 relative; never 1. The
/// N numbers of the first N indices are as even as N numbers of a sequence can be, up to a
/// constant: the star discrepancy is O(log N / N). A base below 2 counts as 2.
///
/// ```
/// use quasilux_sampling::radical_inverse;
/// assert_eq!(radical_inverse(10, 1234), 0.4321);
/// assert_eq!(radical_inverse(3, 5), 7.0 / 9.0);
/// ```
#[must_use]
pub fn radical_inverse(base: u32, index: u64) -> f64 {
    let base = u64::from(base.max(2));
    if base == 2 {
        return crate::unit::unit_from_word(index.reverse_bits());
    }
    if index > u64::MAX / base {
        return long_radical_inverse(base, index);
    }
    let (mut rest, mut reversed, mut power) = (index, 0, 1);
    while rest != 0 {
        let (quotient, digit) = (rest / base, rest % base);
        reversed = reversed * base + digit;
        power *= base;
        rest = quotient;
    }
    (reversed as f64 / power as f64).min(ONE_BELOW)
}

/// The same where b^n, n digits, may pass 2^64; it stays below 2^96.
#[cold]
fn long_radical_inverse(base: u64, index: u64) -> f64 {
    let (mut rest, mut reversed, mut power) = (index, 0_u128, 1_u128);
    while rest != 0 {
        reversed = reversed * u128::from(base) + u128::from(rest % base);
        power *= u128::from(base);
        rest /= base;
    }
    (reversed as f64 / power as f64).min(ONE_BELOW)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The slow twin: Horner's scheme from the last digit on, one division a digit.
    fn slow_radical_inverse(base: u32, index: u64) -> f64 {
        let mut digits = Vec::new();
        let mut rest = index;
        while rest != 0 {
            digits.push((rest % u64::from(base)) as f64);
            rest /= u64::from(base);
        }
        let add = |sum, digit| (sum + digit) / f64::from(base);
        digits.into_iter().rev().fold(0.0, add)
    }

    #[test]
    fn equals_the_slow_twin() {
        for base in (2..100).chain([256, 1000, 8161, 65_536, u32::MAX]) {
            for step in 0..2000 {
                let index = crate::hash::mix(step) >> (step % 64);
                let (fast, slow) =
                    (radical_inverse(base, index), slow_radical_inverse(base, index));
                assert!((fast - slow).abs() <= 1e-15, "{index} in base {base}: {fast}, {slow}");
                assert!((0.0..1.0).contains(&fast));
            }
        }
    }

    #[test]
    fn extreme_arguments_have_values() {
        for base in [0, 1, 2, 3, 8161, u32::MAX] {
            for index in [0, 1, 1 << 53, u64::MAX - 1, u64::MAX] {
                assert!((0.0..1.0).contains(&radical_inverse(base, index)));
            }
        }
    }
}
