//! Triangle references of the builder: a triangle index with the box of its part.

use crate::frame::Frame;
use glam::{DVec3, Vec3A, Vec4};
use rayon::prelude::*;

/// Lists of references longer than this are gone through on all threads, in parts of a quarter of
/// it.
const PARALLEL: usize = 1 << 16;

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

    /// The box around this one and a point.
    #[inline(always)]
    pub(crate) fn and(self, p: Vec3A) -> Self {
        Self { low: self.low.min(p), high: self.high.max(p) }
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

/// The boxes around references and around their middles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    pub(crate) bounds: Bounds,
    pub(crate) middles: Bounds,
}

impl Extent {
    pub(crate) const EMPTY: Self = Self { bounds: Bounds::EMPTY, middles: Bounds::EMPTY };

    pub(crate) fn new(references: &[Reference]) -> Self {
        let part = |references: &[Reference]| {
            references.iter().fold(Self::EMPTY, |extent, reference| Self {
                bounds: extent.bounds.union(reference.bounds()),
                middles: extent.middles.and(reference.middle()),
            })
        };
        let union = |one: Self, other: Self| Self {
            bounds: one.bounds.union(other.bounds),
            middles: one.middles.union(other.middles),
        };
        in_parts(references, part, union)
    }
}

/// A triangle, or a part of one, and its box.
#[derive(Clone, Copy, Debug, Default)]
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

/// A reference to each triangle, and after them room for this many more.
pub(crate) fn all(corners: &[[DVec3; 3]], frame: &Frame, spare: usize) -> Vec<Reference> {
    let of = |(triangle, corners): (usize, &[DVec3; 3])| {
        let [a, b, c] = corners.map(|corner| frame.point(corner).as_vec3a());
        Reference::new(triangle as u32, Bounds { low: a, high: a }.and(b).and(c))
    };
    let mut all = Vec::with_capacity(corners.len() + spare);
    corners.par_iter().enumerate().map(of).collect_into_vec(&mut all);
    all.resize(corners.len() + spare, Reference::default());
    all
}

/// Result of `part` for all references, where it may be computed for parts of them that `union`
/// puts together.
pub(crate) fn in_parts<R: Send>(
    references: &[Reference],
    part: impl Fn(&[Reference]) -> R + Send + Sync,
    union: impl Fn(R, R) -> R + Send + Sync,
) -> R {
    if references.len() <= PARALLEL {
        return part(references);
    }
    let parts = references.par_chunks(PARALLEL / 4).map(part);
    parts.reduce_with(union).expect("a long list has parts")
}
