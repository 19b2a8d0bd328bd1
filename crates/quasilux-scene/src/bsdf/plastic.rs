//! Rough plastic, paint, varnish.

use crate::Rgb;

/// A diffuse base under a clear coat with a rough surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plastic {
    /// Of the light that enters the coat, the share that comes out again, each channel in [0, 1].
    pub reflectance: Rgb,
    /// Refractive index of the coat; above 1.
    pub eta: f64,
    /// Width of the distribution of slopes, in [0.0004, 1]: the square of the roughness.
    pub alpha: f64,
}
