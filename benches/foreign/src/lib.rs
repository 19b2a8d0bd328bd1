//! What the benchmarks call that is not Rust: a competitor, and clocks.

#![cfg(unix)]

mod clock;
mod embree;

pub use clock::{all_processors_seconds, processor_seconds};
pub use embree::{Embree, Mesh, Quality, RayHit};
