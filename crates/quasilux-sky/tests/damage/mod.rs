//! Damaged weather files and panoramas, and what must hold of the readers' answers to any bytes.
//!
//! The bounded run of the test suite, the full run (`examples/mutate.rs`) and the fuzz targets
//! (`fuzz/`) share this module. Memory is counted for each thread by itself
//! (`allocation-counter`), so that any number of files can be read side by side.

pub(crate) mod panorama;
pub(crate) mod weather;

/// The answer of a reader, and the most memory in bytes that it held at one time.
fn measured<T>(read: impl FnOnce() -> T) -> (T, usize) {
    let mut answer = None;
    let allocated = allocation_counter::measure(|| answer = Some(read()));
    (answer.expect("the reader was called"), allocated.bytes_max as usize)
}
