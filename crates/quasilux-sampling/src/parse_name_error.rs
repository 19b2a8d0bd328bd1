//! The error of parsing the name of a sequence or of a randomisation.

use std::error::Error;
use std::fmt;

/// A text that names no sequence, or no randomisation.
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

impl fmt::Display for ParseNameError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { kind, name, expected } = self;
        write!(f, "unknown {kind} \"{name}\"; expected {expected}")
    }
}

impl Error for ParseNameError {}
