//! Inputs made at random of good ones: pieces cut, repeated, swapped or replaced by numbers at the
//! edges of what numbers are, bits turned; and command lines of words that do not belong together.
//!
//! The deep variant makes 3000 of them. A fault that one input in a hundred has is found with
//! probability 0.87 by 200 of them.

use super::seeds::{Seed, seeds};
use super::{fault_of, limited};
use crate::support::{Numbers, damaged};
use quasilux_stats::deep;
use std::fmt::Write;

const INPUTS: usize = 200;
const DEEP_INPUTS: usize = 3000;

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
const PIECES: [&str; 16] = [
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
];

/// One to three changes of a file.
fn changed(bytes: &[u8], numbers: &mut Numbers) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for _ in 0..1 + numbers.below(3) {
        bytes = match numbers.below(7) {
            0 if !bytes.is_empty() => damaged(&bytes, numbers),
            1 | 2 => other_number(&bytes, numbers),
            3 => with_piece(&bytes, numbers),
            4 => repeated(&bytes, numbers),
            5 => without_line(&bytes, numbers),
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

/// Words of command lines.
const WORDS: [&str; 40] = [
    "run",
    "points",
    "photometry",
    "bsdf",
    "plan",
    "shard",
    "merge",
    "resume",
    "check",
    "validate",
    "completions",
    "room.toml",
    "lamp.ies",
    "sheet.xml",
    "a.part",
    "run.ck",
    "plan.json",
    "sobol",
    "--out",
    "out",
    "--samples",
    "2",
    "--time",
    "0.1s",
    "--rel-tol",
    "1e-300",
    "--threads",
    "1025",
    "--seed",
    "18446744073709551615",
    "--json",
    "--quiet",
    "--plan",
    "--shard",
    "0/1",
    "--csv",
    "-n",
    "2^3",
    "--dims",
    "4294967295",
];

fn words(numbers: &mut Numbers) -> Vec<&'static str> {
    // The first word is a command most of the time.
    let commands = if numbers.below(8) == 0 { WORDS.len() } else { 11 };
    let first = WORDS[numbers.below(commands)];
    let more = numbers.below(7);
    std::iter::once(first).chain((0..more).map(|_| WORDS[numbers.below(WORDS.len())])).collect()
}

#[test]
fn inputs_at_random_are_refused_or_done() {
    let (folder, seeds) = seeds();
    let mut faults = String::new();
    let mut refused = 0;
    let inputs = if deep() { DEEP_INPUTS } else { INPUTS };
    for input in 0..inputs {
        let numbers = &mut Numbers(input as u64);
        numbers.below(2);
        let run = if input % (seeds.len() + 1) == seeds.len() {
            let words = words(numbers);
            let run = limited(&folder, &words);
            if let Some(fault) = fault_of(&run) {
                writeln!(faults, "{input}: {words:?}: {fault}").expect("text takes everything");
            }
            run
        } else {
            let Seed { file, bytes, commands } = &seeds[input % (seeds.len() + 1)];
            folder.write(file, changed(bytes, numbers));
            let command = &commands[numbers.below(commands.len())];
            let run = limited(&folder, command);
            if let Some(fault) = fault_of(&run) {
                writeln!(faults, "{input}: {file} of {command:?}: {fault}")
                    .expect("text takes everything");
            }
            run
        };
        refused += usize::from(run.code == Some(2));
        // What runs have written over.
        for Seed { file, bytes, .. } in &seeds {
            folder.write(file, bytes);
        }
    }
    println!("{refused} of {inputs} refused");
    assert!(faults.is_empty(), "\n{faults}");
    assert!((inputs / 4..inputs).contains(&refused), "{refused} of {inputs} are refused");
}
