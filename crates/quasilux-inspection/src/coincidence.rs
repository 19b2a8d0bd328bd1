//! Two surfaces at one place, of which a ray meets either.
//!
//! Of emitting faces in the plane of another surface the emitting one counts, which is what is
//! meant.

use crate::finding::{Check, Findings};
use crate::names;
use crate::probe::{sphere_direction, square};
use crate::survey::Survey;
use quasilux_scene::Light;

/// Rays in all.
const RAYS: u32 = 2048;

pub(crate) fn check(survey: &Survey<'_>, findings: &mut Findings<'_>) {
    let (probe, scene) = (survey.probe, survey.probe.scene);
    let vertices: Vec<_> = survey.eyes.iter().chain(&survey.lit).collect();
    if vertices.is_empty() {
        return;
    }
    let emits = |triangle: u32| {
        scene.lights.iter().any(|light| match light {
            Light::Area(area) => area.triangles.binary_search(&triangle).is_ok(),
            Light::Point(_) | Light::Luminaire(_) => false,
        })
    };
    let matters = |a: u32, b: u32| {
        let (one, other) = (&scene.material(a).bsdf, &scene.material(b).bsdf);
        (one != other || one.transmits()) && !emits(a) && !emits(b)
    };
    let found = (0..RAYS).find_map(|i| {
        let vertex = vertices[(square(i)[0] * vertices.len() as f64) as usize];
        let direction = sphere_direction(i, RAYS);
        let met = probe.first(vertex.position, direction)?;
        let twin = probe.twin(vertex.position, direction, &met)?;
        matters(met.triangle, twin).then_some((met, twin))
    });
    let Some((met, twin)) = found else { return };
    let of = |triangle: u32| {
        let material = &scene.material(triangle).name;
        format!("\"{}\" (material \"{material}\")", names::object(&scene.mesh, triangle))
    };
    let message = format!(
        "faces of {} and of {} coincide, for example at {}",
        of(met.triangle),
        of(twin),
        names::position(met.position)
    );
    let cure =
        "delete one of them, or leave a gap between them; until then the one listed first counts";
    findings.add(Check::CoincidentFaces, findings.places.scene, message, cure).at(met.position);
}
