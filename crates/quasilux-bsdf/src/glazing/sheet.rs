//! One sheet of glass at any angle, from what was measured at normal incidence.
//!
//! Uncoated glass is a slab: both boundaries reflect by Fresnel's equations, and light is absorbed
//! between them. Index and absorption follow from transmittance and reflectance at normal
//! incidence, in closed form and for each wavelength (Rubin 1985; Finlayson, Arasteh, Huizenga,
//! Rubin and Reilly 1993). The two polarisations are kept apart, also between several sheets.
//!
//! What happens in a coating or a film is not in the data. Such a sheet follows the mean curves of
//! clear or bronze glass (the same report, as used by LBNL WINDOW and EnergyPlus): bronze where no
//! more than 64.5 % of visible light passes. Deviation: the curves are scaled so that the values at
//! normal incidence are those of the file, and held to [0, 1], so that no light is made.

use super::photopic::{WAVELENGTHS, visible};

/// What becomes of light that meets a sheet, or several, at one angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SheetShares {
    /// Transmitted over incident flux, the same from both sides.
    pub transmittance: f64,
    /// Reflected over incident flux, for light that comes from the front.
    pub front_reflectance: f64,
    /// For light that comes from the back.
    pub back_reflectance: f64,
}

impl SheetShares {
    /// The same sheet turned round.
    #[must_use]
    pub fn flipped(self) -> Self {
        let Self { transmittance, front_reflectance, back_reflectance } = self;
        Self {
            transmittance,
            front_reflectance: back_reflectance,
            back_reflectance: front_reflectance,
        }
    }
}

/// Which of two plane waves: that whose field lies across the plane of incidence, or within it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Polarization {
    Across,
    Within,
}

/// How one sheet depends on the angle.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Sheet {
    /// A slab for each wavelength.
    Uncoated(Vec<Slab>),
    /// Values at normal incidence for each wavelength, and the curves that they follow.
    Coated(Vec<SheetShares>, &'static Curves),
}

/// A slab of one material at one wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Slab {
    /// Refractive index, from 1 on.
    pub(super) eta: f64,
    /// The share that is not absorbed on the way across, from boundary to boundary.
    pub(super) internal_transmittance: f64,
}

impl Sheet {
    /// A slab for each wavelength, from values at normal incidence that add up to at most 1. The
    /// mean of both reflectances counts.
    pub(super) fn uncoated(normal: &[SheetShares]) -> Self {
        Self::Uncoated(normal.iter().map(Slab::from_normal).collect())
    }

    /// A sheet that follows the curves of coated glass.
    pub(super) fn coated(normal: Vec<SheetShares>) -> Self {
        let transmittance = visible(|number| normal[number].transmittance);
        let curves = if transmittance > MIN_CLEAR { &CLEAR } else { &BRONZE };
        Self::Coated(normal, curves)
    }

    /// The shares of a wavelength at an angle whose cosine with the normal is `cos`.
    pub(super) fn at(&self, number: usize, cos: f64, polarization: Polarization) -> SheetShares {
        match self {
            Self::Uncoated(slabs) => slabs[number].at(cos, polarization),
            Self::Coated(normal, curves) => curves.at(normal[number], cos),
        }
    }

    /// The refractive index as the eye weighs it; `None` of coated sheets.
    pub(super) fn eta(&self) -> Option<f64> {
        match self {
            Self::Uncoated(slabs) => {
                debug_assert_eq!(slabs.len(), WAVELENGTHS);
                Some(visible(|number| slabs[number].eta))
            }
            Self::Coated(..) => None,
        }
    }
}

