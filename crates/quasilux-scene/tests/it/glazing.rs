//! `kind = "glazing"`: panes from files of products.

use crate::support::{MapFiles, PROJECT, load_text};
use quasilux_scene::bsdf::{AngularTable, Pane};
use quasilux_scene::{Bsdf, LoadError, Loaded};

/// A coated product, the same at all wavelengths.
fn product([t, front, back]: [f64; 3]) -> String {
    let line =
        |um: f64| format!("{{\"T\": {t}, \"Rf\": {front}, \"Rb\": {back}, \"wavelength\": {um}}}");
    format!(
        "{{\"type\": \"glazing\", \"subtype\": \"coated\", \"spectral_data\": \
         {{\"spectral_data\": [{}, {}]}}}}",
        line(0.3),
        line(0.9)
    )
}

fn load(lines: &str) -> Result<Loaded, LoadError> {
    let files = MapFiles::room()
        .with("outer.json", product([0.7, 0.1, 0.2]))
        .with("inner.json", product([0.5, 0.3, 0.05]))
        .with("odd.json", product([0.95, 0.1, 0.05]))
        .with("broken.json", "{\"name\": 1,\n  \"spectral_data\": 3}");
    load_text(&format!("{PROJECT}[materials.wood]\nkind = \"glazing\"\n{lines}\n"), &files)
}

/// What a pane does at normal incidence: transmittance, front and back reflectance.
fn normal(lines: &str) -> [f64; 3] {
    let loaded = load(lines).unwrap_or_else(|error| panic!("{lines}: {error}"));
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    let Bsdf::Pane(pane) = &loaded.scene.materials[0].bsdf else { panic!("no pane") };
    let Pane::Measured { transmittance, front_reflectance, back_reflectance } = pane else {
        panic!("{pane:?}");
    };
    let tables = [transmittance, front_reflectance, back_reflectance];
    for degrees in 0..90 {
        let [t, front, back] = tables.map(|it| it.at_angle(f64::from(degrees).to_radians()));
        assert!(t + front <= 1.0 && t + back <= 1.0);
    }
    assert!(tables.map(|it: &AngularTable| it.at(0.0))[0] < 1e-9);
    tables.map(|it| it.at(1.0))
}

/// Two sheets with light to and fro between them.
fn both([t, f, b]: [f64; 3], [u, g, c]: [f64; 3]) -> [f64; 3] {
    let between = 1.0 / (1.0 - b * g);
    [t * u * between, f + t * t * g * between, c + u * u * b * between]
}

#[test]
fn layers_stand_behind_one_another_from_the_front_on() {
    let (outer, inner) = ([0.7, 0.1, 0.2], [0.5, 0.3, 0.05]);
    let turned = [0.5, 0.05, 0.3];
    for (layers, expected) in [
        ("[\"outer.json\"]", outer),
        ("[{ file = \"inner.json\", flipped = true }]", turned),
        ("[{ file = \"inner.json\", flipped = false }]", inner),
        ("[\"outer.json\", \"inner.json\"]", both(outer, inner)),
        ("[\"inner.json\", \"outer.json\"]", both(inner, outer)),
        ("[\"outer.json\", { file = \"inner.json\", flipped = true }]", both(outer, turned)),
        ("[\"outer.json\", \"outer.json\", \"inner.json\"]", both(both(outer, outer), inner)),
    ] {
        let found = normal(&format!("layers = {layers}"));
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12, "{layers}: {found} not {expected}");
        }
    }
}

#[test]
fn warnings_of_a_file_are_passed_on_once() {
    let loaded = load("layers = [\"odd.json\", \"odd.json\"]").unwrap();
    let warnings: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    assert!(warnings[0].starts_with("odd.json:1:1: found transmittance and reflectance of 1.05"));
}

#[test]
fn what_makes_no_sense_is_refused_at_its_place() {
    for (lines, wanted) in [
        ("", "lacks \"layers\""),
        ("layers = []", ":18:10: \"layers\" is []; expected files of the IGSDB"),
        ("layers = \"outer.json\"", "\"layers\" is \"outer.json\"; expected files"),
        ("layers = [3]", "\"layers\" is 3; expected files"),
        ("layers = [\"none.json\"]", "none.json"),
        ("layers = [\"broken.json\"]", "broken.json:2:20: found invalid type: integer `3`"),
        ("layers = [{ file = \"outer.json\", flip = true }]", "flip"),
        ("layers = [{ flipped = true }]", "lacks \"file\""),
        ("layers = [{ file = \"outer.json\", flipped = 1 }]", "true or false"),
        ("layers = [\"outer.json\"]\neta = 1.5", "not with \"glazing\"; expected kind, layers"),
        ("layers = [[1], [2], [3], [4], [5], [6], [7], [8], [9], [0], [1]]", "at most 10"),
    ] {
        let error = load(lines).expect_err(lines).to_string();
        assert!(error.contains(wanted), "no {wanted:?} in: {error}");
        assert!(!error.contains('\n'), "several lines: {error}");
    }
}
