//! The CIE standard general sky.

use crate::error::SkyError;
use crate::gradation::Gradation;
use std::f64::consts::FRAC_PI_2;

/// One of the sky types of CIE S 011/E:2003 (ISO 15469:2004), or the traditional overcast sky.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CieType(u8);

/// a, b, c, d, e of types 1 to 15: CIE S 011/E:2003, table 1.
const PARAMETERS: [[f64; 5]; 15] = [
    [4.0, -0.70, 0.0, -1.0, 0.0],
    [4.0, -0.70, 2.0, -1.5, 0.15],
    [1.1, -0.8, 0.0, -1.0, 0.0],
    [1.1, -0.8, 2.0, -1.5, 0.15],
    [0.0, -1.0, 0.0, -1.0, 0.0],
    [0.0, -1.0, 2.0, -1.5, 0.15],
    [0.0, -1.0, 5.0, -2.5, 0.30],
    [0.0, -1.0, 10.0, -3.0, 0.45],
    [-1.0, -0.55, 2.0, -1.5, 0.15],
    [-1.0, -0.55, 5.0, -2.5, 0.30],
    [-1.0, -0.55, 10.0, -3.0, 0.45],
    [-1.0, -0.32, 10.0, -3.0, 0.45],
    [-1.0, -0.32, 16.0, -3.0, 0.30],
    [-1.0, -0.15, 16.0, -3.0, 0.30],
    [-1.0, -0.15, 24.0, -2.8, 0.15],
];

impl CieType {
    /// Type 1 to 15 of the standard; 16 is the traditional overcast sky of Moon and Spencer, with
    /// luminances in proportion to 1 + 2 sin(altitude).
    ///
    /// # Errors
    /// For other numbers.
    pub fn new(number: i64) -> Result<Self, SkyError> {
        match u8::try_from(number) {
            Ok(number @ 1..=16) => Ok(Self(number)),
            _ => Err(SkyError::new("the type of the CIE sky", number, "1 to 16")),
        }
    }

    /// Its number.
    #[must_use]
    pub fn number(self) -> u8 {
        self.0
    }

    /// Whether its luminances depend on where the sun is.
    #[must_use]
    pub fn needs_sun(self) -> bool {
        !matches!(self.0, 1 | 3 | 5 | 16)
    }

    /// What the standard calls it.
    #[must_use]
    pub fn description(self) -> &'static str {
        match self.0 {
            1 => "overcast, steep gradation, azimuthal uniformity",
            2 => "overcast, steep gradation, slight brightening towards the sun",
            3 => "overcast, moderate gradation, azimuthal uniformity",
            4 => "overcast, moderate gradation, slight brightening towards the sun",
            5 => "uniform luminance",
            6 => "partly cloudy, no gradation, slight brightening towards the sun",
            7 => "partly cloudy, no gradation, brighter circumsolar region",
            8 => "partly cloudy, no gradation, distinct solar corona",
            9 => "partly cloudy, sun obscured",
            10 => "partly cloudy, brighter circumsolar region",
            11 => "white-blue, distinct solar corona",
            12 => "clear, low turbidity",
            13 => "clear, polluted atmosphere",
            14 => "cloudless turbid, broad solar corona",
            15 => "white-blue turbid, broad solar corona",
            _ => "traditional overcast",
        }
    }

    /// The form of its luminances; `None` for the traditional overcast sky.
    pub(crate) fn gradation(self) -> Option<Gradation> {
        let [a, b, c, d, e] = *PARAMETERS.get(usize::from(self.0) - 1)?;
        let offset = libm::exp(d * FRAC_PI_2);
        Some(Gradation { a, b, c, d, e, offset, min_cos_zenith: 0.0 })
    }
}
