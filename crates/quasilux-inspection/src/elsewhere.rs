//! Geometry that is not where lamps and sensors are: far from the origin, or in another unit.

use crate::finding::{Check, Findings};
use crate::names;
use crate::survey::{Survey, position_of};
use crate::units;
use glam::DVec3;

/// What is this near to the geometry, in m, is beside it: a luminaire on the outside of a wall.
const BESIDE_M: f64 = 0.5;

pub(crate) fn check(survey: &Survey<'_>, findings: &mut Findings<'_>) {
    let scene = survey.probe.scene;
    let Some([low, high]) = scene.mesh.bounds() else { return };
    // Above a square or a road are its lamps.
    let is_there = |at: DVec3| {
        let [near, far] = [low - DVec3::splat(BESIDE_M), high + DVec3::splat(BESIDE_M)];
        at.truncate().cmpge(near.truncate()).all() && at.truncate().cmple(far.truncate()).all()
    };
    let lamps: Vec<DVec3> = scene.lights.iter().filter_map(position_of).collect();
    let points = survey.asked.iter().map(|asked| asked.point.position);
    let elsewhere: Vec<DVec3> = points.filter(|&at| !is_there(at)).collect();
    let lamps_there = lamps.iter().filter(|&&at| is_there(at)).count();
    // Most points: a grid that is too long ends at the wrong wall. Half of the lamps: what is too
    // small lies below some of them, as 1 of 80 rooms at random whose metres were taken for feet.
    let lamps_elsewhere = !lamps.is_empty() && 2 * lamps_there <= lamps.len();
    if lamps_elsewhere && 2 * elsewhere.len() > survey.asked.len() {
        let message = format!(
            "{} of {} and {} of {} sensor points stand within the outline of the geometry, which \
             is from {} to {}",
            lamps_there,
            names::count(lamps.len(), "lamp", "lamps"),
            survey.asked.len() - elsewhere.len(),
            survey.asked.len(),
            names::position(low),
            names::position(high)
        );
        let is_roofed = |at: DVec3| survey.probe.first(at, DVec3::Z).is_some();
        let cure = units::cure_of_all(scene, findings.places, is_roofed).unwrap_or_else(|| {
            "bring both into one room: set units in [scene] to the unit of the geometry, or move \
             the geometry to its origin in the program that it comes from"
                .to_owned()
        });
        let place = findings.places.scene;
        findings.add(Check::GeometryElsewhere, place, message, cure).at(elsewhere[0]);
    }
}
