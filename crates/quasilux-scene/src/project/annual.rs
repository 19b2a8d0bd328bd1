//! `[annual]`: what a year is judged by.

use super::document::Section;
use super::keys::{Key, optional};
use super::outside::{OutsideEntry, OutsideLight};
use crate::annual::{Thresholds, WORKING_HOURS};
use crate::{LoadError, Spanned};
use quasilux_sky::WEEKDAYS;
use quasilux_text::Position;
use std::ops::Range;

pub(super) const KEYS: [Key; 8] = [
    optional("occupied_h", "`[from, to]`, hours, 0 to 24", "`[8, 18]`", "When people are there"),
    optional(
        "weekends",
        "`true` or `false`",
        "`true`",
        "Whether they are there on Saturdays and Sundays",
    ),
    optional(
        "first_day",
        "`\"monday\"` to `\"sunday\"`",
        "the weather file's",
        "The day of the week of 1 January",
    ),
    optional(
        "schedule",
        "file name",
        "none",
        "A CSV file with a row for each interval of the weather file, in place of `occupied_h`, \
         `weekends` and `first_day`",
    ),
    optional(
        "column",
        "text",
        "none",
        "The column of `schedule` that is 1 while people are there, 0 else",
    ),
    optional("enough_lx", "lx, above 0", "`300`", "What sDA and DA ask for"),
    optional(
        "useful_lx",
        "`[least, most]`, lx",
        "`[100, 3000]`",
        "The limits of useful daylight (UDI); `enough_lx` lies between them",
    ),
    optional(
        "sunlight_lx",
        "lx, above 0",
        "`1000`",
        "Direct sun above which an hour counts for ASE",
    ),
];

/// Terms that a year is judged by, as far as the project file says them.
#[derive(Clone, Debug, Default)]
pub(crate) struct AnnualEntry {
    pub(crate) occupancy: OccupancyEntry,
    pub(crate) thresholds: Thresholds,
}

/// When people are there.
#[derive(Clone, Debug)]
pub(crate) enum OccupancyEntry {
    Hours {
        hours: Range<f64>,
        /// Where the project says that nobody is there on weekends.
        no_weekends: Option<Position>,
        /// The day of the week of 1 January, from 0 for Monday, where it says so.
        new_year: Option<u32>,
    },
    Schedule {
        file: Spanned<String>,
        column: Spanned<String>,
    },
}

impl Default for OccupancyEntry {
    fn default() -> Self {
        Self::Hours { hours: WORKING_HOURS, no_weekends: None, new_year: None }
    }
}

pub(super) fn read(
    root: &Section<'_>,
    outside: Option<&OutsideEntry>,
) -> Result<AnnualEntry, LoadError> {
    let Some(section) = root.table("annual")? else { return Ok(AnnualEntry::default()) };
    if !matches!(outside, Some(OutsideEntry { light: OutsideLight::Weather(_), .. })) {
        let message = "[annual] goes with [sky] model = \"weather\": it is about a year";
        return Err(section.error(message));
    }
    section.only(&KEYS, &[])?;
    Ok(AnnualEntry { occupancy: occupancy(&section)?, thresholds: thresholds(&section)? })
}

fn occupancy(section: &Section<'_>) -> Result<OccupancyEntry, LoadError> {
    let text = |key, expected: &str| {
        let value = section.require(key, expected)?;
        Ok::<_, LoadError>(value.spanned(value.string(expected)?.to_owned()))
    };
    let [schedule, column] = ["schedule", "column"].map(|key| section.get(key));
    if schedule.is_some() || column.is_some() {
        let clock = ["occupied_h", "weekends", "first_day"];
        if let Some(value) = clock.iter().find_map(|key| section.get(key)) {
            let message = format!("\"{}\" and a schedule exclude each other", value.key);
            return Err(value.error(message));
        }
        let file = text("schedule", "the name of a CSV file with a row for each interval")?;
        let column = text("column", "the name of its column: 1 while people are there, else 0")?;
        return Ok(OccupancyEntry::Schedule { file, column });
    }
    let hours = section.get("occupied_h").map(|value| {
        let expected = "hours of a day, like [8, 18]";
        let [from, to] = value.pair(expected)?;
        let is_in_day = (0.0..to).contains(&from) && to <= 24.0;
        is_in_day.then_some(from..to).ok_or_else(|| value.unexpected(expected))
    });
    let weekends = section.get("weekends");
    let has_weekends = weekends.map(|value| value.boolean()).transpose()?.unwrap_or(true);
    let first_day = section.get("first_day").map(|value| value.name(&WEEKDAYS, &[])).transpose()?;
    let number = |name: &str| (0..).zip(WEEKDAYS).find(|(_, day)| *day == name).map(|(day, _)| day);
    Ok(OccupancyEntry::Hours {
        hours: hours.transpose()?.unwrap_or(WORKING_HOURS),
        no_weekends: weekends.filter(|_| !has_weekends).map(|value| value.place()),
        new_year: first_day.and_then(number),
    })
}

fn thresholds(section: &Section<'_>) -> Result<Thresholds, LoadError> {
    let usual = Thresholds::default();
    let number = |key, usual: f64| match section.get(key) {
        Some(value) => value.number("an illuminance in lx, above 0", |lx| lx > 0.0),
        None => Ok(usual),
    };
    let enough_lx = number("enough_lx", usual.enough_lx)?;
    let sunlight_lx = number("sunlight_lx", usual.sunlight_lx)?;
    let useful_lx = match section.get("useful_lx") {
        None => usual.useful_lx,
        Some(value) => value.pair("two illuminances in lx, like [100, 3000]")?,
    };
    let [least_lx, most_lx] = useful_lx;
    if !(0.0 < least_lx && least_lx <= enough_lx && enough_lx <= most_lx) {
        return Err(section.error(format!(
            "useful_lx is {least_lx} to {most_lx}, and enough_lx {enough_lx}; expected enough \
             light to be of use"
        )));
    }
    Ok(Thresholds { enough_lx, useful_lx, sunlight_lx })
}
