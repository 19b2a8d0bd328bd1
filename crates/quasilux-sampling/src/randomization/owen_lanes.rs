//! Several of Owen's scrambles side by side, for vectors of coordinates of different dimensions.

use super::owen::{OwenKey, short_even};

/// The words of scrambles that [`OwenKey::scramble`] makes from its key each time: in vectors,
/// where all keys differ, that would take a fifth of the time.
#[derive(Clone, Copy)]
pub(crate) struct OwenLanes<const LANES: usize> {
    addend: [u64; LANES],
    /// The factors of the three products, in their order.
    factors: [[u64; LANES]; 3],
    /// The coefficients of the flips by three digits: of p, p q, p q r, p r, q, q r and r.
    flips: [[u64; LANES]; 7],
    /// Flips whatever the digits are.
    constant: [u64; LANES],
}

impl<const LANES: usize> OwenLanes<LANES> {
    /// Scrambles side by side.
    pub(crate) fn new(keys: [OwenKey; LANES]) -> Self {
        let words = |word: fn(u64, u64) -> u64| keys.map(|key| word(key.first, key.second));
        Self {
            addend: words(|first, _| first),
            factors: [
                words(|_, second| short_even(second)),
                words(|first, _| first.rotate_right(32) | 1),
                words(|first, _| short_even(first.rotate_right(48))),
            ],
            flips: [
                words(|_, second| second.rotate_right(16)),
                words(|_, second| second.rotate_right(32)),
                words(|_, second| second.rotate_right(48)),
                words(|first, _| first.rotate_right(20)),
                words(|first, _| first.rotate_right(8)),
                words(|first, _| first.rotate_right(40)),
                words(|_, second| second.rotate_right(8)),
            ],
            constant: words(|_, second| second.rotate_right(56)),
        }
    }

    /// What [`OwenKey::scramble`] gives for the key of a lane, bit for bit.
    #[inline(always)]
    pub(crate) const fn scramble(&self, lane: usize, digits: u64) -> u64 {
        let [by_p, by_pq, by_pqr, by_pr, by_q, by_qr, by_r] = &self.flips;
        let mut x = digits.wrapping_add(self.addend[lane]);
        x ^= x.wrapping_mul(self.factors[0][lane]);
        x = x.wrapping_mul(self.factors[1][lane]);
        let (p, q, r) = (x << 1, x << 2, x << 3);
        let with_p = by_p[lane] ^ (q & (by_pq[lane] ^ (r & by_pqr[lane]))) ^ (r & by_pr[lane]);
        let with_q = by_q[lane] ^ (r & by_qr[lane]);
        x ^= (p & with_p) ^ (q & with_q) ^ (r & by_r[lane]);
        x ^= x.wrapping_mul(self.factors[2][lane]);
        x ^ self.constant[lane]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hash::mix;

    #[test]
    fn equal_the_scrambles_of_their_keys() {
        let keys: [OwenKey; 8] = std::array::from_fn(|lane| OwenKey::new(mix(lane as u64)));
        let lanes = OwenLanes::new(keys);
        for digits in (0..1000).map(|step| mix(step) >> (step % 64)) {
            for (lane, key) in keys.iter().enumerate() {
                assert_eq!(lanes.scramble(lane, digits), key.scramble(digits));
            }
        }
    }
}
