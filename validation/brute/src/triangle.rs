//! Triangles, and where a ray meets them.

use crate::random::Xoshiro;
use crate::surface::Surface;
use glam::DVec3;

/// A triangle, its front where its corners run counter-clockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// The corners in m.
    pub corners: [DVec3; 3],
    /// How it scatters light.
    pub surface: Surface,
    /// Luminance of the front in cd/m^2, the same in all directions; 0 where it does not shine.
    pub luminance_cd_m2: f64,
}

/// A ray: a unit direction, and between which distances it looks.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray {
    pub(crate) origin: DVec3,
    pub(crate) direction: DVec3,
    pub(crate) nearest_m: f64,
    pub(crate) farthest_m: f64,
}

impl Triangle {
    /// Twice the area along the front normal.
    pub(crate) fn double_area(&self) -> DVec3 {
        let [a, b, c] = self.corners;
        (b - a).cross(c - a)
    }

    /// The area in m^2.
    pub(crate) fn area_m2(&self) -> f64 {
        0.5 * self.double_area().length()
    }

    /// A place of it, all alike.
    pub(crate) fn place(&self, random: &mut Xoshiro) -> DVec3 {
        let root = random.uniform().sqrt();
        let along = random.uniform();
        let [a, b, c] = self.corners;
        a * (1.0 - root) + b * (root * (1.0 - along)) + c * (root * along)
    }

    /// Where the ray meets it (Moeller and Trumbore 1997).
    pub(crate) fn distance_m(&self, ray: &Ray) -> Option<f64> {
        let [a, b, c] = self.corners;
        let (e, f) = (b - a, c - a);
        let p = ray.direction.cross(f);
        let determinant = e.dot(p);
        if determinant.abs() < 1e-300 {
            return None;
        }
        let s = ray.origin - a;
        let u = s.dot(p) / determinant;
        let q = s.cross(e);
        let v = ray.direction.dot(q) / determinant;
        // A hair wider than the triangle: no ray slips between neighbours.
        if u < -1e-12 || v < -1e-12 || u + v > 1.0 + 2e-12 {
            return None;
        }
        let distance = f.dot(q) / determinant;
        (distance > ray.nearest_m && distance < ray.farthest_m).then_some(distance)
    }
}
