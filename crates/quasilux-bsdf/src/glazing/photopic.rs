//! Weights of wavelengths for daylight as the eye sees it.
//!
//! ISO 9050:2003 and EN 410:2011: the visible value of a spectral one is its mean weighted by the
//! CIE standard illuminant D65 (CIE 15:2004, table T.1) and the luminous efficiency V (CIE
//! 018:2019; the same as the 1931 observer's y), both here in steps of 5 nm.

/// The wavelengths that are weighed: from 380 to 780 nm, in steps of 5.
pub(super) const WAVELENGTHS: usize = 81;

/// Wavelength in nm of a number below [`WAVELENGTHS`].
pub(super) fn wavelength_nm(number: usize) -> f64 {
    380.0 + 5.0 * number as f64
}

/// The mean of what `value` gives by number of a wavelength, as the eye weighs it under D65.
pub(super) fn visible(value: impl Fn(usize) -> f64) -> f64 {
    let weight = |number: usize| D65[number] * V[number];
    let (sum, weights) = (0..WAVELENGTHS).fold((0.0, 0.0), |(sum, weights), number| {
        let weight = weight(number);
        (sum + weight * value(number), weights + weight)
    });
    sum / weights
}

/// Relative power of D65, 100 at 560 nm.
#[rustfmt::skip]
const D65: [f64; WAVELENGTHS] = [
    49.9755, 52.3118, 54.6482, 68.7015, 82.7549, 87.1204, 91.486, 92.4589, 93.4318, 90.057, 86.6823,
    95.7736, 104.865, 110.936, 117.008, 117.41, 117.812, 116.336, 114.861, 115.392, 115.923,
    112.367, 108.811, 109.082, 109.354, 108.578, 107.802, 106.296, 104.79, 106.239, 107.689,
    106.047, 104.405, 104.225, 104.046, 102.023, 100.0, 98.1671, 96.3342, 96.0611, 95.788, 92.2368,
    88.6856, 89.3459, 90.0062, 89.8026, 89.5991, 88.6489, 87.6987, 85.4936, 83.2886, 83.4939,
    83.6992, 81.863, 80.0268, 80.1207, 80.2146, 81.2462, 82.2778, 80.281, 78.2842, 74.0027, 69.7213,
    70.6652, 71.6091, 72.979, 74.349, 67.9765, 61.604, 65.7448, 69.8856, 72.4863, 75.087, 69.3398,
    63.5927, 55.0054, 46.4182, 56.6118, 66.8054, 65.0941, 63.3828,
];

/// Luminous efficiency, 1 at 555 nm.
#[rustfmt::skip]
const V: [f64; WAVELENGTHS] = [
    0.000039, 0.000064, 0.00012, 0.000217, 0.000396, 0.00064, 0.00121, 0.00218, 0.004, 0.0073,
    0.0116, 0.01684, 0.023, 0.0298, 0.038, 0.048, 0.06, 0.0739, 0.09098, 0.1126, 0.13902, 0.1693,
    0.20802, 0.2586, 0.323, 0.4073, 0.503, 0.6082, 0.71, 0.7932, 0.862, 0.91485, 0.954, 0.9803,
    0.99495, 1.0, 0.995, 0.9786, 0.952, 0.9154, 0.87, 0.8163, 0.757, 0.6949, 0.631, 0.5668, 0.503,
    0.4412, 0.381, 0.321, 0.265, 0.217, 0.175, 0.1382, 0.107, 0.0816, 0.061, 0.04458, 0.032, 0.0232,
    0.017, 0.01192, 0.00821, 0.005723, 0.004102, 0.002929, 0.002091, 0.001484, 0.001047, 0.00074,
    0.00052, 0.000361, 0.000249, 0.000172, 0.00012, 0.000085, 0.000060, 0.000042, 0.000030,
    0.000021, 0.000015,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_are_those_of_the_observer() {
        let sum = |x: fn(usize) -> f64| (0..WAVELENGTHS).map(x).sum::<f64>();
        // CIE 15:2004: the sum of y in steps of 5 nm.
        assert!((sum(|number| V[number]) - 21.3713).abs() < 1e-4);
        // The same of D65 times y in steps of 1 nm from 360 to 830 nm, the white of colorimetry.
        let white = 5.0 * sum(|number| D65[number] * V[number]);
        assert!((white / 10_566.864 - 1.0).abs() < 1e-4, "{white}");
        assert_eq!((D65[36], V[35]), (100.0, 1.0));
        assert_eq!(wavelength_nm(35), 555.0);
        assert_eq!(wavelength_nm(WAVELENGTHS - 1), 780.0);
    }

    #[test]
    fn a_mean_of_the_same_is_the_same() {
        assert!((visible(|_| 0.37) - 0.37).abs() < 1e-15);
    }
}
