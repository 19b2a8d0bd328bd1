//! The reader of Honeybee models, on any bytes: what loads, what becomes a project, and what of
//! that loads again.

#![no_main]

mod mutation;

use libfuzzer_sys::{fuzz_mutator, fuzz_target};
use quasilux_scene::{FileKind, Files, ImportTerms, import_honeybee, load};
use quasilux_stats::damage::Seeds;
use std::collections::HashMap;
use std::io::{Error, ErrorKind};

/// Most memory, in bytes for each byte of a model, and besides.
const BYTES_PER_BYTE: u64 = 512;
const BYTES_BESIDES: u64 = 16 << 20;

struct Named(HashMap<String, Vec<u8>>);

impl Files for Named {
    fn read(&self, path: &str, _kind: FileKind) -> std::io::Result<Vec<u8>> {
        self.0.get(path).cloned().ok_or_else(|| Error::from(ErrorKind::NotFound))
    }
}

const WEATHER: &str = "place Here\nlatitude 37.72\nlongitude 122.22\ntime_zone 120\n\
    site_elevation 2\nweather_data_file_units 1\n3 20 11.5 700 90\n";

fn samples() -> Seeds {
    let model = r#"{"type": "Model", "units": "Feet", "rooms": [{"identifier": "a", "faces": [
        {"identifier": "f", "face_type": "Wall", "boundary_condition": {"type": "Surface",
        "boundary_condition_objects": ["g", "b"]}, "geometry": {"boundary":
        [[0, 0, 0], [4, 0, 0], [4, 0, 3], [0, 0, 3]], "holes": [[[1, 0, 1], [2, 0, 1], [2, 0, 2]]]},
        "apertures": [{"identifier": "w",
        "geometry": {"boundary": [[2, 0, 1], [3, 0, 1], [3, 0, 2]]},
        "properties": {"radiance": {"dynamic_group_identifier": "d", "states": [{"modifier": "m"},
        {"shades": [{"identifier": "s",
        "geometry": {"boundary": [[0, 1, 0], [1, 1, 0], [1, 1, 1]]}}]}
        ]}}}]}], "properties": {"radiance": {"modifier_set": "set"}}}],
        "shade_meshes": [{"identifier": "x", "geometry": {"vertices": [[0, 0, 0], [1, 0, 0],
        [1, 1, 0], [0, 1, 0]], "faces": [[0, 1, 2, 3]]}}],
        "properties": {"radiance": {"modifiers": [{"type": "Glass", "identifier": "m",
        "r_transmissivity": 0.9}, {"type": "Light", "identifier": "l", "r_emittance": 3}],
        "modifier_sets": [{"identifier": "set", "wall_set": {"interior_modifier": "l"}}],
        "sensor_grids": [{"identifier": "s", "sensors": [{"pos": [1, 1, 1], "dir": [0, 0, 1]}]}],
        "views": [{"identifier": "v", "position": [1, 1, 1], "direction": [1, 0, 0]}]}}}"#;
    Seeds::new(vec![model.as_bytes().to_vec()])
}

fn examine(bytes: &[u8]) {
    let terms =
        ImportTerms { model: "m.hbjson", geometry: "m.hbjson", weather: Some("a.wea"), stem: "m" };
    let imported = match import_honeybee(bytes, &terms) {
        Ok(imported) => imported,
        Err(error) => return assert!(!error.to_string().contains('\n'), "{error}"),
    };
    let files = imported.files.into_iter().map(|file| (file.name, file.bytes));
    let mut files: HashMap<String, Vec<u8>> = files.collect();
    files.insert("m.hbjson".to_owned(), bytes.to_vec());
    files.insert("a.wea".to_owned(), WEATHER.into());
    if let Err(error) = load("m.toml", imported.text.as_bytes(), &Named(files)) {
        let text = error.to_string();
        assert!(!text.contains("not valid TOML") && !text.contains('\n'), "{text}");
    }
}

fuzz_target!(|bytes: &[u8]| {
    let peak_bytes = allocation_counter::measure(|| examine(bytes)).bytes_max;
    let most = BYTES_PER_BYTE * bytes.len() as u64 + BYTES_BESIDES;
    assert!(peak_bytes <= most, "{peak_bytes} bytes for a model of {}, over {most}", bytes.len());
});

fuzz_mutator!(|bytes: &mut [u8], length: usize, room: usize, key: u32| {
    mutation::change(samples, bytes, length, room, key)
});
