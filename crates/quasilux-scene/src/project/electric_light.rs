//! `[electric_light]`, or `[[electric_light]]` for several zones: lamps that daylight dims over a
//! year.

use super::document::Section;
use super::keys::{Key, optional, required};
use super::names::zone_name;
use crate::{LoadError, Spanned};

pub(super) const KEYS: [Key; 5] = [
    optional("name", "text", "`\"electric_light\"` if there is but one", "The name of the zone"),
    required("power_w", "W, above 0", "The power of all its lamps without daylight"),
    optional(
        "min_power_w",
        "W, 0 to `power_w`",
        "`0`",
        "The power of the dimmed lamps when daylight is enough",
    ),
    required("target_lx", "lx, above 0", "The illuminance to which the lamps fill up daylight"),
    required("sensor", "name of a sensor", "The sensor whose average counts"),
];
/// Most zones.
const MAX_ZONES: usize = 1000;

/// A zone of electric light, as far as the project file says it.
#[derive(Clone, Debug)]
pub(crate) struct ElectricLightEntry {
    pub(crate) name: String,
    pub(crate) power_w: f64,
    pub(crate) min_power_w: f64,
    pub(crate) target_lx: f64,
    /// The name of the sensor that measures daylight.
    pub(crate) sensor: Spanned<String>,
}

/// The zones: none where there is no `[electric_light]`.
pub(super) fn read(root: &Section<'_>) -> Result<Vec<ElectricLightEntry>, LoadError> {
    let sections = root.table_or_tables("electric_light", MAX_ZONES)?;
    let mut zones: Vec<ElectricLightEntry> = Vec::new();
    for section in &sections {
        let taken = zones.iter().map(|zone| zone.name.as_str());
        let name = zone_name(section, "electric_light", sections.len(), taken)?;
        zones.push(zone(section, name)?);
    }
    Ok(zones)
}

fn zone(section: &Section<'_>, name: String) -> Result<ElectricLightEntry, LoadError> {
    section.only(&KEYS, &[])?;
    let number =
        |key, expected: &str| section.require(key, expected)?.number(expected, |x| x > 0.0);
    let power_w = number("power_w", "the power of all lamps in W, above 0")?;
    let target_lx = number("target_lx", "the wanted illuminance in lx, above 0")?;
    let min_power_w = section.get("min_power_w").map(|value| {
        value.number("power in W from 0 to power_w", |x| (0.0..=power_w).contains(&x))
    });
    let expected = "the name of the sensor whose average counts";
    let sensor = section.require("sensor", expected)?;
    Ok(ElectricLightEntry {
        name,
        power_w,
        min_power_w: min_power_w.transpose()?.unwrap_or(0.0),
        target_lx,
        sensor: sensor.spanned(sensor.string(expected)?.to_owned()),
    })
}
