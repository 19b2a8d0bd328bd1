//! A tilted luminaire gives the share of its direct light that its tilt factors say.

use crate::support::{Folder, number, parsed};

const FLOOR_OBJ: &str =
    "o floor\nusemtl black\nv -20 -20 0\nv 20 -20 0\nv 20 20 0\nv -20 20 0\nf 1 2 3 4\n";

/// Tilted by arctan(3/4) from straight down: 36.87 degrees.
const PROJECT: &str = r#"
[scene]
geometry = ["floor.obj"]
[materials.black]
reflectance = 0
[[luminaires]]
photometry = "lamp.ies"
position = [0, 0, 3]
aim = [0, 3, -4]
[[sensors]]
name = "points"
kind = "points"
points = [[0, 0, 0.1], [1, 2, 0.1], [-1.5, 3, 0.1]]
normals = [[0, 0, 1], [0, 0, 1], [0, 0, 1]]
"#;

fn ies(tilt: &str) -> String {
    format!(
        "IESNA:LM-63-2002\n[TEST] none\n[TESTLAB] none\n[ISSUEDATE] 1-JAN-2026\n[MANUFAC] none\n\
         TILT={tilt}\n1 -1 1 3 1 1 2 0 0 0\n1 1 10\n0 45 90\n0\n900 700 100\n"
    )
}

#[test]
fn direct_light_scales_with_the_tilt_factor() {
    let folder = Folder::new("tilt");
    folder.write("floor.obj", FLOOR_OBJ);
    folder.write("project.toml", PROJECT);
    folder.write("mh.tlt", "1\n3\n0 30 90\n1 0.9 0.6\n");
    let illuminances_lx = |tilt: &str, out: &str| -> Vec<f64> {
        folder.write("lamp.ies", ies(tilt));
        let document = parsed(&folder.document("project.toml", out, &[], 0));
        assert_eq!(document["warnings"].as_array().map(Vec::len), Some(0), "{document}");
        (0..3)
            .map(|i| number(&document, &format!("/sensors/0/points/{i}/illuminance_lx")))
            .collect()
    };
    let tilt_deg = libm::atan2(3.0, 4.0) / std::f64::consts::PI * 180.0;
    let factor = 0.9 - (tilt_deg - 30.0) / 60.0 * 0.3;
    let untilted = illuminances_lx("NONE", "none");
    let included = illuminances_lx("INCLUDE\n1\n3\n0 30 90\n1 0.9 0.6", "include");
    let file = illuminances_lx("mh.tlt", "file");
    for i in 0..3 {
        let expected = factor * untilted[i];
        assert!(expected > 1.0, "point {i} tells nothing: {expected} lx");
        for got in [included[i], file[i]] {
            assert!((got / expected - 1.0).abs() < 1e-9, "point {i}: {got}, not {expected}");
        }
    }
}
