//! Sine and cosine of small angles by their series: the same bits everywhere, and no reduction of
//! the angle, which takes most of the time of functions for all angles.

use std::f64::consts::FRAC_PI_4;

/// The sine and the cosine of an angle of at most an eighth of a turn, in rad. The terms left out
/// are below 1e-17 of the sum, and both are within 2^-52 of `libm`'s.
#[inline]
pub(super) fn sine_and_cosine_of_eighth(angle_rad: f64) -> (f64, f64) {
    debug_assert!(angle_rad.is_nan() || angle_rad.abs() <= FRAC_PI_4 * (1.0 + 1e-15));
    let x = angle_rad * angle_rad;
    // Of x^(2 k + 1) over that of x^(2 k - 1), and of x^(2 k + 2) over that of x^(2 k): Horner's
    // scheme from the last ratio on.
    let sine = SINE.iter().rev().fold(1.0, |sum, ratio| 1.0 - x * ratio * sum);
    let cosine = COSINE.iter().rev().fold(1.0, |sum, ratio| 1.0 - x * ratio * sum);
    (angle_rad * sine, cosine)
}

/// `1 / (2 k (2 k + 1))`.
const SINE: [f64; 8] = [
    1.0 / 6.0,
    1.0 / 20.0,
    1.0 / 42.0,
    1.0 / 72.0,
    1.0 / 110.0,
    1.0 / 156.0,
    1.0 / 210.0,
    1.0 / 272.0,
];
/// `1 / ((2 k - 1) 2 k)`.
const COSINE: [f64; 8] = [
    1.0 / 2.0,
    1.0 / 12.0,
    1.0 / 30.0,
    1.0 / 56.0,
    1.0 / 90.0,
    1.0 / 132.0,
    1.0 / 182.0,
    1.0 / 240.0,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_are_the_functions() {
        const STEPS: i32 = 200_000;
        for step in -STEPS..=STEPS {
            let angle_rad = FRAC_PI_4 * f64::from(step) / f64::from(STEPS);
            let (sin, cos) = sine_and_cosine_of_eighth(angle_rad);
            let off = [sin - libm::sin(angle_rad), cos - libm::cos(angle_rad)];
            assert!(off[0].abs() <= f64::EPSILON * sin.abs(), "{angle_rad}: {off:?}");
            assert!(off[1].abs() <= f64::EPSILON * cos, "{angle_rad}: {off:?}");
        }
        assert_eq!(sine_and_cosine_of_eighth(0.0), (0.0, 1.0));
    }
}
