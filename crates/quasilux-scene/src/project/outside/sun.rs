//! `[sun]`: where the sun is, and whether its disk shines.

use super::site::Oriented;
use crate::LoadError;
use crate::Spanned;
use crate::environment::Sun;
use crate::project::document::{Section, Value};
use crate::project::keys::{Key, optional};
use quasilux_sky::{LocalTime, SkyError, SkyPoint};
use quasilux_text::Position;

const DIRECT: Key =
    optional("direct", "`true` or `false`", "`false`", "Whether the disk of the sun shines");
pub(in crate::project) const KEYS: [Key; 5] = [
    optional("altitude_deg", "degrees, -90 to 90", "from `time`", "Above the horizon"),
    optional("azimuth_deg", "degrees, -360 to 360", "from `time`", "Clockwise from north"),
    optional(
        "time",
        "date and time, such as `2026-03-20T12:00:00`",
        "none",
        "Local time of `[site]`, in place of the two angles",
    ),
    DIRECT,
    optional(
        "normal_illuminance_lx",
        "lx, 0 to 1e9",
        "from the irradiances of a Perez sky",
        "What the sun gives on a plane across its rays; asked for where it shines under another \
         sky",
    ),
];
/// Keys of a sun that a weather file describes.
pub(in crate::project) const WEATHER_KEYS: [Key; 2] = [
    optional(
        "time",
        "date and time",
        "none",
        "Which interval of the weather file; a year needs none",
    ),
    DIRECT,
];

/// The day of the year where no time says which: the distance of the sun is then its mean one.
const MEAN_DAY: u32 = 94;
/// Largest illuminance of the sun that a project file may give, in lx.
const MAX_SUN_LX: f64 = 1e9;

/// Where the sun is, and when.
#[derive(Clone, Copy)]
pub(super) struct PlacedSun {
    pub(super) centre: SkyPoint,
    pub(super) time: Option<LocalTime>,
}

/// Time and direct light that are asked of the sun of a weather file.
#[derive(Default)]
pub(super) struct WeatherSun {
    pub(super) time: Option<Spanned<LocalTime>>,
    pub(super) is_direct: bool,
}

impl PlacedSun {
    pub(super) fn day_of_year(&self) -> u32 {
        self.time.map_or(MEAN_DAY, |time| time.day_of_year())
    }
}

pub(super) fn place(section: &Section<'_>, site: &Oriented) -> Result<PlacedSun, LoadError> {
    section.only(&KEYS, &[])?;
    let Some(time) = section.get("time") else {
        let number = |key, expected: &str, most: f64| {
            section.require(key, expected)?.number(expected, |x| x.abs() <= most)
        };
        let altitude_deg = number("altitude_deg", "degrees above the horizon, or time", 90.0)?;
        let azimuth_deg = number("azimuth_deg", "degrees clockwise from north", 360.0)?;
        return Ok(PlacedSun { centre: SkyPoint { altitude_deg, azimuth_deg }, time: None });
    };
    if let Some(angle) = section.get("altitude_deg").or(section.get("azimuth_deg")) {
        return Err(angle.error(format!("\"{}\" and \"time\" exclude each other", angle.key)));
    }
    let site = site.site.ok_or_else(|| {
        let keys = "latitude_deg, longitude_deg and time_zone_h";
        time.error(format!("\"time\" needs a site; expected [site] with {keys}"))
    })?;
    let at = local_time(&time)?;
    let centre = site.sun_at(&at).map_err(|error| time.error(error.to_string()))?;
    Ok(PlacedSun { centre, time: Some(at) })
}

/// Of a project whose sky is that of a weather file.
pub(super) fn of_weather(section: &Section<'_>) -> Result<WeatherSun, LoadError> {
    let told = KEYS
        .iter()
        .map(|key| key.name)
        .filter(|name| WEATHER_KEYS.iter().all(|it| it.name != *name));
    if let Some(value) = told.filter_map(|name| section.get(name)).next() {
        let message = format!(
            "the weather file says where the sun is and how bright, not \"{}\"; expected time, \
             and direct = true where its disk shines",
            value.key
        );
        return Err(value.error(message));
    }
    section.only(&WEATHER_KEYS, &[])?;
    let time = section.get("time").map(|value| Ok(value.spanned(local_time(&value)?)));
    Ok(WeatherSun { time: time.transpose()?, is_direct: is_direct(section)? })
}

/// The disk of the sun; `None` where it does not shine.
pub(super) fn disk(
    section: &Section<'_>,
    PlacedSun { centre, .. }: &PlacedSun,
    sun_lx: Option<f64>,
) -> Result<Option<Sun>, LoadError> {
    let is_direct = is_direct(section)?;
    let given = section.get("normal_illuminance_lx");
    if let (Some(given), Some(_)) = (given, sun_lx) {
        let message = "\"normal_illuminance_lx\" and the irradiances of [sky] exclude each other";
        return Err(given.error(message));
    }
    if !is_direct {
        return Ok(None);
    }
    let normal_illuminance_lx = match sun_lx {
        Some(lx) => lx,
        None => {
            let expected = "the illuminance in lx that the sun gives on a plane across its rays";
            let value = section.require("normal_illuminance_lx", expected)?;
            value.number(expected, |x| (0.0..=MAX_SUN_LX).contains(&x))?
        }
    };
    // Below the horizon there is no sun.
    let is_up = centre.altitude_deg > 0.0 && normal_illuminance_lx > 0.0;
    Ok(is_up.then_some(Sun { centre: *centre, normal_illuminance_lx }))
}

/// Where a section asks for the disk of the sun.
pub(super) fn place_of_direct(section: &Section<'_>) -> Result<Option<Position>, LoadError> {
    let asked = is_direct(section)?;
    Ok(section.get("direct").filter(|_| asked).map(|value| value.place()))
}

fn is_direct(section: &Section<'_>) -> Result<bool, LoadError> {
    section.get("direct").map_or(Ok(false), |value| value.boolean())
}

fn local_time(value: &Value<'_>) -> Result<LocalTime, LoadError> {
    value.time_text()?.parse().map_err(|error: SkyError| value.error(error.to_string()))
}
