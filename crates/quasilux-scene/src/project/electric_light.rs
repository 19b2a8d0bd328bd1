//! `[electric_light]`: lamps that daylight dims over a year.

use super::document::Section;
use crate::{LoadError, Spanned};

const KEYS: [&str; 4] = ["power_w", "min_power_w", "target_lx", "sensor"];

/// Electric light, as far as the project file says it.
#[derive(Clone, Debug)]
pub(crate) struct ElectricLightEntry {
    pub(crate) power_w: f64,
    pub(crate) min_power_w: f64,
    pub(crate) target_lx: f64,
    /// The name of the sensor that measures daylight.
    pub(crate) sensor: Spanned<String>,
}

/// `None` where there is no `[electric_light]`.
pub(super) fn read(root: &Section<'_>) -> Result<Option<ElectricLightEntry>, LoadError> {
    let Some(section) = root.table("electric_light")? else { return Ok(None) };
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
    Ok(Some(ElectricLightEntry {
        power_w,
        min_power_w: min_power_w.transpose()?.unwrap_or(0.0),
        target_lx,
        sensor: sensor.spanned(sensor.string(expected)?.to_owned()),
    }))
}
