//! The program that examples called `mutate` are: any number of damaged files of some kinds.

use super::{Outcome, Outcomes, Seeds, examine_damaged};
use std::process::ExitCode;

/// Files that one reader reads.
pub struct Kind {
    /// What they are called, in the plural.
    pub name: &'static str,
    /// The undamaged ones.
    pub seeds: Seeds,
    /// The reader with its checks.
    pub examine: fn(&[u8]) -> Outcome,
}

/// Reads as many damaged files of each kind as the first argument of the program says, or `files`,
/// their numbers from the second argument on (0 without it), and prints what became of them.
///
/// # Panics
/// Where `examine` panics, naming the file.
#[must_use]
pub fn examine_kinds(kinds: &[Kind], files: u64) -> ExitCode {
    let arguments: Result<Vec<u64>, _> = std::env::args().skip(1).map(|a| a.parse()).collect();
    let Ok(arguments) = arguments else {
        eprintln!("usage: mutate [FILES [FIRST]]");
        return ExitCode::from(2);
    };
    let count = arguments.first().copied().unwrap_or(files);
    let first = arguments.get(1).copied().unwrap_or(0);
    for Kind { name, seeds, examine } in kinds {
        let Outcomes { read, max_bytes } = examine_damaged(seeds, first..first + count, examine);
        println!(
            "{count} damaged {name} of {} seeds: {read} load, {} are refused; at most {max_bytes} \
             bytes allocated at one time",
            seeds.files().len(),
            count - read,
        );
    }
    ExitCode::SUCCESS
}
