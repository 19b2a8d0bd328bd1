//! `as = "area"`: a luminaire shines from its luminous opening.

use crate::support::{Folder, number, parsed};

/// 1000 cd to every direction of the lower half; the luminous dimensions are `OPENING`.
const LAMP: &str = "IESNA:LM-63-2002\n[TEST] made-up\n[TESTLAB] none\n[ISSUEDATE] 1-JAN-2026\n\
    [MANUFAC] none\nTILT=NONE\n1 -1 1 2 1 1 2 OPENING\n1 1 10\n0 90\n0\n1000 1000\n";
const PROJECT: &str = "[scene]\ngeometry = [\"floor.obj\"]\n[materials.black]\nreflectance = 0\n\
    [[luminaires]]\nphotometry = \"lamp.ies\"\nposition = [0, 0, 0.5]\nAS\n[[sensors]]\n\
    name = \"floor\"\nkind = \"points\"\npoints = [[0, 0, 0]]\nnormals = [[0, 0, 1]]\n\
    [simulation]\nrel_tol = 0.001\n";
const FLOOR: &str =
    "o floor\nusemtl black\nv -20 -20 0\nv 20 -20 0\nv 20 20 0\nv -20 20 0\nf 1 2 3 4\n";

fn folder(name: &str, opening: &str, form: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("floor.obj", FLOOR);
    folder.write("lamp.ies", LAMP.replace("OPENING", opening));
    folder.write("project.toml", PROJECT.replace("AS", form));
    folder
}

/// I / d^2 for a point; the integral of (I / A) h / d^3 over a disk of radius r,
/// 2 I / r^2 (1 - h / sqrt(h^2 + r^2)), for the area.
#[test]
fn the_opening_counts_where_it_is_asked_for() {
    let area_lx = 2.0 * 1000.0 / 0.0625 * (1.0 - 0.5 / 0.3125_f64.sqrt());
    for (form, wanted_lx) in [("", 4000.0), ("as = \"point\"", 4000.0), ("as = \"area\"", area_lx)]
    {
        let folder = folder(&format!("area_{wanted_lx:.0}_{}", form.len()), "-0.5 -0.5 0", form);
        for estimator in ["path", "bidirectional"] {
            let arguments = ["--estimator", estimator];
            let document = parsed(&folder.document("project.toml", estimator, &arguments, 0));
            let found_lx = number(&document, "/sensors/0/points/0/illuminance_lx");
            let half_width_lx = number(&document, "/sensors/0/points/0/half_width_lx");
            let is_right = (found_lx - wanted_lx).abs() <= 1.5 * half_width_lx + 1e-6 * wanted_lx;
            assert!(is_right, "{form}, {estimator}: {found_lx}, not {wanted_lx} lx");
            assert_eq!(half_width_lx > 1e-9 * wanted_lx, form == "as = \"area\"");
        }
    }
}

#[test]
fn an_unknown_form_is_refused_with_the_known_ones() {
    let folder = folder("area_unknown", "-0.5 -0.5 0", "as = \"aera\"");
    let run = folder.quasilux(&["run", "project.toml"]);
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    let expected = "project.toml:8:6: \"as\" is \"aera\"; expected \"point\" or \"area\"";
    assert!(run.stderr.contains(expected), "{}", run.stderr);
    assert!(run.stderr.contains("did you mean \"area\"?"), "{}", run.stderr);
}

#[test]
fn an_opening_without_extent_stays_a_point_with_a_warning() {
    let folder = folder("area_of_a_point", "0 0 0", "as = \"area\"");
    let run = folder.quasilux(&["run", "project.toml", "--out", "out"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let document = folder.read("out/result.json");
    let expected = "the luminous opening of \\\"lamp.ies\\\" is a point";
    assert!(document.contains(expected), "{document}");
    let found_lx = number(&parsed(&document), "/sensors/0/points/0/illuminance_lx");
    assert!((found_lx / 4000.0 - 1.0).abs() < 1e-6, "{found_lx}");
}
