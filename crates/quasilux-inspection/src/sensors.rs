//! Sensor points without light, outside the geometry or right behind a surface.

use crate::finding::{Check, Findings};
use crate::names;
use crate::probe::{cosine_direction, square};
use crate::survey::{Asked, Survey, Vertex};
use crate::units::{self, Thing};
use glam::DVec3;
use quasilux_scene::{Sensor, SensorPoint};

/// A surface this near before a sensor point covers it, in m: a workplane is not put right below a
/// table top, which is no thicker.
const COVERED_M: f64 = 0.03;

/// Nor is most of the light that comes to it allowed to start nearer than this, in m.
const NEAR_M: f64 = 0.1;
/// Directions that are looked into, and how many of them meet something near.
const DIRECTIONS: u32 = 16;
const NEAR_DIRECTIONS: usize = 14;

/// Points of all sensors of which the surface before them is looked for: a table is before so few
/// of a large grid that a survey of hundreds misses it, as 3 of 64 did in rooms at random.
const MAX_POINTS: usize = 1 << 16;

/// What is odd about the points of one sensor.
#[derive(Default)]
struct Odd {
    tried: usize,
    outside: Vec<DVec3>,
    /// Outside and under the sky, where light of lamps comes.
    lit_outside: Vec<DVec3>,
    /// How many of these are under the sky, on a roof or a square.
    under_the_sky: usize,
    /// Whether others are in a room.
    is_in_a_room: bool,
}

/// Points of one sensor right behind a surface.
struct Covered {
    tried: usize,
    count: usize,
    first: DVec3,
    /// Before the first one.
    triangle: u32,
}

pub(crate) fn check(survey: &Survey<'_>, findings: &mut Findings<'_>) {
    let scene = survey.probe.scene;
    let mut odd: Vec<Odd> = scene.sensors.iter().map(|_| Odd::default()).collect();
    for (asked, is_lit) in survey.asked.iter().zip(&survey.is_lit) {
        let odd = &mut odd[asked.sensor];
        odd.tried += 1;
        if covering(survey, &asked.point).is_some() {
            continue;
        }
        let eye = Vertex::facing(survey.before(&asked.point), asked.point.normal);
        let position = asked.point.position;
        match is_outside(survey, asked) {
            true if !is_lit => {
                odd.outside.push(position);
                odd.under_the_sky += usize::from(survey.sees_the_sky(&eye));
            }
            true if survey.sees_the_sky(&eye) => odd.lit_outside.push(position),
            _ => odd.is_in_a_room |= survey.is_in_a_room(eye.position),
        }
    }
    // Lamps light what is before a window, and of 75 grids at random through its wall 23 were not
    // told for that. Of a sensor in the room it is outside all the same.
    for odd in odd.iter_mut().filter(|odd| odd.is_in_a_room) {
        odd.under_the_sky += odd.lit_outside.len();
        odd.outside.append(&mut odd.lit_outside);
    }
    for (number, odd) in odd.iter().enumerate() {
        report(survey, number, odd, findings);
        report_covered(survey, number, findings);
    }
}

/// Whether a dark point is dark because it is not in the room.
fn is_outside(survey: &Survey<'_>, asked: &Asked) -> bool {
    let position = asked.point.position;
    let [low, high] = survey.probe.scene.mesh.bounds().unwrap_or_default();
    let margin = DVec3::splat(0.01 * survey.probe.size_m);
    let is_beyond = position.cmplt(low - margin).any() || position.cmpgt(high + margin).any();
    is_beyond || (!survey.is_open && survey.is_in_the_open(survey.before(&asked.point)))
}

/// The triangle right in front of a point, from which nearly all of its light would come.
fn covering(survey: &Survey<'_>, point: &SensorPoint) -> Option<u32> {
    let (probe, eye) = (survey.probe, survey.before(point));
    let ahead = probe.first(eye, point.normal).filter(|ahead| ahead.distance_m <= COVERED_M)?;
    let is_near = |&i: &u32| {
        let met = probe.first(eye, cosine_direction(point.normal, square(i)));
        met.is_some_and(|met| met.distance_m <= NEAR_M)
    };
    let near = (0..DIRECTIONS).filter(is_near).count();
    (near >= NEAR_DIRECTIONS).then_some(ahead.triangle)
}

fn report(survey: &Survey<'_>, number: usize, odd: &Odd, findings: &mut Findings<'_>) {
    let scene = survey.probe.scene;
    let sensor = &scene.sensors[number];
    let place = findings.places.sensors[number];
    let is_under_the_sky = odd.under_the_sky == odd.outside.len();
    // A roof, a square or a terrace is where people want to know it.
    let is_meant = is_under_the_sky && !odd.is_in_a_room;
    if let Some(&first) = odd.outside.first().filter(|_| !is_meant) {
        let place_of = match is_under_the_sky {
            true => "outside the room, under the sky",
            false => "outside the geometry, where no light was found",
        };
        let message = format!(
            "{} {place_of}, for example at {}",
            share(sensor, odd.outside.len(), odd.tried),
            names::position(first)
        );
        let cure = units::cure(scene, findings.places, first, Thing::Other).unwrap_or_else(|| {
            match odd.outside.len() < odd.tried {
                true => "keep its points within the walls".to_owned(),
                false => "move it into the room, in m, its normal toward the room".to_owned(),
            }
        });
        findings.add(Check::SensorOutside, place, message, cure).at(first);
    }
}

/// How many points of a sensor, of those that were tried.
fn share(sensor: &Sensor, count: usize, tried: usize) -> String {
    let name = &sensor.name;
    match (count == tried, sensor.len() == tried) {
        (true, _) => format!("sensor \"{name}\" lies"),
        (false, true) => format!("{count} of {tried} points of sensor \"{name}\" lie"),
        (false, false) => {
            format!("{count} of {tried} tested points of sensor \"{name}\" lie")
        }
    }
}

fn covered(survey: &Survey<'_>, sensor: &Sensor) -> Option<Covered> {
    let most = (MAX_POINTS / survey.probe.scene.sensors.len().max(1)).max(1);
    let tried = sensor.len().min(most);
    let mut covered: Option<Covered> = None;
    for i in 0..tried {
        let point = sensor.point(i * sensor.len() / tried);
        let Some(triangle) = covering(survey, &point) else { continue };
        let first = Covered { tried, count: 0, first: point.position, triangle };
        covered.get_or_insert(first).count += 1;
    }
    covered
}

fn report_covered(survey: &Survey<'_>, number: usize, findings: &mut Findings<'_>) {
    let scene = survey.probe.scene;
    let sensor = &scene.sensors[number];
    let Some(Covered { tried, count, first, triangle }) = covered(survey, sensor) else { return };
    let message = format!(
        "{} right in front of \"{}\", facing it, for example at {}",
        share(sensor, count, tried),
        names::object(&scene.mesh, triangle),
        names::position(first)
    );
    let cure = "move it to the other side, or turn its normal";
    let place = findings.places.sensors[number];
    findings.add(Check::SensorCovered, place, message, cure).at(first);
}
