//! Measurement files that are named on the command line: their bytes, and why one cannot be read.

use crate::input;
use quasilux_scene::FileKind;
use quasilux_text::{ParseError, Warning, printable};
use serde::Serialize;
use std::fmt;
use std::io;
use std::path::Path;

/// Why a file cannot be read.
pub(super) struct Failure {
    name: String,
    /// What is wrong, without the place.
    message: String,
    /// Line and column, counted from 1, where the file could be opened.
    place: Option<[usize; 2]>,
}

/// A failure in a document.
#[derive(Serialize)]
pub(super) struct ErrorEntry<'a> {
    line: Option<usize>,
    column: Option<usize>,
    message: &'a str,
}

/// A warning in a document.
#[derive(Serialize)]
pub(super) struct WarningEntry {
    rule: String,
    line: usize,
    column: usize,
    count: usize,
    message: String,
}

/// Whether a path stands for the standard input.
pub(super) fn is_stdin(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// What messages call a file.
pub(super) fn name_of(path: &Path) -> String {
    if is_stdin(path) { "stdin".to_owned() } else { path.display().to_string() }
}

/// Its name without folder and extension.
pub(super) fn stem_of(name: &str) -> String {
    let stem = Path::new(name).file_stem();
    stem.map_or_else(|| name.to_owned(), |stem| stem.to_string_lossy().into_owned())
}

/// The bytes of a file or of the standard input, as many as its kind can have.
pub(super) fn bytes_of(path: &Path, kind: FileKind) -> Result<Vec<u8>, Failure> {
    let bytes: io::Result<Vec<u8>> = if is_stdin(path) {
        input::read_all(io::stdin().lock(), kind.max_bytes())
    } else {
        input::read_kind(path, kind)
    };
    bytes.map_err(|error| Failure { name: name_of(path), message: error.to_string(), place: None })
}

/// A warning as a line of a summary.
pub(super) fn warning_line<K: Copy + fmt::Debug>(name: &str, warning: &Warning<K>) -> String {
    printable(&format!("warning: {name}:{warning} [{}]", rule(warning)))
}

/// The rule's name, as the `WarningKind` of the reader's crate lists it.
fn rule<K: Copy + fmt::Debug>(warning: &Warning<K>) -> String {
    format!("{:?}", warning.kind())
}

impl Failure {
    /// A reader's error.
    pub(super) fn new(name: &str, error: &ParseError) -> Self {
        Self::at(name, [error.line(), error.column()], error.message())
    }

    /// A file as a whole.
    pub(super) fn of_file(name: &str, message: String) -> Self {
        Self { name: name.to_owned(), message, place: None }
    }

    pub(super) fn at(name: &str, place: [usize; 2], message: String) -> Self {
        Self { name: name.to_owned(), message, place: Some(place) }
    }

    pub(super) fn entry(&self) -> ErrorEntry<'_> {
        ErrorEntry {
            line: self.place.map(|[line, _]| line),
            column: self.place.map(|[_, column]| column),
            message: &self.message,
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, message, .. } = self;
        match self.place {
            Some([line, column]) => write!(f, "{name}:{line}:{column}: {message}"),
            None => write!(f, "{name}: {message}"),
        }
    }
}

impl WarningEntry {
    pub(super) fn new<K: Copy + fmt::Debug>(warning: &Warning<K>) -> Self {
        Self {
            rule: rule(warning),
            line: warning.line(),
            column: warning.column(),
            count: warning.count(),
            message: warning.message(),
        }
    }
}
