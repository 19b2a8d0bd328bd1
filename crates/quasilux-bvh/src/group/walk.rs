//! The way of a group through the hierarchy.
//!
//! As that of a ray ([`crate::traverse`]), with a shaft in its place: children are met in the order of the depth
//! at which their boxes begin, and none that begins behind the ends of all rays.

use crate::group::Parted;
use crate::group::eye::Eye;
use crate::group::found::Found;
use crate::group::pace::{BLOCK, NODE, Pace, TRIAL};
use crate::group::rays::Rays;
use crate::group::shaft::Shaft;
use crate::lanes::Lanes;
use crate::node::{Child, Node, WIDTH};
use crate::prefetch::prefetch;
use crate::traverse::Tree;
use crate::waiting::Waiting;

impl Tree {
    /// Collects what the rays may hit, and returns what that cost.
    #[inline(always)]
    pub(crate) fn walk_together<L: Lanes, E: Eye<L>, const ANY: bool>(
        &self,
        rays: &mut Rays,
        shaft: &Shaft<L>,
        eye: &E,
        found: &mut Found,
    ) -> Result<usize, Parted> {
        let limit = Pace::limit(rays.vectors);
        let mut cost = 0;
        let mut depth = shaft.depth(rays);
        let mut waiting = Waiting::new();
        let mut child = Child::node(0);
        loop {
            if child.is_block() {
                // SAFETY: the children of a valid tree exist.
                let block = unsafe { self.blocks.get_unchecked(child.index()) };
                let (facets, mut met) = eye.facets(shaft, block, depth);
                cost += BLOCK + met.count_ones() as usize * rays.vectors * TRIAL;
                let mut is_new = false;
                while met != 0 {
                    let lane = met.trailing_zeros() as usize % WIDTH;
                    met &= met - 1;
                    let facet = eye.facet(&facets, block, lane);
                    let triangle = block.triangles[lane];
                    for k in 0..rays.vectors {
                        let view = eye.view(&facet, rays, k);
                        let possible = view.possible() & rays.counted::<L>(k, triangle);
                        if possible != 0 {
                            is_new = true;
                            prefetch(&self.corners, triangle as usize);
                            found.note::<L, ANY>(rays, k, triangle, possible, &view);
                        }
                    }
                }
                if is_new {
                    depth = shaft.depth(rays);
                }
                if cost > limit {
                    return Err(Parted);
                }
            } else {
                // SAFETY: the children of a valid tree exist.
                let node = unsafe { self.nodes.get_unchecked(child.index()) };
                cost += NODE;
                let (near, limit) = shaft.cross(node, depth);
                let met = near.at_most(limit);
                if met != 0 {
                    self.prefetch(node, met);
                    child = waiting.enter(node, near, limit, met);
                    continue;
                }
            }
            match waiting.next(depth) {
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
