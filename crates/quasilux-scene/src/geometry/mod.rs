//! Geometry: OBJ and glTF files, Honeybee models, Radiance scenes and arrays to one mesh with
//! shared vertices.
//!
//! Each reader hands its triangles to one [`MeshBuilder`], which turns them up, merges vertices at
//! exactly the same position, and counts the degenerate triangles that it drops.

mod arrays;
mod builder;
mod copies;
mod corner_grid;
mod cut;
mod data_uri;
mod elsewhere;
mod gltf;
mod gltf_accessor;
mod gltf_buffers;
mod gltf_elements;
mod gltf_primitive;
mod gltf_sparse;
mod honeybee;
mod material_looks;
mod mtl;
mod obj;
mod obj_lines;
mod polygon;
mod radiance;
mod seams;

pub(crate) use crate::files::reason;
use crate::project::{Project, UpAxis};
use crate::radiance::Unusable;
use crate::{Bsdf, FileKind, Files, LoadError, Mesh, Rgb, Spanned, Warning, files as reading};
use builder::MeshBuilder;
pub use elsewhere::ifc_advice;
use glam::DVec3;
pub(crate) use honeybee::look_over;
pub(crate) use radiance::look_over_radiance;
use std::sync::Arc;

/// The name that triangles without a material get.
pub(crate) const DEFAULT_MATERIAL: &str = "default";

/// The geometry of all files of a project.
#[derive(Debug, Default)]
pub(crate) struct Geometry {
    pub(crate) mesh: Mesh,
    /// The materials that `Mesh::material_of` refers to.
    pub(crate) materials: Vec<FileMaterial>,
}

/// Material as geometry files describe it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct FileMaterial {
    pub(crate) name: String,
    /// Diffuse reflectance; `None` where no file defines the material.
    pub(crate) reflectance: Option<Rgb>,
    /// Whether a file says that it emits light.
    pub(crate) emits: bool,
    /// Whether a file says that light passes through it.
    pub(crate) is_clear: bool,
    /// How it scatters, where a file says more than a reflectance.
    pub(crate) scattering: Option<FileScattering>,
    /// The first file that uses it.
    pub(crate) file: String,
}

impl FileMaterial {
    /// Whether a file says how it scatters.
    pub(crate) fn is_described(&self) -> bool {
        self.reflectance.is_some() || self.scattering.is_some()
    }
}

/// Scattering of a material, as a geometry file describes it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum FileScattering {
    Described(Arc<Bsdf>),
    /// By the tables of an XML text, whose `y` axis points along `up`.
    Sheet {
        /// A name among the sheets of the file.
        name: Arc<str>,
        xml: Arc<str>,
        up: DVec3,
    },
    /// Something that there is nothing for, in the words of a refusal.
    Unknown(Unusable),
}

/// Format of a geometry file: a closed set, a module for each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum GeometryFormat {
    Obj,
    Gltf,
    Honeybee,
    Radiance,
}

impl GeometryFormat {
    /// The format that a file's name ends with; `None` for no geometry file.
    fn of_name(name: &str) -> Option<Self> {
        let (_, extension) = name.rsplit_once('.')?;
        match extension.to_ascii_lowercase().as_str() {
            "obj" => Some(Self::Obj),
            "gltf" | "glb" => Some(Self::Gltf),
            "hbjson" => Some(Self::Honeybee),
            "rad" | "mat" => Some(Self::Radiance),
            _ => None,
        }
    }

    const fn kind(self) -> FileKind {
        match self {
            Self::Obj | Self::Gltf => FileKind::Geometry,
            Self::Honeybee => FileKind::Model,
            Self::Radiance => FileKind::Radiance,
        }
    }
}

