//! Watertight ray-triangle queries on an eight-wide bounding volume hierarchy (BVH).
//!
//! The interface is narrow: [`TriangleBvh::closest_hit`] and [`TriangleBvh::is_occluded`], and both
//! for batches of rays. The hierarchy works in single precision with bounds on every rounding error
//! and proposes candidates; one rule in double precision, [`intersect`], decides hit, distance and
//! barycentric coordinates, and ties go to the lowest triangle index. So the results equal brute
//! force to the last bit, and hierarchy and instructions can be replaced without changing a digit.
//!
//! Modules: `build` builds the hierarchy (surface area heuristic, spatial splits), `node` is its
//! layout in memory, `frame` has the single-precision coordinates and the bounds of their rounding,
//! `lanes` the vector instructions, `ray_simd` the tests of one ray against eight boxes or
//! triangles, `traverse` the traversal of one ray, `candidates` the triangles that await the
//! decision, `exact` the decision where rounding would matter, `stream` many interleaved rays,
//! `group` coherent rays.
//!
//! However nearly edge-on a triangle is seen, the decision returns a point of both triangle and
//! ray, by which its candidates are bounded (`intersect`, `exact`): the hierarchy never differs
//! from brute force, and no ray leaves a closed mesh. Limits: coordinates below 1e300 in size, and
//! directions of unit length; the result for other directions is unspecified, but the query ends.
//! Photon paths in a kitchen take 1.18 decisions a ray, some 7 % of the time of single rays.
//!
//! ```
//! use glam::DVec3;
//! use quasilux_bvh::{Ray, TriangleBvh};
//!
//! let floor = [DVec3::ZERO, DVec3::X, DVec3::Y];
//! let bvh = TriangleBvh::build(vec![floor]);
//! let ray = Ray::new(DVec3::new(0.25, 0.25, 2.0), DVec3::NEG_Z);
//! assert_eq!(bvh.closest_hit(&ray, &[]).unwrap().distance, 2.0);
//! assert!(!bvh.is_occluded(&ray.up_to(1.5), &[]));
//! ```

mod batch;
mod build;
mod candidates;
mod coverage;
mod exact;
mod frame;
mod group;
mod huge_pages;
mod intersect;
mod lanes;
mod node;
mod prefetch;
mod ray;
mod ray_simd;
mod simd_level;
mod stream;
mod traversal_stack;
mod traverse;
mod triangle_bvh;
mod validate;

pub use glam::DVec3;
pub use intersect::{Corners, Hit, PreparedRay, intersect};
pub use ray::{Ray, RayQuery};
pub use simd_level::SimdLevel;
pub use triangle_bvh::TriangleBvh;
