//! Scenes that are exported for Radiance and read again.

use crate::radiance_import::load_imported;
use crate::support::{MapFiles, load_text, warnings_of};
use glam::DVec3;
use quasilux_scene::bsdf::Pane;
use quasilux_scene::light::Luminaire;
use quasilux_scene::{Bsdf, Light, Loaded, RadianceTerms, export_radiance, import_radiance};
use std::collections::BTreeMap;

/// Quadrilaterals of 1 m2 to 6 m2 above each other, each of a material.
const MATERIALS: [&str; 6] = ["wood", "paper", "glazing", "shiny", "water", "panel"];

const PROJECT: &str = r#"[scene]
geometry = ["room.obj"]

[materials]
wood = { reflectance = [0.5, 0.4, 0.3] }
paper = { reflectance = 0.3, transmittance = 0.2 }
glazing = { kind = "pane", transmittance = 0.8 }
shiny = { kind = "mirror", reflectance = 0.9 }
water = { kind = "dielectric", eta = 1.33 }
panel = { reflectance = 0 }

[[lights]]
kind = "point"
position = [0.5, 0.5, 2.0]
intensity_cd = 100

[[lights]]
kind = "area"
material = "panel"
luminance_cd_m2 = 1500

[sky]
model = "cie"
type = 16
horizontal_illuminance_lx = 9000

[[sensors]]
name = "plane"
kind = "grid"
origin = [0, 0, 0.8]
u = [1, 0, 0]
v = [0, 1, 0]
spacing = 0.5
"#;

/// Openings in m, and directions of gamma = 0 and of C0.
const LUMINAIRES: [([f64; 3], &str, &str); 5] = [
    ([0.0; 3], "[0, 0, -1]", "[1, 0, 0]"),
    ([0.4, 0.2, 0.0], "[0, 0, -1]", "[0, 1, 0]"),
    ([0.4, 0.2, 0.1], "[0.6, 0, -0.8]", "[0, 1, 0]"),
    ([-0.3, -0.3, 0.0], "[0, 1, 0]", "[1, 0, 0]"),
    ([0.3, 0.5, 0.2], "[1, -1, 1]", "[1, 1, 0]"),
];

/// A photometric file whose light differs by all angles.
fn ies([width, length, height]: [f64; 3]) -> String {
    let rows: [&str; 5] =
        ["90 80 70 9 5", "90 60 30 8 5", "90 40 20 7 5", "90 70 50 6 5", "90 80 70 9 5"];
    format!(
        "IESNA:LM-63-2002\n[TEST] none\n[MANUFAC] none\nTILT=NONE\n\
         1 -1 1 5 5 1 2 {width} {length} {height}\n1 1 10\n0 45 90 135 180\n0 90 180 270 360\n{}\n",
        rows.join("\n")
    )
}

fn room() -> Loaded {
    let mut obj = String::new();
    for (number, material) in MATERIALS.iter().enumerate() {
        let (z, size) = (3 + number, 1 + number);
        obj += &format!("v 0 0 {z}\nv {size} 0 {z}\nv {size} 1 {z}\nv 0 1 {z}\n");
        obj += &format!("usemtl {material}\nf -4 -3 -2 -1\n");
    }
    let mut files = MapFiles::default().with("room.obj", obj);
    let mut project = PROJECT.to_owned();
    for (number, (opening, aim, c0)) in LUMINAIRES.iter().enumerate() {
        files = files.with(&format!("{number}.ies"), ies(*opening));
        project += &format!(
            "[[luminaires]]\nphotometry = \"{number}.ies\"\nas = \"{}\"\n\
             position = [{number}, 2, 1.5]\naim = {aim}\nc0 = {c0}\ndimming = 0.5\n",
            if number == 0 { "point" } else { "area" }
        );
    }
    load_text(&project, &files).unwrap()
}

/// Areas in m2 by material, without the beginning of the names that exports give.
fn areas(loaded: &Loaded) -> BTreeMap<String, f64> {
    let scene = &loaded.scene;
    let mut areas = BTreeMap::new();
    for (triangle, &material) in (0..).zip(&scene.mesh.material_of) {
        let name = &scene.materials[material as usize].name;
        let name = name.strip_prefix("m_").unwrap_or(name).to_owned();
        *areas.entry(name).or_insert(0.0) += scene.mesh.area_m2(triangle);
    }
    areas
}

