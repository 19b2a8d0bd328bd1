//! Boxes, and with fewer extents rectangles, lines and points.
//!
//! The silhouette of a box is that of its three faces turned to the observer, each with its area
//! times a direction cosine: a face is chosen by these, then a point uniform on it.

use super::SurfacePoint;
use glam::DVec3;
use quasilux_sampling::choose_weights;

/// How many extents are not zero.
pub(super) fn extents(half_m: DVec3) -> usize {
    half_m.to_array().iter().filter(|half_m| **half_m > 0.0).count()
}

pub(super) fn projected_area_m2(half_m: DVec3, direction: DVec3) -> f64 {
    projected_faces_m2(half_m, direction).iter().sum()
}

pub(super) fn sample(half_m: DVec3, toward: DVec3, u: [f64; 2]) -> SurfacePoint {
    match extents(half_m) {
        3 => {
            let faces_m2 = projected_faces_m2(half_m, toward);
            let choice = choose_weights(u[0], faces_m2.into_iter());
            let (axis, rest) = choice.map_or((2, u[0]), |choice| (choice.index, choice.u_remapped));
            on_face(half_m, toward, axis, [rest, u[1]])
        }
        2 => on_face(half_m, toward, flat_axis(half_m), u),
        _ => SurfacePoint { position_m: half_m * (2.0 * u[0] - 1.0), normal: DVec3::ZERO },
    }
}

pub(super) fn pdf(half_m: DVec3, toward: DVec3, normal: DVec3) -> f64 {
    match extents(half_m) {
        3 => normal.dot(toward).max(0.0) / projected_area_m2(half_m, toward),
        2 => 1.0 / faces_m2(half_m)[flat_axis(half_m)],
        1 => 1.0 / (2.0 * half_m.max_element()),
        _ => 1.0,
    }
}

pub(super) fn invert(half_m: DVec3, toward: DVec3, point: &SurfacePoint) -> [f64; 2] {
    let share = |axis: usize| {
        if half_m[axis] > 0.0 { 0.5 * (1.0 + point.position_m[axis] / half_m[axis]) } else { 0.5 }
    };
    let on = |axis: usize| [share((axis + 1) % 3), share((axis + 2) % 3)];
    match extents(half_m) {
        3 => {
            let axis = (0..3).find(|&axis| point.normal[axis] != 0.0).unwrap_or(2);
            let faces_m2 = projected_faces_m2(half_m, toward);
            let before: f64 = faces_m2[..axis].iter().sum();
            let [rest, second] = on(axis);
            [(before + rest * faces_m2[axis]) / faces_m2.iter().sum::<f64>(), second]
        }
        2 => on(flat_axis(half_m)),
        1 => [(0..3).find(|&axis| half_m[axis] > 0.0).map_or(0.5, share), 0.5],
        _ => [0.5; 2],
    }
}

/// The point of the face across `axis` that is turned to `toward`.
fn on_face(half_m: DVec3, toward: DVec3, axis: usize, u: [f64; 2]) -> SurfacePoint {
    let mut local = DVec3::ZERO;
    let mut normal = DVec3::ZERO;
    normal[axis] = 1.0_f64.copysign(toward[axis]);
    local[axis] = normal[axis];
    local[(axis + 1) % 3] = 2.0 * u[0] - 1.0;
    local[(axis + 2) % 3] = 2.0 * u[1] - 1.0;
    SurfacePoint { position_m: local * half_m, normal }
}

/// The axis without an extent.
fn flat_axis(half_m: DVec3) -> usize {
    (0..3).find(|&axis| half_m[axis] == 0.0).unwrap_or(2)
}

/// Areas of a face across x, y and z.
fn faces_m2(half_m: DVec3) -> [f64; 3] {
    let DVec3 { x, y, z } = half_m;
    [4.0 * y * z, 4.0 * z * x, 4.0 * x * y]
}

fn projected_faces_m2(half_m: DVec3, direction: DVec3) -> [f64; 3] {
    let faces_m2 = faces_m2(half_m);
    [0, 1, 2].map(|axis| direction[axis].abs() * faces_m2[axis])
}
