//! glTF and GLB: hierarchy, names, buffers, and headers that lie.

use crate::support::{MapFiles, PROJECT, load_geometry, load_text, warnings_of};
use glam::DVec3;
use quasilux_scene::Rgb;

/// A unit square of two indexed triangles in the xz plane, under a node that moves, one that
/// turns and one that mirrors.
pub(crate) const SQUARE: &str = r#"{
  "asset": {"version": "2.0"},
  "scene": 0,
  "scenes": [{"nodes": [0]}],
  "nodes": [
    {"name": "house", "translation": [10, 0, 0], "children": [1, 2]},
    {"name": "floor", "mesh": 0, "rotation": [0, 0.70710678, 0, 0.70710678]},
    {"mesh": 0, "scale": [-1, 1, 1]}
  ],
  "meshes": [{"name": "square", "primitives": [
    {"attributes": {"POSITION": 0}, "indices": 1, "material": 0}
  ]}],
  "materials": [
    {"name": "oak", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 0.125, 1]}}
  ],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
     "min": [0, 0, -1], "max": [1, 0, 0]},
    {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}
  ],
  "bufferViews": [
    {"buffer": 0, "byteOffset": 0, "byteLength": 48},
    {"buffer": 0, "byteOffset": 48, "byteLength": 12}
  ],
  "buffers": [{"byteLength": 60, "uri": "square%20mesh.bin"}]
}"#;

pub(crate) fn square_bytes() -> Vec<u8> {
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, -1.0], [0.0, 0.0, -1.0]];
    let positions = corners.into_iter().flatten().flat_map(f32::to_le_bytes);
    let indices = [0_u16, 1, 2, 0, 2, 3].into_iter().flat_map(u16::to_le_bytes);
    positions.chain(indices).collect()
}

/// A GLB of a JSON text and a binary chunk.
pub(crate) fn glb(json: &str, bin: &[u8]) -> Vec<u8> {
    let pad = |bytes: &[u8], fill: u8| {
        let mut padded = bytes.to_vec();
        padded.resize(bytes.len().next_multiple_of(4), fill);
        padded
    };
    let (json, bin) = (pad(json.as_bytes(), b' '), pad(bin, 0));
    let mut glb = b"glTF".to_vec();
    for word in [2, 28 + json.len() + bin.len(), json.len()] {
        glb.extend((word as u32).to_le_bytes());
    }
    glb.extend(b"JSON");
    glb.extend(&json);
    glb.extend((bin.len() as u32).to_le_bytes());
    glb.extend(b"BIN\0");
    glb.extend(&bin);
    glb
}

pub(crate) fn square_glb() -> Vec<u8> {
    glb(&SQUARE.replace(", \"uri\": \"square%20mesh.bin\"", ""), &square_bytes())
}

fn files() -> MapFiles {
    MapFiles::room()
        .with("models/room.gltf", SQUARE)
        .with("models/square mesh.bin", square_bytes())
        .with("room.glb", square_glb())
}

#[test]
fn hierarchy_names_and_colours() {
    let project = PROJECT.replace("[\"room.obj\"]", "[\"models/room.gltf\"]\nup = \"y\"");
    let loaded = load_text(&project, &files()).unwrap();
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    let scene = &loaded.scene;
    assert_eq!(scene.mesh.objects, ["floor".into(), "square".into()]);
    assert_eq!(scene.mesh.object_of, [0, 0, 1, 1]);
    assert_eq!(scene.materials[0].name, "oak");
    assert_eq!(scene.materials[0].bsdf.reflectance(), Some(Rgb([0.5, 0.25, 0.125])));
    // A quarter turn about y takes x to -z and -z to -x; then 10 m along x; then z up.
    for (corner, expected) in scene.mesh.corners(0).iter().zip([
        DVec3::new(10.0, 0.0, 0.0),
        DVec3::new(10.0, 1.0, 0.0),
        DVec3::new(9.0, 1.0, 0.0),
    ]) {
        assert!((*corner - expected).length() < 1e-7, "{corner} is not {expected}");
    }
    // Mirrored or not, the front stays on top.
    for triangle in 0..4 {
        assert!((scene.mesh.front_normal(triangle) - DVec3::Z).length() < 1e-7, "{triangle}");
    }
}

#[test]
fn the_three_kinds_of_buffer_hold_the_same() {
    use std::fmt::Write;
    let text = load_geometry("models/room.gltf", &files()).unwrap();
    let binary = load_geometry("room.glb", &files()).unwrap();
    assert_eq!(text.scene.mesh, binary.scene.mesh);
    let digits = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut uri = "data:application/octet-stream;base64,".to_owned();
    for three in square_bytes().chunks(3) {
        let bits = three.iter().fold(0_usize, |bits, &byte| bits << 8 | usize::from(byte));
        for shift in [18, 12, 6, 0] {
            let _ = write!(uri, "{}", char::from(digits[bits >> shift & 63]));
        }
    }
    let embedded = files().with("room.gltf", SQUARE.replace("square%20mesh.bin", &uri));
    assert_eq!(load_geometry("room.gltf", &embedded).unwrap().scene.mesh, text.scene.mesh);
}

