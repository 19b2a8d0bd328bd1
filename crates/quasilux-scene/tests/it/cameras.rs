//! `[[cameras]]`: what is right, what is refused, and where.

use crate::support::{MapFiles, PROJECT, load_text};
use glam::DVec3;

/// Follows the small project; its first line is 17.
const CAMERA: &str = "
[[cameras]]
name = \"view\"
position = [0.5, -2, 1]
target = [0.5, 0.5, 0.5]
up = [0, 0, 1]
vertical_fov_deg = 60
resolution = [64, 48]
";

fn refusal(project: &str) -> String {
    let refused = load_text(project, &MapFiles::room()).map(|_| ());
    refused.expect_err(&format!("accepted:\n{project}")).to_string()
}

#[test]
fn a_camera_is_what_the_file_says() {
    let loaded = load_text(&format!("{PROJECT}{CAMERA}"), &MapFiles::room()).unwrap();
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    let [camera] = loaded.scene.cameras.as_slice() else { panic!("one camera") };
    assert_eq!((camera.name.as_str(), camera.resolution), ("view", [64, 48]));
    assert_eq!(camera.position, DVec3::new(0.5, -2.0, 1.0));
    assert_eq!(camera.target, DVec3::new(0.5, 0.5, 0.5));
    assert_eq!((camera.up, camera.pixels()), (DVec3::Z, 64 * 48));
    assert!((camera.vertical_fov_rad - std::f64::consts::FRAC_PI_3).abs() < 1e-15);
    let plain = CAMERA.replace("up = [0, 0, 1]\n", "");
    let default = load_text(&format!("{PROJECT}{plain}"), &MapFiles::room()).unwrap();
    assert_eq!(default.scene.cameras, loaded.scene.cameras);
    assert_eq!((camera.samples, camera.rel_tol), (None, None));
    let told = format!("{PROJECT}{CAMERA}samples = 64\nrel_tol = 0.05\n");
    let told = load_text(&told, &MapFiles::room()).unwrap();
    let camera = &told.scene.cameras[0];
    assert_eq!((camera.samples, camera.rel_tol), (Some(64), Some(0.05)));
}

#[test]
fn a_project_may_have_cameras_alone() {
    let lit = &PROJECT[..PROJECT.find("[[sensors]]").expect("a sensor")];
    let loaded = load_text(&format!("{lit}{CAMERA}"), &MapFiles::room()).unwrap();
    assert!(loaded.scene.sensors.is_empty() && loaded.scene.cameras.len() == 1);
    assert!(refusal(lit).starts_with("room.toml:1:1: no sensors and no cameras"));
}

#[test]
fn broken_cameras_are_refused_at_their_line() {
    for (from, to, line, needle) in [
        ("name = \"view\"\n", "", 17, "lacks \"name\""),
        ("\"view\"", "\"a/b\"", 18, "can be a file name"),
        ("\"view\"", "\"Plane\"", 18, "the same name as the sensor \"plane\" on line 9"),
        ("position = [0.5, -2, 1]\n", "", 17, "lacks \"position\""),
        ("[0.5, -2, 1]", "[0.5, -2]", 19, "expected a position [x, y, z] in m"),
        ("[0.5, -2, 1]", "[0.5, nan, 1]", 19, "is nan"),
        ("target = [0.5, 0.5, 0.5]\n", "", 17, "lacks \"target\""),
        ("[0.5, 0.5, 0.5]", "[0.5, -2, 1]", 20, "\"target\" is \"position\""),
        ("[0.5, 0.5, 0.5]", "[0.5, 1e13, 0.5]", 20, "is 1e13"),
        ("up = [0, 0, 1]", "up = [0, 0, 0]", 21, "a direction [x, y, z] with a length"),
        ("up = [0, 0, 1]", "up = [0, -5, 1]", 21, "parallel to the line"),
        ("[0.5, 0.5, 0.5]\nup = [0, 0, 1]", "[0.5, -2, 0]", 17, "along the default \"up\""),
        ("vertical_fov_deg = 60\n", "", 17, "lacks \"vertical_fov_deg\""),
        ("= 60", "= 0", 22, "between 0 and 180"),
        ("= 60", "= 180", 22, "between 0 and 180"),
        ("= 60", "= \"60 deg\"", 22, "between 0 and 180"),
        ("resolution = [64, 48]\n", "", 17, "lacks \"resolution\""),
        ("[64, 48]", "[64]", 23, "expected [width, height] in pixels"),
        ("[64, 48]", "[64, 0]", 23, "1 to 16384 each"),
        ("[64, 48]", "[64.5, 48]", 23, "1 to 16384 each"),
        ("[64, 48]", "[16385, 1]", 23, "1 to 16384 each"),
        ("[64, 48]", "[16384, 16384]", 23, "at most 16777216 in all"),
        ("[64, 48]", "[64, 48]\nsamples = 0", 24, "paths per pixel and replicate, 1 to"),
        ("[64, 48]", "[64, 48]\nrel_tol = 0", 24, "a share above 0, at most 0.5"),
        ("vertical_fov_deg", "fov_deg", 22, "unknown key \"fov_deg\" in [[cameras]]"),
        ("[[cameras]]", "[cameras]", 17, "expected [[cameras]], in double brackets"),
    ] {
        assert!(CAMERA.contains(from), "{from} is not in the camera");
        let text = refusal(&format!("{PROJECT}{}", CAMERA.replacen(from, to, 1)));
        assert!(text.starts_with(&format!("room.toml:{line}:")), "{from} -> {to}: {text}");
        assert!(text.contains(needle) && !text.contains('\n'), "no {needle:?} in: {text}");
    }
}

/// A camera writes two pictures, so it has two names.
#[test]
fn names_of_pictures_are_unique() {
    let other = CAMERA.replace("\"view\"", "\"VIEW\"");
    let text = refusal(&format!("{PROJECT}{CAMERA}{other}"));
    assert!(text.contains("as the camera \"view\" on line 17"), "{text}");
    let other = CAMERA.replace("\"view\"", "\"view-falsecolour\"");
    let text = refusal(&format!("{PROJECT}{CAMERA}{other}"));
    assert!(text.contains("as the camera \"view\" on line 17"), "{text}");
    let text = refusal(&format!("{PROJECT}{other}{CAMERA}"));
    assert!(text.contains("as the camera \"view-falsecolour\" on line 17"), "{text}");
}

#[test]
fn pixels_count_together() {
    let large = CAMERA.replace("[64, 48]", "[4096, 4095]");
    let small = CAMERA.replace("\"view\"", "\"second\"");
    let text = refusal(&format!("{PROJECT}{large}{}", small.replace("[64, 48]", "[4097, 1]")));
    assert!(text.contains("16777217 pixels so far"), "{text}");
}
