//! `quasilux validate`: the project's own cases hold, and a wrong one does not.

use crate::support::{Folder, Run};
use quasilux_stats::deep;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// 100 cd, 2 m above the point: 25 lx.
const PROJECT: &str = r#"[scene]
geometry = ["floor.obj"]
[materials.black]
reflectance = 0
[[lights]]
kind = "point"
position = [0, 0, 2.5]
intensity_cd = 100
[[sensors]]
name = "spot"
kind = "points"
points = [[0, 0, 0.5]]
normals = [[0, 0, 1]]
"#;
const FLOOR_OBJ: &str =
    "o floor\nusemtl black\nv -2 -2 0\nv 2 -2 0\nv 2 2 0\nv -2 2 0\nf 1 2 3 4\n";

/// All of them in the deep variant. Else of each room that has a case for each of the 16 CIE skies
/// two, so that each sky is that of a room: a room that is wrong, or a sky, is found. The furnace
/// that reflects 0.9, which takes as long as the rest, is one of the tests of `quasilux-transport`.
#[test]
fn cases_of_the_project_hold() {
    let folder = folder("validate_project");
    let project = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../validation").canonicalize();
    let project = project.expect("the folder of the cases");
    let entries = std::fs::read_dir(project.join("cases")).expect("cases");
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    let mut rooms = BTreeSet::new();
    for path in &paths {
        let name = path.file_stem().and_then(|name| name.to_str()).expect("a name in ASCII");
        if !deep() && name == "furnace_90" {
            continue;
        }
        if let Some((room, sky)) = name.split_once("_sky_") {
            rooms.insert(room);
            let sky: usize = sky.parse().expect("the number of a sky");
            if !deep() && !(rooms.len() + sky).is_multiple_of(8) {
                continue;
            }
        }
        let text = std::fs::read_to_string(path).expect("a case");
        let text = text.replace("project = \"..", &format!("project = \"{}", project.display()));
        folder.write(&format!("validation/cases/{name}.toml"), text);
    }
    assert!(rooms.len() > 12, "{rooms:?}");
    let run = folder.quasilux(&["validate"]);
    assert_eq!(run.code, Some(0), "{}{}", run.stdout, run.stderr);
    let last = run.stdout.lines().last().unwrap_or_default();
    assert!(last.ends_with(" passed, 0 failed") && !last.starts_with("0 "), "{last}");
}

#[test]
fn a_wrong_value_fails() {
    let folder = folder("validate_wrong");
    folder.write("validation/cases/wrong.toml", case("25.01"));
    folder.write("validation/cases/right.toml", case("25"));
    let run = folder.quasilux(&["validate"]);
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    assert!(run.stdout.ends_with("1 passed, 1 failed\n"), "{}", run.stdout);
    assert_eq!(run.stdout.matches("FAILS: I / h^2").count(), 1, "{}", run.stdout);
}

#[test]
fn what_is_no_case_is_refused() {
    for (name, case, needle) in [
        ("empty", None, "no cases"),
        (
            "no_values",
            Some("name = \"a\"\nsource = \"\"\nproject = \"a\"\nexpect = []\n"),
            "at least",
        ),
        ("no_sensor", Some(&*case("25").replace("\"spot\"", "\"sport\"")), "sport"),
        ("no_point", Some(&*case("25").replace("point = 0", "point = 1")), "no point 1"),
        ("place", Some(&*case("25").replace("point = 0", "point = 1")), "case.toml:4:1: "),
        ("typing", Some(&*case("25").replace("point = 0", "point = x")), "case.toml:7:9: "),
        (
            "no_estimator",
            Some(&*format!("rel_tol = {{ path = 0.1 }}\n{}", case("25"))),
            "none of the estimators",
        ),
        ("no_figure", Some(&*case("25").replace("illuminance_lx", "luminance")), "luminance"),
    ] {
        let folder = folder(&format!("validate_{name}"));
        folder.write("validation/cases/note.txt", "not a case");
        if let Some(case) = case {
            folder.write("validation/cases/case.toml", case);
        }
        let run = folder.quasilux(&["validate"]);
        assert_eq!(run.code, Some(2), "{name}: {}", run.stdout);
        assert!(run.stderr.starts_with("error: ") && run.stderr.contains(needle), "{}", run.stderr);
    }
}

/// What was computed until then is too rough to be judged.
#[cfg(unix)]
#[test]
fn an_interrupt_is_no_verdict() {
    use crate::scenes::{Look, write_room};
    use crate::support::interrupt;
    use std::io::{BufRead, BufReader, Read};

    let folder = folder("validate_interrupt");
    write_room(&folder, "endless", &Look::GREY);
    let endless = folder.read("endless.toml").replace("rel_tol = 0.1", "rel_tol = 1e-9");
    folder.write("endless.toml", endless);
    let case = case("25").replace("../scenes/direct.toml", "../../endless.toml");
    folder.write("validation/cases/endless.toml", case.replace("\"spot\"", "\"probes\""));
    let mut child = folder.command(&["validate"]).spawn().expect("the program starts");
    // It listens to interrupts before it prints the header.
    let mut stdout = BufReader::new(child.stdout.take().expect("a pipe"));
    let mut text = String::new();
    stdout.read_line(&mut text).expect("a header");
    interrupt(&child);
    stdout.read_to_string(&mut text).expect("UTF-8");
    let run = Run::new(child.wait_with_output().expect("the program ends"));
    assert_eq!(run.code, Some(130), "{text}{}", run.stderr);
    assert!(!text.contains("holds") && !text.contains("FAILS"), "{text}");
}

/// As in `quasilux validate | head -1`.
#[test]
fn a_reader_that_has_gone_is_no_reason_to_panic() {
    let folder = folder("validate_pipe");
    folder.write("validation/cases/right.toml", case("25"));
    let mut child = folder.command(&["validate"]).spawn().expect("the program starts");
    drop(child.stdout.take());
    let run = Run::new(child.wait_with_output().expect("the program ends"));
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert_eq!(run.stderr, "");
}

fn folder(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("validation/scenes/floor.obj", FLOOR_OBJ);
    folder.write("validation/scenes/direct.toml", PROJECT);
    folder
}

fn case(value: &str) -> String {
    format!(
        "name = \"spot\"\nsource = \"closed form\"\nproject = \"../scenes/direct.toml\"\n\
         [[expect]]\nsensor = \"spot\"\nfigure = \"illuminance_lx\"\npoint = 0\nvalue = {value}\n\
         tolerance_rel = 1e-6\nwhy = \"I / h^2\"\n"
    )
}