#[test]
fn an_axis_that_is_not_named_is_warned_of() {
    let loaded = load_geometry("room.glb", &files()).unwrap();
    assert_eq!(
        warnings_of(&loaded),
        ["room.glb: glTF has y up, but is read with z up; set up = \"y\" in [scene]"]
    );
}

#[test]
fn what_lies_or_is_not_built_is_refused() {
    for (from, to, needle) in [
        ("\"count\": 4", "\"count\": 1000000000", "accessor 0 says 1000000000 elements"),
        ("\"count\": 6", "\"count\": 1000000000", "accessor 1 says 1000000000 elements"),
        ("\"count\": 6", "\"count\": 18446744073709551615", "accessor 1 says 18446744073709551615"),
        (
            "\"byteLength\": 60",
            "\"byteLength\": 1000000000",
            "buffer 0 has 60 bytes; expected 1000000000",
        ),
        ("\"byteLength\": 48", "\"byteLength\": 1000", "buffer view 0 reaches beyond"),
        (
            "\"byteLength\": 12",
            "\"byteLength\": 12, \"byteStride\": 252",
            "accessor 1 says 6 elements",
        ),
        ("\"count\": 4", "\"count\": 3", "refers to vertex 3, but has 3"),
        ("\"count\": 4", "\"byteOffset\": 18446744073709551615, \"count\": 4", "accessor 0 says"),
        ("\"POSITION\": 0", "\"POSITION\": 2", "mesh 0 refers to accessor 2, but the file has 2"),
        ("5126", "5123", "expected 32-bit floats, or the extension KHR_mesh_quantization"),
        ("5123", "5126", "expected unsigned integers"),
        ("{\"mesh\": 0, \"scale\"", "{\"children\": [0], \"scale\"", "node 0 has two parents"),
        ("[1, 2]", "[1, 1]", "node 1 has two parents"),
        ("[1, 2]", "[1, 7]", "Index out of bounds"),
        ("[10, 0, 0]", "[1e38, 0, 0]", "beyond 1e9 m"),
        ("[0, 0.70710678, 0, 0.70710678]", "[0, 0, 0, 0]", "no quaternion"),
        (
            "\"2.0\"}",
            "\"2.0\"}, \"extensionsRequired\": [\"KHR_draco_mesh_compression\"]",
            "requires the extension \"KHR_draco_mesh_compression\"",
        ),
        ("\"bufferView\": 1,", "", "accessors[1].bufferView: Missing data"),
        ("square%20mesh.bin", "none.bin", "cannot read the buffer \"models/none.bin\""),
        ("square%20mesh.bin", "data:text/plain,abc", "not base64"),
        ("\"version\"", "\"vershun\"", "not a valid glTF file"),
    ] {
        let json = SQUARE.replacen(from, to, 1);
        assert_ne!(json, SQUARE, "{from} is not in the file");
        let files = files().with("models/room.gltf", json);
        let error = load_geometry("models/room.gltf", &files).unwrap_err();
        assert_eq!(error.file(), "models/room.gltf", "{error}");
        assert!(error.to_string().contains(needle), "no {needle:?} in: {error}");
    }
}

#[test]
fn broken_json_is_refused_at_its_line() {
    let files = files().with("models/room.gltf", SQUARE.replace("\"scene\": 0,", "\"scene\": 0"));
    let error = load_geometry("models/room.gltf", &files).unwrap_err();
    assert_eq!(error.place().map(|place| place.line), Some(4), "{error}");
}

#[test]
fn glb_headers_that_lie_are_refused() {
    let good = square_glb();
    let word = |at: usize, value: u32| {
        let mut bytes = good.clone();
        bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
        bytes
    };
    for (bytes, needle) in [
        (word(4, 1), "GLB version 1; expected 2"),
        (word(8, 1_000_000_000), "says 1000000000 bytes"),
        (word(8, 11), "says 11 bytes"),
        (word(12, 4_000_000_000), "4000000000 bytes, more than"),
        (good[..13].to_vec(), "cut off"),
        (good[..100].to_vec(), "expected 100"),
        (b"glTF".to_vec(), "cut off"),
        (b"junk".to_vec(), "not a valid glTF file"),
        (Vec::new(), "not a valid glTF file"),
    ] {
        let error = load_geometry("room.glb", &files().with("room.glb", bytes)).unwrap_err();
        assert!(error.to_string().contains(needle), "no {needle:?} in: {error}");
    }
}

