//! Luminance of linear RGB (ITU-R BT.709).

/// Luminance of linear RGB (ITU-R BT.709).
const LUMINANCE_WEIGHTS: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// Luminance of linear RGB (ITU-R BT.709); grey stays exactly what it is.
#[must_use]
pub fn luminance(rgb: [f64; 3]) -> f64 {
    // The weights add up to 1 but for rounding: grey stays what it is.
    if rgb[0] == rgb[1] && rgb[1] == rgb[2] {
        return rgb[0];
    }
    rgb.iter().zip(LUMINANCE_WEIGHTS).map(|(channel, weight)| channel * weight).sum()
}
