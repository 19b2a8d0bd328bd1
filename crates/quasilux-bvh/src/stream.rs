//! Interleaved traversal of many independent rays, which hides memory latency.
//!
//! A ray alone waits most of its time: for memory, for the outcome of a test, and for the processor
//! to come back from a wrong guess of an outcome. So a few rays are in flight together, and each in
//! turn takes a step: through a node, through a block, to a decision or back to what waits for it.
//! A step has next to no branches: what a ray meets is written to its stack whether there is
//! anything to write or not, and the queue for its next step is computed. While others take their
//! steps, memory for its next one arrives.
//!
//! A ray that needs more room than nearly all do leaves, and is traced alone.

use crate::frame::FrameRay;
use crate::lanes::{Lanes, Quad};
use crate::node::{Child, NONE, WIDTH};
use crate::prefetch::prefetch;
use crate::ray_simd::RaySimd;
use crate::simd_level::{SimdLevel, SimdTask};
use crate::traverse::Tree;
use std::hint::select_unpredictable;

/// Rays in flight.
const RAYS_IN_FLIGHT: usize = 24;

/// Children that may wait for a ray.
const ROOM: usize = 24;

/// Where the children that wait begin: behind as many that are none and one that ends the search.
const BOTTOM: usize = WIDTH + 1;

/// Source of rays, which decides what they hit.
pub(crate) trait RaySource {
    /// The next ray.
    fn next_ray(&mut self) -> Option<ActiveRay>;
    /// Decides on triangles that a ray may hit, and returns where the search for others ends; a
    /// negative place ends it.
    fn decide<Q: Quad>(&mut self, active: &ActiveRay, triangles: impl Iterator<Item = u32>) -> f32;
    /// The ray must be traced alone.
    fn trace_alone(&mut self, number: u32);
}

/// A ray and what it is for.
#[derive(Clone, Copy)]
pub(crate) struct ActiveRay {
    pub(crate) ray: FrameRay,
    /// Which one it is.
    pub(crate) number: u32,
    /// Triangles that do not count.
    pub(crate) excluded: [u32; 2],
}

/// A ray on its way.
#[repr(C, align(64))]
struct RayInFlight {
    active: ActiveRay,
    offset: [f32; 3],
    /// Where in a node the planes are that the ray meets first, in bytes.
    first: [u32; 3],
    child: Child,
    /// How many children are in the list of those that wait, the bottom included.
    waiting: u32,
    /// Triangles of the block that the ray may hit, a bit each.
    possible: u32,
    nears: [f32; BOTTOM + ROOM + WIDTH],
    children: [Child; BOTTOM + ROOM + WIDTH],
}

/// Next step of a flight.
type Step = u32;
const NODE: Step = 0;
const POP: Step = 1;
const BLOCK: Step = 2;
const DONE: Step = 3;
const DECISION: Step = 4;

/// Flights by what they do next.
struct Queues {
    slots: [[u32; RAYS_IN_FLIGHT + 1]; 5],
    counts: [u32; 5],
}

impl Queues {
    /// Has a flight wait for its next task.
    #[inline(always)]
    fn enter(&mut self, task: Step, slot: u32) {
        let task = task as usize;
        // SAFETY: there are no more tasks than queues and no more slots than `RAYS_IN_FLIGHT`.
        unsafe {
            let count = self.counts.get_unchecked_mut(task);
            *self.slots.get_unchecked_mut(task).get_unchecked_mut(*count as usize) = slot;
            *count += 1;
        }
    }

    /// Empties a queue and returns how many were in it; what is entered while they are taken comes
    /// behind them.
    #[inline(always)]
    fn take(&mut self, task: Step) -> usize {
        std::mem::take(&mut self.counts[task as usize]) as usize
    }

    #[inline(always)]
    fn slot(&self, task: Step, at: usize) -> u32 {
        // SAFETY: as above.
        unsafe { *self.slots[task as usize].get_unchecked(at) }
    }
}

/// The way of all rays of a source.
struct Stream<'a, V> {
    tree: &'a Tree,
    source: &'a mut V,
}

impl<V: RaySource> SimdTask for Stream<'_, V> {
    type Result = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        self.tree.trace_stream::<L>(self.source);
    }
}

impl Tree {
    /// Takes all rays of a source through the tree.
    pub(crate) fn stream(&self, simd: SimdLevel, source: &mut impl RaySource) {
        simd.run(Stream { tree: self, source });
    }

