//! Reads 200,000 damaged weather files and as many damaged panoramas, or as many as the first
//! argument says:
//!
//!     cargo run --release -p quasilux-sky --example mutate -- 1000000
//!
//! The numbers of the files go on from a second argument (0 without it), so that runs can share the
//! work. A panic names the file.

#[path = "../tests/damage/mod.rs"]
mod damage;

use damage::{panorama, weather};
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
    let kinds: [Kind; 2] = [
        ("weather files", weather::seeds(), weather::examine),
        ("panoramas", panorama::samples(), panorama::examine),
    ];
    for (name, seeds, examine) in kinds {
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
