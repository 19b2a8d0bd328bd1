//! The lights of a project: luminaire files read, emitting triangles collected.

use super::materials::listed;
use crate::geometry::{self, Geometry};
use crate::light::{AreaLight, Luminaire};
use crate::project::{Emission, LightEntry, LuminaireEntry, Project};
use crate::{Files, Light, LoadError, Place, Placed, Warning};
use quasilux_photometry::{Photometry, read_ies, read_ldt, read_tm33};
use std::collections::HashMap;
use std::f64::consts::PI;
use std::sync::Arc;

/// All lights: luminaires first, in the order of the project file.
pub(super) fn place(
    project: &Project,
    geometry: &Geometry,
    files: &dyn Files,
    warnings: &mut Vec<Warning>,
) -> Result<Vec<Light>, LoadError> {
    let mut read: HashMap<&str, Arc<Photometry>> = HashMap::new();
    let mut lights = Vec::new();
    for entry in &project.luminaires {
        let name = entry.photometry.value.as_str();
        let photometry = match read.get(name) {
            Some(known) => Arc::clone(known),
            None => {
                let photometry = Arc::new(photometry(project, &entry.photometry, files, warnings)?);
                read.insert(name, Arc::clone(&photometry));
                photometry
            }
        };
        lights.push(Light::Luminaire(luminaire(entry, photometry)));
    }
    let mut emitting: HashMap<u32, Place> = HashMap::new();
    for entry in &project.lights {
        lights.push(match entry {
            LightEntry::Point { light, .. } => Light::Point(*light),
            LightEntry::Area { material, emission } => {
                let light = area_light(project, geometry, material, *emission)?;
                if let Some(first) = emitting.insert(light.material, material.place) {
                    let message = format!(
                        "the material \"{}\" already emits by line {}; expected one light for it",
                        material.value, first.line
                    );
                    return Err(project.error(material.place, message));
                }
                Light::Area(light)
            }
        });
    }
    if !lights.iter().any(|light| light.flux_lm() > 0.0) {
        let first_luminaire = project.luminaires.iter().map(|entry| entry.place);
        let first_light = project.lights.iter().map(LightEntry::place);
        let place =
            first_luminaire.chain(first_light).min().unwrap_or(Place { line: 1, column: 1 });
        let message = "no light gives any flux; expected at least one light with a positive flux";
        return Err(project.error(place, message));
    }
    Ok(lights)
}

fn luminaire(entry: &LuminaireEntry, photometry: Arc<Photometry>) -> Luminaire {
    Luminaire {
        photometry,
        position: entry.position,
        world_from_luminaire: entry.world_from_luminaire,
        dimming: entry.dimming,
    }
}

/// Reads an IES, EULUMDAT or TM-33 file, as its extension says, passing its warnings on.
fn photometry(
    project: &Project,
    name: &Placed<String>,
    files: &dyn Files,
    warnings: &mut Vec<Warning>,
) -> Result<Photometry, LoadError> {
    let bytes = geometry::read_file(project, name, files)?;
    let file = name.value.as_str();
    let extension = file.rsplit_once('.').map(|(_, end)| end.to_ascii_lowercase());
    let read = match extension.as_deref() {
        Some("ldt") => read_ldt(&bytes),
        Some("xml") => read_tm33(&bytes),
        _ => read_ies(&bytes),
    };
    let read = read.map_err(|error| {
        let place = Place { line: error.line(), column: error.column() };
        LoadError::new(file, Some(place), without_place(&error.to_string(), place))
    })?;
    warnings.extend(read.warnings.iter().map(|warning| {
        let place = Place { line: warning.line(), column: warning.column() };
        Warning::new(file, Some(place), without_place(&warning.to_string(), place))
    }));
    Ok(read.photometry)
}

/// The message without the `line:column: ` that it starts with.
fn without_place(message: &str, place: Place) -> String {
    let prefix = format!("{}:{}: ", place.line, place.column);
    message.strip_prefix(&prefix).unwrap_or(message).to_owned()
}

fn area_light(
    project: &Project,
    geometry: &Geometry,
    name: &Placed<String>,
    emission: Emission,
) -> Result<AreaLight, LoadError> {
    let mesh = &geometry.mesh;
    let index = geometry.materials.iter().position(|material| material.name == name.value);
    let triangles: Vec<u32> = (0..mesh.triangles.len() as u32)
        .filter(|&t| Some(mesh.material_of[t as usize] as usize) == index)
        .collect();
    let (Some(material), false) = (index, triangles.is_empty()) else {
        let names = || geometry.materials.iter().map(|material| material.name.as_str());
        let message = format!(
            "no triangle has the material \"{}\"; expected one of {}",
            name.value,
            listed(names())
        );
        return Err(project.error(name.place, message).offer(&name.value, names()));
    };
    let area_m2: f64 = triangles.iter().map(|&t| mesh.area_m2(t)).sum();
    let luminance_cd_m2 = match emission {
        Emission::LuminanceCdM2(luminance_cd_m2) => luminance_cd_m2,
        Emission::FluxLm(flux_lm) => flux_lm / (PI * area_m2),
    };
    Ok(AreaLight { material: material as u32, triangles, area_m2, luminance_cd_m2 })
}
