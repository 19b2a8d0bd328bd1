//! Intensities around the circle of directions in a vertical plane.

use super::LuminaireAngles;
use crate::{Angles, PhotometricType, Photometry};
use std::f64::consts::{FRAC_PI_2, PI};

/// Steps of a half-plane where intensities are not piecewise linear in gamma: 0.1 degrees.
const STEPS: u32 = 1800;

/// A vertical plane through the luminaire: the half-planes C and C + 180 degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// The half-plane of positive gamma.
    pub c_rad: f64,
}

/// Intensities in a plane over gamma: a piecewise linear curve from -pi to pi (both are zenith).
///
/// Gamma is positive in the half-plane C and negative in C + 180 degrees. Neighbouring points may
/// share their gamma: there the intensity jumps.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaneCurve {
    points: Vec<PlanePoint>,
}

/// A point of a [`PlaneCurve`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanePoint {
    /// From nadir, signed, in radians.
    pub gamma_rad: f64,
    /// In candela.
    pub intensity_cd: f64,
}

impl Plane {
    /// The plane C0-C180.
    pub const C0_C180: Self = Self { c_rad: 0.0 };
    /// The plane C90-C270.
    pub const C90_C270: Self = Self { c_rad: FRAC_PI_2 };
    /// Both of them, the planes of every data sheet.
    pub const PRINCIPAL: [Self; 2] = [Self::C0_C180, Self::C90_C270];
}

impl PlaneCurve {
    /// The curve of a luminaire in a plane.
    pub fn new(photometry: &Photometry, plane: Plane) -> Self {
        let mut points = half_plane(photometry, plane.c_rad + PI);
        points.reverse();
        for point in &mut points {
            point.gamma_rad = -point.gamma_rad;
        }
        points.extend(half_plane(photometry, plane.c_rad));
        Self { points }
    }

    /// A curve through points that ascend from -pi to pi.
    #[cfg(test)]
    pub(super) fn through(points: &[(f64, f64)]) -> Self {
        let point = |&(degrees, cd): &(f64, f64)| PlanePoint {
            gamma_rad: degrees / 180.0 * PI,
            intensity_cd: cd,
        };
        Self { points: points.iter().map(point).collect() }
    }

    /// Its points, gamma ascending from -pi to pi.
    pub fn points(&self) -> &[PlanePoint] {
        &self.points
    }

    /// The greatest intensity in candela.
    pub fn maximum_cd(&self) -> f64 {
        self.points.iter().map(|point| point.intensity_cd).fold(0.0, f64::max)
    }
}

/// From nadir to zenith.
fn half_plane(photometry: &Photometry, c_rad: f64) -> Vec<PlanePoint> {
    match photometry.facts().photometric_type {
        PhotometricType::C => along_meridian(photometry, c_rad),
        // H of type A counts the other way around the same poles.
        PhotometricType::A => along_meridian(photometry, -c_rad),
        PhotometricType::B => sampled(photometry, c_rad),
    }
}

/// Between two parallels of a table with vertical poles the intensity is linear in gamma.
fn along_meridian(photometry: &Photometry, phi_rad: f64) -> Vec<PlanePoint> {
    let table = photometry.table();
    let dark = |gamma_rad| PlanePoint { gamma_rad, intensity_cd: 0.0 };
    let nodes = table.theta_rad();
    let (first, last) = (nodes[0], nodes[nodes.len() - 1]);
    let mut points = Vec::with_capacity(nodes.len() + 4);
    if first > 0.0 {
        points.extend([dark(0.0), dark(first)]);
    }
    points.extend(nodes.iter().map(|&gamma_rad| PlanePoint {
        gamma_rad,
        intensity_cd: table.value_at(Angles { theta_rad: gamma_rad, phi_rad }),
    }));
    if last < PI {
        points.extend([dark(last), dark(PI)]);
    }
    points
}

fn sampled(photometry: &Photometry, c_rad: f64) -> Vec<PlanePoint> {
    let at = |step| {
        let gamma_rad = PI * f64::from(step) / f64::from(STEPS);
        let direction = LuminaireAngles { c_rad, gamma_rad }.direction();
        PlanePoint { gamma_rad, intensity_cd: photometry.intensity_cd(direction) }
    };
    (0..=STEPS).map(at).collect()
}
