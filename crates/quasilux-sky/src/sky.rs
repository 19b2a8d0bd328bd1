//! The luminance of a whole sky.

use crate::distribution::Distribution;
use crate::error::SkyError;
use crate::panorama::Panorama;
use std::f64::consts::PI;

/// What is known of how bright a sky is, without the sun.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SkyLevel {
    /// The illuminance that the sky alone gives on a horizontal plane.
    HorizontalIlluminance {
        /// In lx.
        lx: f64,
    },
    /// The luminance of the zenith.
    ZenithLuminance {
        /// In cd/m2.
        cd_m2: f64,
    },
    /// Relative luminances are in cd/m2, as those of a panorama.
    Absolute,
}

/// A sky with luminances in cd/m2.
#[derive(Clone, Debug, PartialEq)]
pub struct Sky {
    distribution: Distribution,
    /// The luminance of a relative luminance of 1.
    unit_cd_m2: f64,
    horizontal_illuminance_lx: f64,
}

/// The brightest sky that is taken for one, in lx and in cd/m2: far more than the sun gives.
const MAX_LEVEL: f64 = 1e9;

impl Sky {
    /// The sky of this distribution and level; where a distribution has no light, a uniform one.
    ///
    /// # Errors
    /// For levels that are negative or above 10^9, and for the luminance of a zenith that is dark.
    pub fn new(distribution: Distribution, level: SkyLevel) -> Result<Self, SkyError> {
        let horizontal = distribution.horizontal();
        if horizontal <= 0.0 && level != SkyLevel::Absolute {
            return Self::new(Distribution::uniform(), level);
        }
        let unit_cd_m2 = match level {
            SkyLevel::HorizontalIlluminance { lx } => {
                SkyError::check("horizontal_illuminance_lx", lx, 0.0..=MAX_LEVEL, "0 to 1e9")?;
                lx / horizontal
            }
            SkyLevel::ZenithLuminance { cd_m2 } => {
                SkyError::check("zenith_luminance_cd_m2", cd_m2, 0.0..=MAX_LEVEL, "0 to 1e9")?;
                let zenith = distribution.relative([0.0, 0.0, 1.0]);
                // A zenith that is next to dark says nothing of the rest.
                if zenith < 1e-6 * horizontal / PI {
                    let name = "zenith_luminance_cd_m2";
                    let expected = "the horizontal illuminance of a sky whose zenith is dark";
                    return Err(SkyError::new(name, cd_m2, expected));
                }
                cd_m2 / zenith
            }
            SkyLevel::Absolute => 1.0,
        };
        let horizontal_illuminance_lx = unit_cd_m2 * horizontal;
        Ok(Self { distribution, unit_cd_m2, horizontal_illuminance_lx })
    }

    /// The luminance in a direction, a unit vector; 0 below the horizon.
    #[must_use]
    pub fn luminance_cd_m2(&self, direction: [f64; 3]) -> f64 {
        self.unit_cd_m2 * self.distribution.relative(direction)
    }

    /// The panorama that it is of, whose luminances may be scaled.
    #[must_use]
    pub fn panorama(&self) -> Option<&Panorama> {
        self.distribution.as_panorama()
    }

    /// Whether it is by Perez, and of another brightness than its irradiances
    /// ([`Perez::is_held`](crate::Perez::is_held)).
    #[must_use]
    pub fn is_held(&self) -> bool {
        self.distribution.is_held()
    }

    /// How its luminances are distributed.
    pub(crate) fn distribution(&self) -> &Distribution {
        &self.distribution
    }

    /// The luminance of a relative luminance of 1.
    pub(crate) fn unit_cd_m2(&self) -> f64 {
        self.unit_cd_m2
    }

    /// The luminance of the zenith.
    #[must_use]
    pub fn zenith_luminance_cd_m2(&self) -> f64 {
        self.luminance_cd_m2([0.0, 0.0, 1.0])
    }

    /// The illuminance that the sky alone gives on a horizontal plane that nothing shades.
    #[must_use]
    pub fn horizontal_illuminance_lx(&self) -> f64 {
        self.horizontal_illuminance_lx
    }
}
