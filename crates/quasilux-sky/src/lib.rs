//! What shines on a building from outside: the luminance of the sky and of the sun at one time.
//!
//! A [`Sky`] has a luminance in every direction above the horizon, a horizontal illuminance and a
//! zenith luminance. Its distribution is one of the CIE standard general skies ([`CieType`]), that
//! of a measured hour ([`Perez`]), of a picture ([`Panorama`]) or even; it is scaled by what is
//! known of it ([`SkyLevel`]). The position of the [`Sun`](SkyPoint) is given or computed of a
//! [`Site`] and a [`LocalTime`].
//!
//! Directions are unit vectors: x east, y north, z up. Azimuths are clockwise from north.
//!
//! ```
//! use quasilux_sky::{CieType, Distribution, Sky, SkyLevel, SkyPoint};
//! let sun = SkyPoint { altitude_deg: 60.0, azimuth_deg: 180.0 };
//! let distribution = Distribution::cie(CieType::new(1)?, sun);
//! let sky = Sky::new(distribution, SkyLevel::HorizontalIlluminance { lx: 10_000.0 })?;
//! // An overcast sky is three times as bright at the zenith as at the horizon, about.
//! let horizon = sky.luminance_cd_m2([1.0, 0.0, 0.0]);
//! assert!((sky.zenith_luminance_cd_m2() / horizon - 3.0).abs() < 0.1);
//! # Ok::<(), quasilux_sky::SkyError>(())
//! ```

mod cie;
mod distribution;
mod error;
mod gradation;
mod local_time;
mod panorama;
mod perez;
mod point;
mod quadrature;
mod sky;
mod solar_day;
mod sun;
mod tabulated;
mod weather;

pub use cie::CieType;
pub use distribution::Distribution;
pub use error::SkyError;
pub use local_time::LocalTime;
pub use panorama::{BrightPixel, Panorama, PanoramaWarning, ParsedPanorama};
pub use perez::{Irradiance, Perez};
pub use point::SkyPoint;
pub use sky::{Sky, SkyLevel};
pub use solar_day::{SolarDay, SolarPosition};
pub use sun::{SUN_RADIUS_DEG, Site, solid_angle_of_the_sun_sr, sun_luminance_cd_m2};
pub use tabulated::TabulatedSky;

pub use weather::{
    LightAt, LightAtError, ParsedWeather, WEEKDAYS, Weather, WeatherHour, WeatherLight, WeatherSky,
    WeatherUnits, WeatherWarning,
};

/// Tests the example of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
