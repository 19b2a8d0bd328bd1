//! Ellipsoids.
//!
//! Dividing by the semi-axes makes a sphere of it, and of parallel rays along w parallel rays along
//! v = w / semi-axes; linear maps keep ratios of areas in silhouettes. On a sphere, a disk across v
//! that is lifted to the half facing v is uniform over the silhouette.

use super::SurfacePoint;
use glam::DVec3;
use quasilux_sampling::warp::{invert_disk, sample_disk};
use std::f64::consts::PI;

/// pi |(bc wx, ca wy, ab wz)|.
pub(super) fn projected_area_m2(half_m: DVec3, direction: DVec3) -> f64 {
    let DVec3 { x: a, y: b, z: c } = half_m;
    PI * (direction * DVec3::new(b * c, c * a, a * b)).length()
}

pub(super) fn sample(half_m: DVec3, toward: DVec3, u: [f64; 2]) -> SurfacePoint {
    let v = (toward / half_m).normalize_or(DVec3::Z);
    let (s, t) = v.any_orthonormal_pair();
    let [x, y] = sample_disk(u);
    let on_sphere = s * x + t * y + v * (1.0 - x * x - y * y).max(0.0).sqrt();
    SurfacePoint {
        position_m: on_sphere * half_m,
        normal: (on_sphere / half_m).normalize_or(DVec3::Z),
    }
}

pub(super) fn pdf(half_m: DVec3, toward: DVec3, normal: DVec3) -> f64 {
    normal.dot(toward).max(0.0) / projected_area_m2(half_m, toward)
}

pub(super) fn invert(half_m: DVec3, toward: DVec3, point: &SurfacePoint) -> [f64; 2] {
    let v = (toward / half_m).normalize_or(DVec3::Z);
    let (s, t) = v.any_orthonormal_pair();
    let on_sphere = point.position_m / half_m;
    invert_disk([on_sphere.dot(s), on_sphere.dot(t)])
}
