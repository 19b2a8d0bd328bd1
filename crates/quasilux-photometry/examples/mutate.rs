//! Reads a million damaged files of each format, or as many as the first argument says:
//!
//!     cargo run --release -p quasilux-photometry --example mutate -- 1000000
//!
//! The numbers of the files go on from a second argument (0 without it), and a third one names a
//! format (Ies, Ldt or Tm33), so that runs can share the work. A panic names the file.

#[path = "../tests/damage/mod.rs"]
mod damage;

use damage::{Format, examine};
use quasilux_stats::damage::{Outcomes, examine_damaged};
use std::process::ExitCode;

fn main() -> ExitCode {
    let numbers = std::env::args().skip(1).take(2);
    let arguments: Result<Vec<u64>, _> = numbers.map(|a| a.parse()).collect();
    let format = std::env::args().nth(3);
    let is_meant = |known: &Format| format.as_ref().is_none_or(|f| *f == format!("{known:?}"));
    let formats: Vec<Format> = Format::ALL.into_iter().filter(is_meant).collect();
    let Some(arguments) = arguments.ok().filter(|_| !formats.is_empty()) else {
        eprintln!("usage: mutate [FILES [FIRST [FORMAT]]]");
        return ExitCode::from(2);
    };
    let count = arguments.first().copied().unwrap_or(1_000_000);
    let first = arguments.get(1).copied().unwrap_or(0);
    for format in formats {
        run(format, first..first + count);
    }
    ExitCode::SUCCESS
}

fn run(format: Format, indices: std::ops::Range<u64>) {
    let seeds = format.seeds();
    let count = indices.end - indices.start;
    let Outcomes { read, max_bytes } =
        examine_damaged(&seeds, indices, |bytes| examine(format, bytes));
    println!(
        "{format:?}: {count} damaged files of {} seeds: {read} load, {} are refused; \
         at most {max_bytes} bytes allocated at one time",
        seeds.files().len(),
        count - read,
    );
}
