//! Errors and warnings of a container: in which of its files, and where there.

use crate::Warning;
use quasilux_text::xml::Element;
use quasilux_text::{ParseError, Position, printable};
use std::fmt;

/// Name of the entry that describes the product.
pub(super) const PRODUCT: &str = "product.xml";

/// Characters of a message: a dozen choices with their names.
const MAX_CHARACTERS: usize = 1000;

/// Why a container gives no luminaire. Shown as `part:line:column: found ...; expected ...`, for
/// callers to put the container's name in front.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub struct GldfError {
    part: String,
    position: Option<Position>,
    message: String,
}

/// A deviation of a file in a container that was lived with.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ContainerWarning {
    /// The name of the file in the container: `product.xml`, `ldc/file.ldt`.
    pub part: String,
    /// The deviation, with its place there.
    pub warning: Warning,
}

impl GldfError {
    pub(super) fn of_container(found: impl fmt::Display, expected: impl fmt::Display) -> Self {
        Self::without_place("", found, expected)
    }

    pub(super) fn without_place(
        part: &str,
        found: impl fmt::Display,
        expected: impl fmt::Display,
    ) -> Self {
        let message = message(found, expected);
        Self { part: part.to_owned(), position: None, message }
    }

    pub(super) fn at(
        element: &Element<'_>,
        found: impl fmt::Display,
        expected: impl fmt::Display,
    ) -> Self {
        let message = message(found, expected);
        Self { part: PRODUCT.to_owned(), position: Some(element.at), message }
    }

    pub(super) fn in_part(part: &str, error: &ParseError) -> Self {
        let position = Some(error.position());
        Self { part: part.to_owned(), position, message: error.message() }
    }

    /// The name of the file in the container; empty for the container itself.
    #[must_use]
    pub fn part(&self) -> &str {
        &self.part
    }

    /// The place in that file, where there is one.
    #[must_use]
    pub fn position(&self) -> Option<Position> {
        self.position
    }

    /// The words after the place: `found ...; expected ...`.
    #[must_use]
    pub fn message(&self) -> &str {
        &self.message
    }
}

/// The message of an error, longer than that of a parser: it may list choices.
fn message(found: impl fmt::Display, expected: impl fmt::Display) -> String {
    cut(&format!("found {found}; expected {expected}"), MAX_CHARACTERS)
}

/// A text without characters that command a terminal, cut after `max_characters`.
pub(super) fn cut(text: &str, max_characters: usize) -> String {
    let mut text = printable(text);
    if let Some((end, _)) = text.char_indices().nth(max_characters) {
        text.truncate(end);
        text.push_str("...");
    }
    text
}

impl fmt::Display for GldfError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.part.is_empty() {
            write!(f, "{}:", cut(&self.part, MAX_CHARACTERS))?;
        }
        if let Some(position) = self.position {
            write!(f, "{position}:")?;
        }
        let gap = if self.part.is_empty() && self.position.is_none() { "" } else { " " };
        write!(f, "{gap}{}", self.message)
    }
}
