//! Rough metal.

use crate::Rgb;

/// A rough conductor: GGX facets that reflect by Schlick's approximation, with the light that they
/// reflect several times.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conductor {
    /// Reflected over incident flux of one facet at normal incidence, each channel in [0, 1].
    pub reflectance: Rgb,
    /// Width of the distribution of slopes, in [0.0004, 1]: the square of the roughness.
    pub alpha: f64,
}
