//! Excerpts of a file in messages: escaped, and cut to a bounded length.

use std::fmt;

/// An excerpt in quotation marks, without control characters, cut after 40 characters.
#[must_use]
pub fn quoted(text: &str) -> String {
    format!("\"{}\"", shortened(text, 40))
}

/// A text without control characters, cut after `max_characters`.
#[must_use]
pub fn shortened(text: &str, max_characters: usize) -> String {
    let mut shown: String =
        text.chars().take(max_characters).flat_map(char::escape_debug).collect();
    if text.chars().nth(max_characters).is_some() {
        shown.push_str("...");
    }
    shown
}

/// One part of a message, cut: a number such as 1e300 is written with all its digits.
pub(crate) fn message_part(part: &impl fmt::Display) -> String {
    const MAX_CHARACTERS: usize = 200;
    let mut text = part.to_string();
    if let Some((end, _)) = text.char_indices().nth(MAX_CHARACTERS) {
        text.truncate(end);
        text.push_str("...");
    }
    text
}
