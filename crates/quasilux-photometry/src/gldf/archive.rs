//! The zip archive of a container: its entries, and how much of them is unpacked.
//!
//! Nothing is written to disk. Names that would lead out of a folder, and two entries of one name,
//! make the archive refused, whoever asks for what. An entry is unpacked only when it is needed, up
//! to a size that its compressed one and the limits here allow, and its CRC-32 is checked. Archives
//! inside (L3D models) stay closed.

use super::GldfError;
use super::names::{MAX_NAME_BYTES, is_root, is_trick, name_of};
use miniz_oxide::inflate::decompress_to_vec_with_limit;
use quasilux_text::quoted;
use rawzip::{CompressionMethod, ZipArchiveEntryWayfinder, ZipSliceArchive};
use std::collections::HashSet;

/// Entries of an archive: products have some dozen.
const MAX_ENTRIES: usize = 10_000;
/// Bytes of all entries that are unpacked together.
const MAX_UNPACKED_BYTES: usize = 16 << 20;
/// Bytes of an entry for each compressed byte; tables of numbers have some 30.
const MAX_RATIO: usize = 200;
/// Bytes that any entry may have, however well it is compressed.
const FREE_BYTES: usize = 1 << 20;

/// The entries of a container.
pub(super) struct Archive<'b> {
    zip: ZipSliceArchive<&'b [u8]>,
    entries: Vec<Entry>,
    unpacked_bytes: usize,
}

struct Entry {
    name: String,
    wayfinder: ZipArchiveEntryWayfinder,
    method: CompressionMethod,
    is_encrypted: bool,
}

impl<'b> Archive<'b> {
    /// Lists the entries.
    pub(super) fn open(bytes: &'b [u8]) -> Result<Self, GldfError> {
        let broken = |error: &dyn ToString| {
            GldfError::of_container(
                error.to_string(),
                "a zip archive (GLDF containers are; check that the download is complete)",
            )
        };
        let zip = rawzip::ZipArchive::from_slice(bytes).map_err(|error| broken(&error))?;
        let mut entries: Vec<Entry> = Vec::new();
        let mut list = zip.entries();
        while let Some(entry) = list.next_entry().map_err(|error| broken(&error))? {
            let raw_bytes = entry.file_path().as_bytes().len();
            if raw_bytes > MAX_NAME_BYTES {
                let found = format!("an entry with a name of {raw_bytes} bytes");
                let expected = format!("no more than {MAX_NAME_BYTES}");
                return Err(GldfError::of_container(found, expected));
            }
            let name = name_of(&entry);
            if is_root(&name) {
                continue;
            }
            if is_trick(&name) {
                let found = format!("an entry with the name {}", quoted(&name));
                let expected = "names inside the container, as \"ldc/file.ldt\" (its maker has to \
                                pack it anew)";
                return Err(GldfError::of_container(found, expected));
            }
            if entries.len() == MAX_ENTRIES {
                let expected = format!("no more than {MAX_ENTRIES} entries");
                return Err(GldfError::of_container("more", expected));
            }
            entries.push(Entry {
                name,
                wayfinder: entry.wayfinder(),
                method: entry.compression_method(),
                is_encrypted: entry.flags().is_encrypted(),
            });
        }
        let mut seen = HashSet::new();
        if let Some(twice) = entries.iter().find(|entry| !seen.insert(entry.name.as_str())) {
            let found = format!("two entries with the name {}", quoted(&twice.name));
            return Err(GldfError::of_container(found, "one (which one counts is unknown)"));
        }
        Ok(Self { zip, entries, unpacked_bytes: 0 })
    }

    /// The name of the entry that is meant by a name: equal, or the only one that is equal but for
    /// capitals.
    pub(super) fn find(&self, name: &str) -> Result<Option<&str>, GldfError> {
        let names = || self.entries.iter().map(|entry| entry.name.as_str());
        if let Some(known) = names().find(|&known| known == name) {
            return Ok(Some(known));
        }
        let folded = name.to_lowercase();
        let mut alike = names().filter(|known| known.to_lowercase() == folded);
        match (alike.next(), alike.next()) {
            (Some(a), Some(b)) => {
                let found = format!("the entries {} and {}", quoted(a), quoted(b));
                let expected = format!("one, for {} (which one counts is unknown)", quoted(name));
                Err(GldfError::of_container(found, expected))
            }
            (only, _) => Ok(only),
        }
    }

    /// The names of all files of a folder, whatever its capitals, sorted.
    pub(super) fn files_in(&self, folder: &str) -> Vec<&str> {
        let names = self.entries.iter().map(|entry| entry.name.as_str());
        let is_in = |name: &&str| {
            let start = name.get(..folder.len());
            start.is_some_and(|start| start.eq_ignore_ascii_case(folder)) && !name.ends_with('/')
        };
        let mut names: Vec<&str> = names.filter(is_in).collect();
        names.sort_unstable();
        names
    }

    /// The bytes of the entry of exactly this name, no more than `max_bytes`.
    pub(super) fn unpack(&mut self, name: &str, max_bytes: usize) -> Result<Vec<u8>, GldfError> {
        let refuse =
            |found: String, expected: &str| Err(GldfError::without_place(name, found, expected));
        let Some(entry) = self.entries.iter().find(|entry| entry.name == name) else {
            return refuse("no such entry".to_owned(), "it in the container");
        };
        if entry.is_encrypted {
            return refuse("an encrypted entry".to_owned(), "a container without a password");
        }
        let broken = |error: &dyn ToString| {
            let expected = "the bytes that the archive promises (download it anew)";
            GldfError::without_place(name, error.to_string(), expected)
        };
        let packed = self.zip.get_entry(entry.wayfinder).map_err(|error| broken(&error))?;
        let data = packed.data();
        let of_entry = max_bytes.min(data.len().saturating_mul(MAX_RATIO).max(FREE_BYTES));
        let left = MAX_UNPACKED_BYTES.saturating_sub(self.unpacked_bytes);
        let room = of_entry.min(left);
        let too_long = || {
            if left < of_entry {
                let found = format!("more than {MAX_UNPACKED_BYTES} bytes with the files before");
                refuse(found, "fewer or shorter files")
            } else {
                refuse(format!("more than {room} bytes"), "a file of a usual size")
            }
        };
        let bytes = match entry.method {
            CompressionMethod::STORE if data.len() <= room => data.to_vec(),
            CompressionMethod::STORE => return too_long(),
            CompressionMethod::DEFLATE => match decompress_to_vec_with_limit(data, room) {
                Ok(bytes) => bytes,
                Err(error) if error.status == miniz_oxide::inflate::TINFLStatus::HasMoreOutput => {
                    return too_long();
                }
                Err(_) => return Err(broken(&"damaged compressed data")),
            },
            other => {
                let found = format!("the compression method {}", other.as_u16());
                return refuse(found, "stored or deflated entries (pack the container anew)");
            }
        };
        let claimed = packed.claim_verifier();
        let is_whole = claimed.uncompressed_size == bytes.len() as u64;
        if !is_whole || claimed.crc != rawzip::crc32(&bytes) {
            return Err(broken(&"bytes with another length or check sum"));
        }
        self.unpacked_bytes += bytes.len();
        Ok(bytes)
    }
}
