//! Lamps whose light reaches nobody: outside the geometry, behind a surface, in a closed body.
//!
//! That no way of light was found is no proof; a lamp is named where besides it sees the sky, or
//! where a short move through a surface would have it shine on sensors, or where a closed body
//! holds it and no sensor.

use crate::finding::{Check, Findings, MAX_LISTED};
use crate::names;
use crate::probe::sphere_direction;
use crate::survey::{Survey, Vertex, emitted_direction, position_of};
use crate::units::{self, Thing};
use glam::DVec3;
use quasilux_scene::solids::{Solid, solids_of};
use quasilux_scene::{Light, Places, Scene};

/// Directions of the shortest ways out of most places.
const AXES: [DVec3; 6] = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
/// A lamp that hangs behind a surface by mistake is no further from it than this, in m.
const MAX_MOVE_M: f64 = 0.5;
/// Surfaces on the way: those of a slab, and of a ceiling below.
const MAX_SURFACES: usize = 4;

/// A surface this near to a lamp is around it, in m.
const IN_SURFACE_M: f64 = 1e-3;
/// Directions of a lamp that are looked at.
const EMITTED: u32 = 64;
/// Less than this share of light behind a ceiling is taken for the table's own upward light.
const LOST_SHARE: f64 = 0.2;
/// A lamp that is meant to shine on what people look at from inside gives it more than the rest.
const MAX_LOST_SHARE: f64 = 0.5;

/// A way to a place where a lamp would shine on sensors.
struct Move {
    direction: DVec3,
    length_m: f64,
    /// The triangle that is in between.
    triangle: u32,
}

pub(crate) fn check(survey: &Survey<'_>, findings: &mut Findings<'_>) {
    let scene = survey.probe.scene;
    let mut solids: Option<Vec<Solid>> = None;
    let before = findings.found.len();
    for (index, lamp) in scene.lights.iter().enumerate() {
        let Some(position) = position_of(lamp) else { continue };
        if lamp.flux_lm() == 0.0 {
            continue;
        }
        if survey.reaches[index] {
            in_surface(survey, index, position, findings);
            by_a_detour(survey, index, position, findings);
            continue;
        }
        if findings.found.len() - before >= MAX_LISTED {
            break;
        }
        let what = names::light(findings.places, &scene.lights, index);
        let what = format!("{what} at {}", names::position(position));
        let place = findings.places.lights[index];
        let way = shortest_move(survey, lamp, position);
        if survey.is_in_the_open(position) {
            let message = format!(
                "{what} hangs outside the geometry, and none of its light was found to reach a \
                 sensor or camera"
            );
            let cure = cure_outside(scene, findings.places, position, way.as_ref());
            findings.add(Check::LampOutside, place, message, cure).at(position);
        } else if let Some(solid) = around_lamp_alone(survey, &mut solids, position) {
            let object = names::object(&scene.mesh, solid);
            let message = format!(
                "{what} is inside the closed object \"{object}\", and none of its light was found \
                 to reach a sensor or camera"
            );
            let cure = "move it into the room, or give the object an opening or glass";
            findings.add(Check::LampInBody, place, message, cure).at(position);
        } else if let Some(way) = way {
            let object = names::object(&scene.mesh, way.triangle);
            let message = format!(
                "{what} hangs behind \"{object}\", and none of its light was found to reach a \
                 sensor or camera"
            );
            let cure = cure_by_move(&way, scene);
            findings.add(Check::LampBehindSurface, place, message, cure).at(position);
        }
    }
}

/// A lamp whose light arrives, and is in a surface behind which some of it is lost.
fn in_surface(survey: &Survey<'_>, index: usize, at: DVec3, findings: &mut Findings<'_>) {
    let scene = survey.probe.scene;
    if !matches!(scene.lights[index], Light::Luminaire(_)) {
        return;
    }
    let near = |direction: DVec3| {
        let met = survey.probe.first(at - direction * IN_SURFACE_M, direction);
        met.filter(|met| met.distance_m <= 2.0 * IN_SURFACE_M)
    };
    let Some(surface) = AXES.into_iter().find_map(near) else { return };
    let lost = lost_share(survey, &scene.lights[index], at, &survey.eyes);
    if survey.is_open || lost < LOST_SHARE {
        return;
    }
    let object = names::object(&scene.mesh, surface.triangle);
    let what = names::light(findings.places, &scene.lights, index);
    let message = format!(
        "{what} at {} is in \"{object}\", and about {:.0} % of its light starts behind it",
        names::position(at),
        100.0 * lost
    );
    let cure = "move it in front of the surface, or turn it away from it";
    findings.add(Check::LampInSurface, findings.places.lights[index], message, cure).at(at);
}

