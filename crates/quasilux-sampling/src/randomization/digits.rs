//! Digit shifts and nested digit permutations of the radical inverse in a prime base.
//!
//! A. B. Owen, "Randomly permuted (t, m, s)-nets and (t, s)-sequences" (1995), here one coordinate
//! of Halton's sequence at a time (A. B. Owen, "A randomized Halton algorithm in R", 2017): digit k
//! goes through a random permutation that is drawn anew for each value of the digits before it.
//!
//! Deviation: the permutations are d -> a d + c modulo b with random a != 0 and c, of which there
//! are b (b - 1) and not b!. Any two digits go to any two others with equal probability, and the
//! variance of an estimate depends on pairs alone (J. Matousek, 1998).

use crate::hash::{GOLDEN, mix};
use crate::unit::ONE_BELOW;

/// The radical inverse with each digit shifted by a random one: d -> d + c modulo b, one c for each
/// place.
pub(crate) fn shifted_radical_inverse(base: u32, index: u64, key: u64) -> f64 {
    let mut place_key = key;
    map_digits(base, index, |digit| {
        place_key = mix(place_key.wrapping_add(GOLDEN));
        let sum = digit + below(place_key, base);
        if sum < u64::from(base) { sum } else { sum - u64::from(base) }
    })
}

/// The radical inverse with nested random permutations of its digits.
pub(crate) fn nested_radical_inverse(base: u32, index: u64, key: u64) -> f64 {
    let mut node_key = mix(key.wrapping_add(GOLDEN));
    map_digits(base, index, |digit| {
        let shift = below(node_key, base);
        // Zero is all that follows the last digit of the index.
        let image = if digit == 0 {
            shift
        } else {
            let factor = 1 + below(node_key << 32, base - 1);
            (factor * digit + shift) % u64::from(base)
        };
        node_key = mix(node_key ^ (digit + 1).wrapping_mul(GOLDEN));
        image
    })
}

/// The number in [0, 1) whose digits are images of those of the index, the lowest first, zeros
/// after them included: as many as 53 bits take, or as fit into 64.
#[inline]
fn map_digits(base: u32, index: u64, mut image: impl FnMut(u64) -> u64) -> f64 {
    let base = u64::from(base);
    let (mut rest, mut reversed, mut power) = (index, 0, 1_u64);
    while power < 1 << 53 {
        let Some(next) = power.checked_mul(base) else { break };
        let digit = if rest == 0 { 0 } else { rest % base };
        rest = if rest == 0 { 0 } else { rest / base };
        reversed = reversed * base + image(digit);
        power = next;
    }
    (reversed as f64 / power as f64).min(ONE_BELOW)
}

/// A number below `bound` from the upper half of a random word, each as likely to 2^-32.
#[inline]
fn below(word: u64, bound: u32) -> u64 {
    ((word >> 32) * u64::from(bound)) >> 32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sequence::{Radix, halton};

    /// The places of a coordinate: the fewest that tell 2^53 numbers apart, or else as many as
    /// leave all numbers below 2^64.
    fn places(base: u32) -> u32 {
        let power = |places| u128::from(base).pow(places);
        let enough = (1..).find(|places| power(*places) >= 1 << 53).expect("powers grow");
        if power(enough) < 1 << 64 { enough } else { enough - 1 }
    }

    /// The slow twin: the digits of the index, each through a table of its images that `images`
    /// gives for the digits before it, and a sum of fractions.
    fn slow_radical_inverse(base: u32, index: u64, images: impl Fn(&[u64]) -> Vec<u64>) -> f64 {
        let digit =
            |place| (u128::from(index) / u128::from(base).pow(place) % u128::from(base)) as u64;
        let digits: Vec<u64> = (0..places(base)).map(digit).collect();
        let image = |place: usize| images(&digits[..place])[digits[place] as usize];
        (0..digits.len())
            .rev()
            .fold(0.0, |sum, place| (sum + image(place) as f64) / f64::from(base))
    }

    /// All digits, a start and then a step apart.
    fn progression(base: u32, start: u64, step: u64) -> Vec<u64> {
        let next = |digit: &u64| Some((digit + step) % u64::from(base));
        std::iter::successors(Some(start), next).take(base as usize).collect()
    }

    fn share(word: u64, bound: u32) -> u64 {
        ((u128::from(word) * u128::from(bound)) >> 32) as u64
    }

    /// The shift of a place: the key mixed once for it and each place before it.
    fn shifted_images(base: u32, key: u64, before: &[u64]) -> Vec<u64> {
        let place_key = (0..=before.len()).fold(key, |key, _| mix(key.wrapping_add(GOLDEN)));
        progression(base, share(place_key >> 32, base), 1)
    }

    /// The permutation of a node: its key is a chain over the digits that lead to it.
    fn nested_images(base: u32, key: u64, before: &[u64]) -> Vec<u64> {
        let down = |key, digit: &u64| mix(key ^ GOLDEN.wrapping_mul(digit + 1));
        let node_key = before.iter().fold(mix(key.wrapping_add(GOLDEN)), down);
        let step = 1 + share(node_key & 0xffff_ffff, base - 1);
        progression(base, share(node_key >> 32, base), step)
    }

    #[test]
    fn equal_the_slow_twins() {
        for base in [3, 5, 7, 29, 127, 1999, 7151, 8161] {
            for step in 0..200 {
                let (index, key) = (mix(step) >> (24 + step % 40), mix(!step));
                let twins = [
                    (
                        shifted_radical_inverse(base, index, key),
                        slow_radical_inverse(base, index, |d| shifted_images(base, key, d)),
                    ),
                    (
                        nested_radical_inverse(base, index, key),
                        slow_radical_inverse(base, index, |d| nested_images(base, key, d)),
                    ),
                ];
                for (fast, slow) in twins {
                    assert!((fast - slow).abs() <= 1e-15, "{index} in base {base}: {fast}, {slow}");
                }
            }
        }
    }

    /// The periods of all bases: 7151^4 = 2^51.2 is the shortest.
    #[test]
    fn coordinates_do_not_repeat_within_2_to_the_51() {
        let period = |base: u32| u128::from(base).pow(places(base));
        let shortest = halton::bases().iter().map(Radix::base).map(period).min();
        assert_eq!(shortest, Some(7151_u128.pow(4)));
        assert!(shortest > Some(1 << 51));
    }

    /// Without randomisation 53 bits no longer tell numbers apart that differ in their fifth digit
    /// alone, where the base to the fifth is well above 2^53: above base 1552, 1552^4 = 2^42.4.
    #[test]
    fn unrandomised_coordinates_meet_from_2_to_the_42() {
        let inverse = crate::sequence::radical_inverse;
        let meets = |base: u64| {
            let power = base.pow(4);
            let last = (0..64).map(|step| power - 1 - step * step);
            last.clone().any(|i| inverse(base as u32, i) == inverse(base as u32, i + power))
        };
        assert!(meets(1999) && !meets(1499));
        assert!((1 << 42..1 << 44).contains(&1999_u64.pow(4)));
    }
}
