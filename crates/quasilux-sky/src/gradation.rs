//! The form that the CIE standard general sky and that of Perez share: a gradation from zenith to
//! horizon, times an indicatrix around the sun.

use libm::exp;

/// Relative luminance (1 + a exp(b / cos Z)) (1 + c (exp(d chi) - o) + e cos^2 chi) at the angle Z
/// from the zenith and chi from the sun.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Gradation {
    pub(crate) a: f64,
    pub(crate) b: f64,
    pub(crate) c: f64,
    pub(crate) d: f64,
    pub(crate) e: f64,
    /// What is taken from the exponential of the indicatrix.
    pub(crate) offset: f64,
    /// The smallest cos Z that is not taken as this.
    pub(crate) min_cos_zenith: f64,
}

impl Gradation {
    /// The relative luminance by the two angles, not below 0.
    pub(crate) fn relative(&self, cos_zenith: f64, cos_sun: f64) -> f64 {
        let Self { a, b, c, d, e, offset, min_cos_zenith } = *self;
        // At the horizon the exponential of a negative number without bound is 0.
        let gradation = 1.0 + a * exp(b / cos_zenith.max(min_cos_zenith));
        let cos_sun = cos_sun.clamp(-1.0, 1.0);
        let indicatrix = 1.0 + c * (exp(d * libm::acos(cos_sun)) - offset) + e * cos_sun * cos_sun;
        (gradation * indicatrix).max(0.0)
    }
}
