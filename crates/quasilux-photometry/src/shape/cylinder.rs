//! Cylinders of elliptical section with both ends, and flat ellipses; the axis is z here.
//!
//! The silhouette has two parts: the end that is turned to the observer, an ellipse, and the side,
//! as wide as the section seen across. Dividing x and y by the semi-axes makes the section a
//! circle; this keeps ratios of areas in silhouettes. On a circle, places uniform across its width
//! are uniform over the silhouette.

use super::SurfacePoint;
use glam::{DVec2, DVec3};
use quasilux_sampling::choose_bool;
use quasilux_sampling::warp::{invert_disk, sample_disk};
use std::f64::consts::PI;

pub(super) fn projected_area_m2(half_m: DVec3, direction: DVec3) -> f64 {
    let Parts { end_m2, side_m2 } = Parts::along(half_m, direction);
    end_m2 + side_m2
}

pub(super) fn sample(half_m: DVec3, toward: DVec3, u: [f64; 2]) -> SurfacePoint {
    let choice = choose_bool(u[0], Parts::along(half_m, toward).end_share());
    if choice.value || half_m.z == 0.0 {
        let [x, y] = sample_disk([choice.u_remapped, u[1]]);
        let normal = DVec3::new(0.0, 0.0, 1.0_f64.copysign(toward.z));
        return SurfacePoint { position_m: DVec3::new(x, y, normal.z) * half_m, normal };
    }
    let facing = facing(half_m, toward);
    let across = 2.0 * choice.u_remapped - 1.0;
    let on_circle = facing * (1.0 - across * across).max(0.0).sqrt() + facing.perp() * across;
    let local = on_circle.extend(2.0 * u[1] - 1.0);
    let normal = (on_circle / half_m.truncate()).normalize().extend(0.0);
    SurfacePoint { position_m: local * half_m, normal }
}

pub(super) fn pdf(half_m: DVec3, toward: DVec3, normal: DVec3) -> f64 {
    if half_m.z == 0.0 {
        return 1.0 / (PI * half_m.x * half_m.y);
    }
    normal.dot(toward).max(0.0) / projected_area_m2(half_m, toward)
}

pub(super) fn invert(half_m: DVec3, toward: DVec3, point: &SurfacePoint) -> [f64; 2] {
    let end_share = Parts::along(half_m, toward).end_share();
    let on_circle = point.position_m.truncate() / half_m.truncate();
    if point.normal.z != 0.0 {
        let [rest, second] = invert_disk(on_circle.to_array());
        return [rest * end_share, second];
    }
    let across = on_circle.dot(facing(half_m, toward).perp());
    let rest = 0.5 * (1.0 + across);
    [end_share + rest * (1.0 - end_share), 0.5 * (1.0 + point.position_m.z / half_m.z)]
}

/// The two parts of a silhouette.
struct Parts {
    end_m2: f64,
    side_m2: f64,
}

impl Parts {
    fn along(half_m: DVec3, direction: DVec3) -> Self {
        let DVec3 { x: a, y: b, z: c } = half_m;
        let half_width_m = DVec2::new(b * direction.x, a * direction.y).length();
        Self { end_m2: PI * a * b * direction.z.abs(), side_m2: 4.0 * c * half_width_m }
    }

    /// 1 for flat ellipses, seen edge on too.
    fn end_share(&self) -> f64 {
        if self.side_m2 > 0.0 { self.end_m2 / (self.end_m2 + self.side_m2) } else { 1.0 }
    }
}

/// Where on the circle the side is turned to the observer most.
fn facing(half_m: DVec3, toward: DVec3) -> DVec2 {
    (toward.truncate() / half_m.truncate()).normalize_or(DVec2::X)
}
