//! Bytes that come in: files with a bound each, and none that has no end.
//!
//! What is no regular file, a device, a pipe or a socket, may have no end, and opening it may wait
//! for ever: it is refused before it is opened. The standard input, which a user has to ask for, is
//! read up to the same bounds.

use crate::machine;
use quasilux_scene::{FileKind, too_large};
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

/// A project file, and a case of `validate`.
pub(crate) const MAX_PROJECT_BYTES: u64 = 64 << 20;
/// A plan: it lists the files of a scene.
pub(crate) const MAX_PLAN_BYTES: u64 = 64 << 20;
/// A checkpoint or a part: sums of all sensor points in all replicates.
pub(crate) const MAX_SUMS_BYTES: u64 = 64 << 30;

/// The bytes of a file, up to a bound.
///
/// # Errors
/// When it cannot be read, is no regular file or has more bytes, or more than memory holds.
pub(crate) fn read(path: &Path, max_bytes: u64) -> io::Result<Vec<u8>> {
    expect_regular(path)?;
    let file = File::open(path)?;
    // What has taken its place since then.
    let metadata = file.metadata()?;
    expect_kind(&metadata)?;
    let max_bytes = max_bytes.min(machine::available_bytes());
    if metadata.len() > max_bytes {
        return Err(too_large(max_bytes));
    }
    read_all(file, max_bytes)
}

/// The bytes of a file that a project needs.
pub(crate) fn read_kind(path: &Path, kind: FileKind) -> io::Result<Vec<u8>> {
    read(path, kind.max_bytes())
}

/// All bytes of a reader, up to a bound.
pub(crate) fn read_all(reader: impl Read, max_bytes: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    reader.take(max_bytes.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > max_bytes { Err(too_large(max_bytes)) } else { Ok(bytes) }
}

/// Refuses what may have no end.
pub(crate) fn expect_regular(path: &Path) -> io::Result<()> {
    expect_kind(&fs::metadata(path)?)
}

fn expect_kind(metadata: &fs::Metadata) -> io::Result<()> {
    if metadata.is_dir() {
        return Err(io::Error::new(io::ErrorKind::IsADirectory, "a folder, not a file"));
    }
    if metadata.is_file() {
        return Ok(());
    }
    let message = "not a regular file, but a device, a pipe or a socket";
    Err(io::Error::new(io::ErrorKind::InvalidInput, message))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_more_is_read_than_the_bound() {
        let endless = io::repeat(b' ');
        let error = read_all(endless, 1 << 20).unwrap_err();
        assert_eq!(error.to_string(), "the file is larger than 1 MiB");
        assert_eq!(read_all(&b"four"[..], 4).unwrap(), b"four");
        assert!(read_all(&b"fives"[..], 4).is_err());
    }

    #[cfg(unix)]
    #[test]
    fn devices_are_refused() {
        let error = read(Path::new("/dev/zero"), 1 << 20).unwrap_err();
        assert!(error.to_string().contains("a device"), "{error}");
        let error = read(&std::env::temp_dir(), 1 << 20).unwrap_err();
        assert!(error.to_string().contains("a folder"), "{error}");
    }
}
