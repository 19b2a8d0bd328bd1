//! Geometry files that make no sense.

use super::{Case, FLOOR_OBJ, check};
use crate::support::Folder;

#[test]
fn geometry_files() {
    check(
        "geometry",
        &[
            Case::new("missing").remove("room.obj").says(&["project.toml:2:13:", "room.obj"]),
            Case::new("a folder")
                .replace("room.obj", "folder.obj")
                .file("folder.obj/note.txt", "")
                .says(&["project.toml:2:13:", "folder.obj"]),
            Case::new("no format")
                .replace("room.obj", "room.stl")
                .file("room.stl", "solid\nendsolid\n")
                .says(&["project.toml:2:13:", ".gltf"]),
            Case::new("an IFC model")
                .replace("room.obj", "room.ifc")
                .file("room.ifc", "ISO-10303-21;\n")
                .says(&["project.toml:2:13:", "python -m quasilux.ifc \"room.ifc\""]),
            Case::new("twice")
                .replace("[\"room.obj\"]", "[\"room.obj\", \"room.obj\"]")
                .says(&["project.toml:2:25:", "twice"]),
        ],
    );
}

#[test]
fn obj() {
    let floor = |from: &str, to: &str| {
        assert!(FLOOR_OBJ.contains(from), "no {from} in the file");
        FLOOR_OBJ.replacen(from, to, 1)
    };
    check(
        "obj",
        &[
            Case::new("empty").file("room.obj", "").says(&["room.obj:", "no triangles"]),
            Case::new("a web page")
                .file("room.obj", "\n<html lang=\"en\"><body>v 0 0 0</body></html>\n")
                .says(&["room.obj:1:1:", "a web page", "raw file"]),
            Case::new("binary junk")
                .file("room.obj", (0..=255).cycle().take(5000).collect::<Vec<u8>>())
                .says(&["room.obj:1:", "binary"]),
            Case::new("a vertex that is no number")
                .file("room.obj", floor("v 2 0 0", "v 2 nan 0"))
                .says(&["room.obj:4:", "nan"]),
            Case::new("an infinite vertex")
                .file("room.obj", floor("v 2 0 0", "v 2 1e999 0"))
                .says(&["room.obj:4:", "1e999"]),
            Case::new("a vertex that is not there")
                .file("room.obj", floor("f 1 2 3 4", "f 1 2 3 5"))
                .says(&["room.obj:7:", "vertex 5", "1 to 4"]),
            Case::new("vertex zero")
                .file("room.obj", floor("f 1 2 3 4", "f 0 1 2"))
                .says(&["room.obj:7:", "\"0\""]),
            Case::new("no area")
                .file("room.obj", floor("f 1 2 3 4", "f 1 2 1"))
                .says(&["room.obj:", "degenerate"]),
        ],
    );
}

#[test]
fn gltf() {
    let gltf = |json: &str| Case::new("").file("room.gltf", json).replace("room.obj", "room.gltf");
    let glb =
        |bytes: Vec<u8>| Case::new("").file("room.glb", bytes).replace("room.obj", "room.glb");
    let named = |what: &'static str, case: Case| Case { what, ..case };
    let triangle = document(r#"{"uri": "room.bin", "byteLength": 36}"#, "36", "3");
    let binary = |length: &str, count: &str| {
        document(&format!(r#"{{"byteLength": {length}}}"#), length, count)
    };
    let whole = container(&binary("36", "3"), &[0; 36]);
    check(
        "gltf",
        &[
            named("empty", gltf("")).says(&["room.gltf:1:1:", "glTF"]),
            named("not JSON", gltf("{\"asset\": ")).says(&["room.gltf"]),
            named("a missing buffer", gltf(&triangle)).says(&["room.gltf", "room.bin"]),
            named("a short buffer", gltf(&triangle))
                .file("room.bin", [0; 20])
                .says(&["room.gltf", "expected"]),
            named("a buffer elsewhere", gltf(&triangle.replace("room.bin", "http://room.bin")))
                .says(&["room.gltf", "http"]),
            named("no bytes", glb(Vec::new())).says(&["room.glb:1:1:", "glTF"]),
            named(
                "a header of 10^9 vertices",
                glb(container(&binary("36", "1000000000"), &[0; 36])),
            )
            .says(&["room.glb", "1000000000"]),
            named(
                "a buffer of 12 * 10^9 bytes",
                glb(container(&binary("12000000000", "1000000000"), &[0; 36])),
            )
            .says(&["room.glb"]),
            named("cut off in the header", glb(whole[..10].to_vec())).says(&["room.glb"]),
            named("cut off in the text", glb(whole[..60].to_vec())).says(&["room.glb"]),
            named("cut off in the buffer", glb(whole[..whole.len() - 7].to_vec()))
                .says(&["room.glb"]),
            named("a triangle in one point", glb(whole.clone())).says(&["room.glb", "degenerate"]),
            named("a chunk of 4 GB", glb(with_chunk_length(&whole, u32::MAX))).says(&["room.glb"]),
            named("another version", glb(with_version(&whole, 9))).says(&["room.glb"]),
        ],
    );
}

/// A glTF document of one triangle without indices.
fn document(buffer: &str, view_bytes: &str, vertices: &str) -> String {
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}],
        "nodes": [{{"mesh": 0}}], "materials": [{{"name": "wood"}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "material": 0}}]}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": {vertices}, "type": "VEC3",
            "min": [0, 0, 0], "max": [1, 1, 1]}}],
        "bufferViews": [{{"buffer": 0, "byteLength": {view_bytes}}}], "buffers": [{buffer}]}}"#
    )
}

/// A GLB container (glTF 2.0, section 4.4).
fn container(json: &str, binary: &[u8]) -> Vec<u8> {
    let mut json = json.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut bytes = b"glTF".to_vec();
    let length = 12 + 8 + json.len() + 8 + binary.len();
    for number in [2, length as u32, json.len() as u32] {
        bytes.extend(number.to_le_bytes());
    }
    bytes.extend(b"JSON");
    bytes.extend(&json);
    bytes.extend((binary.len() as u32).to_le_bytes());
    bytes.extend(b"BIN\0");
    bytes.extend(binary);
    bytes
}

fn with_chunk_length(container: &[u8], length: u32) -> Vec<u8> {
    [&container[..12], &length.to_le_bytes(), &container[16..]].concat()
}

fn with_version(container: &[u8], version: u32) -> Vec<u8> {
    [&container[..4], &version.to_le_bytes(), &container[8..]].concat()
}

/// Names come from files, and are shown as what they are: no colours, no turned writing, no page of
/// one word.
#[test]
fn names_of_files_command_no_terminal() {
    let long = "x".repeat(20_000);
    let names = ["wo\u{1b}[31mod", "wo\u{202e}od", "wo\u{7}od", &long];
    let shown = ["wo\\u{1b}[31mod", "wo\\u{202e}od", "wo\\u{7}od", "xxx..."];
    let folder = Folder::new("terminal");
    for (name, shown) in names.into_iter().zip(shown) {
        let obj = FLOOR_OBJ.replace("usemtl wood", &format!("usemtl {name}"));
        let run = Case::new("a name").file("room.obj", obj).run(&folder);
        assert_eq!(run.code, Some(2), "{}", run.stderr);
        assert!(run.stderr.contains(shown), "{}", run.stderr);
        let is_plain = |c: char| c == '\n' || !(c.is_control() || c == '\u{202e}');
        assert!(run.stderr.chars().all(is_plain) && run.stderr.len() < 1000, "{:?}", run.stderr);
    }
}
