//! The container format of checkpoints and parts: a file is complete and unchanged, or refused.
//!
//! ```text
//! FORMAT/VERSION line feed      such as quasilux-part/1
//! length of the header          u64, little-endian
//! header                        JSON
//! length of the body            u64, little-endian
//! body
//! SHA-256 of all bytes before   32 bytes
//! ```
//!
//! Any bit that changes and any cut changes the digest. It is no signature: who can write the file
//! can write the digest.

use crate::digest::{BYTES, sha256};
use crate::input;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Longest line with format and version.
const MAX_FORMAT_BYTES: u64 = 64;

/// The bytes of a file of this format.
pub(crate) fn encode(format: &str, header: &str, body: &[u8]) -> Vec<u8> {
    let mut bytes = format!("{format}\n").into_bytes();
    for part in [header.as_bytes(), body] {
        bytes.extend_from_slice(&(part.len() as u64).to_le_bytes());
        bytes.extend_from_slice(part);
    }
    let digest = sha256(&bytes);
    bytes.extend_from_slice(&digest);
    bytes
}

/// The bytes of a file that begins like one of any format here: one that does not may be as long
/// as it likes, and is read no further than its first line.
pub(crate) fn read(path: &Path) -> io::Result<Vec<u8>> {
    input::expect_regular(path)?;
    let mut head = Vec::new();
    File::open(path)?.take(MAX_FORMAT_BYTES).read_to_end(&mut head)?;
    let is_ours = head.starts_with(b"quasilux-") && head.contains(&b'\n');
    if is_ours { input::read(path, input::MAX_SUMS_BYTES) } else { Ok(head) }
}

/// The bytes of the next of several files in one, up to where the reader ends; `None` at its end.
/// What is no file of this format is read no further than its first bytes, and no part of it may
/// have more than this many.
pub(crate) fn next(
    reader: &mut dyn Read,
    format: &str,
    max_bytes: u64,
) -> io::Result<Option<Vec<u8>>> {
    let mut bytes = Vec::new();
    let line = format!("{format}\n");
    reader.take(line.len() as u64).read_to_end(&mut bytes)?;
    if bytes.is_empty() {
        return Ok(None);
    }
    if bytes != line.as_bytes() {
        return Ok(Some(bytes));
    }
    // Header and body, each behind its length.
    for _ in 0..2 {
        let begin = bytes.len();
        reader.take(size_of::<u64>() as u64).read_to_end(&mut bytes)?;
        let Some(length) = bytes[begin..].first_chunk() else { return Ok(Some(bytes)) };
        let length = u64::from_le_bytes(*length);
        if length > max_bytes {
            return Ok(Some(bytes));
        }
        reader.take(length).read_to_end(&mut bytes)?;
    }
    reader.take(BYTES as u64).read_to_end(&mut bytes)?;
    Ok(Some(bytes))
}

/// The two parts of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Contents<'b> {
    /// JSON.
    pub(crate) header: &'b str,
    pub(crate) body: &'b [u8],
}

/// The contents of a file of this format, or what is wrong with it.
pub(crate) fn decode<'b>(format: &str, bytes: &'b [u8]) -> Result<Contents<'b>, String> {
    let name = format.split('/').next().unwrap_or(format);
    let Some(version) = bytes.strip_prefix(format!("{name}/").as_bytes()) else {
        return Err(format!("is no file of the format {format}"));
    };
    let digits = version.iter().take_while(|byte| byte.is_ascii_digit()).count();
    if &bytes[..name.len() + 1 + digits] != format.as_bytes() {
        let found = String::from_utf8_lossy(&version[..digits.min(9)]);
        return Err(format!("has the format {name}/{found}, and this program reads {format}"));
    }
    let damaged = || "is damaged: it was cut short or changed".to_owned();
    let (content, digest) = bytes.split_last_chunk::<BYTES>().ok_or_else(damaged)?;
    if sha256(content) != *digest {
        return Err(damaged());
    }
    let mut rest = content.get(format.len() + 1..).ok_or_else(damaged)?;
    let mut next = || {
        let (length, behind) = rest.split_first_chunk().ok_or_else(damaged)?;
        let length = usize::try_from(u64::from_le_bytes(*length)).map_err(|_| damaged())?;
        let (part, behind) = behind.split_at_checked(length).ok_or_else(damaged)?;
        rest = behind;
        Ok::<_, String>(part)
    };
    let (header, body) = (next()?, next()?);
    let header = std::str::from_utf8(header).map_err(|_| damaged())?;
    if rest.is_empty() { Ok(Contents { header, body }) } else { Err(damaged()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FORMAT: &str = "quasilux-part/1";

    /// Every cut, every bit of a small file, and bytes behind its end.
    #[test]
    fn nothing_but_the_whole_file_is_accepted() {
        let bytes = encode(FORMAT, "{\"a\": 1}", &[0, 255, 7]);
        assert_eq!(
            decode(FORMAT, &bytes),
            Ok(Contents { header: "{\"a\": 1}", body: &[0, 255, 7] })
        );
        for length in 0..bytes.len() {
            assert!(decode(FORMAT, &bytes[..length]).is_err(), "{length}");
        }
        for bit in 0..8 * bytes.len() {
            let mut changed = bytes.clone();
            changed[bit / 8] ^= 1 << (bit % 8);
            assert!(decode(FORMAT, &changed).is_err(), "{bit}");
        }
        assert!(decode(FORMAT, &[&bytes[..], &[0]].concat()).is_err());
    }

    /// Two in one, every cut of them, and lengths that are too large.
    #[test]
    fn several_in_one_are_read_one_by_one() {
        let [a, b] = [encode(FORMAT, "{}", &[1, 2]), encode(FORMAT, "[]", &[3])];
        let both = [&a[..], &b].concat();
        for length in 0..=both.len() {
            let mut reader = &both[..length];
            let mut whole = Vec::new();
            while let Some(bytes) = next(&mut reader, FORMAT, 100).unwrap() {
                whole.push(decode(FORMAT, &bytes).is_ok());
            }
            let expected = match length {
                0 => vec![],
                _ if length < a.len() => vec![false],
                _ if length == a.len() => vec![true],
                _ => vec![true, length == both.len()],
            };
            assert_eq!(whole, expected, "{length}");
        }
        let bytes = next(&mut &both[..], FORMAT, 1).unwrap().unwrap();
        assert!(decode(FORMAT, &bytes).is_err() && bytes.len() < a.len());
    }

    #[test]
    fn other_formats_are_named() {
        let message = |format, bytes: &[u8]| decode(format, bytes).unwrap_err();
        let other = message("quasilux-checkpoint/1", &encode(FORMAT, "", &[]));
        assert!(other.contains("no file of the format quasilux-checkpoint/1"), "{other}");
        let newer = message(FORMAT, &encode("quasilux-part/12", "", &[]));
        assert!(newer.contains("quasilux-part/12") && newer.contains("reads quasilux-part/1"));
        let damaged = message(FORMAT, b"quasilux-part/1\nshort");
        assert!(damaged.contains("cut short"), "{damaged}");
    }
}
