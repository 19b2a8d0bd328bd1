//! A run from its start to its result: the loop over checkpoints ([`simulate`]), how far it has
//! come ([`course`]), parts of a run on several machines ([`parts`]), pictures ([`pictures`]).

pub(crate) mod blocks;
pub(crate) mod cannot_see;
pub(crate) mod check;
pub(crate) mod course;
pub(crate) mod memory;
pub(crate) mod parts;
mod pass;
pub(crate) mod pictures;
mod pixel_sums;
mod pixels;
mod raster;
pub(crate) mod simulate;
pub mod trial;
