//! A run from its start to its result: the loop over checkpoints, parts, checkpoints, pictures.

pub(crate) mod check;
pub(crate) mod checkpoint;
pub(crate) mod memory;
pub(crate) mod parts;
pub(crate) mod pixels;
pub(crate) mod simulate;
pub mod trial;
