//! The standard normal distribution.
//!
//! M. J. Wichura, "Algorithm AS 241: The percentage points of the normal distribution" (Appl.
//! Statist. 37, 1988), routine PPND16: ratios of polynomials of degree 7 in three intervals, to
//! 1e-16 relative.

use std::f64::consts::{FRAC_1_SQRT_2, TAU};

use crate::unit::clamp_to_unit;

/// The number below which a standard normal variable lies with probability u.
///
/// At 0 it is that of 2^-54, half the smallest coordinate above, so that all coordinates give
/// finite numbers: at least -8.3, at most 8.3.
#[must_use]
pub fn sample_normal(u: f64) -> f64 {
    const LEAST: f64 = f64::EPSILON / 4.0;
    let centred = u - 0.5;
    if centred.abs() <= 0.425 {
        return centred * CENTRE.value(0.180_625 - centred * centred);
    }
    let tail = if centred < 0.0 { u } else { 1.0 - u };
    let t = (-libm::log(tail.max(LEAST))).sqrt();
    let x = if t <= 5.0 { MIDDLE.value(t - 1.6) } else { TAIL.value(t - 5.0) };
    if centred < 0.0 { -x } else { x }
}

/// Density of [`sample_normal`].
#[must_use]
pub fn pdf_normal(x: f64) -> f64 {
    libm::exp(-0.5 * x * x) / TAU.sqrt()
}

/// The coordinate that [`sample_normal`] maps to x: the distribution function.
#[must_use]
pub fn invert_normal(x: f64) -> f64 {
    clamp_to_unit(0.5 * libm::erfc(-x * FRAC_1_SQRT_2))
}

/// A ratio of polynomials, the constant coefficients first.
struct RationalFunction {
    numerator: [f64; 8],
    denominator: [f64; 8],
}

impl RationalFunction {
    fn value(&self, x: f64) -> f64 {
        let horner =
            |coefficients: &[f64]| coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c);
        horner(&self.numerator) / horner(&self.denominator)
    }
}

/// In 0.425^2 - (u - 1/2)^2.
const CENTRE: RationalFunction = RationalFunction {
    numerator: [
        3.387_132_872_796_366_5,
        133.141_667_891_784_38,
        1_971.590_950_306_551_3,
        13_731.693_765_509_46,
        45_921.953_931_549_87,
        67_265.770_927_008_7,
        33_430.575_583_588_13,
        2_509.080_928_730_122_7,
    ],
    denominator: [
        1.0,
        42.313_330_701_600_91,
        687.187_007_492_057_9,
        5_394.196_021_424_751,
        21_213.794_301_586_597,
        39_307.895_800_092_71,
        28_729.085_735_721_943,
        5_226.495_278_852_854,
    ],
};
/// In t - 1.6, t the root of the negative logarithm of the tail, up to 5.
const MIDDLE: RationalFunction = RationalFunction {
    numerator: [
        1.423_437_110_749_683_5,
        4.630_337_846_156_546,
        5.769_497_221_460_691,
        3.647_848_324_763_204_5,
        1.270_458_252_452_368_4,
        0.241_780_725_177_450_6,
        0.022_723_844_989_269_184,
        0.000_774_545_014_278_341_4,
    ],
    denominator: [
        1.0,
        2.053_191_626_637_759,
        1.676_384_830_183_803_8,
        0.689_767_334_985_1,
        0.148_103_976_427_480_08,
        0.015_198_666_563_616_457,
        0.000_547_593_808_499_534_5,
        1.050_750_071_644_416_9e-9,
    ],
};
/// In t - 5.
const TAIL: RationalFunction = RationalFunction {
    numerator: [
        6.657_904_643_501_103,
        5.463_784_911_164_114,
        1.784_826_539_917_291_3,
        0.296_560_571_828_504_87,
        0.026_532_189_526_576_124,
        0.001_242_660_947_388_078_4,
        2.711_555_568_743_487_6e-5,
        2.010_334_399_292_288_1e-7,
    ],
    denominator: [
        1.0,
        0.599_832_206_555_888,
        0.136_929_880_922_735_8,
        0.014_875_361_290_850_615,
        0.000_786_869_131_145_613_3,
        1.846_318_317_510_054_8e-5,
        1.421_511_758_316_446e-7,
        2.044_263_103_389_939_7e-15,
    ],
};
