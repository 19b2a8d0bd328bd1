//! Lamps that are listed twice at one place.

use crate::finding::{Check, Findings, MAX_LISTED};
use crate::names;
use crate::survey::position_of;
use glam::DVec3;
use quasilux_scene::{Light, Scene};

/// Lamps nearer to each other than this, in m, are at one place.
const APART_M: f64 = 1e-3;

pub(crate) fn check(scene: &Scene, findings: &mut Findings<'_>) {
    let mut lamps: Vec<Lamp> = Vec::new();
    for (index, light) in scene.lights.iter().enumerate() {
        lamps.extend(position_of(light).map(|position| Lamp { index, position }));
    }
    lamps.sort_by(|a, b| a.position.x.total_cmp(&b.position.x).then(a.index.cmp(&b.index)));
    let mut pairs: Vec<[usize; 2]> = Vec::new();
    for (i, lamp) in lamps.iter().enumerate() {
        let near = lamps[i + 1..]
            .iter()
            .take_while(|other| other.position.x - lamp.position.x <= APART_M)
            .take(64)
            .filter(|other| other.position.distance(lamp.position) <= APART_M)
            .find(|other| are_alike(&scene.lights[lamp.index], &scene.lights[other.index]));
        pairs.extend(near.map(|other| [lamp.index.min(other.index), lamp.index.max(other.index)]));
    }
    pairs.sort_unstable();
    for &[first, second] in pairs.iter().take(MAX_LISTED) {
        let name = |index| names::light(findings.places, &scene.lights, index);
        let position = position_of(&scene.lights[second]).unwrap_or_default();
        let message = format!(
            "{} and {} coincide at {}, with the same aim",
            name(second),
            name(first),
            names::position(position)
        );
        let place = findings.places.lights[second];
        let cure = "delete one of them, or move it";
        findings.add(Check::LampTwice, place, message, cure).at(position);
    }
}

struct Lamp {
    index: usize,
    position: DVec3,
}

/// Whether two lamps at one place do the same: the same file with the same turn, or two points.
fn are_alike(a: &Light, b: &Light) -> bool {
    match (a, b) {
        (Light::Luminaire(a), Light::Luminaire(b)) => {
            let turned = a.world_from_luminaire - b.world_from_luminaire;
            std::sync::Arc::ptr_eq(&a.photometry, &b.photometry)
                && turned.to_cols_array().iter().all(|entry| entry.abs() < 1e-6)
        }
        (Light::Point(_), Light::Point(_)) => true,
        _ => false,
    }
}
