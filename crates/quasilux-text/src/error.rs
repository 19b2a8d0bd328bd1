//! Errors that end the parsing of a file.

use crate::Position;
use crate::quote::message_part;
use std::fmt;

/// Why a file cannot be parsed, and where. Shown as `line:column: found ...; expected ...`, for
/// callers to put the file's name in front.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{position}: {}", self.message())]
pub struct ParseError {
    position: Position,
    found: String,
    expected: String,
}

impl ParseError {
    /// An error at `position`, where `found` stands and `expected` should.
    pub fn new(position: Position, found: impl fmt::Display, expected: impl fmt::Display) -> Self {
        Self { position, found: message_part(&found), expected: message_part(&expected) }
    }

    /// The same error with another expectation.
    #[must_use]
    pub fn expecting(self, expected: impl fmt::Display) -> Self {
        Self { expected: expected.to_string(), ..self }
    }

    /// The position in the file.
    #[must_use]
    pub fn position(&self) -> Position {
        self.position
    }

    /// The line, counted from 1.
    #[must_use]
    pub fn line(&self) -> usize {
        self.position.line
    }

    /// The column in characters, counted from 1.
    #[must_use]
    pub fn column(&self) -> usize {
        self.position.column
    }

    /// What stands at the position.
    #[must_use]
    pub fn found(&self) -> &str {
        &self.found
    }

    /// What should stand there, or what would mend it.
    #[must_use]
    pub fn expected(&self) -> &str {
        &self.expected
    }

    /// What is wrong, without the position.
    #[must_use]
    pub fn message(&self) -> String {
        format!("found {}; expected {}", self.found, self.expected)
    }
}
