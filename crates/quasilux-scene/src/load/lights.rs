//! The lights of a project: luminaires placed, emitting triangles collected.
//!
//! All of them are dimmed by the maintenance factor (CIE 97:2005: what an installation gives in use
//! over what it gives when new), so that every figure of a run is a maintained one.

use super::materials::listed;
use super::photometry::{self, Told};
use crate::geometry::Geometry;
use crate::light::{AreaLight, Luminaire, PointLight};
use crate::project::{Emission, LightEntry, LightOutput, LuminaireEntry, Project};
use crate::{Files, Light, LoadError, Spanned, Warning};
use glam::{DMat3, DVec3};
use quasilux_photometry::{GldfChoice, LuminousShape, Photometry, TiltFactor, TiltSupport};
use quasilux_text::Position;
use std::collections::HashMap;
use std::collections::hash_map::Entry as MapEntry;
use std::f64::consts::PI;
use std::sync::Arc;

/// All lights: luminaires first, in the order of the project file.
pub(super) fn place(
    project: &Project,
    geometry: &Geometry,
    files: &dyn Files,
    told: &mut Told,
) -> Result<Vec<Light>, LoadError> {
    let mut known: HashMap<LuminaireKey<'_>, Shared> = HashMap::new();
    let mut lights = Vec::new();
    for entry in &project.luminaires {
        let shared = match known.entry(LuminaireKey::new(entry)) {
            MapEntry::Occupied(known) => known.get().clone(),
            MapEntry::Vacant(unknown) => {
                let read = photometry::read(project, entry, files, told)?;
                let luminaire_from_photometry = read.luminaire_from_photometry;
                let photometry = Arc::new(read.photometry);
                unknown.insert(Shared { photometry, luminaire_from_photometry }).clone()
            }
        };
        lights.push(Light::Luminaire(luminaire(project, entry, shared, &mut told.warnings)?));
    }
    let mut emitting: HashMap<u32, Position> = HashMap::new();
    for entry in &project.lights {
        lights.push(match entry {
            LightEntry::Point { light, .. } => Light::Point(PointLight {
                intensity_cd: project.maintenance_factor * light.intensity_cd,
                ..*light
            }),
            LightEntry::Area { material, emission } => {
                let light = area_light(project, geometry, material, *emission)?;
                if let Some(first) = emitting.insert(light.material, material.place) {
                    let message = format!(
                        "the material \"{}\" already emits by line {}; give it one light",
                        material.value, first.line
                    );
                    return Err(project.error(material.place, message));
                }
                Light::Area(light)
            }
        });
    }
    let is_dark = |lights: &[Light]| !lights.iter().any(|light| light.flux_lm() > 0.0);
    if project.outside.is_none() && is_dark(&lights) {
        let first_luminaire = project.luminaires.iter().map(|entry| entry.place);
        let first_light = project.lights.iter().map(LightEntry::place);
        let place =
            first_luminaire.chain(first_light).min().unwrap_or(Position { line: 1, column: 1 });
        let message = "no light gives any flux; give at least one light a positive flux";
        return Err(project.error(place, message));
    }
    Ok(lights)
}

/// A luminaire of a file that several entries ask for.
#[derive(PartialEq, Eq, Hash)]
struct LuminaireKey<'a> {
    file: &'a str,
    choice: &'a GldfChoice,
    length_bits: Option<u64>,
}

impl<'a> LuminaireKey<'a> {
    fn new(entry: &'a LuminaireEntry) -> Self {
        Self {
            file: &entry.photometry.value,
            choice: &entry.choice,
            length_bits: entry.length_m.as_ref().map(|length_m| length_m.value.to_bits()),
        }
    }
}

/// A luminaire that was read.
#[derive(Clone)]
struct Shared {
    photometry: Arc<Photometry>,
    /// From the frame of the photometry to that of the luminaire.
    luminaire_from_photometry: DMat3,
}

/// Places a luminaire; maintenance, and a lamp that feels the tilt, dim it.
fn luminaire(
    project: &Project,
    entry: &LuminaireEntry,
    shared: Shared,
    warnings: &mut Vec<Warning>,
) -> Result<Luminaire, LoadError> {
    let Shared { photometry, luminaire_from_photometry } = shared;
    let turn = luminaire_from_photometry;
    // Not a product with the identity, which would lose the signs of zeros.
    let world_from_luminaire = if turn == DMat3::IDENTITY {
        entry.world_from_luminaire
    } else {
        entry.world_from_luminaire * turn
    };
    let down = world_from_luminaire.transpose() * DVec3::NEG_Z;
    let tilt_factor = tilt_factor(project, entry, photometry.tilt_factor(down), warnings);
    let dimming = dimming(project, entry, &photometry)?;
    Ok(Luminaire {
        position: entry.position,
        world_from_luminaire,
        dimming: dimming * tilt_factor * project.maintenance_factor,
        shape: shape(project, entry, &photometry, warnings),
        photometry,
    })
}

