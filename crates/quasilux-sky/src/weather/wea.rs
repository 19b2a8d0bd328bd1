//! Radiance's WEA: six lines of a header, then month, day, hour, direct and diffuse light.

use super::interval::usual_interval_s;
use super::row::{Row, date, number};
use super::{HOUR_S, PlacedWeather, Weather, WeatherHour, WeatherLight, WeatherUnits, year_of};
use crate::sun::Site;
use quasilux_text::{ParseError, Position, Token, quoted};

/// Degrees that the sun goes on in an hour.
const DEGREES_AN_HOUR: f64 = 15.0;

pub(super) fn read(rows: &[Row<'_>]) -> Result<PlacedWeather, ParseError> {
    let place = rows[0].text().trim_start().trim_start_matches("place").trim().to_owned();
    let mut rows = rows[1..].iter().filter(|row| !row.text().trim().is_empty());
    let mut header = |key: &str, most: f64| {
        let what = format!("{key} with a number within -{most} and {most}");
        let row = rows
            .next()
            .ok_or_else(|| ParseError::new(Position::START, "a header that ends early", &what))?;
        let fields = row.by_blanks();
        let name = row.field(&fields, 0, &what)?;
        if name.text != key {
            return Err(ParseError::new(name.at, quoted(name.text), &what));
        }
        let value = row.field(&fields, 1, &what)?;
        Ok((value, number(&value, -most..=most, &what)?))
    };
    let (_, latitude_deg) = header("latitude", 90.0)?;
    // West is positive in these files.
    let (_, longitude_west_deg) = header("longitude", 180.0)?;
    let (zone, meridian_west_deg) = header("time_zone", DEGREES_AN_HOUR * 15.0)?;
    header("site_elevation", 1e6)?;
    let (units_at, units) = header("weather_data_file_units", 3.0)?;
    let time_zone_h = -meridian_west_deg / DEGREES_AN_HOUR;
    let site = Site::new(latitude_deg, -longitude_west_deg, time_zone_h)
        .map_err(|error| ParseError::new(zone.at, error, "a site"))?;
    let units = match units {
        1.0 => WeatherUnits::Irradiance,
        2.0 => WeatherUnits::HorizontalIrradiance,
        3.0 => WeatherUnits::Illuminance,
        _ => return Err(ParseError::new(units_at.at, quoted(units_at.text), "1, 2 or 3")),
    };
    let rows: Vec<&Row<'_>> = rows.collect();
    let hours = rows.iter().map(|row| hour(row, units));
    let hours = hours.collect::<Result<Vec<WeatherHour>, ParseError>>()?;
    let interval_s = usual_interval_s(hours.iter().map(WeatherHour::time)).unwrap_or(HOUR_S);
    let places = rows.iter().map(|row| row.start()).collect();
    let year = year_of(&hours);
    let weather = Weather { place, site, units, interval_s, hours, new_year_weekday: None, year };
    Ok(PlacedWeather { weather, places })
}

fn hour(row: &Row<'_>, units: WeatherUnits) -> Result<WeatherHour, ParseError> {
    let fields = row.by_blanks();
    let field = |n, what: &str| row.field(&fields, n, what);
    let [month, day] = date(&field(0, "a month")?, &field(1, "a day")?)?;
    // 24 h is 0 h of the next day.
    let what = "the middle of an hour, from 0 to before 24";
    let hour = number(&field(2, what)?, 0.0..=24.0_f64.next_down(), what)?;
    let what = format!("direct and diffuse light, 0 to {}", units.most());
    let light = |token: Token<'_>| number(&token, 0.0..=units.most(), &what);
    let (direct, diffuse) = (light(field(3, &what)?)?, light(field(4, &what)?)?);
    let light = Some(WeatherLight { direct, diffuse });
    Ok(WeatherHour { month, day, seconds: 3600.0 * hour, light, dew_point_c: None })
}
