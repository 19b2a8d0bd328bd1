//! Rays that travel together, up to [`MAX_GROUP`] at a time.
//!
//! Photons that leave a lamp in nearly the same direction meet the same boxes and the same triangles. So
//! what is alike is candidates out once for all of them: a box is held against the shaft around the
//! rays (Reshetov, Soupikov and Hurley 2005, "Multi-level ray tracing algorithm", SIGGRAPH; here
//! for all eight children of a node at once), and a triangle against the directions of all rays
//! before it is held against eight rays at a time. As for single rays, all of this only proposes; the
//! arithmetic of [`crate::intersect()`] decides, four rays at a time, with the same bits.
//!
//! Where rays part the shaft holds too much; then they are given up as a group.
//!
//! Where what is: `run` finds rays that belong together, `rays` has them by coordinate, `shaft` is
//! what surrounds them, `tester` what they see of triangles, `candidates` what they may hit, `walk` their
//! way, `decide` the decision, `group_size` how many of them go together.

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

/// Rays and what they candidates, for one group after the other.
pub(crate) struct GroupTracer {
    rays: Rays,
    candidates: GroupCandidates,
}

/// What is asked of the rays, and where answers go.
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
