//! One change to a file: of its bytes, of its numbers and lines, or of the whole of it.
//!
//! Bytes are what a disk damages. Numbers, lines and encodings are what other programs get wrong,
//! and what brings a file past the first check of its reader.

use crate::SplitMix64;
use std::ops::Range;

/// No file grows beyond this, however often parts of it are repeated.
const MAX_BYTES: usize = 1 << 16;

/// Numbers that a reader must not trust, and marks with a meaning.
const FRAGMENTS: [&[u8]; 40] = [
    b"0",
    b"-0",
    b"1",
    b"-1",
    b"2",
    b"3",
    b"1.5",
    b"1,5",
    b"00012",
    b"+7",
    b"0.0000001",
    b"-90",
    b"45",
    b"89.9999999999",
    b"90.0000000001",
    b"180",
    b"270",
    b"360",
    b"720",
    b"1e15",
    b"1e18",
    b"1e-300",
    b"4e-324",
    b"1e308",
    b"1e999",
    b"-1e999",
    b"nan",
    b"inf",
    b"65536",
    b"4294967295",
    b"4294967296",
    b"18446744073709551615",
    b"999999999999999",
    b"0x10",
    b"1e",
    b".",
    b"TILT=",
    b"[MORE]",
    b"\xC3\xA9",
    b"\0",
];

/// Changes `bytes` in one way. `others` are files to take parts from.
pub fn mutate(bytes: &mut Vec<u8>, others: &[Vec<u8>], random: &mut SplitMix64) {
    match random.below(16) {
        0 => change_bytes(bytes, random),
        1..=3 => change_digit(bytes, random),
        4..=8 => change_token(bytes, random),
        9..=11 => change_line(bytes, random),
        12 => drop_or_repeat(bytes, random),
        13 => splice(bytes, others, random),
        14 => bytes.truncate(random.below(bytes.len() + 1)),
        _ => change_all(bytes, random),
    }
    bytes.truncate(MAX_BYTES);
}

fn change_bytes(bytes: &mut Vec<u8>, random: &mut SplitMix64) {
    let at = random.below(bytes.len() + 1);
    if at == bytes.len() {
        return bytes.push(random.byte());
    }
    match random.below(4) {
        0 => bytes[at] = random.byte(),
        1 => bytes[at] ^= 1 << random.below(8),
        2 => bytes.insert(at, random.byte()),
        _ => {
            bytes.remove(at);
        }
    }
}

fn change_digit(bytes: &mut [u8], random: &mut SplitMix64) {
    let digits: Vec<usize> = (0..bytes.len()).filter(|&i| bytes[i].is_ascii_digit()).collect();
    if !digits.is_empty() {
        bytes[digits[random.below(digits.len())]] = b"0123456789.-e"[random.below(13)];
    }
}

fn change_token(bytes: &mut Vec<u8>, random: &mut SplitMix64) {
    let tokens = parts(bytes, |byte| matches!(byte, b' ' | b'\t' | b'\r' | b'\n' | b',' | b';'));
    if tokens.is_empty() {
        return;
    }
    let any = |random: &mut SplitMix64| tokens[random.below(tokens.len())].clone();
    let (one, other) = (any(random), any(random));
    let fragment = FRAGMENTS[random.below(FRAGMENTS.len())];
    match random.below(6) {
        0 | 1 => replace(bytes, one, fragment),
        2 => {
            let end = one.end;
            replace(bytes, end..end, &[b" ", fragment].concat());
        }
        3 => replace(bytes, one, b""),
        4 => {
            let copy = [b" ", &bytes[one.clone()]].concat();
            replace(bytes, one.end..one.end, &copy);
        }
        _ => swap(bytes, one, other),
    }
}

