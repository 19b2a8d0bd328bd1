//! Reads 200,000 damaged files of measured surfaces and as many of glazing products, or as many as
//! the first argument says:
//!
//!     cargo run --release -p quasilux-bsdf --example mutate -- 1000000
//!
//! The numbers of the files go on from a second argument (0 without it), so that runs can share the
//! work. A panic names the file.

#[path = "../tests/damage/mod.rs"]
mod damage;

use damage::{examine, glazing, seeds};
use quasilux_stats::damage::{Outcome, Outcomes, Seeds, examine_damaged};
use std::process::ExitCode;

/// What is read, what files start as, and the reader with its checks.
type Kind = (&'static str, Seeds, fn(&[u8]) -> Outcome);

fn main() -> ExitCode {
    let arguments: Result<Vec<u64>, _> = std::env::args().skip(1).map(|a| a.parse()).collect();
    let Ok(arguments) = arguments else {
        eprintln!("usage: mutate [FILES [FIRST]]");
        return ExitCode::from(2);
    };
    let count = arguments.first().copied().unwrap_or(200_000);
    let first = arguments.get(1).copied().unwrap_or(0);
    let surfaces: Kind = ("surfaces", seeds(), examine);
    let products: Kind = ("glazings", glazing::seeds(), glazing::examine);
    for (name, seeds, examine) in [surfaces, products] {
        let Outcomes { read, max_bytes } = examine_damaged(&seeds, first..first + count, examine);
        println!(
            "{count} damaged {name} of {} seeds: {read} load, {} are refused; at most {max_bytes} \
             bytes allocated at one time",
            seeds.files().len(),
            count - read,
        );
    }
    ExitCode::SUCCESS
}