    #[inline(always)]
    fn trace_stream<L: Lanes>(&self, source: &mut impl RaySource) {
        let mut in_flight: Vec<RayInFlight> = Vec::with_capacity(RAYS_IN_FLIGHT);
        let mut queues = Queues { slots: [[0; RAYS_IN_FLIGHT + 1]; 5], counts: [0; 5] };
        while in_flight.len() < RAYS_IN_FLIGHT {
            let Some(active) = source.next_ray() else { break };
            queues.enter(NODE, (in_flight.len() * size_of::<RayInFlight>()) as u32);
            in_flight.push(RayInFlight::new(active));
        }
        let mut active_count = in_flight.len();
        let base = in_flight.as_mut_ptr();
        // SAFETY: slots are those of flights.
        let state_at = |slot: u32| unsafe { &mut *base.byte_add(slot as usize) };
        while active_count > 0 {
            for i in 0..queues.take(NODE) {
                let slot = queues.slot(NODE, i);
                let task = self.step_node::<L>(state_at(slot));
                queues.enter(task, slot);
            }
            for i in 0..queues.take(BLOCK) {
                let slot = queues.slot(BLOCK, i);
                let task = self.step_block::<L>(state_at(slot));
                queues.enter(task, slot);
            }
            for i in 0..queues.take(DECISION) {
                let slot = queues.slot(DECISION, i);
                let state = state_at(slot);
                self.decide::<L>(state, source);
                queues.enter(self.pop::<L>(state), slot);
            }
            for i in 0..queues.take(POP) {
                let slot = queues.slot(POP, i);
                queues.enter(self.pop::<L>(state_at(slot)), slot);
            }
            for i in 0..queues.take(DONE) {
                let slot = queues.slot(DONE, i);
                let state = state_at(slot);
                if state.child == Child::OVERFLOWED {
                    source.trace_alone(state.active.number);
                }
                if let Some(active) = source.next_ray() {
                    state.start(active);
                    queues.enter(NODE, slot);
                } else {
                    active_count -= 1;
                }
            }
        }
    }

    /// One step through a node.
    #[inline(always)]
    fn step_node<L: Lanes>(&self, state: &mut RayInFlight) -> Step {
        // SAFETY: the children of a valid tree exist.
        let node = unsafe { self.nodes.get_unchecked(state.child.index()) };
        let planes = node.planes.as_ptr();
        let [x, y, z] = state.first.map(|first| first as usize);
        let inverse: &[f32; 3] = state.active.ray.inverse.as_ref();
        // SAFETY: `first` has the place of a plane, and the other one of its axis is beside it.
        let plane = |at: usize, axis: usize| unsafe {
            let lanes = L::load(&*planes.byte_add(at));
            lanes.mul_sub(L::splat_from(&inverse[axis]), L::splat_from(&state.offset[axis]))
        };
        let near = plane(x, 0).max(plane(y, 1)).max(plane(z, 2).max(L::splat(0.0)));
        let far = plane(x ^ 32, 0).min(plane(y ^ 32, 1));
        let far = far.min(plane(z ^ 32, 2).min(L::splat_from(&state.active.ray.end)));
        let met = near.at_most(far);
        let nearest = near.smallest(far);
        let others = met & !(1 << nearest);
        let count = state.waiting as usize;
        // SAFETY: there is room for eight more, since `waiting` is checked below.
        unsafe {
            let to = state.nears.as_mut_ptr().add(count);
            let to_children = state.children.as_mut_ptr().add(count);
            near.compress(&node.children, others, to, to_children);
            state.child = *node.children.get_unchecked(nearest);
        }
        let pushed = count + others.count_ones() as usize;
        state.waiting = pushed as u32;
        if pushed > BOTTOM + ROOM {
            state.overflow();
        }
        self.prefetch_child(state.child);
        select_unpredictable(met == 0, POP, state.child.step())
    }

    /// One step through a block: which triangles the ray may hit.
    #[inline(always)]
    fn step_block<L: Lanes>(&self, state: &mut RayInFlight) -> Step {
        // SAFETY: the children of a valid tree exist.
        let block = unsafe { self.blocks.get_unchecked(state.child.index()) };
        let ray = &state.active.ray;
        let test = RaySimd::<L>::from_memory(ray).test(block, ray.end);
        let [one, other] = state.active.excluded;
        let possible = test.possible() & L::differ(&block.triangles, [one, other, NONE]);
        state.possible = possible;
        let triangle = block.triangles[possible.trailing_zeros() as usize % WIDTH];
        prefetch(&self.corners, triangle as usize);
        select_unpredictable(possible == 0, POP, DECISION)
    }

