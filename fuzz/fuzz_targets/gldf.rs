//! The reader of GLDF containers, on any bytes: as an archive, and as the product in one.

#![no_main]

#[allow(dead_code, reason = "pieces of products are for the test suite")]
#[path = "../../crates/quasilux-photometry/tests/container/mod.rs"]
mod container;
mod mutation;

use libfuzzer_sys::{fuzz_mutator, fuzz_target};
use quasilux_photometry::{GldfChoice, max_read_memory_bytes, read_gldf};
use quasilux_stats::damage::Seeds;

/// Most bytes that the reader unpacks of a product and a photometric file: 200 times what they are
/// packed in, or 1 MiB, and no more than 2 MiB of the product, which is XML, and 8 MiB of the file.
fn most_unpacked(file_bytes: usize) -> usize {
    let of_entry = file_bytes.saturating_mul(200).max(1 << 20);
    of_entry.min(2 << 20) + of_entry.min(8 << 20)
}

fn product() -> String {
    container::simple_product("a.ldt", "<RatedLuminousFlux>900</RatedLuminousFlux>")
}

fn samples() -> Seeds {
    let text = product();
    let archive = container::packed(&text, "a.ldt", &container::ldt(1, 1000.0));
    Seeds::new(vec![archive, text.into_bytes()])
}

fn examine(bytes: &[u8]) {
    let choice = GldfChoice::default();
    match read_gldf(bytes, &choice) {
        Ok(read) => assert!(read.photometry.flux_lm().is_finite()),
        Err(error) => assert!(!error.to_string().contains('\n'), "{error}"),
    }
    let ldt = container::ldt(1, 1000.0);
    let archive = container::Zip::default().file("product.xml", bytes);
    let _ = read_gldf(&archive.file("ldc/a.ldt", ldt.as_bytes()).finish(), &choice);
}

fuzz_target!(|bytes: &[u8]| {
    let peak_bytes = allocation_counter::measure(|| examine(bytes)).bytes_max;
    let most = max_read_memory_bytes(bytes.len() + most_unpacked(bytes.len())) as u64;
    assert!(peak_bytes <= most, "{peak_bytes} bytes for a file of {}, over {most}", bytes.len());
});

fuzz_mutator!(|bytes: &mut [u8], length: usize, room: usize, key: u32| {
    mutation::change(samples, bytes, length, room, key)
});
