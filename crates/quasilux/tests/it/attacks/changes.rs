//! Changes of good files: pieces cut, repeated, swapped or replaced by numbers at the edges of what
//! numbers are, bits turned, names that terminals would obey.

use crate::support::{Numbers, damaged};

/// What numbers are replaced by.
const NUMBERS: [&str; 24] = [
    "0",
    "-0",
    "-1",
    "1",
    "1e308",
    "-1e308",
    "1e309",
    "5e-324",
    "1e-320",
    "nan",
    "inf",
    "-inf",
    "4294967295",
    "4294967296",
    "2147483648",
    "18446744073709551615",
    "18446744073709551616",
    "-9223372036854775808",
    "1e400",
    "0x10",
    "1_000",
    "",
    "999999999999999999999999999999999999",
    "0.0000000000000000000000000000000001",
];

/// What is put in anywhere.
const PIECES: [&str; 19] = [
    "[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[",
    "{\"a\":{\"a\":{\"a\":{\"a\":",
    "\n",
    "\r",
    "\\\n",
    "\0",
    "\u{feff}",
    "\u{202e}",
    "\"",
    "'''",
    "<![CDATA[",
    "<!ENTITY a \"&a;&a;\">",
    "&a;",
    "TILT=INCLUDE\n",
    "f -1 -1 -1 1\n",
    "../../../../../../dev/null",
    "<a>",
    ",",
    "4294967295 ",
];

/// What names get in their middle, once or more: commands to terminals, text that runs backwards.
const EVILS: [&str; 5] = ["\u{1b}[31m", "\u{202e}", "\u{7}", "\r", "x"];

/// One to three changes of a file.
pub(super) fn changed(bytes: &[u8], numbers: &mut Numbers) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for _ in 0..1 + numbers.below(3) {
        bytes = match numbers.below(8) {
            0 if !bytes.is_empty() => damaged(&bytes, numbers),
            1 | 2 => other_number(&bytes, numbers),
            3 => with_piece(&bytes, numbers),
            4 => repeated(&bytes, numbers),
            5 => without_line(&bytes, numbers),
            6 => with_evil_name(&bytes, numbers),
            _ => swapped(&bytes, numbers),
        };
    }
    bytes
}

/// Where a number of a text begins and ends, at random.
fn number_at(bytes: &[u8], numbers: &mut Numbers) -> Option<[usize; 2]> {
    let is_part = |byte: &u8| byte.is_ascii_digit() || b"+-.eE".contains(byte);
    let from = numbers.below(bytes.len().max(1));
    let start = from + bytes.get(from..)?.iter().position(u8::is_ascii_digit)?;
    let length = bytes[start..].iter().take_while(|byte| is_part(byte)).count();
    Some([start, start + length])
}

fn other_number(bytes: &[u8], numbers: &mut Numbers) -> Vec<u8> {
    let Some([start, end]) = number_at(bytes, numbers) else { return bytes.to_vec() };
    let number = NUMBERS[numbers.below(NUMBERS.len())].as_bytes();
    [&bytes[..start], number, &bytes[end..]].concat()
}

fn with_piece(bytes: &[u8], numbers: &mut Numbers) -> Vec<u8> {
    let at = numbers.below(bytes.len() + 1);
    let piece = PIECES[numbers.below(PIECES.len())];
    let piece = piece.repeat(1 << numbers.below(12));
    [&bytes[..at], piece.as_bytes(), &bytes[at..]].concat()
}

/// A stretch of the file, once or up to some thousand times more.
fn repeated(bytes: &[u8], numbers: &mut Numbers) -> Vec<u8> {
    let start = numbers.below(bytes.len() + 1);
    let length = numbers.below((bytes.len() - start).min(80) + 1);
    let piece = bytes[start..start + length].repeat(1 << numbers.below(13));
    [&bytes[..start], &piece, &bytes[start..]].concat()
}

fn lines(bytes: &[u8]) -> Vec<&[u8]> {
    bytes.split_inclusive(|byte| *byte == b'\n').collect()
}

fn without_line(bytes: &[u8], numbers: &mut Numbers) -> Vec<u8> {
    let mut lines = lines(bytes);
    if !lines.is_empty() {
        lines.remove(numbers.below(lines.len()));
    }
    lines.concat()
}

fn swapped(bytes: &[u8], numbers: &mut Numbers) -> Vec<u8> {
    let mut lines = lines(bytes);
    if !lines.is_empty() {
        let [a, b] = [0; 2].map(|_| numbers.below(lines.len()));
        lines.swap(a, b);
    }
    lines.concat()
}

/// A word with what no terminal should see, or so long that no message should hold it.
fn with_evil_name(bytes: &[u8], numbers: &mut Numbers) -> Vec<u8> {
    let from = numbers.below(bytes.len().max(1));
    let rest = bytes.get(from..).unwrap_or_default();
    let Some(start) = rest.windows(2).position(|pair| pair.iter().all(u8::is_ascii_alphabetic))
    else {
        return bytes.to_vec();
    };
    let evil = EVILS[numbers.below(EVILS.len())].repeat(1 << (4 * numbers.below(4)));
    let middle = from + start + 1;
    [&bytes[..middle], evil.as_bytes(), &bytes[middle..]].concat()
}
