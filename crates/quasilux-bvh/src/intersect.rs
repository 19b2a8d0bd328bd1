//! The one function that decides whether a ray hits a triangle.
//!
//! Watertight in the sense of Woop, Benthin and Wald (2013, "Watertight Ray/Triangle
//! Intersection", JCGT 2(1)): vertices are translated and sheared so that the ray becomes the z
//! axis, a map that depends on ray and vertex alone; the sign of an edge function is the comparison
//! of two rounded products, which rounding can turn into a tie but never reverse; and ties count as
//! inside for both neighbours. A ray through a shared edge or vertex hits at least one of the
//! triangles around it.
//!
//! Deviation: all in double precision, so the paper's fallback for ties is not needed.

use crate::Ray;
use glam::DVec3;

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Index of the triangle.
    pub triangle: u32,
    /// Distance along the ray in m.
    pub distance: f64,
    /// Weights of the three corners: not negative, with sum 1 up to rounding.
    pub barycentric: [f64; 3],
}

/// A ray with the shear that makes it the z axis, computed once per ray.
#[derive(Clone, Copy, Debug)]
pub struct PreparedRay {
    /// Origin along the three axes.
    origin: [f64; 3],
    t_max: f64,
    axes: [usize; 3],
    shear: [f64; 3],
}

impl PreparedRay {
    /// Prepares a ray with a finite, non-zero direction.
    #[must_use]
    pub fn new(ray: &Ray) -> Self {
        let d = ray.direction.to_array();
        let size = d.map(f64::abs);
        let z = if size[0] >= size[1] && size[0] >= size[2] {
            0
        } else if size[1] >= size[2] {
            1
        } else {
            2
        };
        let (mut x, mut y) = ((z + 1) % 3, (z + 2) % 3);
        if d[z] < 0.0 {
            std::mem::swap(&mut x, &mut y);
        }
        Self {
            origin: [x, y, z].map(|axis| ray.origin[axis]),
            t_max: ray.t_max,
            axes: [x, y, z],
            shear: [d[x] / d[z], d[y] / d[z], 1.0 / d[z]],
        }
    }

    /// A corner in the sheared frame: the ray runs along the third axis, scaled to its length.
    #[inline(always)]
    fn sheared(&self, corner: &DVec3) -> [f64; 3] {
        let corner: &[f64; 3] = corner.as_ref();
        let p = |i: usize| corner[self.axes[i]] - self.origin[i];
        [p(0) - self.shear[0] * p(2), p(1) - self.shear[1] * p(2), self.shear[2] * p(2)]
    }
}

/// Intersects a ray with a triangle, from either side; `None` beyond `t_max` and for triangles seen
/// exactly edge-on.
#[inline(always)]
#[must_use]
pub fn intersect(ray: &PreparedRay, corners: &[DVec3; 3], triangle: u32) -> Option<Hit> {
    let [a, b, c] = [ray.sheared(&corners[0]), ray.sheared(&corners[1]), ray.sheared(&corners[2])];
    let u = c[0] * b[1] - c[1] * b[0];
    let v = a[0] * c[1] - a[1] * c[0];
    let w = b[0] * a[1] - b[1] * a[0];
    // Without branches in between: which of the conditions fails cannot be predicted.
    let mixed = ((u < 0.0) | (v < 0.0) | (w < 0.0)) & ((u > 0.0) | (v > 0.0) | (w > 0.0));
    let sum = u + v + w;
    let distance = (u * a[2] + v * b[2] + w * c[2]) / sum;
    let barycentric = [u / sum, v / sum, w / sum];
    let counts = !mixed & (sum != 0.0) & (distance > 0.0) & (distance < ray.t_max);
    counts.then_some(Hit { triangle, distance, barycentric })
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [DVec3; 3] = [DVec3::ZERO, DVec3::X, DVec3::Y];

    fn shoot(origin: DVec3, direction: DVec3) -> Option<Hit> {
        intersect(&PreparedRay::new(&Ray::new(origin, direction.normalize())), &CORNERS, 7)
    }

    #[test]
    fn both_sides_are_hit_at_the_right_place() {
        for side in [1.0, -1.0] {
            let origin = DVec3::new(0.0, 0.0, 3.0 * side);
            let target = DVec3::new(0.2, 0.3, 0.0);
            let hit = shoot(origin, target - origin).unwrap();
            assert_eq!(hit.triangle, 7);
            assert!((hit.distance - (target - origin).length()).abs() < 1e-14);
            let weights = [0.5, 0.2, 0.3];
            for (got, wanted) in hit.barycentric.iter().zip(weights) {
                assert!((got - wanted).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn behind_beyond_and_edge_on_miss() {
        let above = DVec3::new(0.2, 0.2, 1.0);
        assert!(shoot(above, DVec3::Z).is_none());
        assert!(shoot(DVec3::new(-1.0, 0.2, 0.0), DVec3::X).is_none());
        let short = Ray::new(above, DVec3::NEG_Z).up_to(1.0);
        assert!(intersect(&PreparedRay::new(&short), &CORNERS, 0).is_none());
    }

    #[test]
    fn edges_and_corners_belong_to_the_triangle() {
        for (x, y) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.5, 0.5), (0.25, 0.0), (0.0, 0.125)] {
            let below = DVec3::new(x, y, -2.0);
            assert!(shoot(below, DVec3::Z).is_some(), "({x}, {y})");
        }
    }
}
