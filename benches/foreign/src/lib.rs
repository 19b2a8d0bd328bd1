//! What the benchmarks call that is not Rust: a competitor, and a clock.

#![cfg(unix)]

mod clock;
mod embree;

pub use clock::processor_seconds;
pub use embree::{Embree, Mesh, Quality, RayHit};
