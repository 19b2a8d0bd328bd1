//! The way of a ray through the hierarchy.
//!
//! Children are met nearest first; the others that the ray meets wait on a stack with the distance
//! at which it enters them, and are dropped there once a nearer hit is known. What may be hit in a
//! block is told apart from what cannot be in single precision, with room for every rounding
//! ([`crate::node::Slack`]); what is left is not decided here.

use crate::Corners;
use crate::frame::FrameRay;
use crate::lanes::{Lanes, Portable};
use crate::node::{Block, Child, NONE, Node, WIDTH};
use crate::pending::{Candidate, Pending};
use crate::sight::{Sight, Slabs};
use std::mem::MaybeUninit;

/// No tree is deeper than this; the builder sees to it.
pub(crate) const MAX_DEPTH: usize = 64;

/// Each level leaves at most seven children waiting, and eight more may be written behind them.
pub(crate) const STACK: usize = MAX_DEPTH * (WIDTH - 1) + WIDTH;

/// Nodes and blocks, and what they are about; the first node is the root.
pub(crate) struct Tree {
    pub(crate) nodes: Vec<Node>,
    pub(crate) blocks: Vec<Block>,
    pub(crate) corners: Vec<Corners>,
}

/// What is asked.
pub(crate) struct Query {
    pub(crate) ray: FrameRay,
    /// Triangles that do not count.
    pub(crate) excluded: [u32; 2],
    /// Whether there are more that do not count, which whoever decides must know; until then none is
    /// hit for sure.
    pub(crate) excludes_more: bool,
}

/// Which instructions are used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kernel {
    /// Those of every machine.
    Portable,
    /// AVX2 and fused multiply-add of x86-64.
    #[cfg(target_arch = "x86_64")]
    Avx2,
    /// The masks of AVX-512 (F, VL, DQ), eight numbers wide.
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Kernel {
    /// The fastest one on this machine, as far as that is known: [`Self::Avx512`] was never timed, and
    /// Embree is slower with it than with AVX2 on rays like ours.
    #[must_use]
    pub fn fastest() -> Self {
        #[cfg(target_arch = "x86_64")]
        if crate::lanes::Avx2::is_supported() {
            return Self::Avx2;
        }
        Self::Portable
    }

    /// All that this machine can run.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let mut all = vec![Self::Portable];
        #[cfg(target_arch = "x86_64")]
        {
            all.extend(crate::lanes::Avx2::is_supported().then_some(Self::Avx2));
            all.extend(crate::lanes::Avx512::is_supported().then_some(Self::Avx512));
        }
        all
    }
}

impl Tree {
    /// Collects every triangle that can be the closest hit, none of `excluded`, and returns an end behind
    /// which none of them is hit.
    #[inline(always)]
    pub(crate) fn closest(&self, kernel: Kernel, query: &Query, pending: &mut Pending) -> f32 {
        self.walk_with::<false>(kernel, query, pending)
    }

    /// Whether the ray hits any triangle but `excluded` for sure; if not, collects those that it may hit.
    #[inline(always)]
    pub(crate) fn any(&self, kernel: Kernel, query: &Query, pending: &mut Pending) -> bool {
        self.walk_with::<true>(kernel, query, pending) < 0.0
    }

    #[inline(always)]
    fn walk_with<const ANY: bool>(
        &self,
        kernel: Kernel,
        query: &Query,
        pending: &mut Pending,
    ) -> f32 {
        match kernel {
            Kernel::Portable => self.walk::<Portable, ANY>(query, pending),
            #[cfg(target_arch = "x86_64")]
            // SAFETY: this kernel is only chosen where the features are there.
            Kernel::Avx2 => unsafe { self.walk_avx2::<ANY>(query, pending) },
            #[cfg(target_arch = "x86_64")]
            // SAFETY: this kernel is only chosen where the features are there.
            Kernel::Avx512 => unsafe { self.walk_avx512::<ANY>(query, pending) },
        }
    }

