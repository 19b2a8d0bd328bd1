//! Statistical tests for the workspace's own test suites: never part of the program.
//!
//! - [`chi_square_test`]: do counts follow a distribution?
//! - [`student_t_quantile`], [`normal_quantile`], [`sidak`]: intervals and families of tests;
//! - [`jacobian_determinant`], [`sphere_jacobian`]: does the density belong to the map?
//! - [`least_squares_slope`]: the order of convergence;
//! - [`SplitMix64`]: rooms, files and damage at random;
//! - [`deep`]: are the variants asked for that find smaller errors and take longer?
//!
//! A test that uses these states its seed, its significance, the number of tests in the family, and
//! the smallest error that it would detect.

mod chi_square;
pub mod damage;
mod deep;
mod distributions;
mod jacobian;
mod random;
mod slope;
mod special;

pub use chi_square::{CellCount, chi_square_test};
pub use deep::{DEEP, deep};
pub use distributions::{
    normal_cdf, normal_quantile, sidak, student_t_cdf, student_t_quantile, student_t_test,
};
pub use jacobian::{jacobian_determinant, sphere_jacobian};
pub use random::SplitMix64;
pub use slope::least_squares_slope;
pub use special::{gamma_q, incomplete_beta};
