//! Bytes to lines of text: encodings and line ends.

use crate::{Position, TextWarning, Warnings};
use std::borrow::Cow;

/// The text of a file. Never fails: UTF-16 is told by its byte order mark, and bytes that are not
/// UTF-8 are read as Latin-1.
pub fn decode<'a, K>(bytes: &'a [u8], warnings: &mut Warnings<K>) -> Cow<'a, str>
where
    K: Copy + PartialEq + From<TextWarning>,
{
    let utf_16 = |body: &[u8], unit: fn([u8; 2]) -> u16| {
        let units = body.chunks_exact(2).map(|pair| unit([pair[0], pair[1]]));
        Cow::Owned(
            char::decode_utf16(units)
                .map(|unit| unit.unwrap_or(char::REPLACEMENT_CHARACTER))
                .collect(),
        )
    };
    match bytes {
        [0xFF, 0xFE, body @ ..] => {
            warnings.push(TextWarning::Encoding, Position::START, "UTF-16 text", "ASCII");
            utf_16(body, u16::from_le_bytes)
        }
        [0xFE, 0xFF, body @ ..] => {
            warnings.push(TextWarning::Encoding, Position::START, "UTF-16 text", "ASCII");
            utf_16(body, u16::from_be_bytes)
        }
        [0xEF, 0xBB, 0xBF, body @ ..] => {
            warnings.push(
                TextWarning::ByteOrderMark,
                Position::START,
                "a byte order mark",
                "plain ASCII",
            );
            eight_bit(body, warnings)
        }
        body => eight_bit(body, warnings),
    }
}

fn eight_bit<'a, K>(bytes: &'a [u8], warnings: &mut Warnings<K>) -> Cow<'a, str>
where
    K: Copy + PartialEq + From<TextWarning>,
{
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(error) => {
            let text: String = bytes.iter().copied().map(char::from).collect();
            let before: String =
                bytes[..error.valid_up_to()].iter().copied().map(char::from).collect();
            let last_line = lines(&before).last().map_or(0, |line| line.chars().count());
            let ended = before.ends_with(['\n', '\r']);
            let at = Position {
                line: lines(&before).count().max(1) + usize::from(ended),
                column: if ended { 1 } else { last_line + 1 },
            };
            let byte = bytes[error.valid_up_to()];
            warnings.push(
                TextWarning::Encoding,
                at,
                format_args!("byte 0x{byte:02X}"),
                "ASCII or UTF-8 text (read as Latin-1)",
            );
            Cow::Owned(text)
        }
    }
}

/// The lines of a text; line feed, carriage return and both together end a line.
pub fn lines(text: &str) -> impl Iterator<Item = &str> + Clone {
    let mut rest = (!text.is_empty()).then_some(text);
    std::iter::from_fn(move || {
        let current = rest?;
        let Some(end) = current.find(['\n', '\r']) else {
            rest = None;
            return Some(current);
        };
        let line_end = if current[end..].starts_with("\r\n") { 2 } else { 1 };
        let tail = &current[end + line_end..];
        rest = (!tail.is_empty()).then_some(tail);
        Some(&current[..end])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_line_ends_end_lines() {
        let found: Vec<&str> = lines("a\nb\r\nc\rd\n\ne\n").collect();
        assert_eq!(found, ["a", "b", "c", "d", "", "e"]);
        assert_eq!(lines("").count(), 0);
    }

    #[test]
    fn encodings_are_recognised() {
        let text = |bytes: &[u8]| {
            let mut warnings = Warnings::<TextWarning>::default();
            let text = decode(bytes, &mut warnings).into_owned();
            (text, warnings.into_vec())
        };
        assert_eq!(text(b"5 cd").0, "5 cd");
        assert_eq!(text(b"\xEF\xBB\xBF5").0, "5");
        assert_eq!(text(b"\xFF\xFE5\0 \0").0, "5 ");
        assert_eq!(text(b"\xFE\xFF\x005\0 ").0, "5 ");
        let (latin, warnings) = text(b"one\r\n30\xB0");
        assert_eq!(latin, "one\r\n30\u{B0}");
        assert_eq!((warnings[0].line(), warnings[0].column()), (2, 3));
    }
}
