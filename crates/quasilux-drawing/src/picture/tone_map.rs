//! What a camera sees, on a screen: luminances compressed into what a screen can show.
//!
//! The global operator of Reinhard, Stark, Shirley and Ferwerda (2002), equations 1, 2 and 4: with
//! `L_avg` the log-average luminance and `L = a L_w / L_avg`, the display shows `L (1 + L /
//! L_white^2) / (1 + L)`, with the key a = 0.18 and `L_white` the largest L of the picture, so that
//! white is the brightest place. Deviation: pixels without light are left out of the log-average,
//! where the paper adds a small number to all. Each channel is scaled like the luminance and cut at
//! 1, then encoded for sRGB (IEC 61966-2-1:1999, clause 5.2), whose primaries are those of the
//! channels.

use super::image::Image;
use crate::canvas::srgb_png;

/// Display luminance of the log-average: a picture that is neither light nor dark.
const KEY: f64 = 0.18;

/// An image as it would look on a screen, a PNG file.
///
/// Luminances are relative to the picture's own: two pictures cannot be compared by it.
#[must_use]
pub fn tone_mapped_png(image: &Image<'_>) -> Vec<u8> {
    let operator = Operator::from_luminances(image.luminance);
    srgb_png(image.resolution, operator.all_shown(image).as_flattened())
}

/// What turns luminances into colours of a screen.
pub(super) struct Operator {
    /// From luminance to L.
    scale: f64,
    /// One over L_white squared.
    burn: f64,
}

impl Operator {
    /// The operator of an image with these luminances.
    pub(super) fn from_luminances(luminances: &[f32]) -> Self {
        let (mut logarithms, mut lit, mut largest) = (0.0, 0_u64, 0.0_f64);
        for luminance in luminances.iter().copied().map(f64::from) {
            if luminance > 0.0 {
                logarithms += libm::log(luminance);
                lit += 1;
                largest = largest.max(luminance);
            }
        }
        if lit == 0 {
            return Self { scale: 0.0, burn: 0.0 };
        }
        let scale = KEY / libm::exp(logarithms / lit as f64);
        let white = scale * largest;
        Self { scale, burn: 1.0 / (white * white) }
    }

    /// The sRGB colours of all pixels of an image.
    pub(super) fn all_shown(&self, image: &Image<'_>) -> Vec<[u8; 3]> {
        let pixels = image.rgb.iter().zip(image.luminance);
        pixels.map(|(rgb, luminance)| self.shown(*rgb, *luminance)).collect()
    }

    /// The sRGB colour of a pixel.
    fn shown(&self, rgb: [f32; 3], luminance: f32) -> [u8; 3] {
        let l = self.scale * f64::from(luminance);
        let factor = self.scale * (1.0 + l * self.burn) / (1.0 + l);
        rgb.map(|channel| {
            let shown = (f64::from(channel) * factor).clamp(0.0, 1.0);
            (255.0 * encoded(shown)).round() as u8
        })
    }
}

/// The sRGB transfer function.
fn encoded(linear: f64) -> f64 {
    if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(operator: &Operator, luminance: f32) -> [u8; 3] {
        operator.shown([luminance; 3], luminance)
    }

    /// In a picture of two luminances L and 4 L the log-average is 2 L.
    #[test]
    fn the_operator_is_the_published_one() {
        for unit in [1e-3_f32, 1.0, 1e4] {
            let operator = Operator::from_luminances(&[unit, 4.0 * unit]);
            assert_eq!(shown(&operator, 4.0 * unit), [255; 3]);
            let (l, white) = (0.09_f64, 0.36_f64);
            let wanted = 255.0 * encoded(l * (1.0 + l / (white * white)) / (1.0 + l));
            assert_eq!(shown(&operator, unit), [wanted.round() as u8; 3]);
        }
    }

    #[test]
    fn dark_and_saturated_pixels_do_not_break() {
        assert_eq!(shown(&Operator::from_luminances(&[0.0]), 0.0), [0; 3]);
        let blue = Operator::from_luminances(&[1.0, 0.0]).shown([0.0, 0.0, 1.0 / 0.0722], 1.0);
        assert_eq!(blue, [0, 0, 255]);
    }

    /// Values of the curve's own definition: its two pieces meet, and half of white is 188 of 255.
    #[test]
    fn the_encoding_is_srgb() {
        assert!((encoded(0.003_130_8) - encoded(0.003_130_800_1)).abs() < 1e-6);
        assert_eq!((255.0 * encoded(0.5)).round(), 188.0);
        assert_eq!((255.0 * encoded(0.18)).round(), 118.0);
    }
}
