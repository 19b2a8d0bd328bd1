//! How much memory a reader of a measured surface may take.

/// Bytes for each byte of a file. The greediest known take 45: XML of empty elements.
const BYTES_PER_BYTE: usize = 48;

/// Bytes for a file of any length: messages with pieces of the file, the first blocks of lists.
const BYTES_BESIDES: usize = 32 * 1024;

/// Bytes for the grids that values of a surface are resampled to, however few those are.
const BYTES_OF_GRIDS: usize = 128 << 20;

/// The most memory in bytes that any reader of this crate has allocated at one time for a file of
/// `file_bytes` bytes, its result included.
///
/// It is a bound for any bytes, not only for files as they should be. The bytes themselves, which
/// are the caller's, are not counted. Tables as programs write them take 1 to 7 bytes a byte,
/// whatever the format: one of 200 MB less than 1.6 GB, the file included (`docs/memory.md`,
/// `examples/surface_memory.rs`).
#[must_use]
pub const fn max_bsdf_memory_bytes(file_bytes: usize) -> usize {
    BYTES_PER_BYTE.saturating_mul(file_bytes).saturating_add(BYTES_BESIDES + BYTES_OF_GRIDS)
}
