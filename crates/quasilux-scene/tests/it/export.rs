//! Scenes as files for Radiance, read by a reader of the test's own.

use crate::support::{MapFiles, PROJECT, load_text};
use quasilux_scene::{Exported, export_radiance};
use std::collections::HashMap;
use std::f64::consts::PI;

/// A primitive of a scene file.
#[derive(Debug)]
struct Primitive {
    modifier: String,
    kind: String,
    texts: Vec<String>,
    numbers: Vec<f64>,
}

/// Reads a scene file, whose comments are whole lines.
fn primitives(text: &str) -> HashMap<String, Primitive> {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    let mut words = lines.flat_map(str::split_whitespace);
    let mut found = HashMap::new();
    while let Some(modifier) = words.next() {
        let mut word = || words.next().expect("a word").to_owned();
        let (kind, name) = (word(), word());
        let mut list = || -> Vec<String> {
            let count = word().parse().expect("a count");
            (0..count).map(|_| word()).collect()
        };
        let (texts, whole) = (list(), list());
        assert!(whole.is_empty(), "{name}");
        let numbers = list().iter().map(|it| it.parse().expect("a number")).collect();
        let primitive = Primitive { modifier: modifier.to_owned(), kind, texts, numbers };
        assert!(modifier == "void" || found.contains_key(modifier), "{modifier} is not there");
        assert!(found.insert(name.clone(), primitive).is_none(), "{name} comes twice");
    }
    found
}

/// The small room with more in its project file.
fn exported(more: &str) -> Result<Exported, String> {
    let project = format!("{PROJECT}{more}");
    let loaded = load_text(&project, &MapFiles::room()).expect("a scene");
    export_radiance(&loaded.scene)
}

fn file<'e>(exported: &'e Exported, name: &str) -> &'e str {
    &exported.files.iter().find(|file| file.name == name).expect("a file").text
}

/// Numbers of a data file behind its dimensions.
fn table(text: &str, dimensions: [usize; 2]) -> Vec<f64> {
    let values = text.split_whitespace().skip(7).map(|it| it.parse().expect("a number"));
    let values: Vec<f64> = values.collect();
    assert_eq!(values.len(), dimensions[0] * dimensions[1]);
    values
}

#[test]
fn a_room_with_a_point_is_written() {
    let exported = exported("").expect("a scene for Radiance");
    let scene = primitives(file(&exported, "scene.rad"));
    let floor = &scene["t0"];
    assert_eq!((floor.kind.as_str(), floor.numbers.len()), ("polygon", 9));
    let wood = &scene[&floor.modifier];
    assert_eq!(wood.kind, "plastic");
    assert!(wood.numbers.iter().zip([0.4, 0.4, 0.4, 0.0, 0.0]).all(|(a, b)| (a - b).abs() < 1e-9));
    // Radiance times the area of the sphere across is the intensity.
    let point = &scene["point0.s"];
    assert_eq!((point.kind.as_str(), &point.numbers[..3]), ("sphere", &[0.5, 0.5, 2.0][..]));
    let radius_m = point.numbers[3];
    let intensity_cd = scene["point0"].numbers[0] * 179.0 * PI * radius_m * radius_m;
    assert!((intensity_cd - 100.0).abs() < 1e-9, "{intensity_cd} cd");
    let points: Vec<&str> = file(&exported, "plane.pts").lines().collect();
    assert_eq!((points.len(), points[0]), (16, "0.125 0.125 0.8 0 0 1"));
}

/// The table of a luminaire is in candela, its light in lumens of a watt; a sky is a table.
#[test]
fn luminaires_and_skies_are_tables() {
    let more = "[[luminaires]]\nphotometry = \"lamp.ies\"\nposition = [0.5, 0.5, 1.5]\n\
        dimming = 0.5\n[sky]\nmodel = \"cie\"\ntype = 16\nhorizontal_illuminance_lx = 9000\n";
    let exported = exported(more).expect("a scene for Radiance");
    let scene = primitives(file(&exported, "scene.rad"));
    let light = &scene["luminaire0"];
    assert!((light.numbers[0] - 0.5 / 179.0).abs() < 1e-12, "{light:?}");
    let pattern = &scene[&light.modifier];
    assert_eq!(pattern.kind, "brightdata");
    assert_eq!(pattern.texts[..5], ["q_point", "web0.dat", "quasilux.cal", "q_gamma", "q_c"]);
    // The angles of the file, and where its light ends.
    let web = file(&exported, "web0.dat").split_whitespace().map(|it| it.parse::<f64>());
    let web: Vec<f64> = web.map(|it| it.expect("a number")).collect();
    let (head, values) = web.split_at(13);
    assert_eq!(head[..5], [2.0, 0.0, 0.0, 4.0, 0.0]);
    assert!(head[5] == 90.0 && (90.0..90.001).contains(&head[6]) && head[7] == 180.0, "{head:?}");
    assert_eq!(head[8..], [0.0, 0.0, 2.0, 0.0, 360.0]);
    assert_eq!(values, [1000.0, 1000.0, 1000.0, 1000.0, 0.0, 0.0, 0.0, 0.0]);
    // Horizontal illuminance of the table, by the mean of each cell.
    let sky = table(file(&exported, "sky.dat"), [181, 721]);
    let mut lx = 0.0;
    for row in 0..180_u32 {
        let [from, to] = [row, row + 1].map(|row| libm::sin(f64::from(row) / 360.0 * PI));
        let columns: f64 =
            (0..720).map(|column| sky[721 * row as usize + column]).sum::<f64>() / 720.0;
        let next: f64 =
            (0..720).map(|column| sky[721 * (row as usize + 1) + column]).sum::<f64>() / 720.0;
        lx += 179.0 * PI * (to * to - from * from) * 0.5 * (columns + next);
    }
    assert!((lx / 9000.0 - 1.0).abs() < 1e-4, "{lx} lx");
    let ground = scene["ground.g"].numbers[0] * 179.0 * PI;
    assert!((ground - 0.2 * 9000.0).abs() < 1e-6, "{ground}");
}

#[test]
fn what_radiance_has_not_is_refused_or_told() {
    let clear = "[materials.wood]\nkind = \"conductor\"\nreflectance = 0.9\nroughness = 0.3\n";
    let exported = exported(clear).expect("a scene for Radiance");
    assert!(exported.findings.iter().any(|finding| finding.contains("\"wood\": roughness")));
}
