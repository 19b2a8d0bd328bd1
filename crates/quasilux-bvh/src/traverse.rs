//! The traversal of the hierarchy by one ray.
//!
//! Children are met nearest first; the others that the ray meets wait on a stack with the distance
//! at which it enters them, and are dropped there once a nearer hit is known. What may be hit in a
//! block is told apart from what cannot be in single precision, with room for every rounding
//! ([`crate::node::Slack`]); what is left is not decided here.

use crate::Corners;
use crate::candidates::{Candidate, Candidates};
use crate::frame::FrameRay;
use crate::lanes::Lanes;
use crate::node::{Block, Child, NONE, Node, WIDTH};
use crate::prefetch::prefetch;
use crate::ray_simd::{Crossing, RaySimd, Slabs};
use crate::simd_level::{SimdLevel, SimdTask};
use crate::traversal_stack::TraversalStack;

/// Nodes and blocks, and what they are about; the first node is the root.
pub(crate) struct Tree {
    pub(crate) nodes: Vec<Node>,
    pub(crate) blocks: Vec<Block>,
    pub(crate) corners: Vec<Corners>,
}

/// A ray, and the triangles that do not count.
pub(crate) struct Query {
    pub(crate) ray: FrameRay,
    /// Triangles that do not count.
    pub(crate) excluded: [u32; 2],
    /// Whether there are more that do not count, which whoever decides must know; until then none
    /// is hit for sure.
    pub(crate) excludes_more: bool,
}

/// The way of one ray.
struct Traversal<'a, const ANY: bool> {
    tree: &'a Tree,
    query: &'a Query,
    candidates: &'a mut Candidates,
}

impl<const ANY: bool> SimdTask for Traversal<'_, ANY> {
    type Result = f32;

    #[inline(always)]
    fn run<L: Lanes>(self) -> f32 {
        self.tree.traverse::<L, ANY>(self.query, self.candidates)
    }
}

impl Tree {
    /// Collects every triangle that can be the closest hit, none of `excluded`, and returns an end
    /// behind which none of them is hit.
    #[inline(always)]
    pub(crate) fn closest(
        &self,
        simd: SimdLevel,
        query: &Query,
        candidates: &mut Candidates,
    ) -> f32 {
        simd.run(Traversal::<false> { tree: self, query, candidates })
    }

    /// Whether the ray hits any triangle but `excluded` for sure; if not, collects those that it
    /// may hit.
    #[inline(always)]
    pub(crate) fn any(&self, simd: SimdLevel, query: &Query, candidates: &mut Candidates) -> bool {
        simd.run(Traversal::<true> { tree: self, query, candidates }) < 0.0
    }

    /// The end of the search; negative where any hit was asked for and found.
    #[inline(always)]
    fn traverse<L: Lanes, const ANY: bool>(
        &self,
        query: &Query,
        candidates: &mut Candidates,
    ) -> f32 {
        let slabs = Slabs::<L>::new(&query.ray);
        let ray_simd = RaySimd::<L>::new(&query.ray);
        let [one, other] = query.excluded;
        let mut end = query.ray.end;
        let mut stack = TraversalStack::new();
        let mut child = Child::node(0);
        loop {
            if child.is_block() {
                // SAFETY: the children of a valid tree exist.
                let block = unsafe { self.blocks.get_unchecked(child.index()) };
                let test = ray_simd.test(block, end);
                let counted = L::differ(&block.triangles, [one, other, NONE]);
                let mut possible = test.possible() & counted;
                if possible != 0 {
                    let sure = if query.excludes_more { 0 } else { test.sure() };
                    if ANY && possible & sure != 0 {
                        return -1.0;
                    }
                    let (earliest, latest) = (test.earliest().store(), test.latest().store());
                    while possible != 0 {
                        let lane = possible.trailing_zeros() as usize % WIDTH;
                        possible &= possible - 1;
                        let is_sure = sure >> lane & 1 == 1;
                        let latest = if is_sure { latest[lane] } else { f32::INFINITY };
                        end = if latest < end { latest } else { end };
                        let triangle = block.triangles[lane];
                        prefetch(&self.corners, triangle as usize);
                        let earliest = earliest[lane];
                        candidates.push(Candidate { triangle, earliest }, latest);
                    }
                }
            } else {
                // SAFETY: the children of a valid tree exist.
                let node = unsafe { self.nodes.get_unchecked(child.index()) };
                let Crossing { near, far } = slabs.cross(node, end);
                let met = near.at_most(far);
                if met != 0 {
                    child = stack.push_children(node, near, far, met);
                    continue;
                }
            }
            match stack.pop(end) {
                Some(next) => child = next,
                None => return end,
            }
        }
    }
}
