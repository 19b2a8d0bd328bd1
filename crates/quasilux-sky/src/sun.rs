//! Where the sun is, and how bright its disk.

use crate::error::SkyError;
use crate::local_time::LocalTime;
use crate::point::SkyPoint;
use libm::sin;
use solar_positioning::time::JulianDate;
use solar_positioning::{Location, SolarPositions, delta_t};
use std::f64::consts::PI;

/// Half of the angle that the sun's disk is seen under: 0.533 degrees, its mean over a year.
pub const SUN_RADIUS_DEG: f64 = 0.533 / 2.0;

/// The hours that clocks of time zones and summer time are off at most, in the west of China.
const MAX_OFF_H: f64 = 3.75;

/// A place on the earth, and its clock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Site {
    latitude_deg: f64,
    longitude_deg: f64,
    time_zone_h: f64,
}

impl Site {
    /// A site by its latitude (north positive), its longitude (east positive) and the hours that
    /// its clock is ahead of Greenwich.
    ///
    /// # Errors
    /// For latitudes beyond 90, longitudes beyond 180 degrees and clocks more than 15 hours off.
    pub fn new(latitude_deg: f64, longitude_deg: f64, time_zone_h: f64) -> Result<Self, SkyError> {
        SkyError::check("latitude_deg", latitude_deg, -90.0..=90.0, "-90 to 90")?;
        SkyError::check("longitude_deg", longitude_deg, -180.0..=180.0, "-180 to 180")?;
        SkyError::check("time_zone_h", time_zone_h, -15.0..=15.0, "-15 to 15")?;
        Ok(Self { latitude_deg, longitude_deg, time_zone_h })
    }

    /// Degrees north of the equator.
    #[must_use]
    pub fn latitude_deg(&self) -> f64 {
        self.latitude_deg
    }

    /// Degrees east of Greenwich.
    #[must_use]
    pub fn longitude_deg(&self) -> f64 {
        self.longitude_deg
    }

    /// Hours that the clock is ahead of Greenwich.
    #[must_use]
    pub fn time_zone_h(&self) -> f64 {
        self.time_zone_h
    }

    /// Whether its clock is further from the mean sun than that of any time zone, summer time too:
    /// then the clock or the longitude is that of another place.
    #[must_use]
    pub fn has_clock_of_another_place(&self) -> bool {
        let off_h = self.time_zone_h - self.longitude_deg / 15.0;
        ((off_h + 12.0).rem_euclid(24.0) - 12.0).abs() > MAX_OFF_H
    }

    /// The centre of the sun, as if there were no air: refraction lifts it by half a degree at the
    /// horizon and by less than 0.1 degrees from 10 degrees on.
    ///
    /// By the algorithm of I. Reda and A. Andreas, "Solar position algorithm for solar radiation
    /// applications" (Solar Energy 76, 2004): 0.0003 degrees. The difference of uniform and
    /// terrestrial time is that of Espenak and Meeus; UTC is taken for UT1.
    ///
    /// # Errors
    /// For times beyond the range of the algorithm, which no [`LocalTime`] is.
    pub fn sun_at(&self, time: &LocalTime) -> Result<SkyPoint, SkyError> {
        let year = f64::from(time.year()) + f64::from(time.day_of_year()) / 365.25;
        let location = Location { latitude: self.latitude_deg, longitude: self.longitude_deg };
        let position = delta_t::estimate(year.min(3000.0))
            .and_then(|delta_t| JulianDate::new(time.julian_date(self.time_zone_h), delta_t))
            .and_then(|time| SolarPositions::new().at_from_julian(time, location, 0.0, None))
            .map_err(|error| SkyError::new("the time", error, "a year from 1583 to 3000"))?;
        let (altitude_deg, azimuth_deg) = (position.elevation_angle(), position.azimuth());
        Ok(SkyPoint { altitude_deg, azimuth_deg })
    }
}

/// The solid angle of the sun's disk in sr.
#[must_use]
pub fn solid_angle_of_the_sun_sr() -> f64 {
    // One less a small cosine would lose digits.
    let half = sin(0.5 * SUN_RADIUS_DEG.to_radians());
    4.0 * PI * half * half
}

/// The mean luminance of the sun's disk in cd/m2 that gives this many lx on a plane across its
/// rays.
#[must_use]
pub fn sun_luminance_cd_m2(normal_illuminance_lx: f64) -> f64 {
    // Over the disk the cosine is 1 but for a part of 10^-5, which is counted in: the projected
    // solid angle is pi sin^2 of the radius.
    let sine = sin(SUN_RADIUS_DEG.to_radians());
    normal_illuminance_lx / (PI * sine * sine)
}
