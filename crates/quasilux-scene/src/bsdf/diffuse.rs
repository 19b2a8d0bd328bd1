//! Lambertian reflection.

use crate::Rgb;

/// A Lambertian surface: its reflected luminance is `reflectance * E / pi` in all directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Diffuse {
    /// Reflected over incident flux, each channel in [0, 1].
    pub reflectance: Rgb,
}
