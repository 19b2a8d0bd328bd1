//! Daylight factors with their components in all forms of output.

use crate::support::{Folder, number, parsed};

/// A ceiling over a floor, and a pane between them.
const ROOM: &str = "usemtl floor\nv 0 0 0\nv 3 0 0\nv 3 3 0\nv 0 3 0\nf 1 2 3 4\n\
                    usemtl ceiling\nv 0 0 2.5\nv 0 3 2.5\nv 3 3 2.5\nv 3 0 2.5\nf 5 6 7 8\n\
                    usemtl glass\nv 0 0 0\nv 0 0 2.5\nv 3 0 2.5\nv 3 0 0\nf 9 10 11 12\n";

const PROJECT: &str = "[scene]\ngeometry = [\"room.obj\"]\n[materials]\n\
                       floor = { reflectance = 0.4 }\nceiling = { reflectance = 0.7 }\n\
                       glass = { kind = \"pane\", transmittance = 0.8 }\n\
                       [sky]\nmodel = \"cie\"\ntype = 1\nhorizontal_illuminance_lx = 10000\n\
                       [ground]\nreflectance = 0.3\n\
                       [[sensors]]\nname = \"desk\"\nkind = \"points\"\n\
                       points = [[1.5, 1, 0.8], [1.5, 0.1, 1.5]]\n\
                       normals = [[0, 0, 1], [0, -1, 0]]\n";

const NAMES: [&str; 3] =
    ["sky_component", "externally_reflected_component", "internally_reflected_component"];

#[test]
fn components_are_columns_with_half_widths() {
    let folder = Folder::new("daylight_factor");
    folder.write("room.obj", ROOM);
    folder.write("a.toml", PROJECT);
    let done = folder.quasilux(&["run", "a.toml", "--out", "out"]);
    assert_eq!(done.code, Some(0), "{}", done.stderr);
    assert!(done.stdout.contains("daylight factor"), "{}", done.stdout);
    let document = parsed(&folder.read("out/result.json"));
    let csv = folder.read("out/desk.csv");
    let mut lines = csv.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let head = lines.next().unwrap();
    for (place, line) in lines.enumerate() {
        let of = |name: &str| number(&document, &format!("/sensors/0/points/{place}/{name}"));
        let total = of("daylight_factor");
        assert!((total - of("illuminance_lx") / 10_000.0).abs() < 1e-12);
        let sum: f64 = NAMES.map(of).iter().sum();
        assert!((sum - total).abs() < 1e-12, "{sum} not {total}");
        for name in NAMES.into_iter().chain(["daylight_factor"]) {
            assert!(of(name) >= 0.0 && of(&format!("{name}_half_width")) < 0.02 * total);
            for name in [name.to_owned(), format!("{name}_half_width")] {
                let column = head.iter().position(|it| *it == name).expect("a column");
                assert_eq!(line[column].parse(), Ok(of(&name)), "{name}");
            }
        }
    }
    // Half of what the point at the pane sees is ground.
    let ground = number(&document, "/sensors/0/points/1/externally_reflected_component");
    assert!((0.08..0.15).contains(&ground), "{ground}");
}

/// Under a lamp there is no daylight factor, and no column.
#[test]
fn lamps_leave_no_daylight_factor() {
    let folder = Folder::new("daylight_factor_lamp");
    folder.write("room.obj", ROOM);
    let lamp = "[[lights]]\nkind = \"point\"\nposition = [1.5, 1.5, 2]\nintensity_cd = 100\n";
    folder.write("a.toml", format!("{PROJECT}{lamp}"));
    let done = folder.quasilux(&["run", "a.toml", "--out", "out", "--samples", "64"]);
    assert!(matches!(done.code, Some(0 | 3)), "{}", done.stderr);
    let written = folder.read("out/desk.csv") + &folder.read("out/result.json") + &done.stdout;
    assert!(!written.contains("component") && !written.contains("daylight"), "{written}");
}
