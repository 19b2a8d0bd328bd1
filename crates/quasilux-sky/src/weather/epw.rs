//! EnergyPlus weather: "Auxiliary programs" (EnergyPlus documentation), EPW data dictionary.

use super::interval::usual_interval_s;
use super::minutes::{LineTime, ends_h};
use super::possible::Possible;
use super::row::{Row, date, number};
use super::{
    HOUR_S, PlacedWeather, WEEKDAYS, Weather, WeatherHour, WeatherLight, WeatherUnits,
    WeatherWarning, year_of,
};
use crate::sun::Site;
use quasilux_text::{ParseError, Position, Token, Warnings, quoted};

/// Lines before the data.
const HEADER: usize = 8;
/// Fields of a line of data; older files have fewer.
const FIELDS: usize = 35;
const MONTH: usize = 1;
const DAY: usize = 2;
const HOUR: usize = 3;
const MINUTE: usize = 4;
const DEW_POINT: usize = 7;
const DIRECT_NORMAL: usize = 14;
const DIFFUSE_HORIZONTAL: usize = 15;
/// What stands for a missing radiation and a missing temperature.
const MISSING_RADIATION: f64 = 9999.0;
/// Of radiation, too, as programs that convert files write it; what is less below 0 is the offset
/// of a pyranometer that sees a cold sky.
const MISSING_BELOW_ZERO: f64 = -99.0;
const MISSING_TEMPERATURE: f64 = 99.9;

/// In this many days some are clear.
const DAYS_THAT_TELL: usize = 28;
/// Clear hours have more than this part of what the sun gives above the air, with the sun this
/// high.
const CLEARNESS: f64 = 0.5;
const CLEAR_ABOVE_DEG: f64 = 15.0;

