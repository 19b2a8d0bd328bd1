//! EnergyPlus weather: "Auxiliary programs" (EnergyPlus documentation), EPW data dictionary.

use super::row::{Row, date, number};
use super::{Weather, WeatherHour, WeatherLight, WeatherUnits, WeatherWarning, expect_a_year};
use crate::sun::Site;
use quasilux_text::{ParseError, Token, Warnings, quoted};

/// Lines before the data.
const HEADER: usize = 8;
/// Fields of a line of data.
const MONTH: usize = 1;
const DAY: usize = 2;
const HOUR: usize = 3;
const MINUTE: usize = 4;
const DEW_POINT: usize = 7;
const DIRECT_NORMAL: usize = 14;
const DIFFUSE_HORIZONTAL: usize = 15;
/// What stands for a missing radiation and a missing temperature.
const MISSING_RADIATION: f64 = 9999.0;
const MISSING_TEMPERATURE: f64 = 99.9;

pub(super) fn read(
    rows: &[Row<'_>],
    warnings: &mut Warnings<WeatherWarning>,
) -> Result<Weather, ParseError> {
    let location = rows[0];
    let fields = location.by_commas();
    let at = |n, what: &str| location.field(&fields, n, what);
    let place = at(1, "the name of the place")?.text.to_owned();
    let degrees = |n, most: f64, what: &str| number(&at(n, what)?, -most..=most, what);
    let latitude_deg = degrees(6, 90.0, "the latitude in degrees north, -90 to 90")?;
    let longitude_deg = degrees(7, 180.0, "the longitude in degrees east, -180 to 180")?;
    let time_zone_h = degrees(8, 15.0, "hours ahead of Greenwich, -15 to 15")?;
    let site = Site::new(latitude_deg, longitude_deg, time_zone_h)
        .map_err(|error| ParseError::new(location.start(), error, "a site"))?;
    let per_hour = intervals_per_hour(rows)?;
    let data = rows.iter().skip(HEADER).filter(|row| !row.text().trim().is_empty());
    let hours = data.map(|row| hour(row, per_hour, warnings));
    let hours = hours.collect::<Result<Vec<WeatherHour>, ParseError>>()?;
    expect_a_year(hours.len(), per_hour as usize, warnings);
    Ok(Weather { place, site, units: WeatherUnits::Irradiance, hours })
}

/// From the last line of the header.
fn intervals_per_hour(rows: &[Row<'_>]) -> Result<f64, ParseError> {
    let what = "DATA PERIODS in line 8";
    let Some(row) = rows.get(HEADER - 1) else {
        let last = rows[rows.len() - 1];
        return Err(ParseError::new(last.start(), "the end of the header", what));
    };
    let fields = row.by_commas();
    let name = row.field(&fields, 0, what)?;
    if !name.text.eq_ignore_ascii_case("DATA PERIODS") {
        return Err(ParseError::new(name.at, quoted(name.text), what));
    }
    let what = "the number of intervals in an hour, 1 to 60";
    let per_hour = row.field(&fields, 2, what)?;
    let count = number(&per_hour, 1.0..=60.0, what)?;
    if 60.0 % count == 0.0 {
        Ok(count)
    } else {
        Err(ParseError::new(per_hour.at, quoted(per_hour.text), what))
    }
}

fn hour(
    row: &Row<'_>,
    per_hour: f64,
    warnings: &mut Warnings<WeatherWarning>,
) -> Result<WeatherHour, ParseError> {
    let fields = row.by_commas();
    let field = |n, what: &str| row.field(&fields, n, what);
    let [month, day] = date(&field(MONTH, "a month")?, &field(DAY, "a day")?)?;
    let what = "the hour, 1 to 24";
    let hour = number(&field(HOUR, what)?, 1.0..=24.0, what)?;
    let what = "the minute that an interval ends with, 0 to 60";
    let minute = number(&field(MINUTE, what)?, 0.0..=60.0, what)?;
    // Of whole hours the minute is 0 or 60, and means nothing.
    let end_h = if per_hour == 1.0 { hour } else { hour - 1.0 + minute / 60.0 };
    let seconds = 3600.0 * (end_h - 0.5 / per_hour).clamp(0.0, 24.0 - 0.5 / per_hour);
    let direct = radiation(&field(DIRECT_NORMAL, "the direct normal radiation in Wh/m2")?)?;
    let diffuse = field(DIFFUSE_HORIZONTAL, "the diffuse horizontal radiation in Wh/m2")?;
    let light = direct
        .zip(radiation(&diffuse)?)
        // A mean power in W/m2 is the energy of the interval over its hours.
        .map(|(direct, diffuse)| WeatherLight {
            direct: direct * per_hour,
            diffuse: diffuse * per_hour,
        });
    if light.is_none() {
        let expected = "direct and diffuse radiation (nothing is known of this sky)";
        warnings.push(WeatherWarning::MissingLight, diffuse.at, "a missing value", expected);
    }
    let what = "the dew point in degrees Celsius, -90 to 70, or 99.9 where it is missing";
    let dew_point = number(&field(DEW_POINT, what)?, -90.0..=100.0, what)?;
    let dew_point_c = Some(dew_point).filter(|celsius| *celsius < MISSING_TEMPERATURE);
    Ok(WeatherHour { month, day, seconds, light, dew_point_c })
}

/// `None` where it is missing.
fn radiation(token: &Token<'_>) -> Result<Option<f64>, ParseError> {
    let what = "a radiation in Wh/m2, 0 to 2000, or 9999 where it is missing";
    if token.text.is_empty() || token.number(what)?.value >= MISSING_RADIATION {
        return Ok(None);
    }
    number(token, 0.0..=WeatherUnits::Irradiance.most(), what).map(Some)
}
