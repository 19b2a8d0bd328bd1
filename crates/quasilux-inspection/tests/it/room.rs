//! A room of 6 m x 4 m x 3 m with two lamps and a workplane, to be spoilt, and files in a map.

use glam::DVec3;
use quasilux_bvh::TriangleBvh;
use quasilux_inspection::{DarkPoints, Finding, explain_darkness, inspect};
use quasilux_scene::{FileKind, Files, Loaded, Scene, load};
use std::collections::HashMap;
use std::fmt::Write;

/// The project of the room.
pub(crate) const PROJECT: &str = r#"[scene]
geometry = ["room.obj"]

[materials.floor]
reflectance = 0.3
[materials.ceiling]
reflectance = 0.8
[materials.wall]
reflectance = 0.6

[[luminaires]]
photometry = "lamp.ies"
position = [1.5, 2, 2.7]
[[luminaires]]
photometry = "lamp.ies"
position = [4.5, 2, 2.7]

[[sensors]]
name = "workplane"
kind = "grid"
origin = [0.5, 0.5, 0.8]
u = [5, 0, 0]
v = [0, 3, 0]
spacing = 0.5
"#;

/// 2000 lm downward: as much to all directions of the lower half as to any other, and a tenth of it
/// upward. Its opening is 1.2 m long.
pub(crate) const LAMP: &str = "IESNA:LM-63-2002\n[TEST] none\n[MANUFAC] none\nTILT=NONE\n\
    1 2500 1 4 1 1 2 0.1 1.2 0\n1 1 20\n0 90 90.01 180\n0\n318.3 318.3 32 32\n";

/// A flat face of a mesh.
#[derive(Clone, Debug)]
pub(crate) struct Face {
    pub(crate) object: &'static str,
    pub(crate) material: &'static str,
    /// Counter-clockwise from the front.
    pub(crate) corners: Vec<DVec3>,
}

/// The six inner faces of a box.
pub(crate) fn shell(low: DVec3, high: DVec3) -> Vec<Face> {
    let at = |x: usize, y: usize, z: usize| {
        let pick = |axis: usize, bit: usize| if bit == 0 { low[axis] } else { high[axis] };
        DVec3::new(pick(0, x), pick(1, y), pick(2, z))
    };
    let face = |object, material, corners: [DVec3; 4]| Face {
        object,
        material,
        corners: corners.to_vec(),
    };
    vec![
        face("floor", "floor", [at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)]),
        face("ceiling", "ceiling", [at(0, 0, 1), at(0, 1, 1), at(1, 1, 1), at(1, 0, 1)]),
        face("south", "wall", [at(0, 0, 0), at(0, 0, 1), at(1, 0, 1), at(1, 0, 0)]),
        face("north", "wall", [at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1)]),
        face("west", "wall", [at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1)]),
        face("east", "wall", [at(1, 0, 0), at(1, 0, 1), at(1, 1, 1), at(1, 1, 0)]),
    ]
}

/// A closed body: the faces of a box turned outward, all of one object.
pub(crate) fn body(object: &'static str, low: DVec3, high: DVec3) -> Vec<Face> {
    let turned = |face: Face| Face {
        object,
        material: "wall",
        corners: face.corners.into_iter().rev().collect(),
    };
    shell(low, high).into_iter().map(turned).collect()
}

/// A horizontal rectangle whose front faces up, or down.
pub(crate) fn plate(
    object: &'static str,
    material: &'static str,
    [low, high]: [DVec3; 2],
    faces_up: bool,
) -> Face {
    let mut corners = vec![
        DVec3::new(low.x, low.y, low.z),
        DVec3::new(high.x, low.y, low.z),
        DVec3::new(high.x, high.y, low.z),
        DVec3::new(low.x, high.y, low.z),
    ];
    if !faces_up {
        corners.reverse();
    }
    Face { object, material, corners }
}

/// The room.
pub(crate) fn room() -> Vec<Face> {
    shell(DVec3::ZERO, DVec3::new(6.0, 4.0, 3.0))
}

/// A project with its files, to be inspected.
#[derive(Clone, Debug)]
pub(crate) struct Case {
    pub(crate) project: String,
    pub(crate) faces: Vec<Face>,
    pub(crate) lamp: String,
}

impl Case {
    pub(crate) fn new() -> Self {
        Self { project: PROJECT.to_owned(), faces: room(), lamp: LAMP.to_owned() }
    }

    /// Puts other text in the project.
    pub(crate) fn say(mut self, old: &str, new: &str) -> Self {
        assert!(self.project.contains(old), "the project does not say {old:?}");
        self.project = self.project.replacen(old, new, 1);
        self
    }

