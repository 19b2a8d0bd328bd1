//! Bins of equal width along each axis, for the surface area heuristic.

use super::reference::Bounds;
use glam::Vec3A;

/// The most bins along an axis, a power of two.
pub(crate) const BINS: usize = 32;

/// The map from places to bins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    low: Vec3A,
    /// Bins per length; 0 along axes that are too short to be divided.
    scale: Vec3A,
    /// The width of a bin.
    width: Vec3A,
    /// Bins along an axis.
    pub(crate) count: usize,
}

impl Grid {
    /// `count` bins over a box, along axes that are longer than `least`.
    pub(crate) fn new(span: Bounds, least: f32, count: usize) -> Self {
        let extent = span.high - span.low;
        let scale = (extent.recip() * count as f32).min(Vec3A::splat(1e30));
        let divides = extent.cmpgt(Vec3A::splat(least));
        let scale = Vec3A::select(divides, scale, Vec3A::ZERO);
        Self { low: span.low, scale, width: extent / count as f32, count }
    }

    pub(crate) fn divides(&self, axis: usize) -> bool {
        self.scale[axis] != 0.0
    }

    /// Where a bin begins.
    #[inline(always)]
    pub(crate) fn plane(&self, axis: usize, bin: usize) -> f32 {
        self.low[axis] + self.width[axis] * bin as f32
    }

    /// The bins of a place along the three axes, the first or last one for what lies outside.
    #[inline(always)]
    pub(crate) fn bins(&self, p: Vec3A) -> [usize; 3] {
        // From here on single precision has integers only, and the last bits tell which one.
        const INTEGERS: f32 = 1.5 * (1 << 23) as f32;
        let at = (p - self.low) * self.scale - Vec3A::splat(0.5);
        let at =
            at.max(Vec3A::ZERO).min(Vec3A::splat(self.count as f32 - 1.0)) + Vec3A::splat(INTEGERS);
        at.to_array().map(|x| x.to_bits() as usize % BINS)
    }
}
