//! Wavefront OBJ geometry, read with `tobj` after [`obj_lines`](super::obj_lines) has checked it.

use super::builder::MeshBuilder;
use super::mtl::{self, MtlMaterial};
use super::obj_lines::{self, ObjLines};
use super::polygon::triangulate;
use super::{DEFAULT_MATERIAL, beside, reason};
use crate::{Files, LoadError, Warning};
use glam::DVec3;
use quasilux_text::Position;
use std::path::Path;

/// The first line of what `tobj` reads: makes it ask for the materials.
const ASK_FOR_MATERIALS: &str = "mtllib materials\n";

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

    let mut face_lines = lines.face_lines.iter();
    // A change of material within an object starts a model of the same name.
    let mut object_of: Option<(String, u32)> = None;
    for model in models(&file, &lines)? {
        let mesh = &model.mesh;
        if mesh.indices.is_empty() {
            continue;
        }
        let object = match &object_of {
            Some((name, object)) if *name == model.name => *object,
            _ => builder.object(&model.name),
        };
        object_of = Some((model.name.clone(), object));
        let material = mesh.material_id.and_then(|id| materials.get(id).copied());
        let material = material.unwrap_or_else(|| builder.material(DEFAULT_MATERIAL));
        let position = |&v: &u32| {
            let at = 3 * v as usize;
            DVec3::new(mesh.positions[at], mesh.positions[at + 1], mesh.positions[at + 2])
        };
        let mut indices = mesh.indices.as_slice();
        for arity in arities(mesh) {
            let (face, rest) = indices.split_at(arity.min(indices.len()));
            indices = rest;
            let place = face_lines.next().map(|&line| Position { line, column: 1 });
            let corners: Vec<DVec3> = face.iter().map(position).collect();
            let triangles = triangulate(&corners)
                .map_err(|error| LoadError::new(&file, place, error.to_string()))?;
            for triangle in triangles {
                builder
                    .triangle(object, material, triangle.map(|i| corners[i]))
                    .map_err(|error| LoadError::new(&file, place, error.message("the face")))?;
            }
        }
    }
    Ok(())
}

/// The models of the checked text. Material `i` of the models is `lines.materials[i]`.
fn models(file: &str, lines: &ObjLines) -> Result<Vec<tobj::Model>, LoadError> {
    let mut reader = std::io::Read::chain(ASK_FOR_MATERIALS.as_bytes(), lines.text.as_bytes());
    let options = tobj::LoadOptions { triangulate: false, ..tobj::LoadOptions::default() };
    let materials = |_: &Path| {
        let named = |name: &String| tobj::Material { name: name.clone(), ..Default::default() };
        let index_of = lines.materials.iter().cloned().zip(0..).collect();
        Ok((lines.materials.iter().map(named).collect(), index_of))
    };
    let (models, _) = tobj::load_obj_buf(&mut reader, &options, materials)
        .map_err(|error| LoadError::new(file, None, format!("not a valid OBJ file: {error}")))?;
    Ok(models)
}

/// The number of corners of each face; `tobj` leaves the list empty where all are triangles.
fn arities(mesh: &tobj::Mesh) -> Vec<usize> {
    if mesh.face_arities.is_empty() {
        return vec![3; mesh.indices.len() / 3];
    }
    mesh.face_arities.iter().map(|&arity| arity as usize).collect()
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