fn luminaires(loaded: &Loaded) -> Vec<&Luminaire> {
    let mut all = Vec::new();
    for light in &loaded.scene.lights {
        if let Light::Luminaire(lamp) = light {
            all.push(lamp);
        }
    }
    all
}

fn read_again(loaded: &Loaded) -> Loaded {
    let exported = export_radiance(&loaded.scene).unwrap();
    let with = |files: MapFiles, (name, text): (&String, &String)| files.with(name, text);
    let files = exported.files.iter().map(|file| (&file.name, &file.text));
    let files = files.fold(MapFiles::default(), with);
    let terms = RadianceTerms {
        model: "scene.rad",
        scene: &["scene.rad".to_owned()],
        points: &["plane.pts".to_owned()],
        views: &[],
        weather: None,
        stem: "scene",
    };
    let imported = import_radiance(&files, &terms).unwrap();
    let loaded = load_imported(&imported, &files).unwrap();
    let told = warnings_of(&loaded);
    assert!(told.iter().any(|it| it.contains("the pattern of the sky is not known")), "{told:?}");
    loaded
}

#[test]
fn exported_scenes_are_read_as_they_were() {
    let before = room();
    let after = read_again(&before);
    expect_materials(&before, &after);
    expect_lights(&before, &after);
    expect_luminaires(&before, &after);
}

fn expect_materials(before: &Loaded, after: &Loaded) {
    let (old, mut new) = (areas(before), areas(after));
    new.remove("point5");
    let panel = new.remove("area6").unwrap();
    assert!((panel - old["panel"]).abs() < 1e-9 && new.len() == old.len() - 1, "{new:?}");
    for (name, area) in &new {
        // Mirrors have a polygon for each side.
        let sides = if name == "shiny" { 2.0 } else { 1.0 };
        assert!((area - sides * old[name]).abs() < 1e-9, "{name}: {area}");
    }
    let find = |loaded: &Loaded, name: &str| -> Bsdf {
        loaded.scene.materials.iter().find(|it| it.name == name).expect(name).bsdf.clone()
    };
    for name in ["wood", "shiny", "water"] {
        assert_eq!(find(after, &format!("m_{name}")), find(before, name), "{name}");
    }
    let Bsdf::Translucent(paper) = find(after, "m_paper") else { panic!("a sheet") };
    assert!((paper.reflectance.luminance() - 0.3).abs() < 1e-12);
    assert!((paper.transmittance.luminance() - 0.2).abs() < 1e-12);
    let Bsdf::Pane(Pane::Measured { transmittance, .. }) = find(after, "m_glazing") else {
        panic!("a pane")
    };
    assert!((transmittance.at_angle(0.0) - 0.8).abs() < 1e-9);
}

/// By flux: a point is a small ball there.
fn expect_lights(before: &Loaded, after: &Loaded) {
    let flux = |loaded: &Loaded| -> Vec<f64> {
        let others = loaded.scene.lights.iter().filter(|it| !matches!(it, Light::Luminaire(_)));
        let mut flux: Vec<f64> = others.map(Light::flux_lm).collect();
        flux.sort_by(f64::total_cmp);
        flux
    };
    for (new, old) in flux(after).iter().zip(flux(before)) {
        assert!((new / old - 1.0).abs() < 1e-6, "{new} lm is not {old} lm");
    }
    assert_eq!(flux(after).len(), 2);
}

fn expect_luminaires(before: &Loaded, after: &Loaded) {
    let (old, new) = (luminaires(before), luminaires(after));
    assert_eq!(new.len(), LUMINAIRES.len());
    for (number, (new, old)) in new.iter().zip(old).enumerate() {
        assert!((new.position - old.position).length() < 1e-6, "{number}: {}", new.position);
        assert_eq!(new.is_area(), old.is_area(), "{number}");
        for direction in [[0.2, 0.3, -0.9], [-0.7, 0.1, -0.4], [0.5, -0.8, 0.2], [0.1, 0.4, 0.8]] {
            let direction = DVec3::from_array(direction).normalize();
            let [new, old] = [new, old].map(|lamp| lamp.intensity_cd(direction));
            assert!((new / old - 1.0).abs() < 2e-3, "{number} {direction}: {new} is not {old}");
        }
    }
}
