//! Rays and ray segments.

use glam::DVec3;

/// A ray: the points `origin + t direction` for `0 < t < t_max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts, in m.
    pub origin: DVec3,
    /// Unit direction.
    pub direction: DVec3,
    /// Where it ends, in m; infinite unless told.
    pub t_max: f64,
}

impl Ray {
    /// The endless ray from `origin` along the unit vector `direction`.
    #[must_use]
    pub const fn new(origin: DVec3, direction: DVec3) -> Self {
        Self { origin, direction, t_max: f64::INFINITY }
    }

    /// This ray, ending before the distance `t_max`.
    #[must_use]
    pub const fn up_to(self, t_max: f64) -> Self {
        Self { t_max, ..self }
    }

    /// The point at distance `t`.
    #[must_use]
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + self.direction * t
    }
}

/// A ray with the triangles that it cannot hit, one of many that are traced together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayQuery {
    /// The ray.
    pub ray: Ray,
    /// Indices of triangles that do not count; [`Self::NONE`] for none.
    pub excluded: [u32; 2],
}

impl RayQuery {
    /// No triangle.
    pub const NONE: u32 = u32::MAX;
}
