//! The adaptive size of ray groups.
//!
//! A shaft that is wide for the triangles in it makes all of its rays try them all. Once a group
//! has cost what its rays would cost alone it is given up, and the next groups are smaller; where
//! they are cheap they grow again. Only speed depends on it.

use crate::group::rays::MAX_GROUP;
use crate::node::WIDTH;

/// Cost of a test of eight rays against a triangle.
pub(crate) const TRIAL: usize = 1;
/// Cost of a test of a node against a shaft.
pub(crate) const NODE: usize = 2;
/// Cost of a test of a block against a shaft.
pub(crate) const BLOCK: usize = 4;

/// Cost of eight rays that go alone.
const ALONE: usize = 400;

/// Where not even small groups go together, this many rays go alone before the next attempt.
const SINGLE_RAYS_AFTER_FAILURE: usize = 4 * MAX_GROUP;

/// The rays of a group are too far apart to be traced together.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Diverged;

/// The size of the next group.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GroupSize {
    most: usize,
    pause: usize,
}

impl GroupSize {
    /// Smaller groups are better off alone.
    const MIN_GROUP: usize = 2 * WIDTH;

    pub(crate) const fn new() -> Self {
        Self { most: MAX_GROUP, pause: 0 }
    }

    /// Largest number of rays that may go together.
    pub(crate) const fn most(&self) -> usize {
        self.most
    }

    /// Largest cost of a group of this many vectors of rays.
    pub(crate) const fn limit(vectors: usize) -> usize {
        vectors * ALONE
    }

    /// Takes note of what a group has cost.
    pub(crate) fn learn(&mut self, count: usize, cost: Result<usize, Diverged>) {
        self.most = match cost {
            Err(Diverged) => (count / 2).max(Self::MIN_GROUP),
            Ok(cost) if cost < count.div_ceil(WIDTH) * ALONE / 4 => (2 * self.most).min(MAX_GROUP),
            Ok(_) => self.most,
        };
        if cost.is_err() && count <= Self::MIN_GROUP {
            self.pause = SINGLE_RAYS_AFTER_FAILURE;
        }
    }

    /// How many of the next rays go alone in any case.
    pub(crate) fn take_pause(&mut self) -> usize {
        std::mem::take(&mut self.pause)
    }
}
