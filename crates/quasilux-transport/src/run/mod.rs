//! A run from its start to its result: the loop over checkpoints ([`simulate`]), how far it has
//! come ([`course`]), and parts of a run on several machines ([`parts`]).

pub(crate) mod blocks;
pub(crate) mod cannot_see;
pub(crate) mod check;
pub(crate) mod course;
pub(crate) mod memory;
pub(crate) mod parts;
pub(crate) mod simulate;
pub mod trial;
