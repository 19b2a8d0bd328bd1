//! Single-precision coordinates, and how far they are from the truth.
//!
//! Everything is moved to the centre of all triangles and scaled by a power of two, so that corners
//! lie in the cube [-1, 1]^3 whatever the scene's size and place. Rays that start far outside
//! are moved along their direction until they start within [`REACH`] of the centre in each
//! coordinate. With unit round-off `h = 2^-24`, hits then lie at most `3.7` from the origin
//! in each coordinate and at most `6.5` along the ray.

use crate::Ray;
use glam::{DVec3, Vec3A};

/// Unit round-off of single precision.
pub(crate) const H: f32 = 1.0 / (1 << 24) as f32;

/// Rays start at most this far from the centre, in each coordinate.
pub(crate) const REACH: f64 = 2.7;

/// Longer than any distance between an origin and a hit.
pub(crate) const FAR: f32 = 7.0;

/// Beyond this many half-sizes from the centre the slow twin answers: moving the origin would
/// cost more digits than single precision has.
const MAX_DISTANCE: f64 = (1 << 20) as f64;

/// Direction components are kept this far from zero. A hit moves by at most `6.5 * 2^-32`, which
/// is `h / 39`.
const MIN_COMPONENT: f32 = 1.0 / (1_u64 << 32) as f32;

/// The map from the scene's coordinates to single precision.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    centre: DVec3,
    /// A power of two.
    scale: f64,
}

/// A ray in the frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FrameRay {
    pub(crate) origin: Vec3A,
    pub(crate) direction: Vec3A,
    /// Reciprocals of the direction's components, none of them infinite.
    pub(crate) inverse: Vec3A,
    /// Where the ray ends; not negative.
    pub(crate) end: f32,
    /// How far the origin was moved along the ray.
    pub(crate) moved: f64,
}

/// Outcome of a ray's way into the frame.
pub(crate) enum Framed {
    /// It can be searched for.
    Ray(FrameRay),
    /// It passes everything by.
    Misses,
    /// It starts too far away for the bounds to hold.
    TooFar,
}

impl Frame {
    /// The frame of a box.
    pub(crate) fn new(low: DVec3, high: DVec3) -> Self {
        let half_size = (0.5 * high - 0.5 * low).max_element();
        // 2^-(e + 1) for a half-size in [2^e, 2^(e + 1)), from the exponent's bits.
        let exponent = ((half_size.to_bits() >> 52) as i64 - 1023).clamp(-1000, 1000);
        let scale = f64::from_bits(((1022 - exponent) as u64) << 52);
        Self { centre: 0.5 * low + 0.5 * high, scale }
    }

    /// A point in the frame.
    #[inline(always)]
    pub(crate) fn point(&self, p: DVec3) -> DVec3 {
        (p - self.centre) * self.scale
    }

    /// A ray in the frame.
    #[inline(always)]
    pub(crate) fn ray(&self, ray: &Ray) -> Framed {
        let mut origin = self.point(ray.origin);
        let mut moved = 0.0;
        let beyond = |size: f64| !origin.abs().cmple(DVec3::splat(size)).all();
        if beyond(2.0) {
            if beyond(MAX_DISTANCE) {
                return Framed::TooFar;
            }
            // Nearest approach to the centre; all corners are within sqrt(3) < 1.75 of it.
            let nearest = -origin.dot(ray.direction);
            let approaches =
                nearest >= -1.75 && (origin + ray.direction * nearest).length() <= 1.75;
            if !approaches {
                return Framed::Misses;
            }
            moved = (nearest - 2.0).max(0.0);
            origin += ray.direction * moved;
        }
        debug_assert!(origin.abs().max_element() <= REACH);
        let direction = ray.direction.as_vec3a();
        if !direction.is_finite() {
            return Framed::Misses;
        }
        let kept = direction.abs().max(Vec3A::splat(MIN_COMPONENT)).copysign(direction);
        let mut framed = FrameRay {
            origin: origin.as_vec3a(),
            direction,
            inverse: kept.recip(),
            end: FAR,
            moved,
        };
        framed.end = self.end(moved, ray.t_max);
        if framed.end >= 0.0 { Framed::Ray(framed) } else { Framed::Misses }
    }

    /// A distance in the frame that is not less than `distance` along the ray; not a number where
    /// that is none.
    #[inline(always)]
    pub(crate) fn end(&self, moved: f64, distance: f64) -> f32 {
        // The move is off by less than 2^20 * 2^-50 = h / 64.
        const UP: f64 = 1.0 + 2.0 * H as f64;
        let end = ((distance * self.scale - moved) * UP + H as f64) as f32;
        if end > FAR { FAR } else { end }
    }
}
