//! What is told of scenes that are probably wrong: before a run, by `check`, and after a run.

use crate::scenes::{Look, write_floor, write_room};
use crate::support::{Folder, parsed};
use serde_json::Value;

const SHORT: [&str; 2] = ["--samples", "128"];

fn right(name: &str) -> Folder {
    let folder = Folder::new(name);
    write_room(&folder, "room", &Look::GREY);
    folder
}

/// The luminaire hangs half a metre above the ceiling.
fn wrong(name: &str) -> Folder {
    let folder = right(name);
    let project = folder.read("room.toml");
    folder.write("room.toml", project.replace("[0.4, 1.2, 1.5]", "[0.4, 1.2, 2.5]"));
    folder
}

/// The names of what was found.
fn checks(document: &Value) -> Vec<&str> {
    let findings = document["findings"].as_array().expect("a list of findings");
    findings.iter().map(|finding| finding["check"].as_str().expect("a name")).collect()
}

#[test]
fn a_right_room_is_let_in_without_a_word() {
    let folder = right("door_right");
    let run = folder.quasilux(&[&["run", "room.toml", "--strict"], &SHORT[..]].concat());
    assert!(matches!(run.code, Some(0 | 3)), "{}", run.stderr);
    assert!(!run.stderr.contains("warning"), "{}", run.stderr);
    assert_eq!(checks(&parsed(&folder.read("out/room/result.json"))), [""; 0]);
    let check = folder.quasilux(&["check", "room.toml", "--strict"]);
    assert_eq!(check.code, Some(0), "{}", check.stderr);
    assert!(check.stdout.contains("nothing odd was found"), "{}", check.stdout);
}

#[test]
fn a_run_tells_of_a_wrong_lamp_before_it_begins() {
    let folder = wrong("door_wrong");
    let run = folder.quasilux(&[&["run", "room.toml"], &SHORT[..]].concat());
    assert!(matches!(run.code, Some(0 | 3)), "{}", run.stderr);
    let told = "warning: room.toml:8:1: luminaire 1 (\"lamp.ies\") at [0.4, 1.2, 2.5]";
    assert!(run.stderr.contains(told), "{}", run.stderr);
    let document = parsed(&folder.read("out/room/result.json"));
    assert_eq!(checks(&document), ["lamp-outside"]);
    let finding = &document["findings"][0];
    assert_eq!((&finding["file"], &finding["line"]), (&"room.toml".into(), &8.into()));
    assert!(document["warnings"].to_string().contains("[lamp-outside]"), "{document}");
}

#[test]
fn a_strict_run_refuses_a_wrong_lamp() {
    let folder = wrong("door_strict");
    let run = folder.quasilux(&["run", "room.toml", "--strict"]);
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    assert!(run.stderr.contains("error: room.toml:8:1: luminaire 1"), "{}", run.stderr);
    assert!(!folder.path("out/room/result.json").exists());
}

#[test]
fn check_lists_what_is_wrong_and_draws_it() {
    let folder = wrong("door_check");
    let check = folder.quasilux(&["check", "room.toml", "--out", "seen"]);
    assert_eq!(check.code, Some(0), "{}", check.stderr);
    assert!(check.stdout.contains("warning 1: room.toml:8:1: luminaire 1"), "{}", check.stdout);
    for word in ["geometry", "materials", "lights", "sensors", "seen/plan.svg"] {
        assert!(check.stdout.contains(word), "{word}: {}", check.stdout);
    }
    let plan = folder.read("seen/plan.svg");
    for words in ["<svg", "hangs outside the geometry", "remark 1: 50 cm above"] {
        assert!(plan.contains(words), "{words}");
    }
    let png = std::fs::read(folder.path("seen/plan.png")).expect("a picture");
    assert!(png.starts_with(b"\x89PNG"));
    let json = folder.quasilux(&["check", "room.toml", "--json"]);
    assert_eq!(checks(&parsed(&json.stdout)), ["lamp-outside"]);
    assert_eq!(folder.quasilux(&["check", "room.toml", "--strict", "--quiet"]).code, Some(1));
}

/// The target of a grid is told by `check`, and changes its picture and no result.
#[test]
fn a_target_is_told_and_drawn() {
    let [plain, aimed] = ["door_plain", "door_target"].map(right);
    let project = aimed.read("room.toml");
    let with = project.replace("counts = [3, 2]", "counts = [3, 2]\ntarget_lx = 250");
    aimed.write("room.toml", with);
    let check = aimed.quasilux(&["check", "room.toml"]);
    assert!(check.stdout.contains("normal up, target 250 lx\n"), "{}", check.stdout);
    let files = [&plain, &aimed].map(|folder| {
        folder.quasilux(&[&["run", "room.toml"], &SHORT[..]].concat());
        ["csv", "png"].map(|ending| {
            std::fs::read(folder.path(&format!("out/room/plane.{ending}"))).expect("a result")
        })
    });
    assert_eq!(files[0][0], files[1][0]);
    assert_ne!(files[0][1], files[1][1]);
}

#[test]
fn a_sensor_in_the_dark_is_told_why() {
    let folder = right("door_dark");
    // A hood over the first probe, that no light gets into.
    let hood = "o hood\nusemtl wall\nv 0.8 0.8 0\nv 1.2 0.8 0\nv 1.2 1.2 0\nv 0.8 1.2 0\n\
                v 0.8 0.8 0.8\nv 1.2 0.8 0.8\nv 1.2 1.2 0.8\nv 0.8 1.2 0.8\n\
                f -8 -7 -3 -4\nf -7 -6 -2 -3\nf -6 -5 -1 -2\nf -5 -8 -4 -1\nf -4 -3 -2 -1\n";
    let geometry = folder.read("room.obj") + hood;
    folder.write("room.obj", geometry);
    let run = folder.quasilux(&[&["run", "room.toml"], &SHORT[..]].concat());
    assert!(matches!(run.code, Some(0 | 3)), "{}", run.stderr);
    assert!(!run.stderr.contains("warning"), "{}", run.stderr);
    let told = "no light was found at 1 point of 2 of sensor \"probes\", for example at \
                [1, 1, 0.5]: \"hood\" stands in front of the nearest lamp, and no surface in sight \
                is lit";
    assert!(run.stdout.contains(told), "{}", run.stdout);
    assert_eq!(checks(&parsed(&folder.read("out/room/result.json"))), ["sensor-dark"]);
}

#[test]
fn the_table_says_where_the_light_went() {
    let folder = Folder::new("door_flux");
    write_floor(&folder, "floor", &Look::GREY);
    let run = folder.quasilux(&[&["run", "floor.toml"], &SHORT[..]].concat());
    let line = run.stdout.lines().find(|line| line.starts_with("light: ")).expect("a line");
    let document = parsed(&folder.read("out/floor/result.json"));
    let lm = |key: &str| document["run"][key].as_f64().expect("a number");
    let lost = 100.0 * lm("flux_lost_lm") / lm("flux_emitted_lm");
    let told: f64 = line.split(", ").nth(2).unwrap().split(' ').next().unwrap().parse().unwrap();
    assert!((told / lost - 1.0).abs() < 0.01 && lost > 20.0, "{line}: {lost} %");
}
