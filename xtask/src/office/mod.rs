//! The office of `examples/office/`, made from numbers: a furnished room of 6 m x 5 m x 2.8 m and
//! the photometry of its luminaires.
//!
//! Geometry is in whole millimetres, so the files have the same bytes everywhere. The project file
//! `office.toml` beside them is written by hand; a test holds it against the geometry.

mod batwing;
mod furniture;
mod room;
mod solids;

use crate::generated::{self, File};
use solids::Wavefront;
use std::path::Path;
use xtask::workspace::Failure;

/// Materials with their reflectances, in the order of the material file.
const MATERIALS: [(&str, f64); 16] = [
    ("ceiling", 0.7),
    ("wall", 0.5),
    ("floor", 0.2),
    ("glass", 0.1),
    ("door", 0.4),
    ("frame", 0.6),
    ("desk", 0.5),
    ("shelf", 0.4),
    ("metal", 0.3),
    ("plastic", 0.1),
    ("screen", 0.05),
    ("fabric", 0.15),
    ("binder", 0.2),
    ("paper", 0.6),
    ("whiteboard", 0.8),
    ("luminaire", 0.8),
];

/// Name below `examples/office/` and content of each generated file.
fn files() -> Result<[File; 3], Failure> {
    let mut wavefront = Wavefront::new("office.mtl");
    room::write(&mut wavefront);
    for object in furniture::objects() {
        wavefront.object(&object);
    }
    Ok([
        ("office.obj".to_owned(), wavefront.finish()),
        ("office.mtl".to_owned(), material_file()),
        ("batwing.ies".to_owned(), batwing::file()?),
    ])
}

/// Writes the generated files.
pub(crate) fn write(root: &Path) -> Result<(), Failure> {
    generated::write(&root.join("examples/office"), &files()?)
}

/// The diffuse colour of each material is its reflectance.
fn material_file() -> String {
    let materials = MATERIALS.map(|(name, reflectance)| {
        format!("newmtl {name}\nKd {reflectance} {reflectance} {reflectance}\n")
    });
    format!("# An office; written by `cargo xtask office`\n{}", materials.concat())
}

#[cfg(test)]
mod tests {
    use super::solids::Block;
    use super::*;
    use xtask::workspace::root as workspace_root;

    fn project() -> toml::Table {
        let path = workspace_root().join("examples/office/office.toml");
        std::fs::read_to_string(path).unwrap().parse().unwrap()
    }

    fn triple(value: &toml::Value) -> [f64; 3] {
        let number = |v: &toml::Value| v.as_float().or(v.as_integer().map(|i| i as f64)).unwrap();
        let numbers: Vec<f64> = value.as_array().unwrap().iter().map(number).collect();
        numbers.try_into().unwrap()
    }

    fn blocks() -> Vec<(String, Block)> {
        let objects = furniture::objects().into_iter();
        objects
            .flat_map(|object| object.blocks.into_iter().map(move |b| (object.name.clone(), b)))
            .collect()
    }

    #[test]
    fn the_committed_files_are_what_the_generator_writes() {
        let folder = workspace_root().join("examples/office");
        generated::assert_committed(&folder, &files().unwrap(), "office");
    }

    #[test]
    fn furniture_neither_touches_the_room_nor_itself() {
        let blocks = blocks();
        for (i, (name, block)) in blocks.iter().enumerate() {
            for axis in 0..3 {
                assert!(block.low_mm[axis] < block.high_mm[axis], "{name} is flat");
                let inside = block.low_mm[axis] > 0 && block.high_mm[axis] < room::SIZE_MM[axis];
                assert!(inside, "{name} touches the room: {block:?}");
            }
            for (other_name, other) in &blocks[..i] {
                assert!(!block.touches(other), "{name} touches {other_name}: {block:?} {other:?}");
            }
        }
    }

    #[test]
    fn materials_of_the_project_are_those_of_the_geometry() {
        let project = project();
        let materials = project["materials"].as_table().unwrap();
        assert_eq!(materials.len(), MATERIALS.len());
        for (name, reflectance) in MATERIALS {
            assert_eq!(materials[name]["reflectance"].as_float(), Some(reflectance), "{name}");
        }
        let used = blocks().into_iter().map(|(_, block)| block.material);
        let known = |name: &str| MATERIALS.iter().any(|(material, _)| *material == name);
        assert!(used.into_iter().all(known));
    }

    #[test]
    fn luminaires_hang_below_their_housings() {
        let project = project();
        let placed = project["luminaires"].as_array().unwrap();
        let positions: Vec<_> = placed.iter().map(|l| triple(&l["position"])).collect();
        assert_eq!(positions.len(), furniture::LUMINAIRES_MM.len());
        for [x, y, z] in furniture::LUMINAIRES_MM {
            let wanted = [x, y, z].map(|mm| f64::from(mm) / 1000.0);
            assert!(positions.contains(&wanted), "no luminaire at {wanted:?}");
        }
    }

    #[test]
    fn no_sensor_point_is_inside_furniture() {
        let blocks = blocks();
        let mut points = Vec::new();
        for sensor in project()["sensors"].as_array().unwrap() {
            if let Some(list) = sensor.get("points") {
                points.extend(list.as_array().unwrap().iter().map(triple));
                continue;
            }
            let [origin, u, v] = ["origin", "u", "v"].map(|key| triple(&sensor[key]));
            let spacing = sensor["spacing"].as_float().unwrap();
            let cells = |edge: [f64; 3]| {
                let length = edge.iter().map(|x| x * x).sum::<f64>().sqrt();
                (length / spacing - 1e-9).ceil().max(1.0) as usize
            };
            let (columns, rows) = (cells(u), cells(v));
            for cell in 0..columns * rows {
                let s = ((cell % columns) as f64 + 0.5) / columns as f64;
                let t = ((cell / columns) as f64 + 0.5) / rows as f64;
                points.push([0, 1, 2].map(|axis| origin[axis] + s * u[axis] + t * v[axis]));
            }
        }
        assert!(points.len() > 300, "{} sensor points", points.len());
        for point in points {
            for (name, block) in &blocks {
                let inside = (0..3).all(|axis| {
                    let x_mm = point[axis] * 1000.0;
                    x_mm > f64::from(block.low_mm[axis]) - 2.0
                        && x_mm < f64::from(block.high_mm[axis]) + 2.0
                });
                assert!(!inside, "sensor point {point:?} is within 2 mm of {name}");
            }
        }
    }
}
