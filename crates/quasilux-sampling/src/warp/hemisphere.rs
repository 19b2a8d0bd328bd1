//! The hemisphere about +z.

use std::f64::consts::{FRAC_1_PI, TAU};

use super::disk::{invert_disk, sample_disk};
use super::sphere::{direction_at, invert_azimuth};
use crate::unit::clamp_to_unit;

/// A direction of the upper hemisphere, its density in solid angle proportional to its cosine with
/// +z.
///
/// A point of the concentric disk is lifted (J. Malley). z is positive even where u lies on the
/// edge of the square.
#[inline]
#[must_use]
pub fn sample_cosine_hemisphere(u: [f64; 2]) -> [f64; 3] {
    let [x, y] = sample_disk(u);
    let r = (2.0 * u[0] - 1.0).abs().max((2.0 * u[1] - 1.0).abs());
    let z_squared = (1.0 - r) * (1.0 + r);
    [x, y, z_squared.max(f64::EPSILON).sqrt()]
}

/// Density of [`sample_cosine_hemisphere`] with respect to solid angle (sr^-1).
#[must_use]
pub fn pdf_cosine_hemisphere(direction: [f64; 3]) -> f64 {
    direction[2].max(0.0) * FRAC_1_PI
}

/// The coordinates that [`sample_cosine_hemisphere`] maps to `direction`, for solid angle.
#[must_use]
pub fn invert_cosine_hemisphere(direction: [f64; 3]) -> [f64; 2] {
    invert_disk([direction[0], direction[1]])
}

/// A direction of the upper hemisphere, uniform in solid angle.
///
/// Archimedes: equal heights have equal areas; u = (0, 0) is +z, and z is positive.
#[must_use]
pub fn sample_uniform_hemisphere(u: [f64; 2]) -> [f64; 3] {
    direction_at(u[0], u[1])
}

/// Density of [`sample_uniform_hemisphere`] with respect to solid angle (sr^-1).
#[must_use]
pub fn pdf_uniform_hemisphere(direction: [f64; 3]) -> f64 {
    if direction[2] > 0.0 { 1.0 / TAU } else { 0.0 }
}

/// The coordinates that [`sample_uniform_hemisphere`] maps to `direction`, for solid angle.
#[must_use]
pub fn invert_uniform_hemisphere(direction: [f64; 3]) -> [f64; 2] {
    let [x, y, z] = direction;
    [clamp_to_unit((x * x + y * y) / (1.0 + z)), invert_azimuth(x, y)]
}