impl Slab {
    /// Solves `T = (1 - r)^2 a / (1 - r^2 a^2)` and `R = r (1 + a T)` for the reflectance r of a
    /// boundary and the internal transmittance a.
    pub(super) fn from_normal(normal: &SheetShares) -> Self {
        let t = normal.transmittance;
        let reflected = 0.5 * (normal.front_reflectance + normal.back_reflectance);
        let b = t * t - reflected * reflected + 2.0 * reflected + 1.0;
        let under_root = (b * b - 4.0 * (2.0 - reflected) * reflected).max(0.0);
        // The smaller root, in the form without a difference of almost equal numbers.
        let r = 2.0 * reflected / (b + under_root.sqrt());
        // By the transmittance: the larger value loses fewer digits.
        let internal_transmittance = internal(t, r).clamp(0.0, 1.0);
        // An index above 199 is a mirror.
        let root = r.sqrt().min(0.99);
        Self { eta: (1.0 + root) / (1.0 - root), internal_transmittance }
    }

    /// At any angle, all inner reflections included.
    pub(super) fn at(self, cos: f64, polarization: Polarization) -> SheetShares {
        let Self { eta, internal_transmittance } = self;
        let cos = cos.clamp(0.0, 1.0);
        let inside = (1.0 - (1.0 - cos * cos) / (eta * eta)).max(0.0).sqrt();
        let (near, far) = match polarization {
            Polarization::Across => (cos, eta * inside),
            Polarization::Within => (eta * cos, inside),
        };
        if near <= 0.0 {
            return SheetShares {
                transmittance: 0.0,
                front_reflectance: 1.0,
                back_reflectance: 1.0,
            };
        }
        let amplitude = (near - far) / (near + far);
        let r = amplitude * amplitude;
        let a = libm::pow(internal_transmittance, 1.0 / inside);
        let transmittance = (1.0 - r) * (1.0 - r) * a / ((1.0 - r * a) * (1.0 + r * a));
        let reflectance = (r * (1.0 + a * transmittance)).min(1.0 - transmittance);
        SheetShares { transmittance, front_reflectance: reflectance, back_reflectance: reflectance }
    }
}

/// The root of `r^2 t a^2 + (1 - r)^2 a - t = 0` from 0 on.
fn internal(t: f64, r: f64) -> f64 {
    let through = (1.0 - r) * (1.0 - r);
    if t <= 0.0 {
        return 0.0;
    }
    2.0 * t / (through + (through * through + 4.0 * r * r * t * t).sqrt())
}

/// Visible transmittance above which a coated sheet follows the curves of clear glass.
const MIN_CLEAR: f64 = 0.645;

/// Polynomials in the cosine of the angle, the constant term first: what passes over what passes at
/// normal incidence, and its sum with how far the reflectance has come on its way to 1.
#[derive(Debug, PartialEq)]
pub(super) struct Curves {
    transmitted: [f64; 5],
    sum: [f64; 5],
}

const CLEAR: Curves = Curves {
    transmitted: [-0.0015, 3.355, -3.840, 1.460, 0.0288],
    sum: [0.999, -0.563, 2.043, -2.532, 1.054],
};

const BRONZE: Curves = Curves {
    transmitted: [-0.002, 2.813, -2.341, -0.05725, 0.599],
    sum: [0.997, -1.868, 6.513, -7.862, 3.225],
};

impl Curves {
    fn at(&self, normal: SheetShares, cos: f64) -> SheetShares {
        let scaled = |coefficients: &[f64; 5]| {
            let value = |cos: f64| coefficients.iter().rev().fold(0.0, |sum, c| sum * cos + c);
            value(cos.clamp(0.0, 1.0)) / value(1.0)
        };
        let passed = scaled(&self.transmitted).clamp(0.0, 1.0);
        let risen = (scaled(&self.sum) - passed).clamp(0.0, 1.0 - passed);
        let transmittance = normal.transmittance * passed;
        let reflected = |share: f64| (share + (1.0 - share) * risen).min(1.0 - transmittance);
        SheetShares {
            transmittance,
            front_reflectance: reflected(normal.front_reflectance),
            back_reflectance: reflected(normal.back_reflectance),
        }
    }
}
