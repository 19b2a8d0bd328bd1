//! The memory that a run predicts, against the peak of the process as Linux tells it (`VmHWM`).

use crate::scenes::{Look, write_room};
use crate::support::{Folder, Run, number, parsed};
use std::fmt::Write;
use std::fs;
use std::process::Stdio;
use std::thread::sleep;
use std::time::Duration;

/// Cells of the ground along an edge, two triangles each.
const CELLS: usize = 300;

/// Runs a project, and says what it predicted and what it took, both in bytes.
fn predicted_and_taken(folder: &Folder, more: &[&str]) -> [f64; 2] {
    let arguments = ["run", "room.toml", "--out", "out", "--quiet", "--threads", "2"];
    let mut command = folder.command(&[&arguments, more].concat());
    let mut child = command.stdout(Stdio::null()).spawn().expect("the program starts");
    let status = format!("/proc/{}/status", child.id());
    let mut peak_bytes = 0.0;
    while child.try_wait().expect("the program runs").is_none() {
        let status = fs::read_to_string(&status).unwrap_or_default();
        let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let kib = line.and_then(|line| line.trim().trim_end_matches(" kB").parse::<f64>().ok());
        peak_bytes = kib.map_or(peak_bytes, |kib| 1024.0 * kib);
        sleep(Duration::from_millis(2));
    }
    let run = Run::new(child.wait_with_output().expect("the program ended"));
    assert_eq!(run.code, Some(3), "{}", run.stderr);
    let document = parsed(&folder.read("out/result.json"));
    [number(&document, "/run/prediction/bytes"), peak_bytes]
}

/// Hills in the room, which are most of its memory.
fn with_many_triangles(folder: &Folder) {
    let mut obj = folder.read("room.obj");
    // The room and its panel have 12 vertices.
    obj += "o ground\nusemtl wall\n";
    for i in 0..=CELLS {
        for j in 0..=CELLS {
            let [x, y] = [i, j].map(|k| 0.01 + 1.98 * k as f64 / CELLS as f64);
            let z = 0.02 + 0.001 * ((7 * i + 13 * j) % 11) as f64;
            writeln!(obj, "v {x:.5} {y:.5} {z:.5}").expect("text takes everything");
        }
    }
    for i in 0..CELLS {
        for j in 0..CELLS {
            let a = 13 + i * (CELLS + 1) + j;
            let [b, c, d] = [a + CELLS + 1, a + CELLS + 2, a + 1];
            writeln!(obj, "f {a} {b} {c}\nf {a} {c} {d}").expect("text takes everything");
        }
    }
    folder.write("room.obj", obj);
}

/// Of a run that goes on for a while: its last moments are looked at, too.
const LIMITS: [&str; 4] = ["--rel-tol", "1e-9", "--samples", "1024"];

#[test]
fn memory_is_predicted_within_a_factor_of_one_and_a_half() {
    let folder = Folder::new("memory_predicted");
    write_room(&folder, "room", &Look::GREY);
    for triangles in ["few", "many"] {
        if triangles == "many" {
            with_many_triangles(&folder);
        }
        let more = [&LIMITS[..], &["--estimator", "path"]].concat();
        let [predicted, taken] = predicted_and_taken(&folder, &more);
        let ratio = predicted / taken;
        println!("{triangles} triangles: {predicted:.3e} predicted, {taken:.3e} taken");
        assert!((1.0 / 1.5..=1.5).contains(&ratio), "{triangles} triangles: {ratio}");
    }
}

/// What photons may take is predicted as the most that it may be.
#[test]
fn memory_of_photons_is_bounded() {
    let folder = Folder::new("memory_bounded");
    write_room(&folder, "room", &Look::GREY);
    for estimator in ["auto", "bidirectional-map"] {
        let more = [&LIMITS[..], &["--estimator", estimator]].concat();
        let [predicted, taken] = predicted_and_taken(&folder, &more);
        println!("{estimator}: {predicted:.3e} predicted, {taken:.3e} taken");
        let ratio = predicted / taken;
        assert!((1.0 / 1.5..=2.0).contains(&ratio), "{estimator}: {ratio}");
    }
}

/// Many lights, of which the text of the project is the most, and maps of many small elements, of
/// which it is where their counters would be.
#[test]
fn memory_of_many_parts_is_predicted() {
    let folder = Folder::new("memory_parts");
    write_room(&folder, "room", &Look::GREY);
    let room = folder.read("room.toml");
    let light = |number: u32| {
        let [x, y] = [number % 180, number / 180].map(|k| 0.1 + 0.01 * f64::from(k));
        format!(
            "[[lights]]\nkind = \"point\"\nposition = [{x:.2}, {y:.2}, 1.6]\nintensity_cd = 1\n"
        )
    };
    let lights: String = (0..30_000).map(light).collect();
    let elements = "map_element_m = 0.002\nmap_adaptive = false\nmap_elements = 100000000\n";
    for (name, project, estimator) in [
        ("lights", room.replace("[simulation]", &format!("{lights}[simulation]")), "auto"),
        ("elements", room.clone() + elements, "bidirectional-map"),
    ] {
        folder.write("room.toml", project);
        let more = ["--rel-tol", "1e-9", "--samples", "16", "--estimator", estimator];
        let [predicted, taken] = predicted_and_taken(&folder, &more);
        println!("{name}: {predicted:.3e} predicted, {taken:.3e} taken");
        let ratio = predicted / taken;
        assert!((1.0 / 1.4..=1.4).contains(&ratio), "{name}: {ratio}");
    }
}
