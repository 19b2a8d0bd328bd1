//! How much light there can be: the physically possible limits of the Baseline Surface Radiation
//! Network (C. N. Long and E. G. Dutton, "BSRN global network recommended QC tests, V2.0", 2002).

use super::{Weather, WeatherHour, WeatherLight, WeatherUnits};
use crate::error::SkyError;
use crate::local_time::LocalTime;
use crate::perez::{SOLAR_CONSTANT_W_M2, eccentricity};
use crate::point::SkyPoint;
use libm::{pow, sin};

/// More than the efficacy of any daylight, in lm/W.
const MAX_LM_W: f64 = 160.0;

/// Sun and limits of an interval.
pub(super) struct Possible {
    /// Of the sun.
    pub(super) altitude_deg: f64,
    /// Of the sun on a plane across its rays above the air, in W/m2.
    pub(super) above_the_air_w_m2: f64,
}

impl Possible {
    /// By the middle of an interval.
    pub(super) fn of_middle(weather: &Weather, hour: &WeatherHour) -> Result<Self, SkyError> {
        Self::at(weather, hour, hour.seconds)
    }

    /// By the highest sun of the beginning, the middle and the end.
    pub(super) fn of_all(weather: &Weather, hour: &WeatherHour) -> Result<Self, SkyError> {
        let last_s = (24.0 * super::HOUR_S).next_down();
        let mut all = Self::of_middle(weather, hour)?;
        for part in [-0.5, 0.5] {
            let seconds = (hour.seconds + part * weather.interval_s).clamp(0.0, last_s);
            let there = Self::at(weather, hour, seconds)?;
            all.altitude_deg = all.altitude_deg.max(there.altitude_deg);
        }
        Ok(all)
    }

    fn at(weather: &Weather, hour: &WeatherHour, seconds: f64) -> Result<Self, SkyError> {
        let time = LocalTime::new(weather.year, hour.month, hour.day, seconds)?;
        Ok(Self {
            altitude_deg: weather.site.sun_at(&time)?.altitude_deg,
            above_the_air_w_m2: SOLAR_CONSTANT_W_M2 * eccentricity(time.day_of_year()),
        })
    }

    /// Whether the sky is dark whatever the weather.
    pub(super) fn is_night(&self) -> bool {
        self.altitude_deg < SkyPoint::NIGHT_DEG
    }

    /// The sine of the sun's altitude, not below 0.
    pub(super) fn sine(&self) -> f64 {
        sin(self.altitude_deg.to_radians()).max(0.0)
    }

    /// The largest light, in the units of a file.
    pub(super) fn most(&self, units: WeatherUnits) -> WeatherLight {
        let sine = self.sine();
        let diffuse = 0.95 * self.above_the_air_w_m2 * pow(sine, 1.2) + 50.0;
        let direct = match units {
            WeatherUnits::HorizontalIrradiance => self.above_the_air_w_m2 * sine + 50.0,
            WeatherUnits::Irradiance | WeatherUnits::Illuminance => self.above_the_air_w_m2,
        };
        let lm_w = efficacy(units);
        WeatherLight { direct: direct * lm_w, diffuse: diffuse * lm_w }
    }

    /// The largest light of sun and sky on a horizontal plane, in the units of a file.
    pub(super) fn most_global(&self, units: WeatherUnits) -> f64 {
        (1.5 * self.above_the_air_w_m2 * pow(self.sine(), 1.2) + 100.0) * efficacy(units)
    }

    /// What sun and sky give a horizontal plane.
    pub(super) fn global(&self, light: WeatherLight, units: WeatherUnits) -> f64 {
        let sine = if units == WeatherUnits::HorizontalIrradiance { 1.0 } else { self.sine() };
        light.direct * sine + light.diffuse
    }

    pub(super) fn holds(&self, light: WeatherLight, units: WeatherUnits) -> bool {
        let most = self.most(units);
        light.direct <= most.direct
            && light.diffuse <= most.diffuse
            && self.global(light, units) <= self.most_global(units)
    }
}

fn efficacy(units: WeatherUnits) -> f64 {
    if units == WeatherUnits::Illuminance { MAX_LM_W } else { 1.0 }
}
