//! The traversal of the hierarchy by a group of rays.
//!
//! As that of a ray ([`crate::traverse`]), with a shaft in its place: children are met in the order
//! of the depth at which their boxes begin, and none that begins behind the ends of all rays.

use crate::group::candidates::GroupCandidates;
use crate::group::group_size::{BLOCK, Diverged, GroupSize, NODE, TRIAL};
use crate::group::rays::Rays;
use crate::group::shaft::Shaft;
use crate::group::triangle_tester::{BlockTest, TriangleTester};
use crate::lanes::Lanes;
use crate::node::{Child, Node, WIDTH};
use crate::prefetch::prefetch;
use crate::ray_simd::Crossing;
use crate::traversal_stack::TraversalStack;
use crate::traverse::Tree;

impl Tree {
    /// Collects the triangles that each ray of a group may hit, and returns the cost in the units
    /// of [`GroupSize`].
    ///
    /// # Errors
    /// [`Diverged`] once the rays cost as much as single rays would.
    #[inline(always)]
    pub(crate) fn traverse_group<L: Lanes, E: TriangleTester<L>, const ANY: bool>(
        &self,
        rays: &mut Rays,
        shaft: &Shaft<L>,
        tester: &E,
        candidates: &mut GroupCandidates,
    ) -> Result<usize, Diverged> {
        let limit = GroupSize::limit(rays.vectors);
        let mut cost = 0;
        let mut depth = shaft.depth(rays);
        let mut stack = TraversalStack::new();
        let mut child = Child::node(0);
        loop {
            if child.is_block() {
                // SAFETY: the children of a valid tree exist.
                let block = unsafe { self.blocks.get_unchecked(child.index()) };
                let BlockTest { prepared, mut met } = tester.test_block(shaft, block, depth);
                cost += BLOCK + met.count_ones() as usize * rays.vectors * TRIAL;
                let mut is_new = false;
                while met != 0 {
                    let lane = met.trailing_zeros() as usize % WIDTH;
                    met &= met - 1;
                    let triangle = tester.prepare(&prepared, block, lane);
                    let number = block.triangles[lane];
                    is_new |= self
                        .test_triangle::<L, E, ANY>(rays, tester, &triangle, number, candidates);
                }
                if is_new {
                    depth = shaft.depth(rays);
                }
                if cost > limit {
                    return Err(Diverged);
                }
            } else {
                // SAFETY: the children of a valid tree exist.
                let node = unsafe { self.nodes.get_unchecked(child.index()) };
                cost += NODE;
                let Crossing { near, far } = shaft.cross(node, depth);
                let met = near.at_most(far);
                if met != 0 {
                    self.prefetch(node, met);
                    child = stack.push_children(node, near, far, met);
                    continue;
                }
            }
            match stack.pop(depth) {
                Some(next) => child = next,
                None => return Ok(cost),
            }
        }
    }

    /// Tests all rays of a group against one triangle and records those that may hit it; whether
    /// there are any.
    #[inline(always)]
    fn test_triangle<L: Lanes, E: TriangleTester<L>, const ANY: bool>(
        &self,
        rays: &mut Rays,
        tester: &E,
        triangle: &E::PreparedTriangle,
        number: u32,
        candidates: &mut GroupCandidates,
    ) -> bool {
        let mut is_new = false;
        for k in 0..rays.vectors {
            let test = tester.test(triangle, rays, k);
            let possible = test.possible() & rays.counted::<L>(k, number);
            if possible != 0 {
                is_new = true;
                prefetch(&self.corners, number as usize);
                candidates.note::<L, ANY>(rays, k, number, possible, &test);
            }
        }
        is_new
    }

    /// Has the processor fetch some of the children of a node.
    #[inline(always)]
    fn prefetch(&self, node: &Node, mut children: u32) {
        while children != 0 {
            let child = node.children[children.trailing_zeros() as usize % WIDTH];
            children &= children - 1;
            if child.is_block() {
                prefetch(&self.blocks, child.index());
            } else {
                prefetch(&self.nodes, child.index());
            }
        }
    }
}