fn change_line(bytes: &mut Vec<u8>, random: &mut SplitMix64) {
    let lines = parts(bytes, |byte| matches!(byte, b'\r' | b'\n'));
    if lines.is_empty() {
        return;
    }
    let any = |random: &mut SplitMix64| lines[random.below(lines.len())].clone();
    let (one, other) = (any(random), any(random));
    match random.below(6) {
        0 => replace(bytes, one, b""),
        1 => {
            let copy = [b"\n", &bytes[one.clone()]].concat();
            replace(bytes, one.end..one.end, &copy);
        }
        2 => swap(bytes, one, other),
        // Joins the line with the one behind it.
        3 if one.end < bytes.len() => bytes[one.end] = b' ',
        4 => {
            let at = one.start + random.below(one.len());
            replace(bytes, at..at, b"\n");
        }
        _ => replace(bytes, one.start..one.start, b"\r\n"),
    }
}

/// Leaves out a piece, or repeats it up to a thousand times.
fn drop_or_repeat(bytes: &mut Vec<u8>, random: &mut SplitMix64) {
    let start = random.below(bytes.len() + 1);
    let end = (start + random.below(64)).min(bytes.len());
    let times = [0, 0, 2, 2, 10, 1000][random.below(6)];
    let piece = bytes[start..end].repeat(times);
    replace(bytes, start..end, &piece);
}

/// Goes on with the rest of another file.
fn splice(bytes: &mut Vec<u8>, others: &[Vec<u8>], random: &mut SplitMix64) {
    let Some(other) = (!others.is_empty()).then(|| &others[random.below(others.len())]) else {
        return;
    };
    bytes.truncate(random.below(bytes.len() + 1));
    bytes.extend_from_slice(&other[random.below(other.len() + 1)..]);
}

/// Encodings, line ends and separators.
fn change_all(bytes: &mut Vec<u8>, random: &mut SplitMix64) {
    let each = |bytes: &[u8], from: u8, to: &[u8]| -> Vec<u8> {
        let changed =
            bytes.iter().map(|byte| if *byte == from { to } else { std::slice::from_ref(byte) });
        changed.flatten().copied().collect()
    };
    *bytes = match random.below(9) {
        0 => [b"\xFF\xFE", utf_16(bytes, u16::to_le_bytes).as_slice()].concat(),
        1 => [b"\xFE\xFF", utf_16(bytes, u16::to_be_bytes).as_slice()].concat(),
        2 => [b"\xEF\xBB\xBF", bytes.as_slice()].concat(),
        3 => each(bytes, b'e', b"\xE9"),
        4 => each(bytes, b'\n', b"\r\n"),
        5 => each(bytes, b'\n', b"\r"),
        6 => each(bytes, b'\n', b" "),
        7 => each(bytes, b' ', b"\n"),
        _ => each(bytes, b'.', b","),
    };
}

fn utf_16(bytes: &[u8], unit: fn(u16) -> [u8; 2]) -> Vec<u8> {
    bytes.iter().flat_map(|&byte| unit(u16::from(byte))).collect()
}

/// The runs of bytes between separators.
fn parts(bytes: &[u8], separates: impl Fn(u8) -> bool) -> Vec<Range<usize>> {
    let mut parts = Vec::new();
    let mut start = 0;
    for end in 0..=bytes.len() {
        if end == bytes.len() || separates(bytes[end]) {
            if end > start {
                parts.push(start..end);
            }
            start = end + 1;
        }
    }
    parts
}

fn replace(bytes: &mut Vec<u8>, range: Range<usize>, with: &[u8]) {
    bytes.splice(range, with.iter().copied());
}

/// Exchanges two parts that do not overlap.
fn swap(bytes: &mut Vec<u8>, one: Range<usize>, other: Range<usize>) {
    let (first, second) = if one.start < other.start { (one, other) } else { (other, one) };
    if first.end <= second.start {
        let copy = bytes[first.clone()].to_vec();
        let moved = bytes[second.clone()].to_vec();
        replace(bytes, second, &copy);
        replace(bytes, first, &moved);
    }
}
