//! Tables of intensities, in the format of Radiance's data files.

use super::words::list;
use glam::DVec3;
use quasilux_photometry::{Angles, PhotometricType, Photometry};
use std::f64::consts::{PI, TAU};
use std::fmt::Write;

/// Steps from nadir to zenith and around of tables whose file has another web.
const GAMMA_STEPS: u32 = 720;
const C_STEPS: u32 = 720;
/// From where a table ends to where it is dark, in rad.
const EDGE_RAD: f64 = 1e-6;

/// Intensities in cd by gamma and C, in the format of Radiance's data files: at the angles of the
/// file, between which both programs go in straight lines.
pub(super) fn intensities(photometry: &Photometry) -> String {
    let WebAngles { gammas, planes } = WebAngles::new(photometry);
    let mut text = String::from("2\n");
    for angles in [&gammas, &planes] {
        let degrees: Vec<f64> = angles.iter().map(|angle| angle.to_degrees()).collect();
        writeln!(text, "0 0 {}\n{}", degrees.len(), list(&degrees)).expect("strings grow");
    }
    for gamma in &gammas {
        let row: Vec<f64> = planes.iter().map(|c| intensity_cd(photometry, *gamma, *c)).collect();
        writeln!(text, "{}", list(&row)).expect("strings grow");
    }
    text
}

/// The intensity at angles in rad; at the poles of its own web that of each plane.
fn intensity_cd(photometry: &Photometry, gamma: f64, c: f64) -> f64 {
    if photometry.facts().photometric_type == PhotometricType::C {
        return photometry.table().value_at(Angles { theta_rad: gamma, phi_rad: c });
    }
    let ((sin, cos), (y, x)) = (libm::sincos(gamma), libm::sincos(c));
    photometry.intensity_cd(DVec3::new(sin * x, sin * y, -cos))
}

/// The angles of a table in rad.
struct WebAngles {
    /// From 0 to half a turn.
    gammas: Vec<f64>,
    /// From 0 to a whole turn.
    planes: Vec<f64>,
}

impl WebAngles {
    fn new(photometry: &Photometry) -> Self {
        let even = |steps: u32, end: f64| -> Vec<f64> {
            (0..=steps).map(|step| end * f64::from(step) / f64::from(steps)).collect()
        };
        if photometry.facts().photometric_type != PhotometricType::C {
            return Self { gammas: even(GAMMA_STEPS, PI), planes: even(C_STEPS, TAU) };
        }
        let table = photometry.table();
        let own: Vec<f64> = table.phi_rad().collect();
        let mut planes: Vec<f64> = own.iter().map(|phi| phi.rem_euclid(TAU)).collect();
        if let [first, .., last] = own.as_slice()
            && last - first < TAU - 1e-9
        {
            planes.extend([first - EDGE_RAD, last + EDGE_RAD].map(|phi| phi.rem_euclid(TAU)));
        }
        let mut gammas = table.theta_rad().to_vec();
        if let [first, .., last] = *gammas.as_slice() {
            gammas.extend([first - EDGE_RAD, last + EDGE_RAD]);
        }
        Self { gammas: sorted(gammas, PI), planes: sorted(planes, TAU) }
    }
}

/// Angles from 0 to an end, both of which are there, each once.
fn sorted(mut angles: Vec<f64>, end: f64) -> Vec<f64> {
    angles.extend([0.0, end]);
    angles.retain(|angle| (0.0..=end).contains(angle));
    angles.sort_by(f64::total_cmp);
    angles.dedup_by(|later, earlier| *later - *earlier < 0.5 * EDGE_RAD);
    // An angle just before the end went before it.
    if let Some(last) = angles.last_mut() {
        *last = end;
    }
    angles
}

/// Whether a photometry shines up (1) or down (-1).
pub(super) fn shines(photometry: &Photometry, up: f64) -> bool {
    let WebAngles { gammas, planes } = WebAngles::new(photometry);
    let mut on_side = gammas.iter().filter(|gamma| -up * libm::cos(**gamma) > 1e-6);
    on_side.any(|gamma| planes.iter().any(|c| intensity_cd(photometry, *gamma, *c) > 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_begin_and_end_where_a_turn_does() {
        let found = sorted(vec![0.0, 1.0, 1.0 + 1e-9, PI - 1e-8, PI + EDGE_RAD], PI);
        assert_eq!(found, [0.0, 1.0, PI]);
    }
}
