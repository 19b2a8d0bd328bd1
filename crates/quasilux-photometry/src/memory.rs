//! How much memory a reader may take.

/// Bytes for each byte of a file. The greediest known take 58: an LM-63 header of labels with one
/// letter each, every one kept in a list that doubles as it grows.
const BYTES_PER_BYTE: usize = 96;

/// Bytes for a file of any length: messages with pieces of the file, the first blocks of lists.
const BYTES_BESIDES: usize = 32 * 1024;

/// The most memory in bytes that any reader of this crate has allocated at one time for a file of
/// `file_bytes` bytes, its result included: no file decides on more.
///
/// It holds for any bytes, not only for files as they should be. The bytes themselves, which are
/// the caller's, are not counted. Of a GLDF container, whose files are deflated, the bytes are
/// those that it unpacks, no more than 16 MiB, in files of no more than 8 MiB, of XML 2 MiB:
/// [`read_gldf`](crate::read_gldf).
#[must_use]
pub const fn max_read_memory_bytes(file_bytes: usize) -> usize {
    BYTES_PER_BYTE.saturating_mul(file_bytes).saturating_add(BYTES_BESIDES)
}
