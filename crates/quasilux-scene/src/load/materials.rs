//! The material of each name: what the project file says, then what geometry files say.

use super::glazing::GlazingFiles;
use super::measured::{MeasuredFiles, Sources};
use crate::bsdf::Diffuse;
use crate::geometry::{DEFAULT_MATERIAL, FileMaterial, FileScattering, Geometry};
use crate::project::{LightEntry, MaterialEntry, Project, Scattering};
use crate::{Bsdf, LoadError, Material, Rgb, Spanned, Warning};
use std::collections::{HashMap, HashSet};

/// Reflectance of materials that neither the project nor a geometry file defines.
const DEFAULT_REFLECTANCE: f64 = 0.5;

/// The materials of the geometry, in its order.
pub(super) fn resolve(
    project: &Project,
    geometry: &Geometry,
    sources: &mut Sources<'_>,
    warnings: &mut Vec<Warning>,
) -> Result<Vec<Material>, LoadError> {
    expect_used(project, geometry)?;
    let entries: HashMap<&str, &MaterialEntry> =
        project.materials.iter().map(|entry| (entry.name.value.as_str(), entry)).collect();
    let entry_of = |name: &str| entries.get(name).copied();
    let default = entry_of(DEFAULT_MATERIAL);
    let mut triangles = vec![0_u64; geometry.materials.len()];
    geometry.mesh.material_of.iter().for_each(|&material| triangles[material as usize] += 1);
    let mut glazings = GlazingFiles::new(project, sources.files);
    let mut measured = MeasuredFiles::new(project, sources);
    let mut materials = Vec::new();
    for ((number, material), count) in (0..).zip(&geometry.materials).zip(triangles) {
        let mut bsdf_of =
            |entry: &MaterialEntry, warnings: &mut Vec<Warning>| match &entry.scattering {
                Scattering::Described(bsdf) => Ok(bsdf.clone()),
                Scattering::Measured { file, up } => {
                    let sheet = measured.read(file, up.as_ref(), warnings)?;
                    measured.must_lie_across(up.as_ref(), &geometry.mesh, number)?;
                    Ok(Bsdf::Measured(sheet))
                }
                Scattering::Glazing(layers) => Ok(Bsdf::Pane(glazings.pane(layers, warnings)?)),
            };
        let bsdf = match (entry_of(&material.name), material.reflectance) {
            (Some(entry), _) => bsdf_of(entry, warnings)?,
            (None, _) if material.scattering.is_some() => {
                of_file(material, number, geometry, &mut measured, warnings)?
            }
            (None, Some(reflectance)) => {
                if material.is_clear && count > 0 {
                    warnings.push(opaque(material));
                }
                Bsdf::Diffuse(Diffuse { reflectance })
            }
            (None, None) => {
                let bsdf = default.map_or_else(|| Ok(grey()), |entry| bsdf_of(entry, warnings))?;
                if count > 0 {
                    warnings.push(undefined(material, count, &bsdf));
                }
                bsdf
            }
        };
        warn_of_emission(project, material, warnings);
        materials.push(Material { name: material.name.clone(), bsdf });
    }
    Ok(materials)
}

/// Scattering that a geometry file describes as a whole.
fn of_file(
    material: &FileMaterial,
    number: u32,
    geometry: &Geometry,
    measured: &mut MeasuredFiles<'_>,
    warnings: &mut Vec<Warning>,
) -> Result<Bsdf, LoadError> {
    match &material.scattering {
        None => Ok(grey()),
        Some(FileScattering::Described(bsdf)) => Ok((**bsdf).clone()),
        Some(FileScattering::Unknown(refusal)) => {
            let place = refusal.place.as_ref();
            let file = place.map_or(material.file.as_str(), |(file, _)| &**file);
            Err(LoadError::new(file, place.map(|(_, at)| *at), &refusal.message))
        }
        Some(FileScattering::Sheet { name, xml, up }) => {
            let name = format!("{}#{name}", material.file);
            let sheet = measured.read_text(&name, xml, *up, warnings)?;
            let up = Spanned { value: *up, place: measured.scene_place() };
            measured.must_lie_across(Some(&up), &geometry.mesh, number)?;
            Ok(Bsdf::Measured(sheet))
        }
    }
}

/// Refuses materials that no geometry uses.
fn expect_used(project: &Project, geometry: &Geometry) -> Result<(), LoadError> {
    let names = || geometry.materials.iter().map(|material| material.name.as_str());
    let known: HashSet<&str> = names().collect();
    for entry in &project.materials {
        let name = &entry.name;
        if name.value != DEFAULT_MATERIAL && !known.contains(name.value.as_str()) {
            let message = format!(
                "no geometry uses the material \"{}\"; expected one of {}",
                name.value,
                listed(names())
            );
            return Err(project.error(name.place, message).offer(&name.value, names()));
        }
    }
    Ok(())
}

/// Names for a message, a few at most.
pub(super) fn listed<'a>(names: impl Iterator<Item = &'a str>) -> String {
    const MAX: usize = 12;
    let names: Vec<&str> = names.collect();
    let more = if names.len() > MAX { ", ..." } else { "" };
    format!("{}{more}", names[..names.len().min(MAX)].join(", "))
}

fn grey() -> Bsdf {
    Bsdf::Diffuse(Diffuse { reflectance: Rgb::grey(DEFAULT_REFLECTANCE) })
}

fn undefined(material: &FileMaterial, count: u64, bsdf: &Bsdf) -> Warning {
    let used = match bsdf.reflectance() {
        Some(reflectance) => format!("reflectance {} is used", reflectance.luminance()),
        None => format!("the default {} is used", bsdf.kind()),
    };
    let message = if material.name == DEFAULT_MATERIAL {
        format!("{count} triangles have no material: {used}")
    } else {
        format!("the material \"{}\" of {count} triangles is not defined: {used}", material.name)
    };
    Warning::new(&material.file, None, message)
}

/// Transparency in a geometry file says nothing of a pane: the project file must describe it.
fn opaque(material: &FileMaterial) -> Warning {
    let name = &material.name;
    let message = format!(
        "the material \"{name}\" lets light through by its file, and is opaque here; add \
         [materials.\"{name}\"] with kind = \"pane\" and its transmittance, or another kind"
    );
    Warning::new(&material.file, None, message)
}

/// Emission in a geometry file has no photometric unit: the project file must give it.
fn warn_of_emission(project: &Project, material: &FileMaterial, warnings: &mut Vec<Warning>) {
    let declared = project.lights.iter().any(|light| {
        matches!(light, LightEntry::Area { material: name, .. } if name.value == material.name)
    });
    if material.emits && !declared {
        let message = format!(
            "the material \"{}\" emits in the geometry file, but no [[lights]] of kind \"area\" \
             names it: dark",
            material.name
        );
        warnings.push(Warning::new(&material.file, None, message));
    }
}
