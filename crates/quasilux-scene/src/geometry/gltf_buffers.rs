//! The buffers that a glTF file names: each file is read once, and all together have a bound.
//!
//! glTF 2.0 Specification (2021), section 3.6.1.

use super::{beside, data_uri, reason};
use crate::files::{self, FileKind};
use crate::{Files, too_large};
use ::gltf::Document;
use ::gltf::buffer::Source;
use std::collections::HashMap;
use std::io;
use std::sync::Arc;

/// The bytes of all buffers, at least as many as each declares. Buffers that name the same file
/// share its bytes.
pub(super) fn read(
    file: &str,
    document: &Document,
    mut blob: Option<Vec<u8>>,
    files: &dyn Files,
) -> Result<Vec<Arc<Vec<u8>>>, String> {
    let mut named = NamedFiles { files, known: HashMap::new(), bytes: 0 };
    let mut buffers = Vec::new();
    for buffer in document.buffers() {
        let bytes = match buffer.source() {
            Source::Bin => {
                Arc::new(blob.take().ok_or("a buffer refers to a binary chunk that is missing")?)
            }
            Source::Uri(uri) if uri.starts_with("data:") => {
                let read = data_uri::decode(uri);
                Arc::new(read.map_err(|e| format!("buffer {}: {e}", buffer.index()))?)
            }
            Source::Uri(uri) => {
                let path = beside(file, &data_uri::percent_decoded(uri));
                let read = named.read(&path);
                read.map_err(|e| format!("cannot read the buffer \"{path}\": {}", reason(&e)))?
            }
        };
        if bytes.len() < buffer.length() {
            let (index, given, declared) = (buffer.index(), bytes.len(), buffer.length());
            return Err(format!("buffer {index} has {given} bytes; expected {declared}"));
        }
        buffers.push(bytes);
    }
    Ok(buffers)
}

/// Files of buffers, as far as they were read.
struct NamedFiles<'a> {
    files: &'a dyn Files,
    known: HashMap<String, Arc<Vec<u8>>>,
    /// Of all of them.
    bytes: u64,
}

impl NamedFiles<'_> {
    /// A file; all together may have as many bytes as one.
    fn read(&mut self, path: &str) -> io::Result<Arc<Vec<u8>>> {
        if let Some(known) = self.known.get(path) {
            return Ok(Arc::clone(known));
        }
        let bytes = Arc::new(files::read(self.files, path, FileKind::Buffer)?);
        self.bytes += bytes.len() as u64;
        if self.bytes > FileKind::Buffer.max_bytes() {
            return Err(too_large(FileKind::Buffer.max_bytes()));
        }
        self.known.insert(path.to_owned(), Arc::clone(&bytes));
        Ok(bytes)
    }
}
