//! Warnings: deviations from a format that a parser tolerates, each kind once.

use crate::Position;
use crate::quote::message_part;
use std::fmt;

/// A tolerated deviation of kind `K`, with its first position and how often it occurs. Shown as
/// `line:column: found ...; expected ...`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning<K> {
    kind: K,
    position: Position,
    count: usize,
    found: String,
    expected: String,
}

/// The kinds of warnings that decoding a text and reading its numbers give. The kinds of a parser
/// are made from them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum TextWarning {
    /// The text is neither ASCII nor UTF-8. UTF-16 is read by its byte order mark, anything else
    /// as Latin-1.
    Encoding,
    /// A byte order mark stands before the first line. It is skipped.
    ByteOrderMark,
    /// A number has a decimal comma. It is read as a point.
    DecimalComma,
    /// A count is written with a decimal point. It is read as the integer it is.
    CountWithPoint,
}

/// Collects warnings: one for each kind, at its first position, counting the later ones.
#[derive(Clone, Debug)]
pub struct Warnings<K>(Vec<Warning<K>>);

impl<K: Copy> Warning<K> {
    /// The kind of the deviation.
    pub fn kind(&self) -> K {
        self.kind
    }

    /// The first position of the deviation.
    pub fn position(&self) -> Position {
        self.position
    }

    /// The line of the first case, counted from 1.
    pub fn line(&self) -> usize {
        self.position.line
    }

    /// The column of the first case in characters, counted from 1.
    pub fn column(&self) -> usize {
        self.position.column
    }

    /// The number of cases.
    pub fn count(&self) -> usize {
        self.count
    }

    /// What stands at the first position.
    pub fn found(&self) -> &str {
        &self.found
    }

    /// What was expected, and how the file was read.
    pub fn expected(&self) -> &str {
        &self.expected
    }

    /// What was found and expected, and how often, without the position.
    pub fn message(&self) -> String {
        let Self { count, found, expected, .. } = self;
        let more = if *count > 1 { format!(" (and {} more)", count - 1) } else { String::new() };
        format!("found {found}; expected {expected}{more}")
    }
}

impl<K: Copy> fmt::Display for Warning<K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.position, self.message())
    }
}

impl<K> Default for Warnings<K> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<K: Copy + PartialEq> Warnings<K> {
    /// Adds a warning, or counts it where its kind is known already.
    pub fn push(
        &mut self,
        kind: impl Into<K>,
        position: Position,
        found: impl fmt::Display,
        expected: impl fmt::Display,
    ) {
        let kind = kind.into();
        match self.0.iter_mut().find(|warning| warning.kind == kind) {
            Some(warning) => warning.count += 1,
            None => self.0.push(Warning {
                kind,
                position,
                count: 1,
                found: message_part(&found),
                expected: message_part(&expected),
            }),
        }
    }

    /// Takes over the warnings of one kind from `others`, and drops the rest.
    pub fn take_kind(&mut self, others: Self, kind: K) {
        self.0.extend(others.0.into_iter().filter(|warning| warning.kind == kind));
    }

    /// Whether there is one of a kind.
    pub fn contains(&self, kind: K) -> bool {
        self.0.iter().any(|warning| warning.kind == kind)
    }

    /// The warnings in the order of their first cases.
    pub fn into_vec(self) -> Vec<Warning<K>> {
        self.0
    }
}
