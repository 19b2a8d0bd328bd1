//! Lambertian reflection and transmission.

use crate::Rgb;

/// A sheet that scatters light to both sides: paper, cloth, opal glass. A side that receives the
/// illuminance E has the luminance `reflectance * E / pi`, the other `transmittance * E / pi`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Translucent {
    /// Reflected over incident flux, each channel in [0, 1].
    pub reflectance: Rgb,
    /// Transmitted over incident flux; with the reflectance at most 1 in each channel.
    pub transmittance: Rgb,
}
