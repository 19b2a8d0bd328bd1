//! `[site]`: a place on the earth, and where north is.

use super::refuse;
use crate::LoadError;
use crate::project::document::Section;
use crate::project::keys::{Key, optional};
use quasilux_sky::Site;

const NO_SITE: &str = "the weather file's, or none";
pub(in crate::project) const KEYS: [Key; 4] = [
    optional(
        "latitude_deg",
        "degrees, -90 to 90",
        NO_SITE,
        "North of the equator; this and the next two go together",
    ),
    optional("longitude_deg", "degrees, -180 to 180", NO_SITE, "East of Greenwich"),
    optional("time_zone_h", "hours, -15 to 15", NO_SITE, "Ahead of Greenwich, without summer time"),
    optional(
        "north_deg",
        "degrees, -360 to 360",
        "`0`",
        "Where north is, counter-clockwise from +y",
    ),
];

/// A place with its compass.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Oriented {
    pub(super) site: Option<Site>,
    pub(super) north_deg: f64,
}

pub(super) fn read(section: &Section<'_>) -> Result<Oriented, LoadError> {
    section.only(&KEYS, &[])?;
    let north = section.get("north_deg").map(|value| {
        value.number("degrees from +y, counter-clockwise, -360 to 360", |x| x.abs() <= 360.0)
    });
    let north_deg = north.transpose()?.unwrap_or(0.0);
    let given = KEYS[..3].iter().find(|key| section.get(key.name).is_some());
    if given.is_none() {
        return Ok(Oriented { site: None, north_deg });
    }
    let number = |key, expected: &str| section.require(key, expected)?.number(expected, |_| true);
    let latitude_deg = number("latitude_deg", "degrees north, -90 to 90")?;
    let longitude_deg = number("longitude_deg", "degrees east, -180 to 180")?;
    let time_zone_h = number("time_zone_h", "hours ahead of Greenwich, -15 to 15")?;
    let site = Site::new(latitude_deg, longitude_deg, time_zone_h);
    Ok(Oriented { site: Some(site.map_err(|error| refuse(section, &error))?), north_deg })
}
