//! From a number in [0, 1] to a colour that grows lighter all the way.
//!
//! The map is viridis (van der Walt and Smith 2015, "A better default colormap for matplotlib",
//! SciPy 2015; public domain, CC0), piecewise linear in sRGB through eleven of its published
//! colours. It is perceptually uniform and stays in order for the usual kinds of colour blindness
//! and in print without colour, because lightness alone carries the order.

use crate::canvas::mix;
use crate::style::Colour;

/// Colour of what a reader must not miss.
pub(crate) const CAUTION_INK: Colour = [168, 52, 0];

/// Viridis at 0, 0.1, ..., 1.
const VIRIDIS: [Colour; 11] = [
    [0x44, 0x01, 0x54],
    [0x48, 0x25, 0x76],
    [0x41, 0x44, 0x87],
    [0x35, 0x60, 0x8d],
    [0x2a, 0x78, 0x8e],
    [0x21, 0x90, 0x8c],
    [0x22, 0xa8, 0x84],
    [0x43, 0xbf, 0x71],
    [0x7a, 0xd1, 0x51],
    [0xbb, 0xdf, 0x27],
    [0xfd, 0xe7, 0x25],
];

/// Black or white, whichever stands out more, is decided at this relative luminance: there the
/// contrast ratios (Y + 0.05) / 0.05 and 1.05 / (Y + 0.05) of WCAG 2.2 are equal.
const EVEN_CONTRAST_LUMINANCE: f64 = 0.179;

/// The colour of `t`; what lies outside [0, 1] gets the colour of the nearer end.
pub(crate) fn colour(t: f64) -> Colour {
    let intervals = VIRIDIS.len() - 1;
    let x = t.clamp(0.0, 1.0) * intervals as f64;
    let i = (x as usize).min(intervals - 1);
    mix(VIRIDIS[i], VIRIDIS[i + 1], x - i as f64)
}

/// Near-black or white, readable on `background`.
pub(crate) fn ink_on(background: Colour) -> Colour {
    if relative_luminance(background) > EVEN_CONTRAST_LUMINANCE { [16, 16, 16] } else { [255; 3] }
}

/// Relative luminance in [0, 1] of an sRGB colour (IEC 61966-2-1, clause 5.2).
fn relative_luminance(colour: Colour) -> f64 {
    let linear = colour.map(|channel| {
        let x = f64::from(channel) / 255.0;
        if x <= 0.04045 { x / 12.92 } else { libm::pow((x + 0.055) / 1.055, 2.4) }
    });
    0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// CIE 1976 lightness L* (ISO/CIE 11664-4, clause 4).
    fn lightness(colour: Colour) -> f64 {
        let y = relative_luminance(colour);
        if y > 216.0 / 24389.0 { 116.0 * libm::cbrt(y) - 16.0 } else { y * 24389.0 / 27.0 }
    }

    #[test]
    fn lightness_grows_evenly() {
        let at: Vec<f64> = (0..=20).map(|i| lightness(colour(f64::from(i) / 20.0))).collect();
        let mean_step = (at[20] - at[0]) / 20.0;
        assert!(at[0] < 16.0 && at[20] > 90.0, "{at:?}");
        for pair in at.windows(2) {
            let step = pair[1] - pair[0];
            assert!((step / mean_step - 1.0).abs() < 0.35, "step {step}, mean {mean_step}");
        }
    }

    #[test]
    fn lightness_never_falls() {
        let mut before = 0.0;
        for i in 0..=1000 {
            let now = lightness(colour(f64::from(i) / 1000.0));
            assert!(now >= before - 0.2, "at {i}: {now} after {before}");
            before = now;
        }
    }

    #[test]
    fn ends_and_outside() {
        assert_eq!(colour(0.0), VIRIDIS[0]);
        assert_eq!(colour(1.0), VIRIDIS[10]);
        assert_eq!(colour(-3.0), VIRIDIS[0]);
        assert_eq!(colour(7.0), VIRIDIS[10]);
    }

    #[test]
    fn ink_has_contrast_everywhere() {
        for i in 0..=100 {
            let background = colour(f64::from(i) / 100.0);
            let mut pair = [background, ink_on(background)].map(relative_luminance);
            pair.sort_by(f64::total_cmp);
            assert!((pair[1] + 0.05) / (pair[0] + 0.05) >= 4.0, "at {i} %");
        }
    }
}
