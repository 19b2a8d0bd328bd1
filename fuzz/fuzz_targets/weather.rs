//! The reader of weather files, on any bytes.

#![no_main]

#[allow(dead_code, reason = "other files, and seeds from published ones, are for the test suite")]
#[path = "../../crates/quasilux-sky/tests/damage/mod.rs"]
mod damage;
mod mutation;

use damage::weather::{examine, samples};
use libfuzzer_sys::{fuzz_mutator, fuzz_target};

fuzz_target!(|bytes: &[u8]| {
    examine(bytes);
});

fuzz_mutator!(|bytes: &mut [u8], length: usize, room: usize, key: u32| {
    mutation::change(samples, bytes, length, room, key)
});
