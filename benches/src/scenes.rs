//! Scenes that light moves through.

use glam::DVec3;
use quasilux_scene::light::PointLight;
use quasilux_scene::{Files, Grid, Light, Quantity, Scene, Sensor, SensorPoint, SensorShape, load};
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A scene and its name.
pub struct Named {
    /// The name.
    pub name: &'static str,
    /// The scene.
    pub scene: Scene,
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
///
/// # Panics
/// Where it cannot be loaded.
#[must_use]
pub fn example(name: &'static str) -> Named {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples").join(name);
    let project = std::fs::read(folder.join(format!("{name}.toml"))).expect("an example");
    let loaded = load(name, &project, &Folder(folder)).expect("examples load");
    Named { name, scene: loaded.scene }
}

/// A furnished kitchen of 57 000 triangles, a lamp and a level grid in its middle; `None` where the
/// file or `zstd` is missing.
#[must_use]
pub fn kitchen() -> Option<Named> {
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

/// Nine points on each face of the diffuse cube, at 0 and half way to the edges.
#[must_use]
pub fn cube_sensors() -> Vec<Sensor> {
    let places = [-2.5, 0.0, 2.5];
    let axes = DVec3::AXES.into_iter().enumerate();
    let points = axes.flat_map(|(axis, n)| {
        let (a, b) = (DVec3::AXES[(axis + 1) % 3], DVec3::AXES[(axis + 2) % 3]);
        [-1.0, 1.0].into_iter().flat_map(move |side| {
            places.into_iter().flat_map(move |u| {
                places.into_iter().map(move |v| SensorPoint {
                    position: n * (5.0 * side) + a * u + b * v,
                    normal: n * -side,
                })
            })
        })
    });
    vec![Sensor { name: "faces".to_owned(), shape: SensorShape::Points(points.collect()) }]
}

/// An even grid of 64 points at working height in the office, and its four desks.
#[must_use]
pub fn office_sensors() -> Vec<Sensor> {
    let grid = Grid {
        origin: DVec3::new(0.5, 0.5, 0.85),
        u: DVec3::X * 5.0,
        v: DVec3::Y * 4.0,
        counts: [8, 8],
        normal: DVec3::Z,
        quantity: Quantity::Centre,
    };
    let desks = [(1.7, 1.89), (4.3, 1.89), (1.7, 3.11), (4.3, 3.11)];
    let desk = |(x, y)| SensorPoint { position: DVec3::new(x, y, 0.76), normal: DVec3::Z };
    vec![
        Sensor { name: "workplane".to_owned(), shape: SensorShape::Grid(grid) },
        Sensor { name: "desks".to_owned(), shape: SensorShape::Points(desks.map(desk).to_vec()) },
    ]
}
