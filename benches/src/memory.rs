//! cargo run --release -p quasilux-benches --bin memory
//!
//! Memory for ten million triangles: a closed room over a rough ground, read from a Wavefront file
//! that is made on the spot, with an illumination map of as many elements. Each line is a process
//! of its own, and the figures are its peaks (`VmHWM` of Linux): after loading, and in all; and
//! the memory predicted for data alone.

use glam::DVec3;
use quasilux_benches::meshes::Numbers;
use quasilux_benches::scenes::lamp_and_probe;
use quasilux_scene::{FileKind, Files, Scene, load};
use quasilux_transport::{EstimatorKind, MemoryNeed, Reconstruction, Settings, simulate};
use std::fmt::Write;
use std::io;
use std::process::Command;

/// Edge of the ground in cells of two triangles.
const CELLS: usize = 2236;
const TRIANGLES: f64 = (2 * CELLS * CELLS + 12) as f64;

/// Estimator, elements, replicates and binary logarithm of the samples.
const RUNS: [[&str; 4]; 3] = [
    ["path", "linear", "16", "4"],
    ["auto", "linear", "16", "10"],
    ["bidirectional-map", "linear", "16", "17"],
];

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [estimator, reconstruction, replicates, samples] = &arguments[..] {
        return run(estimator, reconstruction, replicates, samples);
    }
    println!(
        "{:<20}{:<12}{:>11}{:>10}{:>14}{:>14}{:>18}{:>15}",
        "estimator",
        "elements",
        "replicates",
        "samples",
        "loaded, GiB",
        "peak, GiB",
        "B / triangle",
        "predicted, GiB"
    );
    for arguments in RUNS {
        let program = std::env::current_exe().expect("this program has a path");
        let status = Command::new(program).args(arguments).status().expect("it starts again");
        assert!(status.success(), "{arguments:?} ended with {status}");
    }
}

fn run(estimator: &str, reconstruction: &str, replicates: &str, log_samples: &str) {
    let scene = relief();
    let loaded = peak_bytes();
    let settings = Settings {
        estimator: named(&EstimatorKind::ALL, EstimatorKind::name, estimator),
        replicates: replicates.parse().expect("a number"),
        max_samples: Some(1 << log_samples.parse::<u32>().expect("a number")),
        rel_tol: 0.0,
        map_elements: 10_000_000,
        map_reconstruction: named(&Reconstruction::ALL, Reconstruction::name, reconstruction),
        ..Settings::default()
    };
    let predicted = MemoryNeed::new(&scene, &settings).total_bytes(settings.max_samples) as f64;
    let estimates = simulate(&scene, &settings, &mut ());
    let peak = peak_bytes();
    println!(
        "{estimator:<20}{reconstruction:<12}{replicates:>11}{:>10}{:>14.2}{:>14.2}{:>18.0}{:>15.2}",
        estimates.samples,
        loaded / GIB,
        peak / GIB,
        peak / TRIANGLES,
        predicted / GIB
    );
}

/// What is called `name`.
fn named<T: Copy>(known: &[T], name_of: fn(T) -> &'static str, name: &str) -> T {
    known.iter().copied().find(|known| name_of(*known) == name).expect("a known name")
}

const GIB: f64 = (1_u64 << 30) as f64;

/// The most memory that this process had so far.
fn peak_bytes() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kib = line.and_then(|line| line.trim().trim_end_matches(" kB").parse::<f64>().ok());
    1024.0 * kib.expect("Linux tells the peak of a process")
}

/// The files of the project: one, and it is made when it is asked for.
struct Ground;

impl Files for Ground {
    fn read(&self, _path: &str, _kind: FileKind) -> io::Result<Vec<u8>> {
        Ok(ground().into_bytes())
    }
}

fn relief() -> Scene {
    let ground = "geometry = [\"ground.obj\"]\n[materials.ground]\nreflectance = 0.6";
    let project = lamp_and_probe(ground, [52.0, 47.0, 15.0], [50.0, 50.0, 10.0]);
    load("relief", project.as_bytes(), &Ground).expect("the project is well-formed").scene
}

/// The room and its ground as a Wavefront file.
fn ground() -> String {
    let numbers = &mut Numbers(11);
    let mut text = String::from("o ground\nusemtl ground\n");
    let vertex = |text: &mut String, p: DVec3| {
        writeln!(text, "v {:.4} {:.4} {:.4}", p.x, p.y, p.z).expect("text takes everything");
    };
    for corner in 0..8 {
        let pick =
            |axis: usize, low: f64, high: f64| if corner >> axis & 1 == 0 { low } else { high };
        let p = DVec3::new(pick(0, -1.0, 101.0), pick(1, -1.0, 101.0), pick(2, -8.0, 30.0));
        vertex(&mut text, p);
    }
    for i in 0..=CELLS {
        for j in 0..=CELLS {
            let (x, y) = (i as f64 / CELLS as f64, j as f64 / CELLS as f64);
            let hills = 2.0 * (wave(7.0 * x + y) + wave(7.0 * y - 2.1 * x));
            vertex(&mut text, DVec3::new(100.0 * x, 100.0 * y, hills + 0.03 * numbers.next()));
        }
    }
    for [a, b, c, d] in
        [[1, 2, 4, 3], [5, 7, 8, 6], [1, 5, 6, 2], [3, 4, 8, 7], [1, 3, 7, 5], [2, 6, 8, 4]]
    {
        writeln!(text, "f {a} {b} {c}\nf {a} {c} {d}").expect("text takes everything");
    }
    for i in 0..CELLS {
        for j in 0..CELLS {
            let a = 9 + i * (CELLS + 1) + j;
            let [b, c, d] = [a + CELLS + 1, a + CELLS + 2, a + 1];
            writeln!(text, "f {a} {b} {c}\nf {a} {c} {d}").expect("text takes everything");
        }
    }
    text
}

fn wave(x: f64) -> f64 {
    (2.0 * (x - x.floor()) - 1.0).abs()
}
