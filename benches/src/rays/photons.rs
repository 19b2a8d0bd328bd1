//! Rays as photons make them.

use glam::DVec3;
use quasilux_benches::meshes::{Numbers, Scene};
use quasilux_bvh::{Ray, TriangleBvh};
use std::f64::consts::TAU;

/// Diffuse bounces of a photon, where it is not lost before.
const BOUNCES: usize = 5;

/// A ray, and the triangle that it leaves, `u32::MAX` where it leaves none.
pub(crate) struct RayQuery {
    pub(crate) ray: Ray,
    pub(crate) from: u32,
}

/// The first `count` rays of photons that leave the scene's inner point in all directions and
/// bounce diffusely, one photon after the other.
#[expect(clippy::disallowed_methods, reason = "the bits of a benchmark's rays do not matter")]
pub(crate) fn photon_rays(scene: &Scene, bvh: &TriangleBvh, count: usize) -> Vec<RayQuery> {
    let numbers = &mut Numbers(5);
    let mut rays = Vec::with_capacity(count);
    while rays.len() < count {
        let z = 2.0 * numbers.next() - 1.0;
        let (y, x) = (TAU * numbers.next()).sin_cos();
        let s = (1.0 - z * z).sqrt();
        let mut from = u32::MAX;
        let mut ray = Ray::new(scene.source, DVec3::new(s * x, s * y, z).normalize());
        for bounce in 0..=BOUNCES {
            rays.push(RayQuery { ray, from });
            if rays.len() == count || bounce == BOUNCES {
                break;
            }
            let Some(hit) = bvh.closest_hit(&ray, &[from]) else { break };
            let [a, b, c] = scene.corners[hit.triangle as usize];
            let n = (b - a).cross(c - a).normalize();
            let n = if n.dot(ray.direction) < 0.0 { n } else { -n };
            let (r, (y, x)) = (numbers.next().sqrt(), (TAU * numbers.next()).sin_cos());
            let (s, t) = n.any_orthonormal_pair();
            let up = (1.0 - r * r).max(1e-6).sqrt();
            let direction = (s * (r * x) + t * (r * y) + n * up).normalize();
            let place = ray.at(hit.distance);
            let offset = 1e-6 * (1.0 + place.abs().max_element());
            ray = Ray::new(place + n * offset, direction);
            from = hit.triangle;
            if !direction.is_finite() {
                break;
            }
        }
    }
    rays
}
