//! Damaged Honeybee models: readers answer, whatever they are given.
//!
//! Bytes are changed as those of other files are. Values of the document are replaced by odd ones,
//! which gets behind the syntax. Deep runs try twenty times as many.

use crate::honeybee_import::everything;
use crate::mutations::mutated;
use crate::support::{LAMP_IES, MapFiles, PROJECT, Stream, load_text};
use quasilux_scene::{ImportTerms, import_honeybee, load};
use serde_json::{Value, json};

/// Models of each kind of damage.
fn models() -> usize {
    if quasilux_stats::deep() { 60_000 } else { 3_000 }
}

/// Loads a model in all ways; the number of ways in which it loaded.
fn survive(bytes: &[u8]) -> usize {
    let files = MapFiles::default().with("m.hbjson", bytes).with("a.wea", crate::blinds::WEA);
    let is_one_line = |text: String| assert!(!text.is_empty() && !text.contains('\n'), "{text:?}");
    let mut loaded = 0;
    match load_text(&PROJECT.replace("room.obj", "m.hbjson"), &files) {
        Ok(_) => loaded += 1,
        Err(error) => is_one_line(error.to_string()),
    }
    let terms =
        ImportTerms { model: "m.hbjson", geometry: "m.hbjson", weather: Some("a.wea"), stem: "m" };
    match import_honeybee(bytes, &terms) {
        Err(error) => is_one_line(error.to_string()),
        Ok(imported) => {
            let files = imported
                .files
                .iter()
                .fold(files, |files, file| files.with(&file.name, &file.bytes));
            match load("m.toml", imported.text.as_bytes(), &files) {
                Ok(_) => loaded += 1,
                Err(error) => {
                    let text = error.to_string();
                    assert!(!text.contains("not valid TOML"), "{text}\n{}", imported.text);
                    is_one_line(text);
                }
            }
        }
    }
    loaded
}

#[test]
fn damaged_bytes() {
    let original = everything().to_string();
    assert_eq!(survive(original.as_bytes()), 2);
    let mut stream = Stream(11);
    let loaded: usize =
        (0..models()).map(|_| survive(&mutated(original.as_bytes(), &mut stream))).sum();
    assert!((models() / 200..models() * 2).contains(&loaded), "{loaded} loaded");
}

/// All places of a document.
fn places<'v>(value: &'v Value, path: &mut String, found: &mut Vec<String>) {
    found.push(path.clone());
    let length = path.len();
    let mut below = |key: String, value: &'v Value| {
        path.push('/');
        path.push_str(&key);
        places(value, path, found);
        path.truncate(length);
    };
    match value {
        Value::Array(list) => {
            list.iter().enumerate().for_each(|(index, it)| below(index.to_string(), it));
        }
        Value::Object(map) => {
            map.iter().for_each(|(key, it)| below(key.replace('~', "~0").replace('/', "~1"), it));
        }
        _ => {}
    }
}

fn odd(stream: &mut Stream, other: &Value) -> Value {
    match stream.below(14) {
        0 => json!(null),
        1 => json!(-1),
        2 => json!(1e308),
        3 => json!(-1e-308),
        4 => json!(0),
        5 => json!(""),
        6 => json!("a/b\\\"\n\u{0}\u{1F600}"),
        7 => json!([]),
        8 => json!({}),
        9 => json!([0, 0, 0]),
        10 => json!([[1e9, 0, 0], [0, 1e9, 0], [0, 0, 1e9], [0, 0, 0]]),
        11 => json!(LAMP_IES),
        12 => json!(stream.next() as f64 / 1e18 - 9.0),
        _ => other.clone(),
    }
}

#[test]
fn odd_values() {
    let original = everything();
    let mut all = Vec::new();
    places(&original, &mut String::new(), &mut all);
    let mut stream = Stream(12);
    let mut loaded = 0;
    for _ in 0..models() {
        let mut model = original.clone();
        for _ in 0..=stream.below(3) {
            let from = model.pointer(&all[stream.below(all.len())]).cloned().unwrap_or_default();
            let value = odd(&mut stream, &from);
            if let Some(place) = model.pointer_mut(&all[stream.below(all.len())]) {
                *place = value;
            }
        }
        loaded += survive(model.to_string().as_bytes());
    }
    assert!((models() / 10..models() * 2).contains(&loaded), "{loaded} loaded");
}

/// Models that are small in the file and large in memory, or slow: each ends in some seconds.
#[test]
fn large_models_end() {
    let wrap = |rooms: &str| format!("{{\"type\":\"Model\",\"rooms\":[{rooms}]}}");
    survive("[".repeat(1 << 20).as_bytes());
    survive(wrap(&"[],".repeat(1 << 20)).as_bytes());
    survive(wrap(&"{\"faces\":[]},".repeat(1 << 16)).as_bytes());
    // Corners of a star, and windows of it that are stars, too.
    let star = |n: usize| -> Vec<[f64; 3]> {
        let corner = |i: usize| {
            let (sin, cos) = libm::sincos(i as f64 * 3.0);
            [5.0 * cos, 0.0, 5.0 * sin]
        };
        (0..n).map(corner).collect()
    };
    let mut model = everything();
    model["rooms"][0]["faces"][2]["geometry"]["boundary"] = json!(star(500));
    let window = json!({"identifier": "w", "geometry": {"boundary": star(300)}});
    model["rooms"][0]["faces"][2]["apertures"] = json!(vec![window; 5]);
    survive(model.to_string().as_bytes());
    let groups = |i: usize| {
        json!({"identifier": "w", "geometry": {"boundary": [[0, 0, 0], [1, 0, 0], [0, 0, i]]},
            "properties": {"radiance": {"dynamic_group_identifier": i.to_string(),
                "states": vec![json!({}); 30]}}})
    };
    let mut model = everything();
    model["orphaned_apertures"] = (0..200).map(groups).collect();
    let terms = ImportTerms { model: "m", geometry: "m", weather: Some("a.wea"), stem: "m" };
    let imported = import_honeybee(model.to_string().as_bytes(), &terms).unwrap();
    let told: Vec<String> = imported.findings.iter().map(ToString::to_string).collect();
    assert!(told.iter().any(|it| it.contains("groups beyond the first 64")), "{told:?}");
}
