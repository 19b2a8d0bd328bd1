//! What the rays of a group may hit, until it is decided.
//!
//! Nearly every ray has one candidate in the end. That one is kept by ray, and whatever else may be
//! hit in a list of all rays.

use crate::group::rays::{ByRay, Rays, VECTORS};
use crate::lanes::Lanes;
use crate::node::{NONE, WIDTH};
use crate::ray_simd::TriangleTest;

/// A triangle that a ray may hit, and the distance in the frame before which it does not.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ExtraCandidate {
    pub(crate) ray: usize,
    pub(crate) triangle: u32,
    pub(crate) earliest: f32,
}

/// Candidates by ray.
#[repr(C, align(32))]
pub(crate) struct GroupCandidates {
    /// One of each ray, [`NONE`] where there is none.
    pub(crate) one: ByRay<u32>,
    /// The least distance of all of a ray.
    first: ByRay<f32>,
    /// A bit for each ray that hits something for sure, where no more was asked for.
    pub(crate) occluded: [u32; VECTORS],
    pub(crate) more: Vec<ExtraCandidate>,
}

impl GroupCandidates {
    pub(crate) fn new() -> Self {
        Self {
            one: [[NONE; WIDTH]; VECTORS],
            first: [[f32::INFINITY; WIDTH]; VECTORS],
            occluded: [0; VECTORS],
            more: Vec::new(),
        }
    }

    #[inline(always)]
    pub(crate) fn clear(&mut self, rays: &Rays) {
        for k in 0..rays.vectors {
            self.one[k] = [NONE; WIDTH];
            self.first[k] = [f32::INFINITY; WIDTH];
            self.occluded[k] = 0;
        }
        self.more.clear();
    }

    /// Notes that some of eight rays may hit a triangle.
    #[inline(always)]
    pub(crate) fn note<L: Lanes, const ANY: bool>(
        &mut self,
        rays: &mut Rays,
        k: usize,
        triangle: u32,
        possible: u32,
        test: &TriangleTest<'_, L>,
    ) {
        // A triangle that the builder has split is met more than once.
        let possible = possible & L::differ(&self.one[k], [triangle; 3]);
        if possible == 0 {
            return;
        }
        let sure = test.sure() & possible;
        if ANY {
            self.occluded[k] |= sure;
            rays.active[k] &= !sure;
            let done = L::splat(f32::NEG_INFINITY).or_else(sure, L::load(&rays.end[k]));
            rays.end[k] = done.store();
            if possible != sure {
                self.add(k, triangle, possible & !sure, &test.earliest().store());
            }
            return;
        }
        let (earliest, first) = (test.earliest(), L::load(&self.first[k]));
        let latest = test.latest().or_else(sure, L::splat(f32::INFINITY));
        // One that is hit for sure before all others takes their place.
        let alone = sure & !first.at_most(latest);
        rays.end[k] = latest.min(L::load(&rays.end[k])).store();
        self.first[k] = earliest.or_else(alone, first).store();
        L::put(&mut self.one[k], alone, triangle);
        if possible != alone {
            self.add(k, triangle, possible & !alone, &earliest.store());
        }
    }

    #[inline(never)]
    fn add(&mut self, k: usize, triangle: u32, rays: u32, earliest: &[f32; WIDTH]) {
        for lane in (0..WIDTH).filter(|lane| rays >> lane & 1 == 1) {
            let (one, first) = (&mut self.one[k][lane], &mut self.first[k][lane]);
            let earliest = earliest[lane];
            if *one == NONE {
                *one = triangle;
            } else {
                self.more.push(ExtraCandidate { ray: k * WIDTH + lane, triangle, earliest });
            }
            *first = first.min(earliest);
        }
    }
}