/// Reads all geometry files of a project.
pub(crate) fn read(
    project: &Project,
    files: &dyn Files,
    warnings: &mut Vec<Warning>,
) -> Result<Geometry, LoadError> {
    let mut builder = MeshBuilder::new(project.up.unwrap_or(UpAxis::Z), project.unit.metres());
    for file in &project.geometry {
        if let Some(triangles) = files.triangles(&file.value) {
            builder.start_file(&file.value);
            arrays::read(&triangles, &mut builder)?;
            builder.finish_file(warnings)?;
            continue;
        }
        let format = GeometryFormat::of_name(&file.value).ok_or_else(|| {
            let other = "no geometry file; expected a name that ends in .obj, .gltf, .glb, \
                         .hbjson, .rad or .mat";
            let what = ifc_advice(&file.value).unwrap_or_else(|| other.to_owned());
            project.error(file.place, format!("\"{}\" is {what}", file.value))
        })?;
        if format == GeometryFormat::Radiance {
            read_scene(project, file, files, &mut builder, warnings)?;
            continue;
        }
        let bytes = read_file(project, file, files, format.kind())?;
        quasilux_text::refuse_web_page(&bytes).map_err(|error| {
            LoadError::new(&file.value, Some(error.position()), error.message())
        })?;
        builder.start_file(&file.value);
        match format {
            GeometryFormat::Obj => obj::read(&bytes, files, &mut builder, warnings)?,
            GeometryFormat::Gltf => {
                if project.up.is_none() {
                    let message = "glTF has y up, but is read with z up; set up = \"y\" in [scene]";
                    warnings.push(Warning::new(&file.value, None, message));
                }
                gltf::read(&bytes, files, &mut builder, warnings)?;
            }
            GeometryFormat::Honeybee => honeybee::read(&bytes, project, &mut builder, warnings)?,
            GeometryFormat::Radiance => {}
        }
        builder.finish_file(warnings)?;
    }
    let dropped = copies::drop_copies(&mut builder.geometry.mesh);
    if dropped > 0 {
        let message = format!(
            "{dropped} triangles have the corners and the material of {} others: dropped",
            copies::MAX_COPIES
        );
        warnings.push(Warning::new(&project.file, None, message));
    }
    Ok(builder.geometry)
}

/// Reads the files of a Radiance scene, which are all of a project, at the first of them.
fn read_scene(
    project: &Project,
    file: &Spanned<String>,
    files: &dyn Files,
    builder: &mut MeshBuilder,
    warnings: &mut Vec<Warning>,
) -> Result<(), LoadError> {
    let kind = GeometryFormat::Radiance;
    let is_scene = |it: &&Spanned<String>| GeometryFormat::of_name(&it.value) == Some(kind);
    let scene: Vec<&Spanned<String>> = project.geometry.iter().filter(is_scene).collect();
    if scene[0].value != file.value {
        return Ok(());
    }
    for file in &scene {
        read_file(project, file, files, kind.kind())?;
    }
    let names: Vec<&str> = scene.iter().map(|it| it.value.as_str()).collect();
    builder.start_file(names[0]);
    radiance::read(&names, project, files, builder, warnings)?;
    builder.finish_file(warnings)
}

/// Reads a file that the project file names.
pub(crate) fn read_file(
    project: &Project,
    name: &Spanned<String>,
    files: &dyn Files,
    kind: FileKind,
) -> Result<Vec<u8>, LoadError> {
    reading::read(files, &name.value, kind).map_err(|error| {
        let reason = reason(&error);
        project.error(
            name.place,
            format!("cannot read \"{}\": {reason}; expected a readable file", name.value),
        )
    })
}

/// The path of a file that `of` names relative to itself.
pub(crate) fn beside(of: &str, name: &str) -> String {
    let name = name.replace('\\', "/");
    match of.rsplit_once('/') {
        Some((folder, _)) if !name.starts_with('/') => format!("{folder}/{name}"),
        _ => name,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_beside_a_file() {
        assert_eq!(beside("room.obj", "room.mtl"), "room.mtl");
        assert_eq!(beside("geo/room.obj", "maps\\room.mtl"), "geo/maps/room.mtl");
        assert_eq!(beside("geo/room.obj", "/room.mtl"), "/room.mtl");
    }
}
