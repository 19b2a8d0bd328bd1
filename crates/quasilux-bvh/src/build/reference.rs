//! Triangles as the builder sees them: boxes.

use crate::frame::Frame;
use glam::{DVec3, Vec3A, Vec4};
use rayon::prelude::*;

/// A box in the frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds {
    pub(crate) low: Vec3A,
    pub(crate) high: Vec3A,
}

impl Bounds {
    pub(crate) const EMPTY: Self =
        Self { low: Vec3A::splat(f32::INFINITY), high: Vec3A::splat(f32::NEG_INFINITY) };

    /// The box around both.
    #[inline(always)]
    pub(crate) fn union(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// The box of what both have in common; low planes may come out above high ones.
    #[inline(always)]
    pub(crate) fn intersection(self, other: Self) -> Self {
        Self { low: self.low.max(other.low), high: self.high.min(other.high) }
    }

    /// Half the surface; 0 for an empty box.
    #[inline(always)]
    pub(crate) fn half_area(self) -> f32 {
        let e = (self.high - self.low).max(Vec3A::ZERO);
        e.x * e.y + e.y * e.z + e.z * e.x
    }
}

/// A triangle, or a part of one, and its box.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reference {
    /// The triangle's index is in the bits of the fourth component.
    low: Vec4,
    high: Vec4,
}

impl Reference {
    pub(crate) fn new(triangle: u32, bounds: Bounds) -> Self {
        Self { low: bounds.low.extend(f32::from_bits(triangle)), high: bounds.high.extend(0.0) }
    }

    #[inline(always)]
    pub(crate) fn triangle(&self) -> u32 {
        self.low.w.to_bits()
    }

    #[inline(always)]
    pub(crate) fn bounds(&self) -> Bounds {
        Bounds { low: Vec3A::from_vec4(self.low), high: Vec3A::from_vec4(self.high) }
    }

    /// Twice the centre of the box.
    #[inline(always)]
    pub(crate) fn middle(&self) -> Vec3A {
        Vec3A::from_vec4(self.low) + Vec3A::from_vec4(self.high)
    }
}

/// A reference to each triangle.
pub(crate) fn all(corners: &[[DVec3; 3]], frame: &Frame) -> Vec<Reference> {
    let of = |(triangle, corners): (usize, &[DVec3; 3])| {
        let [a, b, c] = corners.map(|corner| frame.point(corner).as_vec3a());
        let bounds = Bounds { low: a.min(b).min(c), high: a.max(b).max(c) };
        Reference::new(triangle as u32, bounds)
    };
    corners.par_iter().enumerate().map(of).collect()
}

/// The box around all references.
pub(crate) fn bounds(references: &[Reference]) -> Bounds {
    references.par_iter().map(Reference::bounds).reduce(|| Bounds::EMPTY, Bounds::union)
}
