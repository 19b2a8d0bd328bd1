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
use quasilux_stats::damage::{Kind, examine_kinds};
use std::process::ExitCode;

fn main() -> ExitCode {
    let seeds = weather::seeds();
    let weather = Kind { name: "weather files", seeds, examine: weather::examine };
    let seeds = panorama::samples();
    let panoramas = Kind { name: "panoramas", seeds, examine: panorama::examine };
    examine_kinds(&[weather, panoramas], 200_000)
}
