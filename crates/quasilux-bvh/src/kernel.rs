//! Candidates from a hierarchy in single precision.
//!
//! The hierarchy is the binary one of the crate `obvhs` (PLOC, Meister and Bittner 2018, with
//! reinsertion); its eight-wide compressed one loses hits just in front of flat boxes. It is built
//! over boxes that are grown by a bound on every rounding that single precision adds to a query.
//! With `e` the half-size of everything about its centre, origins within `2 e` of it, distances up
//! to `5.2 e` and unit round-off `h = 2^-24`, a query is off by at most: `2 h e` from the origin,
//! `(h + 2 h) 5.2 e` from the direction and from the smallest direction component that `obvhs` tells
//! from zero, and about `16 h e` from the slab arithmetic; `64 h e` covers them nearly twice.

use crate::{Hit, PreparedRay, Ray, intersect};
use glam::{DVec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use obvhs::ray::RayHit;

/// Box growth as a share of the half-size of everything: 64 units of round-off.
const GROWTH: f64 = 64.0 / (1 << 24) as f64;

/// Rays may start this many half-sizes from the centre; the slow twin answers the others.
const REACH: f64 = 2.0;

/// A triangle mesh that answers ray queries.
pub struct TriangleBvh {
    hierarchy: Option<Bvh2>,
    /// Corners in the order of the hierarchy's leaves.
    corners: Vec<[DVec3; 3]>,
    /// Original index of each triangle, in the order of the hierarchy's leaves.
    triangle_of: Vec<u32>,
    centre: DVec3,
    half_size: f64,
}

impl TriangleBvh {
    /// Builds the hierarchy over triangles with finite corners.
    ///
    /// # Panics
    /// With more than 2^31 triangles.
    #[must_use]
    pub fn build(corners: Vec<[DVec3; 3]>) -> Self {
        assert!(corners.len() <= 1 << 31, "too many triangles for 32-bit indices");
        let Some(&[first, ..]) = corners.first() else {
            return Self {
                hierarchy: None,
                corners,
                triangle_of: Vec::new(),
                centre: DVec3::ZERO,
                half_size: 0.0,
            };
        };
        let points = corners.iter().flatten();
        let (low, high) = points.fold((first, first), |(low, high), &p| (low.min(p), high.max(p)));
        let centre = 0.5 * (low + high);
        let half_size = (0.5 * (high - low)).max_element().max(f64::MIN_POSITIVE);
        let growth = DVec3::splat(GROWTH * half_size);
        let boxes: Vec<Aabb> = corners
            .iter()
            .map(|&[a, b, c]| Aabb {
                min: (a.min(b).min(c) - centre - growth).as_vec3a(),
                max: (a.max(b).max(c) - centre + growth).as_vec3a(),
            })
            .collect();
        let hierarchy = build_bvh2(&boxes, BvhBuildParams::medium_build(), &mut Default::default());
        let triangle_of = hierarchy.primitive_indices.clone();
        let corners = triangle_of.iter().map(|&t| corners[t as usize]).collect();
        Self { hierarchy: Some(hierarchy), corners, triangle_of, centre, half_size }
    }

    /// The nearest triangle that the ray hits, none of `excluded`; ties go to the lowest index.
    #[must_use]
    pub fn closest_hit(&self, ray: &Ray, excluded: &[u32]) -> Option<Hit> {
        let (Some(hierarchy), Some(query)) = (&self.hierarchy, self.single_precision(ray)) else {
            return self.closest_hit_by_brute_force(ray, excluded);
        };
        let prepared = PreparedRay::new(ray);
        let mut best: Option<Hit> = None;
        hierarchy.ray_traverse(query, &mut RayHit::none(), |_, leaf| {
            let found = self.candidate(&prepared, leaf, excluded).filter(|hit| wins(hit, &best));
            match found {
                Some(hit) => {
                    best = Some(hit);
                    distance_above(hit.distance, self.half_size)
                }
                None => f32::INFINITY,
            }
        });
        best
    }

    /// Whether the ray hits any triangle but `excluded`.
    #[must_use]
    pub fn is_occluded(&self, ray: &Ray, excluded: &[u32]) -> bool {
        let (Some(hierarchy), Some(query)) = (&self.hierarchy, self.single_precision(ray)) else {
            return self.closest_hit_by_brute_force(ray, excluded).is_some();
        };
        let prepared = PreparedRay::new(ray);
        !hierarchy.ray_traverse_miss(query, |_, leaf| {
            match self.candidate(&prepared, leaf, excluded) {
                Some(_) => f32::NEG_INFINITY,
                None => f32::INFINITY,
            }
        })
    }

    /// The slow twin of [`Self::closest_hit`]: every triangle is tried.
    #[must_use]
    pub fn closest_hit_by_brute_force(&self, ray: &Ray, excluded: &[u32]) -> Option<Hit> {
        let prepared = PreparedRay::new(ray);
        let mut best = None;
        for leaf in 0..self.corners.len() {
            let hit = self.candidate(&prepared, leaf, excluded).filter(|hit| wins(hit, &best));
            best = hit.or(best);
        }
        best
    }

    /// The number of triangles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.corners.len()
    }

    /// Whether there are no triangles.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.corners.is_empty()
    }

    #[inline(always)]
    fn candidate(&self, ray: &PreparedRay, leaf: usize, excluded: &[u32]) -> Option<Hit> {
        let triangle = self.triangle_of[leaf];
        if excluded.contains(&triangle) {
            return None;
        }
        intersect(ray, &self.corners[leaf], triangle)
    }

    /// The ray for the hierarchy, about its centre; `None` where the rounding bound does not hold.
    fn single_precision(&self, ray: &Ray) -> Option<obvhs::ray::Ray> {
        let origin = ray.origin - self.centre;
        if origin.abs().max_element() > REACH * self.half_size {
            return None;
        }
        let end = distance_above(ray.t_max, self.half_size);
        // Adding zero turns -0 into +0, whose octant and inverse have the same sign in `obvhs`.
        let direction = ray.direction.as_vec3a() + Vec3A::ZERO;
        Some(obvhs::ray::Ray::new(origin.as_vec3a(), direction, 0.0, end))
    }
}

/// Whether `hit` comes before the best so far.
#[inline]
fn wins(hit: &Hit, best: &Option<Hit>) -> bool {
    best.is_none_or(|best| {
        hit.distance < best.distance
            || (hit.distance == best.distance && hit.triangle < best.triangle)
    })
}

/// A distance in single precision that no candidate at `distance` or nearer can exceed.
#[inline]
fn distance_above(distance: f64, half_size: f64) -> f32 {
    (distance * (1.0 + GROWTH) + GROWTH * half_size) as f32
}
