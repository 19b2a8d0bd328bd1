//! A brute-force reference: plain path tracing from sensors with pseudo-random numbers.
//!
//! It shares no code with quasilux, and takes no decision from what it finds: no pilot, no
//! adaptation, no map. Where light is hard to find, the scene lists hints, [`Lookout`]s:
//! parallelograms worth looking at. Directions are drawn from a mixture of the cosine lobe and of
//! the hints, and weighed by the density of the whole mixture (one-sample balance heuristic, Veach
//! and Guibas 1995), so that hints change the error and never the mean.
//!
//! Light of point lights over mirrors has probability zero and is missed: a scene that has mirrors
//! must have emitting triangles alone.

mod estimate;
mod hint;
mod light;
mod path;
mod random;
mod scene;
mod tree;
mod triangle;

#[cfg(test)]
mod tests;

pub use estimate::{Estimate, Limits, direct_point_lx, solve, solve_until};
pub use hint::Lookout;
pub use light::{Candela, CandelaRow, PointLight};
pub use random::Xoshiro;
pub use scene::{Scene, Sensor};
pub use triangle::{Surface, Triangle};