    /// # Safety
    /// The machine must have what [`crate::lanes::Avx2::is_supported`] asks for.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    unsafe fn walk_avx2<const ANY: bool>(&self, query: &Query, pending: &mut Pending) -> f32 {
        self.walk::<crate::lanes::Avx2, ANY>(query, pending)
    }

    /// # Safety
    /// The machine must have what [`crate::lanes::Avx512::is_supported`] asks for.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f,avx512vl,avx512dq,avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    unsafe fn walk_avx512<const ANY: bool>(&self, query: &Query, pending: &mut Pending) -> f32 {
        self.walk::<crate::lanes::Avx512, ANY>(query, pending)
    }

    /// The end of the search; negative where any hit was asked for and found.
    #[inline(always)]
    fn walk<L: Lanes, const ANY: bool>(&self, query: &Query, pending: &mut Pending) -> f32 {
        let slabs = Slabs::<L>::new(&query.ray);
        let sight = Sight::<L>::new(&query.ray);
        let [one, other] = query.excluded;
        let mut end = query.ray.end;
        let mut waiting_at = [const { MaybeUninit::<f32>::uninit() }; STACK];
        let mut waiting = [const { MaybeUninit::<Child>::uninit() }; STACK];
        let mut count = 0;
        let mut child = Child::node(0);
        loop {
            if child.is_block() {
                // SAFETY: the children of a valid tree exist.
                let block = unsafe { self.blocks.get_unchecked(child.index()) };
                let view = sight.view(block, end);
                let counted = L::differ(&block.triangles, [one, other, NONE]);
                let mut possible = view.possible() & counted;
                if possible != 0 {
                    let sure = if query.excludes_more { 0 } else { view.sure() };
                    if ANY && possible & sure != 0 {
                        return -1.0;
                    }
                    let bounds = view.bounds();
                    while possible != 0 {
                        let lane = possible.trailing_zeros() as usize % WIDTH;
                        possible &= possible - 1;
                        let is_sure = sure >> lane & 1 == 1;
                        let latest = if is_sure { bounds.latest(lane) } else { f32::INFINITY };
                        end = if latest < end { latest } else { end };
                        let triangle = block.triangles[lane];
                        prefetch(&self.corners, triangle as usize);
                        let earliest = bounds.earliest(lane);
                        pending.push(Candidate { triangle, earliest }, latest);
                    }
                }
            } else {
                // SAFETY: the children of a valid tree exist.
                let node = unsafe { self.nodes.get_unchecked(child.index()) };
                let (near, far) = slabs.cross(node, end);
                let met = near.at_most(far);
                if met != 0 {
                    let nearest = near.smallest(far);
                    let others = met & !(1 << nearest);
                    debug_assert!(count + WIDTH <= STACK);
                    // SAFETY: a valid tree is not deeper than `MAX_DEPTH`, so that eight more have
                    // room; `nearest` is a lane.
                    unsafe {
                        let to = waiting_at.as_mut_ptr().add(count).cast();
                        let to_children = waiting.as_mut_ptr().add(count).cast();
                        near.compress(&node.children, others, to, to_children);
                        count += others.count_ones() as usize;
                        child = *node.children.get_unchecked(nearest);
                    }
                    continue;
                }
            }
            loop {
                if count == 0 {
                    return end;
                }
                count -= 1;
                // SAFETY: everything below `count` was written.
                unsafe {
                    if waiting_at.get_unchecked(count).assume_init() <= end {
                        child = waiting.get_unchecked(count).assume_init();
                        break;
                    }
                }
            }
        }
    }
}

/// Has the processor fetch an element of a list.
#[inline(always)]
pub(crate) fn prefetch<T>(list: &[T], index: usize) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        const LINE: usize = 64;
        let at = list.as_ptr().wrapping_add(index).cast::<i8>();
        for line in 0..size_of::<T>().div_ceil(LINE) {
            // SAFETY: prefetching does not fault, whatever the address.
            unsafe { _mm_prefetch::<_MM_HINT_T0>(at.wrapping_add(LINE * line)) };
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (list, index);
}
