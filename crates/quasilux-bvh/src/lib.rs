//! Which triangle does this ray hit.
//!
//! The kernel is narrow on purpose: [`TriangleBvh::closest_hit`] and [`TriangleBvh::is_occluded`], and
//! both of many rays at once. An eight-wide bounding volume hierarchy in single precision proposes
//! candidates, with room for every rounding; one rule in double precision, that of [`intersect`],
//! decides hit, distance and barycentric coordinates, and ties go to the lowest triangle index. So
//! hierarchy and instructions can be replaced without changing a digit.
//!
//! Where what is: `frame` has the coordinates and the bounds of their rounding, `node` the layout in memory,
//! `build` the builder, `traverse` the way of a ray, `ray_simd` what it sees of eight boxes or triangles,
//! `lanes` the instructions for that, `pending` what waits for the decision, `exact` what decides where
//! rounding would, `stream` many rays at once, `group` those of them that travel together.
//!
//! However nearly edge-on a triangle is seen, the decision returns a point of both triangle and ray, by
//! which its candidates are bounded (`intersect`, `exact`): hierarchy and slow twin never differ, and
//! no ray leaves a closed mesh. Limits: coordinates below 1e300 in size, and directions of unit length;
//! what rays in other directions hit is not said, but they come to an end. Rays of photons in a kitchen
//! ask for 1.18 decisions each, which take some 7 % of their time when traced one by one.
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

pub use intersect::{Corners, Hit, PreparedRay, intersect};
pub use ray::{Ray, Shot};
pub use simd_level::SimdLevel;
pub use triangle_bvh::TriangleBvh;
