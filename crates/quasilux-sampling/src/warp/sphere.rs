//! The whole sphere of directions.

use std::f64::consts::{FRAC_1_PI, TAU};

use crate::unit::clamp_to_unit;

/// A direction, uniform in solid angle.
///
/// Archimedes: equal heights have equal areas; u = (0, 0) is +z.
#[must_use]
pub fn sample_uniform_sphere(u: [f64; 2]) -> [f64; 3] {
    direction_at(2.0 * u[0], u[1])
}

/// Density of [`sample_uniform_sphere`] with respect to solid angle (sr^-1).
#[must_use]
pub fn pdf_uniform_sphere(_direction: [f64; 3]) -> f64 {
    0.25 * FRAC_1_PI
}

/// The coordinates that [`sample_uniform_sphere`] maps to `direction`, for solid angle.
#[must_use]
pub fn invert_uniform_sphere(direction: [f64; 3]) -> [f64; 2] {
    let [x, y, z] = direction;
    let depth = if z > 0.0 { (x * x + y * y) / (1.0 + z) } else { 1.0 - z };
    [clamp_to_unit(0.5 * depth), invert_azimuth(x, y)]
}

/// The direction at `depth` = 1 - z below the pole and `turns` about it. sin^2 = depth (2 - depth)
/// keeps its digits at both poles.
pub(super) fn direction_at(depth: f64, turns: f64) -> [f64; 3] {
    let sin_theta = (depth * (2.0 - depth)).max(0.0).sqrt();
    let (sin_phi, cos_phi) = libm::sincos(TAU * turns);
    [sin_theta * cos_phi, sin_theta * sin_phi, 1.0 - depth]
}

/// The azimuth of (x, y) in turns, in [0, 1).
pub(super) fn invert_azimuth(x: f64, y: f64) -> f64 {
    let turns = libm::atan2(y, x) / TAU;
    clamp_to_unit(if turns < 0.0 { turns + 1.0 } else { turns })
}
