//! The reader of LM-63 files, on any bytes.

#![no_main]

#[allow(dead_code, reason = "seeds from published files are for the test suite")]
#[path = "../../crates/quasilux-photometry/tests/damage/mod.rs"]
mod damage;
mod mutation;

use damage::{Format, examine};
use libfuzzer_sys::{fuzz_mutator, fuzz_target};

fuzz_target!(|bytes: &[u8]| {
    examine(Format::Ies, bytes);
});

fuzz_mutator!(|bytes: &mut [u8], length: usize, room: usize, key: u32| {
    mutation::change(|| Format::Ies.samples(), bytes, length, room, key)
});
