//! Tests of the crate through its public interface.
//!
//! All seeds are fixed. Significance of each statistical test: 1e-6, so that the family of a few
//! hundred fails by chance once in some 3000 sets of seeds; what it detects stands beside it.

mod assignment;
mod block;
mod convergence;
mod discrete;
mod emission;
mod faure4;
mod groups;
mod halton;
mod integrands;
mod missed_sets;
mod owen;
mod quality;
mod random;
mod randomised_points;
mod sampler;
mod sobol;
mod support;
mod variation;
mod warp;
