//! Right scenes: the examples, the cases of validation, and rooms that only look odd.

use crate::room::{Case, Face, body, inspected, plate, shell};
use glam::DVec3;
use quasilux_scene::{FileKind, Files};
use std::path::{Path, PathBuf};

/// Files of a folder.
struct Folder(PathBuf);

impl Files for Folder {
    fn read(&self, path: &str, _: FileKind) -> std::io::Result<Vec<u8>> {
        std::fs::read(self.0.join(path))
    }
}

fn v(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

/// Panics with all that is said of scenes of which nothing is to be said.
fn quiet(cases: impl IntoIterator<Item = (String, Vec<quasilux_inspection::Finding>)>) {
    let told: Vec<String> = cases
        .into_iter()
        .flat_map(|(name, findings)| findings.into_iter().map(move |it| format!("{name}: {it}")))
        .collect();
    assert!(told.is_empty(), "{}", told.join("\n"));
}

fn projects(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).expect("a folder of projects") {
        let path = entry.expect("a readable folder").path();
        if path.is_dir() {
            found.extend(projects(&path));
        } else if path.extension().is_some_and(|end| end == "toml")
            && path.file_name().is_some_and(|name| name != "expected.toml")
        {
            found.push(path);
        }
    }
    found.sort();
    found
}

#[test]
fn examples_and_validation_are_right() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let examples = projects(&root.join("examples"));
    let validation = projects(&root.join("validation/scenes"));
    assert!(examples.len() >= 6 && validation.len() >= 18);
    quiet(examples.into_iter().chain(validation).map(|path| {
        let name = path.display().to_string();
        let project = std::fs::read(&path).expect("a project file");
        let folder = Folder(path.parent().expect("a folder").to_owned());
        let findings = inspected(&name, &project, &folder);
        (name, findings)
    }));
}

#[test]
fn rooms_that_only_look_odd_are_right() {
    let office = Case::new();
    let desk = body("desk", v(1.0, 1.0, 0.7), v(2.5, 1.8, 0.74));
    let window = Face {
        object: "south",
        material: "glass",
        corners: vec![v(1.0, 0.0, 1.0), v(1.0, 0.0, 2.0), v(3.0, 0.0, 2.0), v(3.0, 0.0, 1.0)],
    };
    let panes = "[materials.glass]\nkind = \"pane\"\n[[luminaires]]";
    let uplight =
        "[[luminaires]]\nphotometry = \"lamp.ies\"\naim = [0, 0, 1]\nposition = [3, 2, 2]\n";
    let back_to_back =
        "[[luminaires]]\nphotometry = \"lamp.ies\"\naim = [0, 0, 1]\nposition = [1.5, 2, 2.7]\n";
    let screen = plate("screen", "wall", [v(2.0, 0.5, 1.5), v(4.0, 3.5, 1.5)], true);
    let tall = "position = [4.5, 2, 2.7]";
    let cases = [
        ("plain", office.clone()),
        ("a desk", office.clone().with(desk)),
        ("a window", wall_with_window(window).say("[[luminaires]]", panes)),
        ("a roof under the sky", office.clone().add(SKY).add(ON_THE_ROOF)),
        ("a square under the sky", square()),
        ("an uplight", office.clone().add(uplight)),
        ("up and down at one place", office.clone().add(back_to_back)),
        ("a lamp in the ceiling's plane", office.clone().say(tall, "position = [4.5, 2, 3]")),
        ("dark below a screen", office.clone().with([screen])),
        ("a hall", office.clone().moved(|p| p * v(2.0, 2.0, 1.5))),
        ("a narrow corridor", corridor()),
        ("inside a tower", office.clone().with(shell(v(-9.0, -9.0, -9.0), v(19.0, 19.0, 29.0)))),
        (
            "centimetres",
            office.clone().moved(|p| p * 100.0).say("[scene]", "[scene]\nunits = \"cm\""),
        ),
        (
            "all in millimetres, said so",
            office
                .moved(|p| p * 1000.0)
                .positions_scaled(1000.0)
                .say("[scene]", "[scene]\nunits = \"mm\"\nposition_units = \"mm\""),
        ),
    ];
    quiet(cases.map(|(name, case)| (name.to_owned(), case.findings())));
}

const SKY: &str = "[sky]\nmodel = \"cie\"\ntype = 1\nhorizontal_illuminance_lx = 10000\n";
const ON_THE_ROOF: &str = "[[sensors]]\nname = \"roof\"\nkind = \"points\"\n\
    points = [[2, 2, 3.1], [4, 2, 3.1]]\nnormals = [[0, 0, 1], [1, 0, 0.1]]\n\
    [[cameras]]\nname = \"c\"\nposition = [2, 2, 20]\ntarget = [3, 2, 3]\n\
    vertical_fov_deg = 50\nresolution = [9, 6]\n";

/// A flat model in the open, seen by points above it.
fn square() -> Case {
    let floor = |case: Case, name| case.without(name);
    let walls = ["ceiling", "south", "north", "west", "east"];
    let bare = "[materials.ceiling]\nreflectance = 0.8\n[materials.wall]\nreflectance = 0.6\n";
    walls.into_iter().fold(Case::new(), floor).say(bare, "").add(SKY)
}

/// The room with the south wall around a pane.
fn wall_with_window(window: Face) -> Case {
    let strip = |x: [f64; 2], z: [f64; 2]| Face {
        object: "south",
        material: "wall",
        corners: vec![
            v(x[0], 0.0, z[0]),
            v(x[0], 0.0, z[1]),
            v(x[1], 0.0, z[1]),
            v(x[1], 0.0, z[0]),
        ],
    };
    let strips = [
        strip([0.0, 1.0], [0.0, 3.0]),
        strip([3.0, 6.0], [0.0, 3.0]),
        strip([1.0, 3.0], [0.0, 1.0]),
        strip([1.0, 3.0], [2.0, 3.0]),
    ];
    Case::new().without("south").with(strips).with([window])
}

/// A corridor that is much longer than wide, lit at one end, with sensors at the other.
fn corridor() -> Case {
    let mut case = Case::new()
        .say("position = [1.5, 2, 2.7]", "position = [1, 0.7, 2.7]")
        .say("position = [4.5, 2, 2.7]", "position = [3, 0.7, 2.7]")
        .say("origin = [0.5, 0.5, 0.8]", "origin = [20, 0.2, 0.8]")
        .say("v = [0, 3, 0]", "v = [0, 1, 0]");
    case.faces = shell(DVec3::ZERO, v(26.0, 1.5, 3.0));
    case
}
