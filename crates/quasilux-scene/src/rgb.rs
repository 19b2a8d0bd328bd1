//! Linear RGB photometric triples.
//!
//! A triple holds one number per channel; its luminance is the weighted sum with the weights of
//! the BT.709 primaries (ITU-R BT.709-6, item 3.2), which add up to exactly one: a grey triple
//! keeps its luminance to the last bit.

use std::ops::{Add, AddAssign, Mul};

/// Luminance weights of the three channels; their floating-point sum is exactly 1.
pub const LUMINANCE_WEIGHTS: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// A linear RGB photometric triple: reflectances, or light in any photometric unit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rgb(pub [f64; 3]);

impl Rgb {
    /// No light.
    pub const BLACK: Self = Self([0.0; 3]);
    /// One in each channel.
    pub const WHITE: Self = Self([1.0; 3]);

    /// The triple with `value` in each channel.
    #[must_use]
    pub const fn grey(value: f64) -> Self {
        Self([value; 3])
    }

    /// The luminance of the triple, in the unit of the channels; exact for grey ones.
    #[must_use]
    pub fn luminance(self) -> f64 {
        if self.is_grey() {
            return self.0[0];
        }
        let [r, g, b] = self.0;
        let [wr, wg, wb] = LUMINANCE_WEIGHTS;
        wr * r + wg * g + wb * b
    }

    /// Whether the three channels are equal.
    #[must_use]
    pub fn is_grey(self) -> bool {
        self.0[0] == self.0[1] && self.0[1] == self.0[2]
    }

    /// The largest channel.
    #[must_use]
    pub fn max_channel(self) -> f64 {
        self.0[0].max(self.0[1]).max(self.0[2])
    }
}

impl Add for Rgb {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(std::array::from_fn(|c| self.0[c] + other.0[c]))
    }
}

impl AddAssign for Rgb {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Mul for Rgb {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self(std::array::from_fn(|c| self.0[c] * other.0[c]))
    }
}

impl Mul<f64> for Rgb {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self(self.0.map(|c| c * factor))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grey_keeps_its_luminance() {
        for value in [0.0, 0.1, 0.7, 1.0 / 3.0, 1e-300, 1e300] {
            assert_eq!(Rgb::grey(value).luminance(), value);
        }
        assert_eq!(LUMINANCE_WEIGHTS.iter().sum::<f64>(), 1.0);
    }
}
