//! Wavefront OBJ geometry: the faces of [`obj_lines`](super::obj_lines) to triangles.

use super::builder::{Look, MeshBuilder};
use super::mtl::{self, MtlMaterial};
use super::obj_lines::{self, ObjLines};
use super::polygon::Cutter;
use super::{DEFAULT_MATERIAL, beside, reason};
use crate::files::{self, FileKind};
use crate::{Files, LoadError, Warning, too_large};
use glam::DVec3;
use quasilux_text::Position;
use std::collections::HashSet;
use std::io;

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
    let mut libraries = Libraries { files, wanted: lines.materials.iter().collect(), bytes: 0 };
    let mut read = HashSet::new();
    for (names, place) in &lines.libraries {
        if read.insert(names) {
            libraries.read_all(names, *place, builder, warnings);
        }
    }
    warnings.extend(oddities(&lines).map(|message| Warning::new(&file, None, message)));
    let objects: Vec<u32> =
        lines.objects.iter().map(|name| builder.object(&name.as_str().into())).collect();
    let mut cutter = Cutter::default();
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
        let triangles = cutter
            .triangulate(&corners)
            .map_err(|error| LoadError::new(&file, place, error.to_string()))?;
        for triangle in triangles {
            builder
                .triangle(objects[face.object], material, triangle.map(|i| corners[i]))
                .map_err(|error| LoadError::new(&file, place, error.message("the face")))?;
        }
    }
    Ok(())
}

/// Warnings about what was left out of a file, or lived with.
fn oddities(lines: &ObjLines) -> impl Iterator<Item = String> {
    let counted = |count: u64, what: &str| (count > 0).then(|| format!("{count} {what}"));
    let unnamed = format!(
        "usemtl statements name no material: their faces have the material \"{DEFAULT_MATERIAL}\""
    );
    [
        counted(lines.unnamed_materials, &unnamed),
        counted(lines.thin_faces, "faces have fewer than three corners: dropped"),
        counted(
            lines.free_forms,
            "curves and surfaces of free form are not read; expected polygons",
        ),
        counted(
            lines.vertices_with_commas,
            "vertices have commas in their numbers; expected decimal points (read as such)",
        ),
    ]
    .into_iter()
    .flatten()
}

/// Bytes that a material file counts for beside its own, so that the number of files is bounded.
const LIBRARY_BYTES: u64 = 1 << 16;

/// Material files of one OBJ file; all together may have as many bytes as one.
struct Libraries<'a> {
    files: &'a dyn Files,
    /// Materials that the OBJ file uses.
    wanted: HashSet<&'a String>,
    /// Of all that were read.
    bytes: u64,
}

impl Libraries<'_> {
    /// Reads what a statement names: one file, whose name may have blanks, or several.
    fn read_all(
        &mut self,
        names: &str,
        place: Position,
        builder: &mut MeshBuilder,
        warnings: &mut Vec<Warning>,
    ) {
        let whole = beside(builder.file(), names.trim_matches('"'));
        let several = file_names(names);
        if several.len() < 2 {
            return self.read(&whole, place, builder, warnings);
        }
        if let Ok(bytes) = self.bytes_of(&whole) {
            return self.add(&whole, &bytes, builder, warnings);
        }
        for name in several {
            if self.bytes >= FileKind::MaterialLibrary.max_bytes() {
                break;
            }
            self.read(&beside(builder.file(), &name), place, builder, warnings);
        }
    }

    /// Reads an MTL file; one that is missing or broken is a warning, for the project file may
    /// define the materials.
    fn read(
        &mut self,
        path: &str,
        place: Position,
        builder: &mut MeshBuilder,
        warnings: &mut Vec<Warning>,
    ) {
        let bytes = match self.bytes_of(path) {
            Ok(bytes) => bytes,
            Err(error) => {
                let reason = reason(&error);
                let message =
                    format!("cannot read \"{path}\": {reason}; its materials are unknown");
                warnings.push(Warning::new(builder.file(), Some(place), message));
                return;
            }
        };
        self.add(path, &bytes, builder, warnings);
    }

    fn add(
        &self,
        path: &str,
        bytes: &[u8],
        builder: &mut MeshBuilder,
        warnings: &mut Vec<Warning>,
    ) {
        for material in mtl::read(path, bytes, warnings) {
            if self.wanted.contains(&material.name) {
                let index = builder.material(&material.name);
                let MtlMaterial { reflectance, emits, is_clear, .. } = material;
                builder.describe(index, Look { reflectance, emits, is_clear }, warnings);
            }
        }
    }

    fn bytes_of(&mut self, path: &str) -> io::Result<Vec<u8>> {
        let max_bytes = FileKind::MaterialLibrary.max_bytes();
        if self.bytes >= max_bytes {
            return Err(too_large(max_bytes));
        }
        self.bytes += LIBRARY_BYTES;
        let bytes = files::read(self.files, path, FileKind::MaterialLibrary)?;
        self.bytes += bytes.len() as u64;
        Ok(bytes)
    }
}

/// The names of the files of a statement: each ends with the word that ends like a material file;
/// words that none ends are names of their own.
fn file_names(names: &str) -> Vec<String> {
    let mut all = Vec::new();
    let mut begun: Vec<&str> = Vec::new();
    for word in names.split_whitespace() {
        begun.push(word);
        let word = word.trim_matches('"');
        if word.len() > 4 && word.to_ascii_lowercase().ends_with(".mtl") {
            all.push(begun.join(" ").trim_matches('"').to_owned());
            begun.clear();
        }
    }
    all.extend(begun.into_iter().map(str::to_owned));
    all
}

#[cfg(test)]
mod tests {
    use super::file_names;

    #[test]
    fn names_end_like_material_files() {
        let of = |names: &str| file_names(names).join("|");
        assert_eq!(of("a.mtl b.mtl"), "a.mtl|b.mtl");
        assert_eq!(of("my own.mtl B.MTL  c"), "my own.mtl|B.MTL|c");
        assert_eq!(of("\"my own.mtl\" b.mtl"), "my own.mtl|b.mtl");
        assert_eq!(of("room"), "room");
        assert_eq!(of(""), "");
    }
}
