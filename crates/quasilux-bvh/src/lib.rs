//! Which triangle does this ray hit.
//!
//! The kernel is narrow on purpose: [`TriangleBvh::closest_hit`] and [`TriangleBvh::is_occluded`].
//! A bounding volume hierarchy in single precision proposes candidates; one scalar function in
//! double precision, [`intersect`], decides hit, distance and barycentric coordinates, and ties go
//! to the lowest triangle index. So the hierarchy can be replaced without changing a digit.
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

mod intersect;
mod kernel;
mod ray;

pub use intersect::{Hit, PreparedRay, intersect};
pub use kernel::TriangleBvh;
pub use ray::Ray;
