//! Sensor points without light, outside the geometry or right behind a surface.

use crate::finding::{Check, Findings};
use crate::names;
use crate::survey::{Asked, Survey};
use crate::units;
use glam::DVec3;

/// A surface this near before a sensor point covers it, in m: a workplane is not put a centimetre
/// below a table top.
const COVERED_M: f64 = 0.01;

/// What is odd about the points of one sensor.
#[derive(Default)]
struct Odd {
    tried: usize,
    outside: Vec<DVec3>,
    /// Each with the triangle before it.
    covered: Vec<Covered>,
}

struct Covered {
    position: DVec3,
    triangle: u32,
}

pub(crate) fn check(survey: &Survey<'_>, findings: &mut Findings<'_>) {
    let scene = survey.probe.scene;
    let lit: Vec<bool> =
        survey.asked_vertices.iter().map(|vertices| survey.is_lit(vertices)).collect();
    let is_open = survey.is_open();
    let mut odd: Vec<Odd> = scene.sensors.iter().map(|_| Odd::default()).collect();
    for (asked, lit) in survey.asked.iter().zip(lit) {
        let odd = &mut odd[asked.sensor];
        odd.tried += 1;
        if !lit {
            sort_in(survey, asked, is_open, odd);
        }
    }
    for (number, odd) in odd.iter().enumerate() {
        report(survey, number, odd, findings);
    }
}

/// Why this dark point may be dark.
fn sort_in(survey: &Survey<'_>, asked: &Asked, is_open: bool, odd: &mut Odd) {
    let (probe, position) = (survey.probe, asked.point.position);
    let eye = survey.before(&asked.point);
    let [low, high] = probe.scene.mesh.bounds().unwrap_or_default();
    let margin = DVec3::splat(0.01 * probe.size_m);
    let is_beyond = position.cmplt(low - margin).any() || position.cmpgt(high + margin).any();
    if is_beyond || (!is_open && survey.is_in_the_open(eye)) {
        odd.outside.push(position);
        return;
    }
    let ahead = probe.first(eye, asked.point.normal);
    if let Some(ahead) = ahead.filter(|ahead| ahead.distance_m <= COVERED_M) {
        odd.covered.push(Covered { position, triangle: ahead.triangle });
    }
}

fn report(survey: &Survey<'_>, number: usize, odd: &Odd, findings: &mut Findings<'_>) {
    let scene = survey.probe.scene;
    let sensor = &scene.sensors[number];
    let place = findings.places.sensors[number];
    let share = |count: usize| match (count == odd.tried, sensor.len() == odd.tried) {
        (true, _) => format!("sensor \"{}\" lies", sensor.name),
        (false, true) => {
            format!("{count} of {} points of sensor \"{}\" lie", odd.tried, sensor.name)
        }
        (false, false) => format!(
            "{count} of {} points that were tried of sensor \"{}\" lie",
            odd.tried, sensor.name
        ),
    };
    if let Some(&first) = odd.outside.first() {
        let message = format!(
            "{} outside the geometry, where no light was found, as at {}",
            share(odd.outside.len()),
            names::position(first)
        );
        let cure = match units::explaining(scene, first) {
            Some(unit) => format!(
                "it would be inside in {}: say position_units = \"{}\" in [scene] if all positions \
                 are meant so",
                units::in_words(unit),
                unit.name()
            ),
            None if odd.outside.len() < odd.tried => {
                "expected a grid that ends at the walls".to_owned()
            }
            None => "expected a place in the room, in m, its normal toward the room".to_owned(),
        };
        findings.add(Check::SensorOutside, place, message, cure).at(first);
    }
    if let Some(first) = odd.covered.first() {
        let object = names::object(&scene.mesh, first.triangle);
        let message = format!(
            "{} right behind \"{object}\", where no light was found, as at {}",
            share(odd.covered.len()),
            names::position(first.position)
        );
        let cure = "expected it on the other side, or its normal turned";
        findings.add(Check::SensorCovered, place, message, cure).at(first.position);
    }
}
