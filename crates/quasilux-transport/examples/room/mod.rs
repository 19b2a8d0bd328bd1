//! The room that the examples light: 4 m x 3 m x 2.5 m, two lamps, a desk of six points.

use quasilux_scene::{FileKind, Files, Scene, load};
use std::io::ErrorKind;

const PROJECT: &str = r#"
    [scene]
    geometry = ["room.obj"]
    [materials.walls]
    reflectance = 0.6
    [[lights]]
    kind = "point"
    position = [1, 1.5, 2.2]
    intensity_cd = 150
    [[lights]]
    kind = "point"
    position = [3, 1.5, 2.2]
    intensity_cd = 150
    [[sensors]]
    name = "desk"
    kind = "grid"
    origin = [1.2, 1, 0.75]
    u = [1.6, 0, 0]
    v = [0, 0.8, 0]
    counts = [3, 2]
    normal = [0, 0, 1]
"#;

const GEOMETRY: &str = "usemtl walls\nv 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 0\nv 0 0 2.5\nv 4 0 2.5\n\
                        v 4 3 2.5\nv 0 3 2.5\nf 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\n\
                        f 3 7 8 4\nf 4 8 5 1\n";

/// Files that are in memory.
struct Memory;

impl Files for Memory {
    fn read(&self, path: &str, _kind: FileKind) -> std::io::Result<Vec<u8>> {
        if path == "room.obj" { Ok(GEOMETRY.into()) } else { Err(ErrorKind::NotFound.into()) }
    }
}

/// Loads it, as a program would from files.
pub(crate) fn room() -> Scene {
    load("room.toml", PROJECT.as_bytes(), &Memory).expect("a project without mistakes").scene
}