    /// Adds text at the end of the project.
    pub(crate) fn add(mut self, text: &str) -> Self {
        self.project += text;
        self
    }

    pub(crate) fn with(mut self, faces: impl IntoIterator<Item = Face>) -> Self {
        self.faces.extend(faces);
        self
    }

    pub(crate) fn without(mut self, object: &str) -> Self {
        self.faces.retain(|face| face.object != object);
        self
    }

    /// Moves all corners.
    pub(crate) fn moved(mut self, to: impl Fn(DVec3) -> DVec3) -> Self {
        for corner in self.faces.iter_mut().flat_map(|face| &mut face.corners) {
            *corner = to(*corner);
        }
        self
    }

    /// Multiplies all numbers in square brackets of lines that begin with one of the keys.
    pub(crate) fn positions_scaled(mut self, factor: f64) -> Self {
        const KEYS: [&str; 4] = ["position", "origin", "u = ", "v = "];
        let scaled = |line: &str| -> String {
            if let Some(number) = line.strip_prefix("spacing = ") {
                return format!("spacing = {}", number.parse::<f64>().unwrap() * factor);
            }
            let Some((key, list)) = line.split_once('[') else { return line.to_owned() };
            if !KEYS.iter().any(|wanted| key.starts_with(wanted)) {
                return line.to_owned();
            }
            let numbers = list.trim_end_matches(']').split(',');
            let numbers = numbers.map(|number| number.trim().parse::<f64>().unwrap() * factor);
            format!("{key}{:?}", numbers.collect::<Vec<f64>>())
        };
        self.project = self.project.lines().map(|line| scaled(line) + "\n").collect();
        self
    }

    fn obj(&self) -> String {
        let mut text = String::new();
        let mut vertices: HashMap<[u64; 3], usize> = HashMap::new();
        for face in &self.faces {
            let mut numbers = String::new();
            for corner in &face.corners {
                let key = (*corner + DVec3::ZERO).to_array().map(f64::to_bits);
                let next = vertices.len() + 1;
                let number = *vertices.entry(key).or_insert_with(|| {
                    writeln!(text, "v {} {} {}", corner.x, corner.y, corner.z).unwrap();
                    next
                });
                write!(numbers, " {number}").unwrap();
            }
            writeln!(text, "o {}\nusemtl {}\nf{numbers}", face.object, face.material).unwrap();
        }
        text
    }

    /// What is said of it.
    pub(crate) fn findings(&self) -> Vec<Finding> {
        inspected("room.toml", self.project.as_bytes(), &self.files())
    }

    /// What its loader warns of.
    pub(crate) fn warnings(&self) -> Vec<String> {
        let loaded = load("room.toml", self.project.as_bytes(), &self.files());
        let loaded = loaded.unwrap_or_else(|error| panic!("{error}"));
        loaded.warnings.into_iter().map(|warning| warning.message).collect()
    }

    /// What is said after a run that found no light at the first point of these sensors.
    pub(crate) fn darkness(&self, sensors: &[usize]) -> Vec<Finding> {
        let loaded = load("room.toml", self.project.as_bytes(), &self.files()).unwrap();
        let Loaded { scene, places, .. } = &loaded;
        let dark: Vec<DarkPoints> =
            sensors.iter().map(|&sensor| DarkPoints { sensor, points: vec![0] }).collect();
        let hierarchy = hierarchy(scene);
        let found = inspect(scene, places, &hierarchy);
        explain_darkness(scene, places, &hierarchy, &dark, &found)
    }

    fn files(&self) -> MapFiles {
        let files = [("room.obj", self.obj()), ("lamp.ies", self.lamp.clone())];
        let files = files.map(|(name, text)| (name.to_owned(), text.into_bytes()));
        MapFiles(HashMap::from(files))
    }
}

/// Loads and inspects a project.
pub(crate) fn inspected(name: &str, project: &[u8], files: &dyn Files) -> Vec<Finding> {
    let loaded = load(name, project, files).unwrap_or_else(|error| panic!("{error}"));
    inspect(&loaded.scene, &loaded.places, &hierarchy(&loaded.scene))
}

fn hierarchy(scene: &Scene) -> TriangleBvh {
    let triangles = 0..scene.mesh.triangles.len() as u32;
    TriangleBvh::build(triangles.map(|t| scene.mesh.corners(t)).collect())
}

/// Files in a map.
pub(crate) struct MapFiles(pub(crate) HashMap<String, Vec<u8>>);

impl Files for MapFiles {
    fn read(&self, path: &str, _: FileKind) -> std::io::Result<Vec<u8>> {
        self.0.get(path).cloned().ok_or_else(|| std::io::ErrorKind::NotFound.into())
    }
}
