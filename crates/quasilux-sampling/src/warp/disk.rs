//! The unit disk by concentric squares.
//!
//! P. Shirley and K. Chiu, "A low distortion map between disk and square" (J. Graphics Tools 2,
//! 1997): squares about the centre become circles, areas keep their ratios.

use std::f64::consts::{FRAC_1_PI, FRAC_2_PI, FRAC_PI_2, FRAC_PI_4, PI};

use super::sine::sine_and_cosine_of_eighth;

use crate::unit::clamp_to_unit;

/// A point of the unit disk, uniform in area.
#[inline]
#[must_use]
pub fn sample_disk(u: [f64; 2]) -> [f64; 2] {
    let (a, b) = (2.0 * u[0] - 1.0, 2.0 * u[1] - 1.0);
    // The azimuth from the nearer axis is an eighth of a turn at most.
    let is_near_x = a.abs() > b.abs();
    let (r, across) = if is_near_x { (a, b) } else { (b, a) };
    let from_axis_rad = FRAC_PI_4 * (across / if r == 0.0 { 1.0 } else { r });
    let (sin, cos) = sine_and_cosine_of_eighth(from_axis_rad);
    let (along, across) = (r * cos, r * sin);
    if is_near_x { [along, across] } else { [across, along] }
}

/// Density of [`sample_disk`] with respect to area (per square radius).
#[must_use]
pub fn pdf_disk(point: [f64; 2]) -> f64 {
    if point[0] * point[0] + point[1] * point[1] <= 1.0 { FRAC_1_PI } else { 0.0 }
}

/// The coordinates that [`sample_disk`] maps to `point`, for area.
#[must_use]
pub fn invert_disk(point: [f64; 2]) -> [f64; 2] {
    let [x, y] = point;
    let r = (x * x + y * y).sqrt();
    let phi_rad = libm::atan2(y, x);
    let (a, b) = if x.abs() > y.abs() {
        let centre_rad = if x > 0.0 { 0.0 } else { PI.copysign(y) };
        (r.copysign(x), (phi_rad - centre_rad) * 2.0 * FRAC_2_PI * r.copysign(x))
    } else {
        let centre_rad = FRAC_PI_2.copysign(y);
        ((centre_rad - phi_rad) * 2.0 * FRAC_2_PI * r.copysign(y), r.copysign(y))
    };
    [clamp_to_unit(0.5 * (a + 1.0)), clamp_to_unit(0.5 * (b + 1.0))]
}
