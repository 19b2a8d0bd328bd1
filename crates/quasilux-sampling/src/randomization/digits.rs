//! Digit shifts and nested digit permutations of the radical inverse in a prime base.
//!
//! A. B. Owen, "Randomly permuted (t, m, s)-nets and (t, s)-sequences" (1995), here one coordinate
//! of Halton's sequence at a time (A. B. Owen, "A randomized Halton algorithm in R", 2017): digit k
//! goes through a random permutation that is drawn anew for each value of the digits before it.
//!
//! Deviation: the permutations are d -> a d + c modulo b with random a != 0 and c, of which there
//! are b (b - 1) and not b!. Any two digits go to any two others with equal probability, and the
//! variance of an estimate depends on pairs alone (J. Matousek, 1998).

use crate::ONE_BELOW;
use crate::hash::{GOLDEN, mix};

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
