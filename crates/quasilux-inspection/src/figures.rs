//! Figures that cannot be meant: lamps bigger than their room, light that no lamp gives, paint that
//! nobody sells.

use crate::finding::{Check, Findings, MAX_LISTED};
use crate::names;
use quasilux_scene::{Bsdf, Light, Places, Scene};

/// White paint and plaster reflect at most about 0.9, special coatings of integrating spheres more.
const HIGH_REFLECTANCE: f64 = 0.95;
/// What leaves a luminaire is between these shares of what its lamps give.
const OUTPUT_RATIO: [f64; 2] = [0.1, 1.15];
/// No white light has more lumens a watt; files of lamps give 250 at the most.
const MAX_LM_W: f64 = 400.0;
/// Files have 0 or 1 where nobody knows the watts.
const UNKNOWN_W: f64 = 1.0;
/// Nobody makes a lamp this many times brighter than it was measured.
const MAX_DIMMING: f64 = 10.0;

pub(crate) fn check(scene: &Scene, findings: &mut Findings<'_>) {
    lamps(scene, findings);
    dimmings(scene, findings);
    materials(scene, findings);
}

fn lamps(scene: &Scene, findings: &mut Findings<'_>) {
    let room = scene.mesh.bounds().map(|[low, high]| (high - low).max_element());
    let mut seen: Vec<&str> = Vec::new();
    let Places { photometry, .. } = findings.places;
    for (index, light) in scene.lights.iter().enumerate() {
        let (Light::Luminaire(light), Some(file)) = (light, &photometry[index]) else { continue };
        if seen.contains(&file.as_str()) || seen.len() >= MAX_LISTED {
            continue;
        }
        seen.push(file);
        let place = findings.places.lights[index];
        let size_m = light.photometry.facts().shape().size_m().max_element();
        if let Some(room_m) = room.filter(|room_m| size_m > *room_m) {
            let message = format!(
                "\"{file}\" has a luminous opening of {}, and the geometry is {} long",
                names::length(size_m),
                names::length(room_m)
            );
            let cure = "correct the unit of the geometry (units in [scene]) or that of the \
                        luminaire file";
            findings.add(Check::LampTooBig, place, message, cure).at(light.position);
        }
        let (flux_lm, watts) = (light.photometry.flux_lm(), light.photometry.facts().input_watts);
        if watts > UNKNOWN_W && flux_lm > MAX_LM_W * watts {
            let message =
                format!("\"{file}\" has {flux_lm:.0} lm of {watts} W, {:.0} lm/W", flux_lm / watts);
            let cure = "correct its lumens or its watts: 250 lm/W is the most to expect";
            findings.add(Check::LampBright, place, message, cure).at(light.position);
        }
        let Some(lamps_lm) = light.photometry.facts().lamps_flux_lm() else { continue };
        let ratio = light.photometry.flux_lm() / lamps_lm;
        if lamps_lm > 0.0 && !(OUTPUT_RATIO[0]..=OUTPUT_RATIO[1]).contains(&ratio) {
            let message = format!(
                "the intensities of \"{file}\" make {:.0} lm, its lamps {lamps_lm:.0} lm",
                light.photometry.flux_lm()
            );
            let cure = "correct its multiplier or its number of lamps: a luminaire gives most of \
                        the light of its lamps";
            findings.add(Check::LampFlux, place, message, cure).at(light.position);
        }
    }
}

/// Lamps that are dimmed to more than they can give, each by itself.
fn dimmings(scene: &Scene, findings: &mut Findings<'_>) {
    let before = findings.found.len();
    for (index, light) in scene.lights.iter().enumerate() {
        let Light::Luminaire(light) = light else { continue };
        if light.dimming <= MAX_DIMMING || findings.found.len() - before >= MAX_LISTED {
            continue;
        }
        let what = names::light(findings.places, &scene.lights, index);
        let flux_lm = light.photometry.flux_lm();
        let message = format!(
            "dimming {} makes {:.0} lm of the {flux_lm:.0} lm of {what}",
            light.dimming,
            light.dimming * flux_lm
        );
        let cure = "set dimming = 1 for the flux of the file, 0.8 for a fifth less";
        let place = findings.places.lights[index];
        findings.add(Check::LampBright, place, message, cure).at(light.position);
    }
}

fn materials(scene: &Scene, findings: &mut Findings<'_>) {
    let mut is_used = vec![false; scene.materials.len()];
    scene.mesh.material_of.iter().for_each(|&material| is_used[material as usize] = true);
    let used = || (0..scene.materials.len()).filter(|&material| is_used[material]);
    if used().next().is_some() && used().all(|material| !findings.places.is_described[material]) {
        let message = "no file gives the reflectance of any surface: all have the default, 0.5";
        let cure = "give each material, or default, a reflectance in [materials.NAME]";
        let place = findings.places.scene;
        findings.add(Check::DefaultReflectance, place, message.to_owned(), cure);
    }
    let high: Vec<usize> = used().filter(|&m| is_high(&scene.materials[m].bsdf)).collect();
    for material in high.into_iter().take(MAX_LISTED) {
        let entry = &scene.materials[material];
        let message = format!(
            "the material \"{}\" reflects more than {HIGH_REFLECTANCE} of the light",
            entry.name
        );
        let place = findings.places.materials[material].unwrap_or(findings.places.scene);
        let cure = "set a reflectance of paint, at most 0.9";
        findings.add(Check::HighReflectance, place, message, cure);
    }
}

/// Whether a surface of this kind scatters more than it can; mirrors and clear bodies may.
fn is_high(bsdf: &Bsdf) -> bool {
    matches!(bsdf, Bsdf::Diffuse(_) | Bsdf::Translucent(_) | Bsdf::Plastic(_))
        && bsdf.most_kept().luminance() > HIGH_REFLECTANCE
}
