//! The one function that decides whether a ray hits a triangle.
//!
//! Watertight in the sense of Woop, Benthin and Wald (2013, "Watertight Ray/Triangle
//! Intersection", JCGT 2(1)): vertices are translated and sheared so that the ray becomes the z
//! axis, a map that depends on ray and vertex alone; the sign of an edge function is the comparison
//! of two rounded products, which rounding can turn into a tie but never reverse; and ties count as
//! inside for both neighbours. A ray through a shared edge or vertex hits at least one of the
//! triangles around it.
//!
//! Deviation: the paper decides ties again in double precision. Here all is in double precision,
//! and what is decided again, without rounding ([`crate::exact`]), are triangles seen so nearly
//! edge-on that rounding would decide where on them the hit is. No neighbour disagrees: its rounded
//! signs are the exact ones or ties. Triangles are missed only where they are seen exactly edge-on
//! after the shear, so that neighbours cover what they hide.
//!
//! What a hit promises to a hierarchy: the point of the triangle with the weights returned is the
//! point of the ray at the distance returned, but for rounding. Let the corners be within `D` of
//! the origin and within `S` of each other in each coordinate, and `e = 2^-53`. A sheared corner is
//! off by `6 e D` across the ray and by `3 e` of itself along it, and weighting takes another `6
//! e`, together `15 e D` at most. Rounding moves edge functions by `2 e` of the products in them.
//! Where the double area of the sheared triangle is at least `f` of the sum of all these products'
//! sizes ([`NARROW`]), the weighted corners, each within `2 S` of the ray, are so off it by at most
//! `4 e S / f`; where it is less, by `6 e S`, since relative errors of the weights are then those
//! of a division.

use crate::Ray;
use crate::exact::edge_functions;
use crate::lanes::{PortableQuad, Quad};
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

impl Hit {
    /// Whether this hit is closer than the closest one so far, or as close with a lower index.
    #[inline(always)]
    pub(crate) fn precedes(&self, closest: &Option<Self>) -> bool {
        closest.is_none_or(|closest| {
            self.distance < closest.distance
                || (self.distance == closest.distance && self.triangle < closest.triangle)
        })
    }
}

/// Triangles whose double area after the shear is a smaller share of what it is the difference of
/// are decided without rounding.
const NARROW: f64 = 1.0 / (1 << 20) as f64;

/// More than products lose by underflow, as far as anything this large can see it.
const MIN_AREA: f64 = 1e-180;

/// The axes that follow each, in a circle.
const AFTER: [usize; 3] = [1, 2, 0];
const BEFORE: [usize; 3] = [2, 0, 1];

/// The corners of a triangle axis by axis, so that an instruction can see all three; the fourth
/// place is empty.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub struct Corners([[f64; 4]; 3]);

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
        let (o, d) = (ray.origin.to_array(), ray.direction.to_array());
        let z = longest_axis(ray.direction);
        let (x, y) = if d[z] < 0.0 { (BEFORE[z], AFTER[z]) } else { (AFTER[z], BEFORE[z]) };
        Self {
            origin: [x, y, z].map(|axis| o[axis]),
            t_max: ray.t_max,
            axes: [x, y, z],
            shear: [d[x] / d[z], d[y] / d[z], 1.0 / d[z]],
        }
    }
}

/// The axis along which a direction moves most; among equals the first.
#[inline(always)]
pub(crate) fn longest_axis(direction: DVec3) -> usize {
    let size = direction.to_array().map(f64::abs);
    if size[0] >= size[1] && size[0] >= size[2] {
        0
    } else if size[1] >= size[2] {
        1
    } else {
        2
    }
}

impl Corners {
    /// Coordinates of the corners, axis by axis.
    #[must_use]
    pub fn new([a, b, c]: [DVec3; 3]) -> Self {
        Self([0, 1, 2].map(|axis| [a[axis], b[axis], c[axis], 0.0]))
    }

    /// A coordinate of the three corners.
    #[inline(always)]
    pub(crate) fn along(&self, axis: usize) -> &[f64; 4] {
        &self.0[axis]
    }

    /// The corners as points.
    #[must_use]
    pub fn points(&self) -> [DVec3; 3] {
        let [x, y, z] = self.0;
        [0, 1, 2].map(|corner| DVec3::new(x[corner], y[corner], z[corner]))
    }
}

