//! Coherent rays traced as groups of up to 128 with one traversal (Reshetov, Soupikov and Hurley
//! 2005, "Multi-level ray tracing algorithm", SIGGRAPH).
//!
//! Photons that leave a lamp in nearly the same direction meet the same boxes and triangles. A box
//! is tested against the shaft around all rays of a group, here for all eight children of a node at
//! once, and a triangle against the range of all directions before it is tested against eight rays
//! at a time. As for single rays, this only proposes candidates; the arithmetic of
//! [`crate::intersect()`] decides, four rays at a time, with the same bits. Where the rays diverge
//! the shaft holds too many triangles, and the group is given up.
//!
//! Modules: `coherence` finds rays that form a group, `rays` stores them by coordinate, `shaft`
//! bounds them by planes, `triangle_tester` tests triangles, `candidates` collects possible hits,
//! `traverse` walks the hierarchy, `decide` decides the hits, `group_size` adapts the size.

mod candidates;
mod coherence;
mod decide;
mod group_size;
mod rays;
mod shaft;
mod traverse;
mod triangle_tester;

use crate::Hit;
use crate::lanes::Lanes;
use crate::simd_level::{SimdLevel, SimdTask};
use candidates::GroupCandidates;
pub(crate) use coherence::{RayGroup, RayRun};
pub(crate) use group_size::{Diverged, GroupSize};
use rays::Rays;
use shaft::Shaft;
use triangle_tester::{CommonOrigin, SeparateOrigins};

/// Memory for the rays of a group and their candidates, used again for each group.
pub(crate) struct GroupTracer {
    rays: Rays,
    candidates: GroupCandidates,
}

/// Places of the answers of rays: closest hits, or whether there is any.
pub(crate) enum Answers<'a> {
    Closest(&'a mut [Option<Hit>]),
    Occluded(&'a mut [bool]),
}

/// The way of one group.
struct GroupTask<'a> {
    tracer: &'a mut GroupTracer,
    group: RayGroup<'a>,
    answers: Answers<'a>,
}

impl SimdTask for GroupTask<'_> {
    type Result = Result<usize, Diverged>;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Self::Result {
        self.tracer.trace::<L>(self.group, self.answers)
    }
}

impl GroupTracer {
    pub(crate) fn new() -> Self {
        Self { rays: Rays::new(), candidates: GroupCandidates::new() }
    }

    /// Answers a run of rays, and returns what that cost by [`GroupSize`]'s measure.
    #[inline(always)]
    pub(crate) fn answer(
        &mut self,
        simd: SimdLevel,
        group: RayGroup<'_>,
        answers: Answers<'_>,
    ) -> Result<usize, Diverged> {
        simd.run(GroupTask { tracer: self, group, answers })
    }

    #[inline(always)]
    fn trace<L: Lanes>(
        &mut self,
        group: RayGroup<'_>,
        answers: Answers<'_>,
    ) -> Result<usize, Diverged> {
        let Self { rays, candidates } = self;
        rays.fill(group.frame, group.shots);
        candidates.clear(rays);
        let shaft = Shaft::<L>::new(rays, group.heading);
        let tree = group.tree;
        let cost = match (&answers, rays.one_origin) {
            (Answers::Closest(_), true) => tree.traverse_group::<L, _, false>(
                rays,
                &shaft,
                &CommonOrigin::new(rays, &shaft),
                candidates,
            ),
            (Answers::Closest(_), false) => {
                tree.traverse_group::<L, _, false>(rays, &shaft, &SeparateOrigins, candidates)
            }
            (Answers::Occluded(_), true) => tree.traverse_group::<L, _, true>(
                rays,
                &shaft,
                &CommonOrigin::new(rays, &shaft),
                candidates,
            ),
            (Answers::Occluded(_), false) => {
                tree.traverse_group::<L, _, true>(rays, &shaft, &SeparateOrigins, candidates)
            }
        }?;
        match answers {
            Answers::Closest(hits) => candidates.decide_closest::<L::Quad>(group, rays, hits),
            Answers::Occluded(occluded) => candidates.decide_any(group, rays, occluded),
        }
        Ok(cost)
    }
}