pub(super) fn read(
    rows: &[Row<'_>],
    warnings: &mut Warnings<WeatherWarning>,
) -> Result<PlacedWeather, ParseError> {
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
    let Declared { at: declared_at, an_hour: declared, weekday } = data_period(rows)?;
    let data = rows.iter().skip(HEADER).filter(|row| !row.text().trim().is_empty());
    let data: Vec<&Row<'_>> = data.collect();
    let lines = data.iter().map(|row| Line::new(row, warnings));
    let mut lines = lines.collect::<Result<Vec<Line>, ParseError>>()?;
    let times: Vec<LineTime> = lines.iter().map(|line| line.time).collect();
    let ends_h = ends_h(&times, declared);
    for (line, end_h) in lines.iter_mut().zip(ends_h) {
        line.hour.seconds = HOUR_S * end_h;
    }
    let mut hours: Vec<WeatherHour> = lines.into_iter().map(|line| line.hour).collect();
    let declared_s = HOUR_S / declared;
    let interval_s = usual_interval_s(hours.iter().map(WeatherHour::time)).unwrap_or(declared_s);
    if (interval_s - declared_s).abs() > 1.0 {
        let found = format!("{declared} intervals an hour");
        let expected = format!("{:.0} as the lines have them (read so)", HOUR_S / interval_s);
        warnings.push(WeatherWarning::OtherThanDeclared, declared_at, found, expected);
    }
    for hour in &mut hours {
        let half_s = 0.5 * interval_s;
        hour.seconds = (hour.seconds - half_s).clamp(0.0, 24.0 * HOUR_S - half_s);
    }
    let places = data.iter().map(|row| row.start()).collect();
    let (units, year) = (WeatherUnits::Irradiance, year_of(&hours));
    let mut weather =
        Weather { place, site, units, interval_s, hours, new_year_weekday: None, year };
    weather.new_year_weekday = weekday.zip(weather.hours.first()).and_then(|(weekday, first)| {
        let day_of_year = weather.time_of(first).ok()?.day_of_year();
        Some((weekday + 371 - (day_of_year - 1)) % 7)
    });
    if interval_s < HOUR_S {
        tell_powers_from_energies(&mut weather, declared_at, warnings);
    }
    Ok(PlacedWeather { weather, places })
}

/// The format says energies in Wh/m2, and EnergyPlus takes powers in W/m2; of hours both are the
/// same. Values are powers, but where they show that they are not: over a month or longer no
/// interval has half of what the sun gives above the air, as the clearest have more; and as
/// energies all are possible.
fn tell_powers_from_energies(
    weather: &mut Weather,
    at: Position,
    warnings: &mut Warnings<WeatherWarning>,
) {
    let per_hour = HOUR_S / weather.interval_s;
    let times = |light: WeatherLight| WeatherLight {
        direct: light.direct * per_hour,
        diffuse: light.diffuse * per_hour,
    };
    let (mut clearest, mut all_possible) = (0.0_f64, true);
    for hour in &weather.hours {
        let Some(light) = hour.light.filter(|light| light.direct + light.diffuse > 0.0) else {
            continue;
        };
        let Ok(possible) = Possible::of_all(weather, hour) else { continue };
        all_possible &= possible.holds(times(light), weather.units);
        if possible.altitude_deg > CLEAR_ABOVE_DEG {
            let above = possible.above_the_air_w_m2 * possible.sine();
            clearest = clearest.max(possible.global(light, weather.units) / above);
        }
    }
    let days = weather.hours.chunk_by(|a, b| (a.month, a.day) == (b.month, b.day)).count();
    let are_energies = days >= DAYS_THAT_TELL && clearest < CLEARNESS && all_possible;
    if are_energies {
        weather.hours.iter_mut().for_each(|hour| hour.light = hour.light.map(times));
    }
    let found = format!("radiation in Wh/m2, {per_hour:.0} intervals an hour");
    let expected = match are_energies {
        true => "W/m2 (read as Wh/m2: as W/m2 no interval is clear)",
        false => "W/m2 (read so, as EnergyPlus does)",
    };
    warnings.push(WeatherWarning::PowerOrEnergy, at, found, expected);
}

/// What the header says of the first data period.
struct Declared {
    at: Position,
    /// Intervals.
    an_hour: f64,
    /// The day of the week of its first day, from 0 for Monday.
    weekday: Option<u32>,
}

/// From the last line of the header.
fn data_period(rows: &[Row<'_>]) -> Result<Declared, ParseError> {
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
        let weekday = row.field(&fields, 4, "the day of the week of the first day").ok();
        let is_weekday = |name: &str| {
            weekday.as_ref().is_some_and(|field| field.text.eq_ignore_ascii_case(name))
        };
        let weekday = (0..).zip(WEEKDAYS).find(|(_, name)| is_weekday(name)).map(|(day, _)| day);
        Ok(Declared { at: per_hour.at, an_hour: count, weekday })
    } else {
        Err(ParseError::new(per_hour.at, quoted(per_hour.text), what))
    }
}

/// A line of data.
struct Line {
    time: LineTime,
    /// Of which the time is not known yet.
    hour: WeatherHour,
}

impl Line {
    fn new(row: &Row<'_>, warnings: &mut Warnings<WeatherWarning>) -> Result<Self, ParseError> {
        let fields = row.by_commas();
        if let Some(field) = fields.iter().skip(FIELDS).find(|field| !field.text.is_empty()) {
            let found = format!("a field more, {}", quoted(field.text));
            let expected = format!("{FIELDS} fields (decimal commas make two of one)");
            return Err(ParseError::new(field.at, found, expected));
        }
        let field = |n, what: &str| row.field(&fields, n, what);
        let [month, day] = date(&field(MONTH, "a month")?, &field(DAY, "a day")?)?;
        let what = "the hour, 1 to 24";
        let hour_of_day = number(&field(HOUR, what)?, 1.0..=24.0, what)?;
        let what = "the minute that an interval ends with, 0 to 60";
        let minute = number(&field(MINUTE, what)?, 0.0..=60.0, what)?;
        let direct = field(DIRECT_NORMAL, "the direct normal radiation in Wh/m2")?;
        let direct = radiation(&direct, warnings)?;
        let diffuse = field(DIFFUSE_HORIZONTAL, "the diffuse horizontal radiation in Wh/m2")?;
        let light = direct.zip(radiation(&diffuse, warnings)?);
        let light = light.map(|(direct, diffuse)| WeatherLight { direct, diffuse });
        if light.is_none() {
            let expected = "direct and diffuse radiation (nothing is known of this sky)";
            warnings.push(WeatherWarning::MissingLight, diffuse.at, "a missing value", expected);
        }
        let what = "the dew point in degrees Celsius, -90 to 70, or 99.9 where it is missing";
        let dew_point = number(&field(DEW_POINT, what)?, -90.0..=100.0, what)?;
        let dew_point_c = Some(dew_point).filter(|celsius| *celsius < MISSING_TEMPERATURE);
        let hour = WeatherHour { month, day, seconds: 0.0, light, dew_point_c };
        let time = LineTime { date: [month, day], hour_of_day, minute };
        Ok(Self { time, hour })
    }
}

/// `None` where it is missing.
fn radiation(
    token: &Token<'_>,
    warnings: &mut Warnings<WeatherWarning>,
) -> Result<Option<f64>, ParseError> {
    let what = "a radiation in Wh/m2, 0 to 2000, or 9999 where it is missing";
    if token.text.is_empty() {
        return Ok(None);
    }
    match token.number(what)?.value {
        missing if missing >= MISSING_RADIATION || missing <= MISSING_BELOW_ZERO => Ok(None),
        offset if offset < 0.0 => {
            let expected = "no radiation below 0 (read as 0)";
            warnings.push(WeatherWarning::BelowZero, token.at, quoted(token.text), expected);
            Ok(Some(0.0))
        }
        _ => number(token, 0.0..=WeatherUnits::Irradiance.most(), what).map(Some),
    }
}
