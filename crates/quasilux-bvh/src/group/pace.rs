//! How many rays go together.
//!
//! A shaft that is wide for the triangles in it makes all of its rays try them all. Once a group
//! has cost what its rays would cost alone it is given up, and the next groups are smaller; where
//! they are cheap they grow again. Only speed depends on it.

use crate::group::{MOST, Parted};
use crate::node::WIDTH;

/// What holding eight rays against a triangle costs.
pub(crate) const TRIAL: usize = 1;
/// What holding a node against a shaft costs.
pub(crate) const NODE: usize = 2;
/// What holding a block against a shaft costs.
pub(crate) const BLOCK: usize = 4;

/// What eight rays cost alone.
const ALONE: usize = 400;

/// Where not even small groups go together, so many rays go alone before the next attempt.
const PAUSE: usize = 4 * MOST;

/// The size of the next group.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pace {
    most: usize,
    pause: usize,
}

impl Pace {
    /// Smaller groups are better off alone.
    const LEAST: usize = 2 * WIDTH;

    pub(crate) const fn new() -> Self {
        Self { most: MOST, pause: 0 }
    }

    /// So many rays may go together.
    pub(crate) const fn most(&self) -> usize {
        self.most
    }

    /// What a group of so many vectors of rays may cost.
    pub(crate) const fn limit(vectors: usize) -> usize {
        vectors * ALONE
    }

    /// Takes note of what a group has cost.
    pub(crate) fn learn(&mut self, count: usize, cost: Result<usize, Parted>) {
        self.most = match cost {
            Err(Parted) => (count / 2).max(Self::LEAST),
            Ok(cost) if cost < count.div_ceil(WIDTH) * ALONE / 4 => (2 * self.most).min(MOST),
            Ok(_) => self.most,
        };
        if cost.is_err() && count <= Self::LEAST {
            self.pause = PAUSE;
        }
    }

    /// How many of the next rays go alone in any case.
    pub(crate) fn pause(&mut self) -> usize {
        std::mem::take(&mut self.pause)
    }
}
