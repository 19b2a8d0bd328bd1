//! Which light subpaths an eye path is paired with: none in particular.

use quasilux_sampling::{PointSet, Sampler};
use std::ops::Range;

/// Odd numbers that mix the digits of indices: those of SplitMix64 (G. L. Steele, D. Lea, C. H.
/// Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014).
const MIXING: [u64; 3] = [0x9e37_79b9_7f4a_7c15, 0xbf58_476d_1ce4_e5b9, 0x94d0_49bb_1331_11eb];

/// The index of the light subpath that an eye subpath is connected to.
///
/// At one index two point sets have the same digits, permuted: subpaths of the same index would
/// have as few pairs of directions as there are permutations. So each power of two of indices up to
/// the next is mixed, by multiplications that carry digits up and shifts that carry them down: both
/// subpaths have all points of a balanced set there, and nothing in common.
fn partner(index: u64) -> u64 {
    let first = (index + 1).next_power_of_two() / 2;
    if first < 2 {
        return index;
    }
    let (mask, half) = (first - 1, first.trailing_zeros().div_ceil(2));
    let mut mixed = index - first;
    for odd in MIXING {
        mixed = mixed.wrapping_mul(odd).wrapping_add(odd >> 7) & mask;
        mixed ^= mixed >> half;
    }
    first + mixed
}

/// The samples of the light subpaths of some indices, `each` of them for one.
pub(super) fn partners(
    points: &PointSet,
    indices: Range<u64>,
    each: u64,
) -> impl Iterator<Item = Sampler<'_>> {
    indices.flat_map(move |index| {
        let own = partner(index) * each;
        (own..own + each).map(|index| Sampler::new(points, index))
    })
}

#[cfg(test)]
mod tests {
    use super::partner;

    /// Each power of two of indices up to the next keeps its indices, and the lowest digits of the
    /// two indices are independent: of 4096 pairs, all 64 combinations of three digits come about
    /// equally often. An affine map, whose lowest digits follow each other, fails.
    #[test]
    fn partners_are_all_indices_and_none_in_particular() {
        for exponent in 0..13 {
            let first = 1_u64 << exponent;
            let mut partners: Vec<u64> = (first..2 * first).map(partner).collect();
            partners.sort_unstable();
            assert!(partners.into_iter().eq(first..2 * first), "{first}");
        }
        assert_eq!(partner(0), 0);
        let mut counts = [0_u32; 64];
        for index in 4096..8192_u64 {
            counts[((index & 7) << 3 | partner(index) & 7) as usize] += 1;
        }
        // 64 each, with a standard deviation of 8.
        assert!(counts.iter().all(|count| (24..104).contains(count)), "{counts:?}");
    }
}
