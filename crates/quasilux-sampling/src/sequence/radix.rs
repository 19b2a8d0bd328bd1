//! A base whose radical inverses are made several digits at a time.

use super::radical_inverse::radical_inverse;
use crate::unit::ONE_BELOW;

/// Digits are taken in groups with at most this many values.
const MAX_VALUES: u32 = 256;

/// A base with what its radical inverses take, but for base 2, where bits are reversed: a table of
/// mirrored groups of digits, and a factor in place of the division by their number (D. Lemire, O.
/// Kaser and N. Kurz, "Faster remainder by direct computation", Software: Practice and Experience
/// 49, 2019).
#[derive(Debug)]
pub(crate) struct Radix {
    base: u32,
    /// The power of the base that groups have values below.
    values: u64,
    /// 2^64 over `values`, rounded up: the high half of its product with a number below 2^32 is
    /// that number over `values`, rounded down.
    reciprocal: u64,
    /// Of each group, its digits mirrored; empty where groups are digits.
    mirrored: Box<[u8]>,
}

impl Radix {
    pub(crate) fn new(base: u32) -> Self {
        let mut digits = 1;
        while base.pow(digits + 1) <= MAX_VALUES {
            digits += 1;
        }
        let values = base.pow(digits);
        let mirror = |group: u32| {
            (0..digits).fold((group, 0), |(rest, sum), _| (rest / base, sum * base + rest % base)).1
        };
        let groups = if digits == 1 { 0 } else { values };
        let mirrored = (0..groups).map(|group| mirror(group) as u8).collect();
        let values = u64::from(values);
        Self { base, values, reciprocal: u64::MAX / values + 1, mirrored }
    }

    pub(crate) const fn base(&self) -> u32 {
        self.base
    }

    /// What [`radical_inverse`] gives, bit for bit: below 2^32 all integers are exact, and zeros
    /// past the last digit change numerator and denominator alike.
    #[inline]
    pub(crate) fn inverse(&self, index: u64) -> f64 {
        if self.base == 2 || index > u64::from(u32::MAX) {
            return radical_inverse(self.base, index);
        }
        let (mut rest, mut reversed, mut power) = (index, 0, 1);
        while rest != 0 {
            let quotient = ((u128::from(rest) * u128::from(self.reciprocal)) >> 64) as u64;
            let group = rest - quotient * self.values;
            let mirrored =
                self.mirrored.get(group as usize).map_or(group, |group| u64::from(*group));
            reversed = reversed * self.values + mirrored;
            power *= self.values;
            rest = quotient;
        }
        (reversed as f64 / power as f64).min(ONE_BELOW)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sequence::halton;

    #[test]
    fn equals_the_radical_inverse_in_all_bases() {
        for radix in halton::bases() {
            let ends = [0, 1, u64::from(u32::MAX) - 1, u64::from(u32::MAX), 1 << 32, u64::MAX];
            let some = (0..2000).map(|step| crate::hash::mix(step) >> (32 + step % 32));
            for index in (0..300).chain(ends).chain(some) {
                let (own, twin) = (radix.inverse(index), radical_inverse(radix.base(), index));
                assert_eq!(own.to_bits(), twin.to_bits(), "{index} in base {}", radix.base());
            }
        }
    }
}
