//! Emitting faces that look at nothing: their front is turned away from the room.

use crate::finding::{Check, Findings};
use crate::names;
use crate::probe::{Probe, cosine_direction, square};
use crate::survey::{Survey, Vertex};
use glam::DVec3;
use quasilux_scene::Light;
use quasilux_scene::light::AreaLight;

/// Faces of a light that are looked at.
const MAX_FACES: usize = 256;
/// Directions from a face.
const DIRECTIONS: u32 = 16;
/// Light that lands nearer than this share of the face's own size is lost behind it.
const NEAR: f64 = 0.2;
/// Of a face that looks away, light is lost in at least this share of directions.
const LOST: f64 = 0.6;

pub(crate) fn check(survey: &Survey<'_>, findings: &mut Findings<'_>) {
    let scene = survey.probe.scene;
    for (index, light) in scene.lights.iter().enumerate() {
        let Light::Area(area) = light else { continue };
        let stride = area.triangles.len().div_ceil(MAX_FACES).max(1);
        let faces: Vec<u32> = area.triangles.iter().copied().step_by(stride).collect();
        let looks_away = |&&face: &&u32| looks_away(survey, area, face);
        let away: Vec<u32> = faces.iter().filter(looks_away).copied().collect();
        let Some(&first) = away.first() else { continue };
        let material = &scene.materials[area.material as usize].name;
        let count = if away.len() == faces.len() {
            "the faces".to_owned()
        } else {
            format!("{} of {} faces", away.len(), faces.len())
        };
        let centroid = scene.mesh.corners(first).into_iter().sum::<DVec3>() / 3.0;
        let message = format!(
            "{count} of the light \"{material}\" shine away from the room, for example at {}",
            names::position(centroid)
        );
        let cure = "turn them over: light leaves the front of a face, where its corners are \
                    counter-clockwise";
        let place = findings.places.lights[index];
        findings.add(Check::EmitterLooksAway, place, message, cure).at(centroid);
    }
}

/// Whether the back of a face sees sensors or what a camera sees, and its front shines at nothing.
fn looks_away(survey: &Survey<'_>, light: &AreaLight, face: u32) -> bool {
    let probe = survey.probe;
    let mesh = &probe.scene.mesh;
    let position = mesh.corners(face).into_iter().sum::<DVec3>() / 3.0;
    let normal = mesh.front_normal(face);
    let side = |normal: DVec3| Vertex::facing(position + normal * probe.hair_m, normal);
    !survey.meet(&[side(normal)], &survey.receivers)
        && survey.meet(&[side(-normal)], &survey.receivers)
        && !has_twin(survey, light, face, &side(normal))
        && lost_share(probe, light, &side(normal), mesh.area_m2(face)) >= LOST
}

/// The share of a face's light that meets nothing, or something near that is no part of the lamp.
fn lost_share(probe: &Probe<'_>, light: &AreaLight, front: &Vertex, area_m2: f64) -> f64 {
    let near_m = NEAR * (2.0 * area_m2).sqrt();
    let normal = front.normal.unwrap_or(DVec3::Z);
    let is_lost = |&i: &u32| {
        let met = probe.first(front.position, cosine_direction(normal, square(i)));
        met.is_none_or(|met| {
            met.distance_m < near_m && light.triangles.binary_search(&met.triangle).is_err()
        })
    };
    (0..DIRECTIONS).filter(is_lost).count() as f64 / f64::from(DIRECTIONS)
}

/// Whether another face of the light is at the same place: a panel that shines to both sides is
/// drawn so.
fn has_twin(survey: &Survey<'_>, light: &AreaLight, face: u32, front: &Vertex) -> bool {
    let normal = front.normal.unwrap_or(DVec3::Z);
    let from = front.position + normal * (10.0 * survey.probe.hair_m);
    let Some(met) = survey.probe.first(from, -normal) else { return false };
    let twin = survey.probe.twin(from, -normal, &met);
    let is_other =
        |triangle: &u32| *triangle != face && light.triangles.binary_search(triangle).is_ok();
    std::iter::once(met.triangle).chain(twin).any(|triangle| is_other(&triangle))
}