    /// Goes on with the newest of the children that wait that is not behind the end.
    #[inline(always)]
    fn pop<L: Lanes>(&self, state: &mut RayInFlight) -> Step {
        state.pop::<L>();
        self.prefetch_child(state.child);
        state.child.step()
    }

    /// Has the triangles of a block decided on.
    #[inline(always)]
    fn decide<L: Lanes>(&self, state: &mut RayInFlight, source: &mut impl RaySource) {
        // SAFETY: the children of a valid tree exist.
        let block = unsafe { self.blocks.get_unchecked(state.child.index()) };
        let mut possible = state.possible;
        let triangles = std::iter::from_fn(|| {
            let lane = possible.trailing_zeros() as usize;
            possible &= possible.wrapping_sub(1);
            block.triangles.get(lane).copied()
        });
        state.active.ray.end = source.decide::<L::Quad>(&state.active, triangles);
    }

    /// Has the processor fetch a child.
    #[inline(always)]
    fn prefetch_child(&self, child: Child) {
        let node = self.nodes.as_ptr().wrapping_add(child.index()).cast::<u8>();
        let block = self.blocks.as_ptr().wrapping_add(child.index()).cast::<u8>();
        let at = select_unpredictable(child.is_block(), block, node);
        #[cfg(target_arch = "x86_64")]
        // SAFETY: prefetching does not fault, whatever the address.
        unsafe {
            use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
            let at = at.cast::<i8>();
            _mm_prefetch::<_MM_HINT_T0>(at);
            _mm_prefetch::<_MM_HINT_T0>(at.wrapping_add(64));
            _mm_prefetch::<_MM_HINT_T0>(at.wrapping_add(128));
            _mm_prefetch::<_MM_HINT_T0>(at.wrapping_add(192));
            _mm_prefetch::<_MM_HINT_T0>(at.wrapping_add(256));
        }
        #[cfg(not(target_arch = "x86_64"))]
        let _ = at;
    }
}

impl RayInFlight {
    /// Memory for a flight, and its first active.
    fn new(active: ActiveRay) -> Self {
        let mut state = Self {
            active,
            offset: [0.0; 3],
            first: [0; 3],
            child: Child::node(0),
            waiting: 0,
            possible: 0,
            nears: [f32::INFINITY; BOTTOM + ROOM + WIDTH],
            children: [Child::DONE; BOTTOM + ROOM + WIDTH],
        };
        state.nears[WIDTH] = f32::NEG_INFINITY;
        state.start(active);
        state
    }

    /// Starts a ray at the root.
    #[inline(always)]
    fn start(&mut self, active: ActiveRay) {
        let FrameRay { origin, inverse, .. } = active.ray;
        self.active = active;
        self.offset = (origin * inverse).to_array();
        let below = inverse.is_negative_bitmask();
        self.first = [below << 5 & 32, 64 + (below << 4 & 32), 128 + (below << 3 & 32)];
        self.child = Child::node(0);
        self.waiting = BOTTOM as u32;
    }

    /// Has no more room.
    #[cold]
    fn overflow(&mut self) {
        self.child = Child::OVERFLOWED;
    }

    /// Takes the newest of the children that wait that is not behind the end.
    #[inline(always)]
    fn pop<L: Lanes>(&mut self) {
        let end = L::splat_from(&self.active.ray.end);
        let mut count = self.waiting as usize;
        let mut before = self.newest_before(end, count);
        while before == 0 {
            count -= WIDTH;
            before = self.newest_before(end, count);
        }
        let top = count - WIDTH + before.ilog2() as usize;
        self.waiting = top as u32;
        // SAFETY: `top` is below what was written.
        self.child = unsafe { *self.children.get_unchecked(top) };
    }

    /// A bit for each of the eight children in front of `count` that is before the end.
    #[inline(always)]
    fn newest_before<L: Lanes>(&self, end: L, count: usize) -> u32 {
        // SAFETY: there are always eight at the bottom, the last of which is before every end.
        let nears = unsafe { &*self.nears.as_ptr().add(count - WIDTH).cast::<[f32; WIDTH]>() };
        L::load(nears).at_most(end)
    }
}

impl Child {
    /// Step of a flight there.
    #[inline(always)]
    const fn step(self) -> Step {
        self.0 >> 30
    }
}
