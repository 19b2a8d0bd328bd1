//! The stack of children that a traversal has yet to visit.

use crate::lanes::Lanes;
use crate::node::{Child, Node, WIDTH};
use std::mem::MaybeUninit;

/// No tree is deeper than this; the builder sees to it.
pub(crate) const MAX_DEPTH: usize = 64;

/// Each level leaves at most seven children waiting, and eight more may be written behind them.
const STACK: usize = MAX_DEPTH * (WIDTH - 1) + WIDTH;

/// A stack of children, each with the distance at which it is entered.
pub(crate) struct TraversalStack {
    at: [MaybeUninit<f32>; STACK],
    children: [MaybeUninit<Child>; STACK],
    count: usize,
}

impl TraversalStack {
    #[inline(always)]
    pub(crate) fn new() -> Self {
        Self {
            at: [const { MaybeUninit::uninit() }; STACK],
            children: [const { MaybeUninit::uninit() }; STACK],
            count: 0,
        }
    }

    /// Returns the nearest of the children in `met`, of which there is one at least, and has the
    /// others wait; none of them is entered behind `limit`.
    #[inline(always)]
    pub(crate) fn push_children<L: Lanes>(
        &mut self,
        node: &Node,
        near: L,
        limit: L,
        met: u32,
    ) -> Child {
        let nearest = near.smallest(limit);
        let others = met & !(1 << nearest);
        debug_assert!(self.count + WIDTH <= STACK);
        // SAFETY: a valid tree is not deeper than `MAX_DEPTH`, so that eight more have room;
        // `nearest` is a lane.
        unsafe {
            let to = self.at.as_mut_ptr().add(self.count).cast();
            let to_children = self.children.as_mut_ptr().add(self.count).cast();
            near.compress(&node.children, others, to, to_children);
            self.count += others.count_ones() as usize;
            *node.children.get_unchecked(nearest)
        }
    }

    /// The newest that is not entered behind `end`; those in front of it in the stack are gone.
    #[inline(always)]
    pub(crate) fn pop(&mut self, end: f32) -> Option<Child> {
        while self.count > 0 {
            self.count -= 1;
            // SAFETY: everything below `count` was written.
            unsafe {
                if self.at.get_unchecked(self.count).assume_init() <= end {
                    return Some(self.children.get_unchecked(self.count).assume_init());
                }
            }
        }
        None
    }
}
