//! What photons fly through.

use glam::DVec3;
use quasilux_scene::light::PointLight;
use quasilux_scene::{Files, Grid, Light, Quantity, Scene, Sensor, SensorShape, load};
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A scene and its name.
pub(crate) struct Named {
    pub(crate) name: &'static str,
    pub(crate) scene: Scene,
}

/// The files of a folder, those that end in `.zst` there unpacked.
struct Folder(PathBuf);

impl Files for Folder {
    fn read(&self, path: &str) -> io::Result<Vec<u8>> {
        let packed = self.0.join(format!("{path}.zst"));
        if !packed.exists() {
            return std::fs::read(self.0.join(path));
        }
        Ok(Command::new("zstd").arg("-dcq").arg(packed).output()?.stdout)
    }
}

/// One of the examples.
pub(crate) fn example(name: &'static str) -> Named {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples").join(name);
    let project = std::fs::read(folder.join(format!("{name}.toml"))).expect("an example");
    let loaded = load(name, &project, &Folder(folder)).expect("examples load");
    Named { name, scene: loaded.scene }
}

/// A furnished kitchen of 57 000 triangles, a lamp and a level grid in its middle; `None` where the
/// file or `zstd` is missing.
pub(crate) fn kitchen() -> Option<Named> {
    let folder =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data/scenes/obvhs-kitchen");
    let project = br#"
        [scene]
        geometry = ["kitchen.obj"]
        up = "y"
        [[lights]]
        kind = "point"
        position = [0, 0, 0]
        intensity_cd = 100
        [[sensors]]
        name = "placeholder"
        kind = "points"
        points = [[0, 0, 0]]
        normals = [[0, 0, 1]]
    "#;
    let mut scene = load("kitchen", project, &Folder(folder)).ok()?.scene;
    let [low, high] = scene.mesh.bounds()?;
    let (middle, edges) = (0.5 * (low + high), 0.5 * (high - low));
    scene.lights = vec![Light::Point(PointLight { position: middle, intensity_cd: 100.0 })];
    let grid = Grid {
        origin: middle - 0.5 * edges,
        u: DVec3::X * edges.x,
        v: DVec3::Y * edges.y,
        counts: [16, 16],
        normal: DVec3::Z,
        quantity: Quantity::Mean,
    };
    scene.sensors = vec![Sensor { name: "level".to_owned(), shape: SensorShape::Grid(grid) }];
    Some(Named { name: "kitchen", scene })
}
