//! Adds rooms to the references of `quasilux experiment gauntlet`, by brute force.
//!
//!     cargo run --release -p quasilux-experiments --example gauntlet-references -- \
//!         FIRST COUNT SECONDS_PER_ROOM [SEED [plain]]
//!
//! Writes the lines of `references.csv` to the standard output, and what a reader should know of
//! each point to the standard error. With `plain` no hints are used.

use quasilux_brute::{Limits, solve_until};
use quasilux_experiments::gauntlet::{
    Face, Lamp, Lookout, Parallelogram, Reference, Room, RoomReferences, SensorPlace, Shine,
    Surface, room,
};
use std::time::Instant;

#[path = "../src/gauntlet/brute.rs"]
mod brute;

/// Standard error over the mean that is enough.
const RELATIVE_ERROR: f64 = 0.002;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |k: usize| arguments.get(k).and_then(|word| word.parse::<u64>().ok());
    let (Some(first), Some(count), Some(seconds)) = (number(0), number(1), number(2)) else {
        eprintln!("expected FIRST COUNT SECONDS_PER_ROOM [SEED [plain]]");
        std::process::exit(2);
    };
    let is_plain = arguments.get(4).is_some_and(|word| word == "plain");
    for number in first..first + count {
        let mut room = room(number);
        if is_plain {
            room.hints.clear();
        }
        let seed = arguments.get(3).and_then(|word| word.parse().ok()).unwrap_or(1);
        print!("{}", solved(&room, seconds, seed).lines());
    }
}

#[expect(clippy::disallowed_methods, reason = "a reference may take so long")]
fn solved(room: &Room, seconds: u64, seed: u64) -> RoomReferences {
    let start = Instant::now();
    let limits = Limits { relative_error: RELATIVE_ERROR, paths: 1 << 34 };
    let may_go_on = || start.elapsed().as_secs() < seconds;
    let scene = brute::brute_scene(room);
    let estimates = solve_until(&scene, limits, seed.wrapping_add(room.number << 32), may_go_on);
    let parameters: Vec<String> = room.parameters.iter().map(ToString::to_string).collect();
    eprintln!("{} {}: {}", room.number, room.family, parameters.join(", "));
    let mut points = Vec::new();
    for (number, it) in estimates.iter().enumerate() {
        eprintln!(
            "  {number}: {:.5e} lx, {:.3} %, largest path {:.2} %, {} paths",
            it.lx,
            100.0 * it.standard_error_lx / it.lx,
            100.0 * it.largest_share,
            it.paths
        );
        points.push(Reference { lx: it.lx, standard_error_lx: it.standard_error_lx });
    }
    RoomReferences { number: room.number, digest: room.digest(), points }
}
