//! Keys: strong 64-bit mixing of small integers.
//!
//! The mixer is the finaliser "variant 13" of D. Stafford (2011), the output function of SplitMix
//! (G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number generators", OOPSLA
//! 2014).

/// 2^64 over the golden ratio, odd: multiples of it are spread evenly.
pub(crate) const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// The key of one independent randomisation.
///
/// `seed` is the user's, `replicate` the number of the randomisation, and `stream` tells apart
/// whatever else must not share coordinates (photons and paths, the children of a split, the
/// sensors). Inputs that differ in one of the three never give the same key; other pairs do so with
/// probability 2^-64. Every bit of the key depends on every bit of the input.
///
/// ```
/// use quasilux_sampling::stream_key;
/// let keys = [stream_key(1, 0, 0), stream_key(0, 1, 0), stream_key(0, 0, 1), stream_key(0, 0, 0)];
/// assert!((1..4).all(|i| keys[..i].iter().all(|key| *key != keys[i])));
/// ```
#[must_use]
pub fn stream_key(seed: u64, replicate: u32, stream: u64) -> u64 {
    let key = mix(seed.wrapping_add(GOLDEN));
    let key = mix(key ^ mix(u64::from(replicate).wrapping_add(GOLDEN.wrapping_mul(2))));
    mix(key ^ mix(stream.wrapping_add(GOLDEN.wrapping_mul(3))))
}

/// A bijection of 64-bit words of which each output bit depends on each input bit.
#[inline(always)]
#[must_use]
pub(crate) const fn mix(mut word: u64) -> u64 {
    word = (word ^ (word >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    word = (word ^ (word >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    word ^ (word >> 31)
}

/// The key of one dimension of a randomised sequence.
#[inline(always)]
#[must_use]
pub(crate) const fn dimension_key(key: u64, dimension: u32) -> u64 {
    mix(key ^ (dimension as u64 + 1).wrapping_mul(GOLDEN))
}
