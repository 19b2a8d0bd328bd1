//! The sky and the sun of an interval of a weather file.

use super::possible::Possible;
use super::{Weather, WeatherHour, WeatherLight, WeatherUnits};
use crate::distribution::Distribution;
use crate::error::SkyError;
use crate::local_time::LocalTime;
use crate::perez::{Irradiance, Perez, SOLAR_CONSTANT_W_M2};
use crate::point::SkyPoint;
use crate::sky::{Sky, SkyLevel};
use libm::sin;

/// Below this altitude horizontal irradiances of the sun say nothing of its beam.
const MIN_BEAM_ALTITUDE_DEG: f64 = 1.0;
/// How often illuminances are turned into irradiances of which the efficacies are known.
const EFFICACY_ROUNDS: usize = 50;
/// What an efficacy is taken for where the formula has none, in lm/W.
const USUAL_EFFICACY_LM_W: f64 = 110.0;

/// What shines in an interval.
#[derive(Clone, Debug, PartialEq)]
pub struct WeatherSky {
    /// The sky without the sun, by Perez.
    pub sky: Sky,
    /// The centre of the sun in the middle of the interval; it may be below the horizon.
    pub sun: SkyPoint,
    /// The illuminance of the sun on a plane across its rays in lx; 0 below the horizon.
    pub sun_normal_illuminance_lx: f64,
}

impl WeatherSky {
    /// The illuminance of sky and sun in lx on a horizontal plane that nothing shades.
    #[must_use]
    pub fn horizontal_illuminance_lx(&self) -> f64 {
        let sine = sin(self.sun.altitude_deg.to_radians()).max(0.0);
        self.sky.horizontal_illuminance_lx() + self.sun_normal_illuminance_lx * sine
    }
}

impl Weather {
    /// Sky and sun of an interval: of its mean light, with the sun where it is in the middle.
    ///
    /// `None` where nothing shines, or where the file does not say what does
    /// ([`WeatherHour::light`]).
    ///
    /// # Errors
    /// For hours that no reader makes: dates that are none, and negative light.
    pub fn sky_of(&self, hour: &WeatherHour) -> Result<Option<WeatherSky>, SkyError> {
        let Some(light) = hour.light.filter(|light| light.direct + light.diffuse > 0.0) else {
            return Ok(None);
        };
        let time = self.time_of(hour)?;
        let sun = self.site.sun_at(&time)?;
        let dew_point_c = hour.dew_point_c.unwrap_or(Perez::DEW_POINT_C);
        let perez = |irradiance| Perez::new(irradiance, sun, time.day_of_year(), dew_point_c);
        let (perez, diffuse_lx, normal_lx) = match self.units {
            WeatherUnits::Irradiance | WeatherUnits::HorizontalIrradiance => {
                let perez = perez(self.irradiance(light, sun))?;
                (perez, perez.diffuse_illuminance_lx(), perez.normal_illuminance_lx())
            }
            WeatherUnits::Illuminance => {
                (of_illuminances(light, perez)?, light.diffuse, light.direct)
            }
        };
        let level = SkyLevel::HorizontalIlluminance { lx: diffuse_lx };
        let sky = Sky::new(Distribution::perez(&perez), level)?;
        let is_up = sun.altitude_deg > 0.0;
        Ok(Some(WeatherSky {
            sky,
            sun,
            sun_normal_illuminance_lx: if is_up { normal_lx } else { 0.0 },
        }))
    }

    /// The middle of an interval, in a year that has its date.
    ///
    /// # Errors
    /// For dates that no year has.
    pub fn time_of(&self, hour: &WeatherHour) -> Result<LocalTime, SkyError> {
        LocalTime::new(self.year, hour.month, hour.day, hour.seconds)
    }

    /// Whether the sky is dark in the middle of an interval, whatever the weather.
    ///
    /// # Errors
    /// For dates that no year has.
    pub fn is_night(&self, hour: &WeatherHour) -> Result<bool, SkyError> {
        Ok(Possible::of_middle(self, hour)?.is_night())
    }

    fn irradiance(&self, light: WeatherLight, sun: SkyPoint) -> Irradiance {
        let WeatherLight { direct, diffuse } = light;
        let across = |horizontal: f64| {
            let altitude_deg = sun.altitude_deg.max(MIN_BEAM_ALTITUDE_DEG);
            (horizontal / sin(altitude_deg.to_radians())).min(SOLAR_CONSTANT_W_M2)
        };
        let is_horizontal = self.units == WeatherUnits::HorizontalIrradiance;
        Irradiance {
            direct_normal_w_m2: if is_horizontal { across(direct) } else { direct },
            diffuse_horizontal_w_m2: diffuse,
        }
    }
}

/// The sky whose illuminances are these: its efficacies depend on the irradiances sought.
fn of_illuminances(
    light: WeatherLight,
    perez: impl Fn(Irradiance) -> Result<Perez, SkyError>,
) -> Result<Perez, SkyError> {
    let efficacy = |lx: f64, w_m2: f64| {
        if lx > 0.0 && w_m2 > 0.0 { lx / w_m2 } else { USUAL_EFFICACY_LM_W }
    };
    let guess = |lx: f64, lm_w: f64| (lx / lm_w).min(SOLAR_CONSTANT_W_M2);
    let mut irradiance = Irradiance {
        direct_normal_w_m2: guess(light.direct, USUAL_EFFICACY_LM_W),
        diffuse_horizontal_w_m2: guess(light.diffuse, USUAL_EFFICACY_LM_W),
    };
    for _ in 0..EFFICACY_ROUNDS {
        let found = perez(irradiance)?;
        let Irradiance { direct_normal_w_m2: direct, diffuse_horizontal_w_m2: diffuse } =
            irradiance;
        irradiance = Irradiance {
            direct_normal_w_m2: guess(
                light.direct,
                efficacy(found.normal_illuminance_lx(), direct),
            ),
            diffuse_horizontal_w_m2: guess(
                light.diffuse,
                efficacy(found.diffuse_illuminance_lx(), diffuse),
            ),
        };
    }
    perez(irradiance)
}