/// Intersects a ray with a triangle, from either side; `None` beyond `t_max` and for triangles seen
/// exactly edge-on.
///
/// Coordinates must be below `1e300` in size.
#[inline(always)]
#[must_use]
pub fn intersect(ray: &PreparedRay, corners: &Corners, triangle: u32) -> Option<Hit> {
    intersect_with::<PortableQuad>(ray, corners, triangle)
}

/// Intersects as [`intersect`] does, with other instructions, to the same bits.
#[inline(always)]
pub(crate) fn intersect_with<Q: Quad>(
    ray: &PreparedRay,
    corners: &Corners,
    triangle: u32,
) -> Option<Hit> {
    let from_origin = |i: usize| Q::load(&corners.0[ray.axes[i]]).sub(Q::splat(ray.origin[i]));
    // Corners in the sheared frame: the ray runs along the third axis, scaled to its length.
    let along = from_origin(2);
    let sheared = |i: usize| from_origin(i).sub(Q::splat(ray.shear[i]).mul(along));
    let (x, y, z) = (sheared(0), sheared(1), Q::splat(ray.shear[2]).mul(along));
    // The weight of each corner comes from the one before and the one after it.
    let (left, right) = (x.previous().mul(y.next()), y.previous().mul(x.next()));
    let weights = left.sub(right);
    let sum = add_three(weights);
    let results = weights.with_last(add_three(weights.mul(z))).div(sum.first());
    let [u, v, w, distance] = results.store();
    let (below, above) = (weights.below(Q::splat(0.0)), Q::splat(0.0).below(weights));
    // Without branches in between: which of the conditions fails cannot be predicted.
    let mixed = (below & 7 != 0) & (above & 7 != 0);
    let products = add_three(left.abs().add(right.abs()));
    // Overflow comes out as a distance that is not finite.
    let wide = (least_area(products).below(sum.abs()) & 1 != 0) & (distance.abs() < f64::INFINITY);
    if !mixed & !wide {
        return intersect_narrow(ray.t_max, [x, y, z].map(Q::store), triangle);
    }
    let counts = !mixed & (distance > 0.0) & (distance < ray.t_max);
    counts.then_some(Hit { triangle, distance, barycentric: [u, v, w] })
}

/// The double area from which on rounded edge functions will do, given the sum of the sizes of the
/// products in them.
#[inline(always)]
pub(crate) fn least_area<Q: Quad>(products: Q) -> Q {
    products.mul(Q::splat(NARROW)).add(Q::splat(MIN_AREA))
}

/// The hit for sheared corners, axis by axis, without rounding until all signs are known.
#[cold]
#[inline(never)]
fn intersect_narrow(t_max: f64, [x, y, z]: [[f64; 4]; 3], triangle: u32) -> Option<Hit> {
    let edges = edge_functions([0, 1, 2].map(|corner| [x[corner], y[corner]]));
    let mixed = edges.iter().any(|&edge| edge < 0.0) && edges.iter().any(|&edge| edge > 0.0);
    let sum = edges[0] + edges[1] + edges[2];
    if mixed || sum == 0.0 {
        return None;
    }
    let barycentric = edges.map(|edge| edge / sum);
    let [u, v, w] = barycentric;
    let distance = u * z[0] + v * z[1] + w * z[2];
    let counts = (distance > 0.0) & (distance < t_max);
    counts.then_some(Hit { triangle, distance, barycentric })
}

/// The sum of the first three numbers, in their order, in the first lane.
#[inline(always)]
fn add_three<Q: Quad>(numbers: Q) -> Q {
    numbers.add(numbers.next()).add(numbers.previous())
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [DVec3; 3] = [DVec3::ZERO, DVec3::X, DVec3::Y];

    fn shoot(origin: DVec3, direction: DVec3) -> Option<Hit> {
        intersect(
            &PreparedRay::new(&Ray::new(origin, direction.normalize())),
            &Corners::new(CORNERS),
            7,
        )
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
        assert!(intersect(&PreparedRay::new(&short), &Corners::new(CORNERS), 0).is_none());
    }

    #[test]
    fn edges_and_corners_belong_to_the_triangle() {
        for (x, y) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.5, 0.5), (0.25, 0.0), (0.0, 0.125)] {
            let below = DVec3::new(x, y, -2.0);
            assert!(shoot(below, DVec3::Z).is_some(), "({x}, {y})");
        }
    }
}
