//! Wavefront OBJ geometry: the faces of [`obj_lines`](super::obj_lines) to triangles.

use super::builder::MeshBuilder;
use super::mtl::{self, MtlMaterial};
use super::obj_lines::{self, ObjLines};
use super::polygon::triangulate;
use super::{DEFAULT_MATERIAL, beside, reason};
use crate::{Files, LoadError, Warning};
use glam::DVec3;
use quasilux_text::Position;

/// Reads an OBJ file and the material files that it names into `builder`.
pub(super) fn read(
    bytes: &[u8],
    files: &dyn Files,
    builder: &mut MeshBuilder,
    warnings: &mut Vec<Warning>,
) -> Result<(), LoadError> {
    let file = builder.file().to_owned();
    let lines = obj_lines::read(&file, bytes)?;
    let materials: Vec<u32> = lines.materials.iter().map(|name| builder.material(name)).collect();
    for (name, place) in &lines.libraries {
        read_library(&beside(&file, name), *place, files, builder, &lines, warnings);
    }
    if lines.thin_faces > 0 {
        let message = format!("{} faces have fewer than three corners: dropped", lines.thin_faces);
        warnings.push(Warning::new(&file, None, message));
    }

    let objects: Vec<u32> = lines.objects.iter().map(|name| builder.object(name)).collect();
    for face in &lines.faces {
        let place = Some(Position { line: face.line, column: 1 });
        let material = match face.material {
            Some(index) => materials[index],
            None => builder.material(DEFAULT_MATERIAL),
        };
        let corners: Vec<DVec3> = lines.corners[face.corners.clone()]
            .iter()
            .map(|index| lines.positions[*index as usize])
            .collect();
        let triangles = triangulate(&corners)
            .map_err(|error| LoadError::new(&file, place, error.to_string()))?;
        for triangle in triangles {
            builder
                .triangle(objects[face.object], material, triangle.map(|i| corners[i]))
                .map_err(|error| LoadError::new(&file, place, error.message("the face")))?;
        }
    }
    Ok(())
}

/// Reads an MTL file; one that is missing or broken is a warning, for the project file may define
/// the materials.
fn read_library(
    path: &str,
    place: Position,
    files: &dyn Files,
    builder: &mut MeshBuilder,
    lines: &ObjLines,
    warnings: &mut Vec<Warning>,
) {
    let bytes = match files.read(path) {
        Ok(bytes) => bytes,
        Err(error) => {
            let message =
                format!("cannot read \"{path}\": {}; its materials are unknown", reason(&error));
            warnings.push(Warning::new(builder.file(), Some(place), message));
            return;
        }
    };
    for material in mtl::read(path, &bytes, warnings) {
        let MtlMaterial { name, reflectance, emits } = material;
        if lines.materials.contains(&name) {
            let index = builder.material(&name);
            builder.describe(index, reflectance, emits, warnings);
        }
    }
}