#[test]
fn strips_fans_and_primitives_without_indices() {
    for (mode, indices) in [(5, [0_u16, 1, 3, 2]), (6, [0, 1, 2, 3])] {
        let mut bytes = square_bytes();
        bytes.splice(48.., indices.into_iter().flat_map(u16::to_le_bytes).chain([0; 4]));
        let json = SQUARE
            .replace("\"count\": 6", "\"count\": 4")
            .replace("\"indices\": 1", &format!("\"indices\": 1, \"mode\": {mode}"));
        let files = files().with("models/room.gltf", json).with("models/square mesh.bin", bytes);
        let mesh = load_geometry("models/room.gltf", &files).unwrap().scene.mesh;
        let area: f64 = (0..4).map(|t| mesh.area_m2(t)).sum();
        assert!((area - 2.0).abs() < 1e-6, "{area}");
        assert!((0..4).all(|t| mesh.front_normal(t).y > 0.999), "mode {mode}");
    }
    let json = SQUARE.replace(", \"indices\": 1", "");
    let mesh = load_geometry("models/room.gltf", &files().with("models/room.gltf", json));
    assert_eq!(mesh.unwrap().scene.mesh.triangles.len(), 2);
}

/// Sparse accessors [3.6.2.3]: positions and indices that replace others, or nothing at all.
#[test]
fn sparse_accessors_replace_elements() {
    let whole = load_geometry("models/room.gltf", &files()).unwrap().scene.mesh;
    let sparse = |numbers: [u8; 4], more: &str, base: &str| {
        // The corners stand rolled by one; three views follow: numbers, positions, and indices.
        let corner = |i: usize| square_bytes()[12 * i..12 * i + 12].to_vec();
        let mut bytes = square_bytes();
        bytes.splice(..12, corner(1));
        bytes.extend(numbers);
        bytes.extend([corner(0), corner(1), corner(2), corner(3)].concat());
        let json = SQUARE
            .replace("\"byteLength\": 60", "\"byteLength\": 112")
            .replace(
                "\"byteOffset\": 48, \"byteLength\": 12}",
                "\"byteOffset\": 48, \"byteLength\": 12}, {\"buffer\": 0, \"byteOffset\": 60, \
                 \"byteLength\": 4}, {\"buffer\": 0, \"byteOffset\": 64, \"byteLength\": 48}",
            )
            .replace("{\"bufferView\": 0,", base)
            .replace(
                "\"count\": 4,",
                &format!(
                    "\"count\": 4, \"sparse\": {{{more}, \"indices\": {{\"bufferView\": 2, \
                     \"componentType\": 5121}}, \"values\": {{\"bufferView\": 3}}}},"
                ),
            );
        let files = files().with("models/room.gltf", json).with("models/square mesh.bin", bytes);
        load_geometry("models/room.gltf", &files).map(|loaded| loaded.scene.mesh)
    };
    let based = "{\"bufferView\": 0,";
    assert_eq!(sparse([0, 9, 9, 9], "\"count\": 1", based).unwrap(), whole);
    assert_eq!(sparse([0, 1, 2, 3], "\"count\": 4", "{").unwrap(), whole);
    for (numbers, more, needle) in [
        ([0, 1, 2, 4], "\"count\": 4", "accessor 0 replaces elements beyond its 4"),
        ([0, 2, 2, 3], "\"count\": 4", "not in rising order"),
        ([0, 1, 2, 3], "\"count\": 5", "the list of replaced numbers says 5 elements"),
    ] {
        let error = sparse(numbers, more, based).unwrap_err().to_string();
        assert!(error.contains(needle), "no {needle:?} in: {error}");
    }
}

/// Integers of 8 and 16 bits, as they are or for -1 to 1 (`KHR_mesh_quantization`).
#[test]
fn quantized_positions_are_read() {
    let whole = load_geometry("models/room.gltf", &files()).unwrap().scene.mesh;
    let corners = [[0, 0, 0], [1, 0, 0], [1, 0, -1], [0, 0, -1]];
    for (component, size, normalized, one) in
        [(5120, 1, false, 1_i16), (5120, 1, true, 127), (5122, 2, false, 1), (5122, 2, true, 32767)]
    {
        let mut bytes: Vec<u8> = Vec::new();
        for corner in corners {
            let numbers = corner.map(|x| (x * one).to_le_bytes());
            bytes.extend(numbers.iter().flat_map(|number| &number[..size]));
            bytes.resize(bytes.len().next_multiple_of(4 * size), 0xAA);
        }
        bytes.resize(48, 0);
        bytes.extend(&square_bytes()[48..]);
        let json = SQUARE
            .replace("5126", &format!("{component}, \"normalized\": {normalized}"))
            .replace(
                "\"byteLength\": 48}",
                &format!("\"byteLength\": 48, \"byteStride\": {}}}", 4 * size),
            )
            .replace(
                "\"2.0\"}",
                "\"2.0\"}, \"extensionsUsed\": [\"KHR_mesh_quantization\"], \
                 \"extensionsRequired\": [\"KHR_mesh_quantization\"]",
            );
        let files = files().with("models/room.gltf", json).with("models/square mesh.bin", bytes);
        let found = load_geometry("models/room.gltf", &files).unwrap().scene.mesh;
        assert_eq!(found, whole, "{component} {normalized}");
    }
}
