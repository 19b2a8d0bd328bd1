//! Lamps whose output depends on how the luminaire is tilted.

use crate::support::{LAMP_IES, MapFiles, PROJECT, load_text, warnings_of};
use quasilux_scene::{Light, Loaded};

/// Half the light of a lamp that lies, in a straight line to it.
const TILT: &str = "2\n0 90\n1 0.5\n";

/// The small project under one luminaire of that file, placed by those keys.
fn load_luminaire(ies: &str, keys: &str, files: &MapFiles) -> Loaded {
    let luminaire =
        format!("[[luminaires]]\nphotometry = \"lamps/lamp.ies\"\nposition = [0, 0, 2]\n{keys}\n");
    let files = files.clone().with("lamps/lamp.ies", ies);
    load_text(&format!("{PROJECT}{luminaire}"), &files).unwrap()
}

fn dimming(loaded: &Loaded) -> f64 {
    let Light::Luminaire(light) = &loaded.scene.lights[0] else { panic!("a luminaire") };
    light.dimming
}

fn included(lamp_geometry: u8, tilt: &str) -> String {
    LAMP_IES.replace("NONE", &format!("INCLUDE\n{lamp_geometry}\n{tilt}"))
}

#[test]
fn the_angle_between_aim_and_straight_down_counts() {
    let ies = included(1, TILT);
    let cases = [
        ("", 1.0),
        ("rotation_deg = 70", 1.0),
        ("aim = [0, 1, -1]", 0.75),
        ("aim = [-3, 0, -3]\nc0 = [0, 1, 0]", 0.75),
        ("aim = [0, 2, 0]", 0.5),
        ("aim = [0, 0, 1]", 1.0),
        ("aim = [0, 1, -1]\ndimming = 0.4", 0.3),
    ];
    for (keys, expected) in cases {
        let loaded = load_luminaire(&ies, keys, &MapFiles::room());
        assert!((dimming(&loaded) - expected).abs() < 1e-12, "{keys}: {}", dimming(&loaded));
        assert!(loaded.warnings.is_empty(), "{keys}: {:?}", warnings_of(&loaded));
    }
    let flat =
        load_luminaire(&LAMP_IES.replace("NONE", "none"), "aim = [0, 1, 0]", &MapFiles::room());
    assert_eq!(dimming(&flat), 1.0);
}

#[test]
fn lying_lamps_feel_the_turn_about_c0_c180() {
    let ies = included(2, TILT);
    let about_c0 = load_luminaire(&ies, "aim = [0, 1, -1]", &MapFiles::room());
    assert!((dimming(&about_c0) - 0.75).abs() < 1e-12);
    assert!(about_c0.warnings.is_empty());
    let across = load_luminaire(&ies, "aim = [0, 1, -1]\nc0 = [0, 0, 1]", &MapFiles::room());
    assert!((dimming(&across) - 1.0).abs() < 1e-12);
    let [warning] = &warnings_of(&across)[..] else { panic!("{:?}", across.warnings) };
    assert!(warning.starts_with("room.toml:16:1: the lamp lies"), "{warning}");
}

#[test]
fn a_tilt_beyond_the_listed_angles_is_warned_of() {
    let ies = included(1, "2\n0 60\n1 0.5\n");
    let loaded = load_luminaire(&ies, "aim = [0, 1, 0]", &MapFiles::room());
    assert!((dimming(&loaded) - 0.5).abs() < 1e-12);
    let warnings = warnings_of(&loaded);
    assert!(warnings[0].starts_with("lamps/lamp.ies:7:1: found tilt angles from 0 to 60"));
    assert!(warnings[1].contains("a tilt of 90.0 degrees is outside"), "{warnings:?}");
}

#[test]
fn a_tilt_file_lies_beside_the_luminaire_file() {
    let ies = LAMP_IES.replace("NONE", "mh.tlt");
    let keys = "aim = [0, 1, 0]";
    let tilt_file = format!("1\n{TILT}");
    let files = MapFiles::room().with("lamps/mh.tlt", &tilt_file);
    let loaded = load_luminaire(&ies, keys, &files);
    assert!((dimming(&loaded) - 0.5).abs() < 1e-12);
    assert!(loaded.warnings.is_empty(), "{:?}", warnings_of(&loaded));

    let missing = load_luminaire(&ies, keys, &MapFiles::room());
    assert_eq!(dimming(&missing), 1.0);
    let [warning] = &warnings_of(&missing)[..] else { panic!("{:?}", missing.warnings) };
    assert!(warning.starts_with("lamps/lamp.ies:4:1: cannot read the tilt file \"lamps/mh.tlt\""));
    assert!(warning.ends_with("(factor 1)"), "{warning}");

    let files =
        MapFiles::room().with("lamps/mh.tlt", "1\n2\n90 0\n1 1").with("lamps/lamp.ies", ies);
    let luminaire = "[[luminaires]]\nphotometry = \"lamps/lamp.ies\"\nposition = [0, 0, 2]\n";
    let error = load_text(&format!("{PROJECT}{luminaire}"), &files).unwrap_err().to_string();
    assert!(error.starts_with("lamps/mh.tlt:3:4: found 0 after 90"), "{error}");
}