/// A lamp above the ceiling of a room by day: some of its light comes back through a window, from a
/// house across the street.
fn by_a_detour(survey: &Survey<'_>, index: usize, at: DVec3, findings: &mut Findings<'_>) {
    let scene = survey.probe.scene;
    let lamp = &scene.lights[index];
    if survey.is_open || survey.is_in_a_room(at) || survey.shines(lamp, &survey.receivers) {
        return;
    }
    let lost = lost_share(survey, lamp, at, &survey.receivers);
    let Some(way) = shortest_move(survey, lamp, at).filter(|_| lost > MAX_LOST_SHARE) else {
        return;
    };
    let what = names::light(findings.places, &scene.lights, index);
    let message = format!(
        "{what} at {} hangs outside the geometry, and {:.0} % of its light lands where no sensor \
         or camera sees it",
        names::position(at),
        100.0 * lost
    );
    let cure = cure_by_move(&way, scene);
    findings.add(Check::LampOutside, findings.places.lights[index], message, cure).at(at);
}

/// The share of a lamp's light that lands where none of these see it, or nowhere.
fn lost_share(survey: &Survey<'_>, lamp: &Light, at: DVec3, eyes: &[Vertex]) -> f64 {
    let direction = |i: u32| match lamp {
        Light::Luminaire(light) => emitted_direction(light, i),
        Light::Point(_) | Light::Area(_) => Some(sphere_direction(i, EMITTED)),
    };
    let lost = (0..EMITTED).filter_map(direction).filter(|&direction| {
        let met = survey.probe.first(at, direction);
        met.is_none_or(|met| !survey.meet(&[Vertex::on(&met)], eyes))
    });
    lost.count() as f64 / f64::from(EMITTED)
}

/// The shortest way through a surface, along an axis, square to a surface that is met along one, or
/// where the lamp aims, to a place from which it would shine on a sensor or on what one sees.
fn shortest_move(survey: &Survey<'_>, lamp: &Light, from: DVec3) -> Option<Move> {
    let aim = match lamp {
        Light::Luminaire(light) => Some(light.world_from_luminaire * DVec3::NEG_Z),
        Light::Point(_) | Light::Area(_) => None,
    };
    // Walls may stand askew.
    let square = |axis| survey.probe.first(from, axis).map(|met| -met.normal);
    let directions = AXES.into_iter().chain(AXES.into_iter().filter_map(square)).chain(aim);
    let ways = directions.filter_map(|direction| through(survey, from, direction));
    ways.min_by(|a, b| a.length_m.total_cmp(&b.length_m))
}

/// A way in this direction through a few surfaces, as of a slab.
fn through(survey: &Survey<'_>, from: DVec3, direction: DVec3) -> Option<Move> {
    let step_m = 4.0 * survey.probe.hair_m;
    let mut length_m = 0.0;
    let mut first = None;
    for _ in 0..MAX_SURFACES {
        let met = survey.probe.first(from + direction * length_m, direction)?;
        length_m += met.distance_m + step_m;
        if length_m > MAX_MOVE_M {
            return None;
        }
        let triangle = *first.get_or_insert(met.triangle);
        if survey.would_light(from + direction * length_m) {
            return Some(Move { direction, length_m, triangle });
        }
    }
    None
}

fn cure_outside(scene: &Scene, places: &Places, position: DVec3, way: Option<&Move>) -> String {
    units::cure(scene, places, position, Thing::Lamp).unwrap_or_else(|| match way {
        Some(way) => cure_by_move(way, scene),
        None => "give it a position inside the room, in m".to_owned(),
    })
}

fn cure_by_move(way: &Move, scene: &Scene) -> String {
    let object = names::object(&scene.mesh, way.triangle);
    let length = names::length((way.length_m * 1e3).ceil() / 1e3);
    let direction = names::position(way.direction);
    format!(
        "move it through \"{object}\" by more than {length} along {direction}, where it lights \
         the room"
    )
}

/// A triangle of a closed body around the lamp and around no sensor or camera; nothing where no
/// lamp lights any of these, for then these may be what is in the wrong place.
fn around_lamp_alone(
    survey: &Survey<'_>,
    solids: &mut Option<Vec<Solid>>,
    position: DVec3,
) -> Option<u32> {
    if !survey.reaches.contains(&true) {
        return None;
    }
    let mesh = &survey.probe.scene.mesh;
    let sensors = survey.asked.iter().map(|asked| asked.point.position);
    let eyes: Vec<DVec3> =
        sensors.chain(survey.probe.scene.cameras.iter().map(|camera| camera.position)).collect();
    let holds_lamp_alone = |solid: &&Solid| {
        solid.contains(mesh, position) && !eyes.iter().any(|&eye| solid.contains(mesh, eye))
    };
    let solids = solids.get_or_insert_with(|| solids_of(mesh));
    solids.iter().find(holds_lamp_alone).map(|solid| solid.triangles[0])
}
