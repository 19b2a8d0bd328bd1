//! Tests of the crate through its public interface.
//!
//! All seeds are fixed. Significance of each statistical test: 1e-6, so that the family of about
//! forty fails by chance once in 25 000 sets of seeds; what it detects stands beside it.

mod block;
mod choice;
mod convergence;
mod cursor;
mod emission;
mod faure4;
mod groups;
mod halton;
mod integrands;
mod owen;
mod quality;
mod random;
mod sobol;
mod support;
mod warp;
