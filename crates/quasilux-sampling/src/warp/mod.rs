//! Maps from the unit square and, one of them, the unit interval, each as sample, pdf and invert.
//!
//! Directions are unit vectors in a local frame with z up. All maps are continuous, and send an
//! even point set to an even one.
//!
//! Spherical triangles and rectangles have no map by solid angle: luminaires are sampled uniformly
//! by area, and multiple importance sampling with cosine directions bounds the variance near them.
//! Close to large luminaires, where the density by area varies most in solid angle, such a map
//! would pay.

mod disk;
mod hemisphere;
mod linear_triangle;
mod normal;
mod sine;
mod sphere;
mod triangle;

pub use disk::{invert_disk, pdf_disk, sample_disk};
pub use hemisphere::{
    invert_cosine_hemisphere, invert_uniform_hemisphere, pdf_cosine_hemisphere,
    pdf_uniform_hemisphere, sample_cosine_hemisphere, sample_uniform_hemisphere,
};
pub use linear_triangle::{invert_linear_triangle, pdf_linear_triangle, sample_linear_triangle};
pub use normal::{invert_normal, pdf_normal, sample_normal};
pub use sphere::{invert_uniform_sphere, pdf_uniform_sphere, sample_uniform_sphere};
pub use triangle::{invert_triangle, pdf_triangle, sample_triangle};
