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
use quasilux_stats::damage::{Kind, examine_kinds};
use std::process::ExitCode;

fn main() -> ExitCode {
    let surfaces = Kind { name: "surfaces", seeds: seeds(), examine };
    let seeds = glazing::seeds();
    let products = Kind { name: "glazings", seeds, examine: glazing::examine };
    examine_kinds(&[surfaces, products], 200_000)
}
