//! The way of a group through the hierarchy.
//!
//! As that of a ray ([`crate::traverse`]), with a shaft in its place: children are met in the order of the depth
//! at which their boxes begin, and none that begins behind the ends of all rays.

use crate::group::Diverged;
use crate::group::candidates::GroupCandidates;
use crate::group::group_size::{BLOCK, GroupSize, NODE, TRIAL};
use crate::group::rays::Rays;
use crate::group::shaft::Shaft;
use crate::group::triangle_tester::TriangleTester;
use crate::lanes::Lanes;
use crate::node::{Child, Node, WIDTH};
use crate::prefetch::prefetch;
use crate::traversal_stack::TraversalStack;
use crate::traverse::Tree;

impl Tree {
    /// Collects what the rays may hit, and returns what that cost.
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
                let (prepared, mut met) = tester.test_block(shaft, block, depth);
                cost += BLOCK + met.count_ones() as usize * rays.vectors * TRIAL;
                let mut is_new = false;
                while met != 0 {
                    let lane = met.trailing_zeros() as usize % WIDTH;
                    met &= met - 1;
                    let facet = tester.prepare(&prepared, block, lane);
                    let triangle = block.triangles[lane];
                    for k in 0..rays.vectors {
                        let test = tester.test(&facet, rays, k);
                        let possible = test.possible() & rays.counted::<L>(k, triangle);
                        if possible != 0 {
                            is_new = true;
                            prefetch(&self.corners, triangle as usize);
                            candidates.note::<L, ANY>(rays, k, triangle, possible, &test);
                        }
                    }
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
                let (near, limit) = shaft.cross(node, depth);
                let met = near.at_most(limit);
                if met != 0 {
                    self.prefetch(node, met);
                    child = stack.push_children(node, near, limit, met);
                    continue;
                }
            }
            match stack.pop(depth) {
                Some(next) => child = next,
                None => return Ok(cost),
            }
        }
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
