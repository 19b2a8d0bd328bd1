//! Colours of a file to those of the program.

use crate::color::luminance;
use crate::warning::WarningKind;
use crate::warning::Warnings;
use quasilux_text::Position;

/// Channels below zero by less, in parts of the luminance, are rounding.
const ROUNDING: f64 = 1e-4;

/// Linear RGB of ITU-R BT.709 from CIE XYZ. A colour that is more saturated than its gamut goes
/// towards the white of its luminance, as far as it must: Y stays.
pub(super) fn rgb([x, y, z]: [f64; 3], at: Position, warnings: &mut Warnings) -> [f64; 3] {
    if y <= 0.0 {
        if x > 0.0 || z > 0.0 {
            let found = format_args!("X {x}, Y {y}, Z {z}").to_string();
            warnings.push(
                WarningKind::OutOfGamut,
                at,
                found,
                "a luminance above 0 (read as black)",
            );
        }
        return [0.0; 3];
    }
    let rgb = [
        3.240_969_9 * x - 1.537_383_2 * y - 0.498_610_8 * z,
        -0.969_243_6 * x + 1.875_967_5 * y + 0.041_555_1 * z,
        0.055_630_1 * x - 0.203_977_0 * y + 1.056_971_5 * z,
    ];
    let least = rgb.iter().copied().fold(f64::INFINITY, f64::min);
    if least >= 0.0 {
        return rgb;
    }
    if least < -ROUNDING * y {
        let found = format_args!("X {x}, Y {y}, Z {z}").to_string();
        let expected = "a colour of BT.709 (made less saturated, its luminance is kept)";
        warnings.push(WarningKind::OutOfGamut, at, found, expected);
    }
    // White of the luminance that these channels have: Y but for the rounding of the matrix.
    let white = luminance(rgb).max(0.0);
    let kept = white / (white - least);
    rgb.map(|channel| (white + kept * (channel - white)).max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_outside_keep_their_luminance() {
        let at = Position { line: 1, column: 1 };
        for (xyz, is_outside) in [
            ([0.05, 0.25, 0.02], true),
            ([0.5, 0.2, 0.9], true),
            ([0.95, 1.0, 1.09], false),
            ([0.3, 0.3, 0.3], false),
        ] {
            let mut warnings = Warnings::default();
            let rgb = rgb(xyz, at, &mut warnings);
            assert!(rgb.iter().all(|channel| *channel >= 0.0), "{rgb:?}");
            assert!((luminance(rgb) / xyz[1] - 1.0).abs() < 1e-3, "{rgb:?} of {xyz:?}");
            assert_eq!(!warnings.into_vec().is_empty(), is_outside, "{xyz:?}");
        }
        let mut warnings = Warnings::default();
        assert_eq!(rgb([1.0, 0.0, 1.0], at, &mut warnings), [0.0; 3]);
        assert_eq!(warnings.into_vec().len(), 1);
    }
}
