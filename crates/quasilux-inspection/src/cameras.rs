//! Cameras that look at nothing lit from outside the geometry.

use crate::finding::{Check, Findings};
use crate::names;
use crate::survey::Survey;
use crate::units::{self, Thing};

pub(crate) fn check(survey: &Survey<'_>, findings: &mut Findings<'_>) {
    let scene = survey.probe.scene;
    for (number, camera) in scene.cameras.iter().enumerate() {
        let seen = &survey.camera_vertices[number];
        let position = camera.position;
        let shows_daylight = scene.environment.is_some()
            && (seen.is_empty() || seen.iter().any(|vertex| survey.sees_the_sky(vertex)));
        if shows_daylight || survey.is_lit(seen) || !survey.is_in_the_open(position) {
            continue;
        }
        let what = if seen.is_empty() {
            "sees nothing"
        } else {
            "sees only surfaces that no light was found to reach"
        };
        let message = format!(
            "camera \"{}\" at {} is outside the geometry and {what}",
            camera.name,
            names::position(position)
        );
        let cure =
            units::cure(scene, findings.places, position, Thing::Other).unwrap_or_else(|| {
                "move it into the room, or to a place that looks into it".to_owned()
            });
        let place = findings.places.cameras[number];
        findings.add(Check::CameraOutside, place, message, cure).at(position);
    }
}
