//! The reader of TM-33 files, on any bytes.

#![no_main]

#[allow(dead_code, reason = "seeds from published files are for the test suite")]
#[path = "../../crates/quasilux-photometry/tests/damage/mod.rs"]
mod damage;
mod mutation;

use damage::{Format, examine};
use libfuzzer_sys::{fuzz_mutator, fuzz_target};

fuzz_target!(|bytes: &[u8]| {
    examine(Format::Tm33, bytes);
});

fuzz_mutator!(|bytes: &mut [u8], length: usize, room: usize, key: u32| {
    mutation::change(|| Format::Tm33.samples(), bytes, length, room, key)
});
