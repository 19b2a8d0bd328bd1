//! What a year is judged by, once its weather is known.

use super::schedule::Scheduled;
use crate::annual::{Occupancy, OccupiedDays, YearTerms};
use crate::project::{AnnualEntry, OccupancyEntry, Project};
use crate::{Files, LoadError};
use quasilux_sky::Weather;

pub(super) fn terms(
    project: &Project,
    weather: Option<&Weather>,
    files: &dyn Files,
) -> Result<YearTerms, LoadError> {
    let AnnualEntry { occupancy, thresholds } = &project.annual;
    let occupancy = match occupancy {
        OccupancyEntry::Hours { hours, no_weekends, new_year } => {
            let of_file = || weather.and_then(|weather| weather.new_year_weekday);
            let days = match (no_weekends, new_year.or_else(of_file)) {
                (None, _) => OccupiedDays::All,
                (Some(_), Some(new_year)) => OccupiedDays::Weekdays { new_year },
                (Some(place), None) => {
                    let message = "the weather file does not say with which day of the week its \
                                   year begins; set first_day, such as \"monday\"";
                    return Err(project.error(*place, message));
                }
            };
            Occupancy::Hours { hours: hours.clone(), days }
        }
        OccupancyEntry::Schedule { file, column } => {
            let intervals = weather.map_or(0, |weather| weather.hours.len());
            let what = Scheduled { file, column, names: &["away", "there"], intervals };
            let numbers = what.read(project, files)?;
            Occupancy::Schedule { is_there: numbers.into_iter().map(|it| it == 1).collect() }
        }
    };
    let areas = project.sensors.iter().map(|entry| entry.areas.clone()).collect();
    Ok(YearTerms { occupancy, thresholds: *thresholds, areas })
}
