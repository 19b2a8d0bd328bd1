//! Excerpts of a file in messages: escaped, and cut to a bounded length.

use std::fmt;
use std::fmt::Write;
use std::ops::RangeInclusive;

/// Characters without a shape that change how others are shown: marks of the direction of writing,
/// joiners, and the mark of the byte order.
const INVISIBLE: [RangeInclusive<char>; 4] = [
    '\u{200b}'..='\u{200f}',
    '\u{2028}'..='\u{202e}',
    '\u{2060}'..='\u{2069}',
    '\u{feff}'..='\u{feff}',
];
/// A word in a message is cut after this many characters: file names are shorter.
const MAX_WORD: usize = 300;

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

/// Whether a terminal obeys it, or shows other characters otherwise for it.
fn is_command(c: char) -> bool {
    c.is_control() || INVISIBLE.iter().any(|range| range.contains(&c))
}

/// A text of lines as a terminal may show it, uncut: characters that command it are escaped, but
/// for line feeds.
#[must_use]
pub fn printable_lines(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\n' => shown.push(c),
            _ if is_command(c) => shown.extend(c.escape_unicode()),
            _ => shown.push(c),
        }
    }
    shown
}

/// A document in JSON as a terminal may show it: the same document, in which strings have escapes
/// for characters that command it and stand in no other place.
#[must_use]
pub fn printable_json(document: &str) -> String {
    let mut shown = String::with_capacity(document.len());
    for c in document.chars() {
        if is_command(c) && !c.is_ascii_whitespace() {
            // A string takes everything.
            _ = write!(shown, "\\u{:04x}", u32::from(c));
        } else {
            shown.push(c);
        }
    }
    shown
}

/// A message as a terminal may show it: characters that command it are escaped, and words that
/// no file name is as long as are cut.
#[must_use]
pub fn printable(message: &str) -> String {
    let mut shown = String::with_capacity(message.len());
    let mut word = 0;
    for c in message.chars() {
        word = if c == ' ' { 0 } else { word + 1 };
        match word {
            _ if word > MAX_WORD + 1 => {}
            _ if word == MAX_WORD + 1 => shown.push_str("..."),
            _ if is_command(c) => shown.extend(c.escape_unicode()),
            _ => shown.push(c),
        }
    }
    shown
}

/// One part of a message, cut: a number such as 1e300 is written with all its digits.
pub(crate) fn message_part(part: &impl fmt::Display) -> String {
    const MAX_CHARACTERS: usize = 200;
    let mut text = printable(&part.to_string());
    if let Some((end, _)) = text.char_indices().nth(MAX_CHARACTERS) {
        text.truncate(end);
        text.push_str("...");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_command_no_terminal() {
        assert_eq!(printable("wall \u{1b}[31m"), "wall \\u{1b}[31m");
        assert_eq!(printable("a\u{202e}b\nc\td"), "a\\u{202e}b\\u{a}c\\u{9}d");
        assert_eq!(printable_lines("a\u{1b}b\n\u{202e}\r\n"), "a\\u{1b}b\n\\u{202e}\\u{d}\n");
        assert_eq!(printable_json("{\n\t\"\u{202e}\u{7f}é\": 1}"), "{\n\t\"\\u202e\\u007fé\": 1}");
        assert_eq!(
            printable("20 \u{b0}C, 7 m\u{b2} in \"B\u{fc}ro\""),
            "20 \u{b0}C, 7 m\u{b2} in \"B\u{fc}ro\""
        );
        for c in (0..0x3000).filter_map(char::from_u32) {
            let shown = printable(&c.to_string());
            assert!(!shown.chars().any(char::is_control), "{c:?}");
        }
    }

    #[test]
    fn long_words_are_cut() {
        let long = format!("no file {} here", "x".repeat(20_000));
        let shown = printable(&long);
        assert!(shown.len() < 400 && shown.ends_with("x... here"), "{shown}");
        let sentence = "no light ".repeat(500);
        assert_eq!(printable(&sentence), sentence);
    }
}
