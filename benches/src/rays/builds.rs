//! cargo run --release -p quasilux-benches --bin rays -- builds [SCENE...]
//!
//! How long hierarchies take to build, ours and Embree's at both its qualities. All take turns; the
//! figures are medians over the turns, in seconds by the wall clock and in seconds of all
//! processors together, and of the ratios within a turn. With `taskset -c 0` in front all run on
//! one thread.

use quasilux_benches::meshes::Scene;
use quasilux_benches::{median, timed};
use quasilux_bvh::TriangleBvh;
use quasilux_foreign::{Embree, Quality, all_processors_seconds};
use std::hint::black_box;

/// Each turn builds all hierarchies once; small scenes have more turns.
const MAX_TURNS: usize = 15;
const TRIANGLES: usize = 20_000_000;

/// Seconds of a build.
struct Cost {
    wall: f64,
    processor: f64,
}

pub(crate) fn headings() {
    let heads = ["wall, s", "processor, s", "wall ratio", "proc. ratio"];
    print!("{:<16}{:<26}", "", "");
    heads.iter().for_each(|head| print!("{head:>14}"));
    println!();
}

/// Builds all hierarchies over a scene in turns and prints what they cost.
pub(crate) fn measure(scene: &Scene, embree: Option<&Embree>) {
    let narrow = scene.narrow();
    let turns = (TRIANGLES / scene.corners.len()).clamp(3, MAX_TURNS);
    let mut costs = [const { Vec::new() }; 3];
    for _ in 0..turns {
        let corners = scene.corners.clone();
        costs[0].push(cost(|| TriangleBvh::build(corners)));
        let qualities = [Quality::Medium, Quality::High];
        for (costs, quality) in costs[1..].iter_mut().zip(qualities) {
            costs.extend(embree.map(|embree| cost(|| embree.build(&narrow, quality))));
        }
    }
    let own = format!("quasilux, {} triangles", scene.corners.len());
    let names = [own.as_str(), "Embree, medium", "Embree, high"];
    for (name, other) in names.iter().zip(&costs).filter(|(_, costs)| !costs.is_empty()) {
        let pairs = || costs[0].iter().zip(other);
        let figures = [
            median(other.iter().map(|cost| cost.wall)),
            median(other.iter().map(|cost| cost.processor)),
            median(pairs().map(|(own, other)| own.wall / other.wall)),
            median(pairs().map(|(own, other)| own.processor / other.processor)),
        ];
        print!("{:<16}{name:<26}", scene.name);
        figures.iter().for_each(|figure| print!("{figure:>14.3}"));
        println!();
    }
}

/// The cost of a build, without that of throwing its result away.
fn cost<R>(build: impl FnOnce() -> R) -> Cost {
    let before = all_processors_seconds();
    let built = timed(build);
    let processor = all_processors_seconds() - before;
    black_box(built.result);
    Cost { wall: built.seconds, processor }
}
