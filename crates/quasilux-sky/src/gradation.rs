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
        (self.below_zenith(cos_zenith) * self.around_sun(cos_sun)).max(0.0)
    }

    /// The gradation.
    pub(crate) fn below_zenith(&self, cos_zenith: f64) -> f64 {
        // At the horizon the exponential of a negative number without bound is 0.
        1.0 + self.a * exp(self.b / cos_zenith.max(self.min_cos_zenith))
    }

    /// The indicatrix.
    pub(crate) fn around_sun(&self, cos_sun: f64) -> f64 {
        let Self { c, d, e, offset, .. } = *self;
        let cos_sun = cos_sun.clamp(-1.0, 1.0);
        1.0 + c * (exp(d * libm::acos(cos_sun)) - offset) + e * cos_sun * cos_sun
    }
}
