//! Triangles.
//!
//! E. Heitz, "A low-distortion map between triangle and square" (2019): the square is folded along
//! its diagonal, one linear map on each side; continuous, with constant Jacobian, and without a
//! root.

use crate::unit::clamp_to_unit;

/// Barycentric coordinates of a point of a triangle, uniform in area.
#[must_use]
pub fn sample_triangle(u: [f64; 2]) -> [f64; 3] {
    let [b0, b1] =
        if u[1] > u[0] { [0.5 * u[0], u[1] - 0.5 * u[0]] } else { [u[0] - 0.5 * u[1], 0.5 * u[1]] };
    [b0, b1, (1.0 - b0 - b1).max(0.0)]
}

/// Density of [`sample_triangle`] with respect to area (m^-2), for a triangle of `area_m2`.
#[must_use]
pub fn pdf_triangle(area_m2: f64) -> f64 {
    1.0 / area_m2
}

/// The coordinates that [`sample_triangle`] maps to `barycentric`, for area.
#[must_use]
pub fn invert_triangle(barycentric: [f64; 3]) -> [f64; 2] {
    let [b0, b1, _] = barycentric;
    if b1 > b0 {
        [clamp_to_unit(2.0 * b0), clamp_to_unit(b0 + b1)]
    } else {
        [clamp_to_unit(b0 + b1), clamp_to_unit(2.0 * b1)]
    }
}
