//! What is probably wrong with a scene, told before light is traced.
//!
//! A scene in the wrong unit, with a lamp above the ceiling or a wall left out, has plausible
//! illuminances with honest intervals around the wrong question. [`inspect`] asks whether the
//! things of a scene stand in a sensible relation to each other, and says of each that does not
//! where it is and how it is mended. A [`Finding`] is an opinion: the scene can be simulated.
//!
//! Most checks rest on one question, asked by rays (`survey.rs`): does light of this lamp reach any
//! sensor or camera? A lamp in a far corner of a corridor does so over many surfaces; one above the
//! ceiling does not, and sees the sky. After a run [`explain_darkness`] asks it again of the sensor
//! points at which no light was found.

mod cameras;
mod coincidence;
mod darkness;
mod elsewhere;
mod emitters;
mod figures;
mod finding;
mod grids;
mod holes;
mod lamps;
mod names;
mod openings;
mod orientation;
mod probe;
mod sensors;
mod survey;
mod twins;
mod units;

pub use darkness::{DarkPoints, explain_darkness};
pub use finding::{Check, Finding};

use finding::Findings;
use probe::Probe;
use quasilux_bvh::TriangleBvh;
use quasilux_scene::{Places, Scene};
use survey::Survey;

/// All that is probably wrong with a scene, the most telling first: a wrong unit explains the lamps
/// that it puts outside.
///
/// `places` says where its things are described; `hierarchy` is over the triangles of the scene's
/// mesh, in their order.
///
/// # Panics
/// If the hierarchy has another number of triangles than the scene.
#[must_use]
pub fn inspect(scene: &Scene, places: &Places, hierarchy: &TriangleBvh) -> Vec<Finding> {
    assert_eq!(hierarchy.len(), scene.mesh.triangles.len(), "hierarchy of another scene");
    let mut findings = Findings::new(places);
    units::check(scene, &mut findings);
    orientation::check(scene, &mut findings);
    figures::check(scene, &mut findings);
    twins::check(scene, &mut findings);
    grids::check(scene, &mut findings);
    if !scene.mesh.triangles.is_empty() {
        let probe = Probe::new(scene, hierarchy);
        let survey = Survey::new(&probe);
        elsewhere::check(&survey, &mut findings);
        lamps::check(&survey, &mut findings);
        emitters::check(&survey, &mut findings);
        sensors::check(&survey, &mut findings);
        grids::check_normals(&survey, &mut findings);
        cameras::check(&survey, &mut findings);
        holes::check(&survey, &mut findings);
        openings::check(&survey, &mut findings);
        coincidence::check(&survey, &mut findings);
    }
    findings.found
}
