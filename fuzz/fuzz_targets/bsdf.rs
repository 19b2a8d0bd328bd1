//! The readers of measured surfaces, on any bytes.

#![no_main]

#[allow(dead_code, reason = "numbered files are for the test suite")]
#[path = "../../crates/quasilux-photometry/tests/damage/mod.rs"]
mod damage;
mod steering;

use damage::{Format, examine};
use libfuzzer_sys::{fuzz_mutator, fuzz_target};

fuzz_target!(|bytes: &[u8]| {
    examine(Format::Bsdf, bytes);
});

fuzz_mutator!(|bytes: &mut [u8], length: usize, room: usize, key: u32| {
    steering::change(Format::Bsdf, bytes, length, room, key)
});
