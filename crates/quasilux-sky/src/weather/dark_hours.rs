//! The nights that files of hours with the sun up leave out, as Ladybug and Honeybee write them.

use super::{HOUR_S, Weather, WeatherHour, WeatherLight};
use crate::error::SkyError;
use crate::local_time::LocalTime;

/// The sun is up for half of the hours of a year everywhere, within some 3 %; a file that has so
/// many leaves out nights alone.
const MIN_HOURS: f64 = 4000.0;
/// An interval of which the sun is up for a moment has its middle below this, in degrees.
const HARDLY_UP_DEG: f64 = 3.0;
const DARK: Option<WeatherLight> = Some(WeatherLight { direct: 0.0, diffuse: 0.0 });

/// Puts in the intervals that are missing: dark ones where the sun is down, else unknown ones. Not
/// where a day with sun is missing as a whole: such a file is not of a year.
pub(super) fn fill_in(weather: &mut Weather) {
    let enough = weather.hours.len() as f64 * weather.interval_s >= MIN_HOURS * HOUR_S;
    if weather.is_of_a_year() || !enough || !is_in_order(&weather.hours) {
        return;
    }
    if let Ok(Some(hours)) = with_nights(weather) {
        weather.hours = hours;
    }
}

pub(super) fn is_in_order(hours: &[WeatherHour]) -> bool {
    hours.is_sorted_by(|a, b| a.time() < b.time())
}

/// `None` where the sun is up on a day that is missing.
fn with_nights(weather: &Weather) -> Result<Option<Vec<WeatherHour>>, SkyError> {
    let interval_s = weather.interval_s;
    let a_day = (24.0 * HOUR_S / interval_s).round() as u32;
    let first = weather.hours.first().map_or(0.0, |hour| hour.seconds);
    let offset_s = first.rem_euclid(interval_s);
    let mut of_dates = weather.hours.chunk_by(|a, b| (a.month, a.day) == (b.month, b.day));
    let mut next = of_dates.next();
    let mut hours = Vec::new();
    for (month, day) in dates(weather.year) {
        let own = next.filter(|own| (own[0].month, own[0].day) == (month, day));
        if own.is_some() {
            next = of_dates.next();
        }
        let mut own = own.unwrap_or_default().iter().peekable();
        let has_own = own.peek().is_some();
        for number in 0..a_day {
            let seconds = offset_s + f64::from(number) * interval_s;
            let count = hours.len();
            hours.extend(std::iter::from_fn(|| {
                own.next_if(|hour| hour.seconds < seconds + 0.5 * interval_s)
            }));
            if hours.len() > count {
                continue;
            }
            let sun = weather.site.sun_at(&LocalTime::new(weather.year, month, day, seconds)?)?;
            let is_up = sun.altitude_deg > HARDLY_UP_DEG;
            if is_up && !has_own {
                return Ok(None);
            }
            let light = if is_up { None } else { DARK };
            hours.push(WeatherHour { month, day, seconds, light, dew_point_c: None });
        }
        hours.extend(own);
    }
    Ok(Some(hours))
}

fn dates(year: i32) -> impl Iterator<Item = (u32, u32)> {
    let all = (1..=12).flat_map(|month| (1..=31).map(move |day| (month, day)));
    all.filter(move |&(month, day)| LocalTime::new(year, month, day, 0.0).is_ok())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fmt::Write;

    /// A year of hours for which `is_there`.
    fn year(latitude_deg: f64, is_there: impl Fn(&Weather, &WeatherHour) -> bool) -> Weather {
        let head = format!(
            "place X\nlatitude {latitude_deg}\nlongitude -8\ntime_zone -15\nsite_elevation 3\n\
            weather_data_file_units 1\n"
        );
        let mut rows = String::new();
        for (month, day) in dates(2002) {
            for hour in 0..24 {
                writeln!(rows, "{month} {day} {hour}.5 100 50").unwrap();
            }
        }
        let all = Weather::parse((head.clone() + &rows).as_bytes()).unwrap().weather;
        let kept: Vec<&str> = rows
            .lines()
            .zip(&all.hours)
            .filter(|(_, hour)| is_there(&all, hour))
            .map(|(row, _)| row)
            .collect();
        Weather::parse((head + &kept.join("\n")).as_bytes()).unwrap().weather
    }

    fn altitude_deg(weather: &Weather, hour: &WeatherHour) -> f64 {
        weather.site.sun_at(&weather.time_of(hour).unwrap()).unwrap().altitude_deg
    }

    #[test]
    fn nights_are_dark_where_a_file_leaves_them_out() {
        for latitude_deg in [-35.0, 0.0, 45.0, 68.0] {
            let up = |weather: &Weather, hour: &WeatherHour| altitude_deg(weather, hour) > 0.0;
            let weather = year(latitude_deg, up);
            assert!(weather.is_of_a_year(), "{latitude_deg}: {}", weather.hours.len());
            assert!(is_in_order(&weather.hours));
            let lit = |hour: &&WeatherHour| hour.light.is_some_and(|light| light.direct > 0.0);
            let lit = weather.hours.iter().filter(lit);
            assert!(lit.clone().all(|hour| up(&weather, hour)));
            assert!((4300..4600).contains(&lit.count()));
        }
    }

    /// Nothing is known of hours by day.
    #[test]
    fn missing_hours_by_day_are_unknown() {
        let weather = year(45.0, |weather, hour| {
            altitude_deg(weather, hour) > 0.0 && (hour.month, hour.seconds) != (6, 12.5 * 3600.0)
        });
        assert!(weather.is_of_a_year());
        let unknown = weather.hours.iter().filter(|hour| hour.light.is_none());
        assert_eq!(unknown.count(), 30);
    }

    /// Nothing is known of days that are missing.
    #[test]
    fn gaps_by_day_stay_gaps() {
        let weather = year(45.0, |weather, hour| {
            altitude_deg(weather, hour) > 0.0 && (hour.month, hour.day) != (5, 7)
        });
        assert!(!weather.is_of_a_year() && weather.hours.len() < 5000);
        let weather = year(45.0, |_, hour| hour.month > 4);
        assert!(!weather.is_of_a_year());
    }
}
