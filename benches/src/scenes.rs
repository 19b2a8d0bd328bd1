//! Scenes that light moves through.

use glam::DVec3;
use quasilux_scene::light::PointLight;
use quasilux_scene::{
    FileKind, Files, Grid, Light, Quantity, Scene, Sensor, SensorPoint, SensorShape, load,
};
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
    fn read(&self, path: &str, _kind: FileKind) -> io::Result<Vec<u8>> {
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

/// Files in memory.
struct Texts([(&'static str, &'static str); 2]);

impl Files for Texts {
    fn read(&self, path: &str, _kind: FileKind) -> io::Result<Vec<u8>> {
        let found = self.0.iter().find(|(name, _)| *name == path);
        found.map(|(_, text)| text.as_bytes().to_vec()).ok_or(io::ErrorKind::NotFound.into())
    }
}

const ROOM: &str = "
    v 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 0\nv 0 0 2.5\nv 4 0 2.5\nv 4 3 2.5\nv 0 3 2.5
    v 1 1 0.7\nv 2 1 0.7\nv 2 2 0.7\nv 1 2 0.7
    usemtl floor\nf 1 2 3 4\nusemtl ceiling\nf 5 8 7 6
    usemtl wall\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1
    usemtl table\nf 9 10 11 12
";
/// A beam of 10 degrees straight down, and a faint glow from there to the horizon.
const SPOT: &str = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 6 1 1 2 0 0 0\n1 1 1\n0 4 6 30 90 180\n0\n\
                    9000 8000 300 40 0 0\n";

/// A room of 4 m x 3 m x 2.5 m with a table and the lights of this part of a project.
fn small_room(name: &'static str, lights: &str) -> Named {
    let project = format!(
        "[scene]\ngeometry = [\"room.obj\"]\n[materials]\n{}\n{lights}\n{}",
        "floor = { reflectance = 0.2 }\nwall = { reflectance = 0.5 }\n\
         ceiling = { reflectance = 0.7 }\ntable = { reflectance = 0.4 }",
        "[[sensors]]\nname = \"plane\"\nkind = \"grid\"\norigin = [0.3, 0.3, 0.8]\n\
         u = [3.4, 0, 0]\nv = [0, 2.4, 0]\ncounts = [6, 4]\nnormal = [0, 0, 1]"
    );
    let files = Texts([("room.obj", ROOM), ("spot.ies", SPOT)]);
    Named { name, scene: load(name, project.as_bytes(), &files).expect("it loads").scene }
}

/// A small room with two narrow beams onto its dark floor and its table.
#[must_use]
pub fn spotlights() -> Named {
    small_room(
        "spotlights",
        "[[luminaires]]\nphotometry = \"spot.ies\"\nposition = [1.4, 1.4, 2.4]\n\
         [[luminaires]]\nphotometry = \"spot.ies\"\nposition = [3.0, 2.0, 2.4]",
    )
}

/// The same room with a bare lamp 2 cm from a wall.
#[must_use]
pub fn lamp_near_a_wall() -> Named {
    small_room(
        "wall",
        "[[lights]]\nkind = \"point\"\nposition = [0.02, 1.1, 1.3]\nintensity_cd = 100",
    )
}

/// A project with this section `[scene]` and what follows it, a light of 10 kcd, and a point that
/// looks up.
#[must_use]
pub fn lamp_and_probe(scene: &str, lamp: [f64; 3], probe: [f64; 3]) -> String {
    format!(
        "[scene]\n{scene}\n\
         [[lights]]\nkind = \"point\"\nposition = {lamp:?}\nintensity_cd = 10000\n\
         [[sensors]]\nname = \"middle\"\nkind = \"points\"\n\
         points = [{probe:?}]\nnormals = [[0, 0, 1]]\n"
    )
}

/// A furnished kitchen of 57 000 triangles, a lamp and a level grid in its middle; `None` with
/// `QUASILUX_CORPUS=none`.
///
/// # Panics
/// Where the file is missing, is damaged, or the program `zstd` is missing.
#[must_use]
pub fn kitchen() -> Option<Named> {
    let folder = quasilux_corpus::find("scenes/obvhs-kitchen")?;
    // Light and sensor are replaced when the size of the kitchen is known.
    let project = lamp_and_probe("geometry = [\"kitchen.obj\"]\nup = \"y\"", [0.0; 3], [0.0; 3]);
    let scene = load("kitchen", project.as_bytes(), &Folder(folder));
    let mut scene = scene.expect("the kitchen and zstd").scene;
    let [low, high] = scene.mesh.bounds().expect("a kitchen has triangles");
    let (middle, edges) = (0.5 * (low + high), 0.5 * (high - low));
    scene.lights = vec![Light::Point(PointLight { position: middle, intensity_cd: 100.0 })];
    let grid = Grid {
        origin: middle - 0.5 * edges,
        u: DVec3::X * edges.x,
        v: DVec3::Y * edges.y,
        counts: [16, 16],
        normal: DVec3::Z,
        quantity: Quantity::Mean,
        target_lx: None,
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
        target_lx: None,
    };
    let desks = [(1.7, 1.89), (4.3, 1.89), (1.7, 3.11), (4.3, 3.11)];
    let desk = |(x, y)| SensorPoint { position: DVec3::new(x, y, 0.76), normal: DVec3::Z };
    vec![
        Sensor { name: "workplane".to_owned(), shape: SensorShape::Grid(grid) },
        Sensor { name: "desks".to_owned(), shape: SensorShape::Points(desks.map(desk).to_vec()) },
    ]
}
