//! How the fuzzer changes its files: by its own means and, as often, by those of the test suite.

use quasilux_stats::SplitMix64;
use quasilux_stats::damage::{Seeds, mutate};
use std::sync::OnceLock;

/// Changes the first `length` of `bytes`, of which `room` may be used, and returns the new length.
pub(super) fn change(
    samples: fn() -> Seeds,
    bytes: &mut [u8],
    length: usize,
    room: usize,
    key: u32,
) -> usize {
    static SEEDS: OnceLock<Seeds> = OnceLock::new();
    let seeds = SEEDS.get_or_init(samples);
    let mut random = SplitMix64::new(u64::from(key));
    let mut file = bytes[..length].to_vec();
    match random.below(16) {
        0 => file.clone_from(&seeds.files()[random.below(seeds.files().len())]),
        1..=8 => mutate(&mut file, seeds.files(), &mut random),
        _ => return libfuzzer_sys::fuzzer_mutate(bytes, length, room),
    }
    file.truncate(room);
    bytes[..file.len()].copy_from_slice(&file);
    file.len()
}
