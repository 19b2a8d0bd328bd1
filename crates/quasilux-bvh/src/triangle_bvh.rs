//! The bounding volume hierarchy over a triangle mesh, and its queries.

use crate::build::{Leaf, WideTree, build, collapse};
use crate::candidates::Candidates;
use crate::frame::{Frame, FrameRay, Framed};
use crate::huge_pages::vec_in_huge_pages;
use crate::node::{Block, FramedTriangle, NONE, Node};
use crate::simd_level::SimdLevel;
use crate::traverse::{Query, Tree};
use crate::validate::validate;
use crate::{Corners, Hit, PreparedRay, Ray, intersect};
use glam::DVec3;
use rayon::prelude::*;

/// Corners are smaller, so that their differences and the frame's bounds are numbers.
const MAX_COORDINATE: f64 = 1e300;

/// A triangle mesh that answers ray queries.
pub struct TriangleBvh {
    pub(crate) frame: Frame,
    pub(crate) tree: Tree,
    pub(crate) simd: SimdLevel,
}

impl TriangleBvh {
    /// Builds the hierarchy over triangles with corners below `1e300` in size.
    ///
    /// # Panics
    /// With more than 2^30 triangles, and for corners that are not below `1e300` in size.
    #[must_use]
    pub fn build(corners: Vec<[DVec3; 3]>) -> Self {
        Self::build_for(corners, SimdLevel::fastest())
    }

    /// Builds the hierarchy as [`Self::build`] does, for a kernel of choice, which must be one of
    /// [`SimdLevel::all`].
    ///
    /// # Panics
    /// As [`Self::build`], and for a kernel that this machine does not have.
    #[must_use]
    pub fn build_for(corners: Vec<[DVec3; 3]>, simd: SimdLevel) -> Self {
        assert!(SimdLevel::all().contains(&simd), "{simd:?} is not on this machine");
        assert!(corners.len() <= 1 << 30, "too many triangles for 32-bit indices");
        let are_small = |&p: &DVec3| p.abs().cmplt(DVec3::splat(MAX_COORDINATE)).all();
        let all_are_small = corners.par_iter().all(|corners| corners.iter().all(are_small));
        assert!(all_are_small, "a corner is not below {MAX_COORDINATE:e} in size");
        let points = corners.par_iter().flatten_iter().map(|&p| (p, p));
        let bounds = points.reduce_with(|a, b| (a.0.min(b.0), a.1.max(b.1)));
        let (low, high) = bounds.unwrap_or_default();
        let frame = Frame::new(low, high);
        let tree = if corners.is_empty() {
            WideTree { nodes: vec![Node::EMPTY], leaves: vec![Leaf::new([].into_iter())] }
        } else {
            collapse(&build(&corners, frame))
        };
        let block = |leaf: &Leaf| {
            let framed = |&triangle: &u32| {
                let corners = corners[triangle as usize].map(|p| frame.point(p));
                FramedTriangle { triangle, corners }
            };
            Block::new(leaf.triangles().iter().map(framed))
        };
        let mut blocks = vec_in_huge_pages(tree.leaves.len());
        tree.leaves.par_iter().map(block).collect_into_vec(&mut blocks);
        let mut nodes = vec_in_huge_pages(tree.nodes.len());
        nodes.extend(tree.nodes);
        let corners = corners.into_par_iter().map(Corners::new).collect();
        Self { frame, tree: Tree { nodes, blocks, corners }, simd }
    }

    /// The nearest triangle that the ray hits, none of `excluded`; ties go to the lowest index.
    #[must_use]
    pub fn closest_hit(&self, ray: &Ray, excluded: &[u32]) -> Option<Hit> {
        let query = match self.frame.ray(ray) {
            Framed::Ray(framed) => query(framed, excluded),
            Framed::Misses => return None,
            Framed::TooFar => return self.closest_hit_by_brute_force(ray, excluded),
        };
        let mut candidates = Candidates::new();
        let mut end = self.tree.closest(self.simd, &query, &mut candidates);
        let prepared = PreparedRay::new(ray);
        let mut best = None;
        while let Some(candidate) = candidates.pop() {
            if candidate.earliest <= end
                && let Some(hit) = self.decide(&prepared, candidate.triangle, excluded)
                && hit.precedes(&best)
            {
                end = end.min(self.frame.end(query.ray.moved, hit.distance));
                best = Some(hit);
            }
        }
        best
    }

    /// Whether the ray hits any triangle but `excluded`.
    #[must_use]
    pub fn is_occluded(&self, ray: &Ray, excluded: &[u32]) -> bool {
        let query = match self.frame.ray(ray) {
            Framed::Ray(framed) => query(framed, excluded),
            Framed::Misses => return false,
            Framed::TooFar => return self.closest_hit_by_brute_force(ray, excluded).is_some(),
        };
        let mut candidates = Candidates::new();
        if self.tree.any(self.simd, &query, &mut candidates) {
            return true;
        }
        let prepared = PreparedRay::new(ray);
        while let Some(candidate) = candidates.pop() {
            if self.decide(&prepared, candidate.triangle, excluded).is_some() {
                return true;
            }
        }
        false
    }

    /// The slow twin of [`Self::closest_hit`]: every triangle is tried.
    #[must_use]
    pub fn closest_hit_by_brute_force(&self, ray: &Ray, excluded: &[u32]) -> Option<Hit> {
        let prepared = PreparedRay::new(ray);
        let mut best = None;
        for triangle in 0..self.len() as u32 {
            let hit = self.decide(&prepared, triangle, excluded).filter(|hit| hit.precedes(&best));
            best = hit.or(best);
        }
        best
    }

    #[inline(always)]
    pub(crate) fn decide(&self, ray: &PreparedRay, triangle: u32, excluded: &[u32]) -> Option<Hit> {
        if excluded.contains(&triangle) {
            return None;
        }
        intersect(ray, &self.tree.corners[triangle as usize], triangle)
    }

    /// Checks everything that queries rely on, and that no part of a triangle is out of their
    /// sight.
    ///
    /// # Errors
    /// The first flaw that is found, which is a defect of the builder.
    pub fn validate(&self) -> Result<(), String> {
        validate(&self.tree, &self.frame)
    }

    /// The number of triangles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.tree.corners.len()
    }

    /// Whether there are no triangles.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.tree.corners.is_empty()
    }
}

/// Excluded triangles that the traversal itself leaves out.
fn query(ray: FrameRay, excluded: &[u32]) -> Query {
    let at = |i: usize| excluded.get(i).copied().unwrap_or(NONE);
    Query { ray, excluded: [at(0), at(1)], excludes_more: excluded.len() > 2 }
}
