//! Light tracing: a photon is emitted and scattered in [`trace`], in waves in [`wave`], and seen by
//! a [`receiver`]; [`batch`] traces those of some indices in the order of [`order`]. Illumination
//! maps are in [`map`], caustics in [`caustics`], photons that begin where light lands in
//! [`first_shot`] and [`lit_cells`].
//!
//! The light subpaths of the default estimator are in `estimator/bidirectional/light_subpath.rs`.

pub(crate) mod batch;
pub(crate) mod caustics;
pub(crate) mod counts;
pub(crate) mod first_shot;
pub(crate) mod lit_cells;
pub(crate) mod map;
pub(crate) mod order;
pub(crate) mod receiver;
#[cfg(test)]
mod tests;
pub(crate) mod trace;
pub(crate) mod wave;
