//! What shines at a time.

use super::{Weather, WeatherSky};
use crate::error::SkyError;
use crate::local_time::LocalTime;

/// The interval that a time lies in.
#[derive(Clone, Debug, PartialEq)]
pub struct LightAt {
    /// The middle of it.
    pub middle: LocalTime,
    /// `None` where nothing shines.
    pub light: Option<WeatherSky>,
}

/// Why a file does not say what shines at a time.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LightAtError {
    /// No interval has it.
    #[error(
        "no interval with {month:02}-{day:02} {:02}:{:02} in it; expected a time of the file, by \
         the clock of its site (the year does not matter)",
        minute / 60,
        minute % 60
    )]
    NoInterval {
        /// The month, from 1.
        month: u32,
        /// The day of the month, from 1.
        day: u32,
        /// The minute from midnight.
        minute: u32,
    },
    /// Its light was not measured.
    #[error(
        "no direct or no diffuse light for this time; expected a time whose light was measured"
    )]
    NoLight,
    /// Its values make no sky, or its date is none.
    #[error(transparent)]
    Sky(#[from] SkyError),
}

impl Weather {
    /// What shines at a time by the clock of the site, of any year.
    ///
    /// # Errors
    /// When the file has no interval of that time, or not its light.
    pub fn light_at(&self, time: &LocalTime) -> Result<LightAt, LightAtError> {
        let (month, day, seconds) = (time.month(), time.day(), time.seconds());
        let number = self.interval_at(month, day, seconds);
        let Some(hour) = number.and_then(|number| self.hours.get(number)) else {
            let minute = (seconds / 60.0) as u32;
            return Err(LightAtError::NoInterval { month, day, minute });
        };
        if hour.light.is_none() {
            return Err(LightAtError::NoLight);
        }
        Ok(LightAt { middle: self.time_of(hour)?, light: self.sky_of(hour)? })
    }
}
