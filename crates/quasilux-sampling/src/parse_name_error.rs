//! The error of parsing a name out of a closed list: of a sequence, a randomisation, a file format.

use std::error::Error;
use std::fmt;

/// A text that is none of the names of its kind.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct ParseNameError {
    /// The kind of thing that the text should name.
    pub kind: &'static str,
    /// The text.
    pub name: String,
    /// All names of this kind.
    pub expected: &'static str,
}

impl ParseNameError {
    /// The error of a text `name` that should have been one of the names in `expected`.
    #[must_use]
    pub fn new(kind: &'static str, name: &str, expected: &'static str) -> Self {
        Self { kind, name: name.to_owned(), expected }
    }
}

impl fmt::Display for ParseNameError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { kind, name, expected } = self;
        write!(f, "unknown {kind} \"{name}\"; expected {expected}")
    }
}

impl Error for ParseNameError {}
