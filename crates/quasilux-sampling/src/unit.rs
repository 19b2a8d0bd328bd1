//! Conversion from 64 bits to the unit interval.

/// The largest coordinate: coordinates have 53 bits.
pub(crate) const ONE_BELOW: f64 = 1.0 - f64::EPSILON / 2.0;

/// The fraction word / 2^64, cut after 53 bits.
///
/// The difference of 1.m, m the first 52 bits, and of 1 or the number below it, by bit 53: exact,
/// and without a conversion that vector units lack.
#[inline(always)]
pub(crate) fn unit_from_word(word: u64) -> f64 {
    const ONE: u64 = 1.0_f64.to_bits();
    f64::from_bits(ONE | (word >> 12)) - f64::from_bits(ONE - ((word >> 11) & 1))
}

/// The number 0.d1 d2 d3 .. in base 2, cut after 53 digits; d1 is in bit 0.
#[inline(always)]
pub(crate) fn unit_from_digits(digits: u64) -> f64 {
    unit_from_word(digits.reverse_bits())
}

/// The coordinate nearest to a number.
#[inline]
pub(crate) fn clamp_to_unit(x: f64) -> f64 {
    x.clamp(0.0, ONE_BELOW)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_the_fraction_of_53_bits() {
        let words = (0..1000).map(crate::hash::mix);
        for word in words.chain([0, 1, 1 << 11, 1 << 12, 1 << 63, u64::MAX]) {
            let expected = (word >> 11) as f64 / (1_u64 << 53) as f64;
            assert_eq!(unit_from_word(word).to_bits(), expected.to_bits());
        }
        assert_eq!(unit_from_word(u64::MAX), ONE_BELOW);
    }
}
