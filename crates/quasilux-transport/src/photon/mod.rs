//! Light tracing: photons from the lights, and what counts them.

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