/// Factor on the light of the file that the project asks for.
fn dimming(
    project: &Project,
    entry: &LuminaireEntry,
    photometry: &Photometry,
) -> Result<f64, LoadError> {
    match entry.amount {
        LightOutput::Dimming(factor) => Ok(factor),
        LightOutput::FluxLm(0.0, _) => Ok(0.0),
        LightOutput::FluxLm(flux_lm, place) => {
            let of_file_lm = photometry.flux_lm();
            if of_file_lm > 0.0 {
                return Ok(flux_lm / of_file_lm);
            }
            let message = format!(
                "\"{}\" gives no light in any direction, and no factor makes it {flux_lm} lm",
                entry.photometry.value
            );
            Err(project.error(place, message))
        }
    }
}

/// Factor on the light of the lamps at the luminaire's tilt.
fn tilt_factor(
    project: &Project,
    entry: &LuminaireEntry,
    tilt: TiltFactor,
    warnings: &mut Vec<Warning>,
) -> f64 {
    let degrees = tilt.angle_rad.to_degrees();
    let odd = match tilt.support {
        // Factors that have not been read are warned of once, at their file.
        TiltSupport::Listed | TiltSupport::NotRead => None,
        TiltSupport::EndHeld => {
            Some(format!("a tilt of {degrees:.1} degrees is outside the file's tilt angles"))
        }
        TiltSupport::OtherAxis => Some(
            "the lamp lies, and the file has tilt factors for a turn about the C0-C180 axis only"
                .to_owned(),
        ),
    };
    if let Some(odd) = odd {
        let message = format!("{odd}; the factor {} is taken", tilt.factor);
        warnings.push(Warning::new(&project.file, Some(entry.place), message));
    }
    tilt.factor
}

/// Luminous shape of the luminaire: a point, unless the project asks for the file's own shape.
fn shape(
    project: &Project,
    entry: &LuminaireEntry,
    photometry: &Photometry,
    warnings: &mut Vec<Warning>,
) -> LuminousShape {
    let Some(place) = entry.as_area else {
        return LuminousShape::POINT;
    };
    let shape = photometry.facts().shape();
    if shape.is_point() {
        let message = format!(
            "\"as\" is \"area\", but the luminous opening of \"{}\" is a point: it stays a point",
            entry.photometry.value
        );
        warnings.push(Warning::new(&project.file, Some(place), message));
    }
    shape
}

fn area_light(
    project: &Project,
    geometry: &Geometry,
    name: &Spanned<String>,
    emission: Emission,
) -> Result<AreaLight, LoadError> {
    let mesh = &geometry.mesh;
    let index = geometry.materials.iter().position(|material| material.name == name.value);
    let triangles: Vec<u32> = (0..mesh.triangles.len() as u32)
        .filter(|&t| Some(mesh.material_of[t as usize] as usize) == index)
        .collect();
    let (Some(material), false) = (index, triangles.is_empty()) else {
        let mut is_used = vec![false; geometry.materials.len()];
        mesh.material_of.iter().for_each(|&material| is_used[material as usize] = true);
        let used = || geometry.materials.iter().zip(&is_used).filter(|(_, is_used)| **is_used);
        let names = || used().map(|(material, _)| material.name.as_str());
        let message = format!(
            "no triangle has the material \"{}\"; expected one of {}",
            name.value,
            listed(names())
        );
        return Err(project.error(name.place, message).offer(&name.value, names()));
    };
    let area_m2: f64 = triangles.iter().map(|&t| mesh.area_m2(t)).sum();
    let new_cd_m2 = match emission {
        Emission::LuminanceCdM2(luminance_cd_m2) => luminance_cd_m2,
        Emission::FluxLm(flux_lm) => flux_lm / (PI * area_m2),
    };
    let luminance_cd_m2 = project.maintenance_factor * new_cd_m2;
    Ok(AreaLight { material: material as u32, triangles, area_m2, luminance_cd_m2 })
}
