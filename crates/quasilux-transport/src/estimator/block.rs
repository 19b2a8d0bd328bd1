//! Blocks of a run that other processes trace ([`crate::control::workers`]): what is asked of them.

use serde::{Deserialize, Serialize};

/// Data that all blocks of some work have in common.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) enum BlockFrame {
    /// Paths of all growing targets and replicates, put in one row.
    Paths { progress: PathProgress },
    /// Photons that sensors count, by index.
    CountedPhotons,
    /// Units of bidirectional paths.
    Bidirectional { progress: PathProgress },
}

/// How far a path estimator is: on which paths and photons come next.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct PathProgress {
    /// Indices of the last checkpoint, and of the coming one.
    pub(crate) samples: u64,
    pub(crate) coming: u64,
    /// Of each target that gets no more, the index that it ends before.
    pub(crate) ends: Vec<Option<u64>>,
}
