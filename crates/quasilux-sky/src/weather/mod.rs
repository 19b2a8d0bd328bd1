//! Weather files: what sun and sky gave to a site, interval by interval.
//!
//! EnergyPlus weather (EPW) and Radiance's format of an hour a line (WEA) are told by their first
//! line. Values of EPW are means of the interval *before* their time stamp:
//! [`WeatherHour::seconds`] is its middle, where the sun belongs. WEA gives the middle itself.

mod dark_hours;
mod epw;
mod interval;
mod light;
mod light_at;
mod minutes;
mod odd;
mod possible;
mod row;
mod wea;

use crate::sun::Site;
use quasilux_text::{ParseError, Position, TextWarning, Warning, Warnings, decode, lines};
use row::Row;

pub use light::WeatherSky;
pub use light_at::{LightAt, LightAtError};

/// A weather file.
#[derive(Clone, Debug, PartialEq)]
pub struct Weather {
    /// What the file calls the place.
    pub place: String,
    /// Where it is.
    pub site: Site,
    /// What direct and diffuse values mean.
    pub units: WeatherUnits,
    /// How long an interval is in s, at most an hour.
    pub interval_s: f64,
    /// The intervals, in the order of the file. Where a WEA file of a year leaves out its nights,
    /// they are here all the same, dark.
    pub hours: Vec<WeatherHour>,
    /// The day of the week of 1 January, from 0 for Monday, where the file says which day of the
    /// week it begins with.
    pub new_year_weekday: Option<u32>,
    /// The year that all dates are taken to be of.
    year: i32,
}

/// The days of the week in lower case, as files write them in one case or another.
pub const WEEKDAYS: [&str; 7] =
    ["monday", "tuesday", "wednesday", "thursday", "friday", "saturday", "sunday"];

/// The units of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WeatherUnits {
    /// Direct normal and diffuse horizontal irradiance in W/m2.
    Irradiance,
    /// Direct and diffuse horizontal irradiance in W/m2.
    HorizontalIrradiance,
    /// Direct normal and diffuse horizontal illuminance in lx.
    Illuminance,
}

/// An interval, most often of an hour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WeatherHour {
    /// The month, from 1.
    pub month: u32,
    /// The day of the month, from 1; the 29th of February where the file has it.
    pub day: u32,
    /// The middle of the interval in seconds from midnight, by the clock of the site.
    pub seconds: f64,
    /// What was measured; `None` where the file has no value.
    pub light: Option<WeatherLight>,
    /// The dew point in degrees Celsius; `None` where the file has none.
    pub dew_point_c: Option<f64>,
}

/// Light of the sun and of the sky in the units of the file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WeatherLight {
    /// Of the sun.
    pub direct: f64,
    /// Of the sky, on a horizontal plane.
    pub diffuse: f64,
}

/// Deviations that are lived with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum WeatherWarning {
    /// One of a text file.
    Text(TextWarning),
    /// An interval has no direct or no diffuse value: nothing is known of its sky.
    MissingLight,
    /// A radiation is a little below 0. It counts as 0.
    BelowZero,
    /// There are more or fewer intervals than a year has.
    OtherThanAYear,
    /// Intervals are longer or shorter than the header says.
    OtherThanDeclared,
    /// Shorter intervals than hours: whether values are powers or energies had to be found out.
    PowerOrEnergy,
    /// An interval is not after the one before it, or comes twice.
    OutOfOrder,
    /// More light than sun and sky of that time can give.
    MoreThanPossible,
    /// Light while the sun is far below the horizon.
    LightByNight,
    /// The clock is far from that of the sun at this longitude.
    ZoneOfAnotherPlace,
}

/// A weather file with what is odd in it.
#[derive(Clone, Debug)]
pub struct ParsedWeather {
    /// The file.
    pub weather: Weather,
    /// Deviations that were lived with.
    pub warnings: Vec<Warning<WeatherWarning>>,
}

impl From<TextWarning> for WeatherWarning {
    fn from(warning: TextWarning) -> Self {
        Self::Text(warning)
    }
}

/// Hours of a year without and with a leap day.
const HOURS: [f64; 2] = [8760.0, 8784.0];
const HOUR_S: f64 = 3600.0;
/// Halfway between two leap years the sun of a date is that of the mean of four years.
const COMMON_YEAR: i32 = 2002;
/// Of files that have a 29th of February.
const LEAP_YEAR: i32 = 2000;
/// More than the sun gives anywhere on the ground.
const MAX_IRRADIANCE_W_M2: f64 = 2000.0;
const MAX_ILLUMINANCE_LX: f64 = 250_000.0;

impl Weather {
    /// Reads a file, in no more memory than 128 bytes for each of its bytes, and 64 KiB.
    ///
    /// # Errors
    /// With the line and the column of what is neither EPW nor WEA.
    pub fn parse(bytes: &[u8]) -> Result<ParsedWeather, ParseError> {
        quasilux_text::refuse_web_page(bytes)?;
        let mut warnings = Warnings::default();
        let text = decode(bytes, &mut warnings);
        let rows: Vec<Row<'_>> =
            (1..).zip(lines(&text)).map(|(n, text)| Row::new(n, text)).collect();
        let first = rows.first().map_or("", Row::text);
        if let Some(at) = first.find(';').filter(|_| first.starts_with("LOCATION;")) {
            let place = Position { line: 1, column: at + 1 };
            let expected = "commas between fields, as EPW has them";
            return Err(ParseError::new(place, "\";\", as spreadsheets write it", expected));
        }
        let PlacedWeather { mut weather, places } = if first.starts_with("LOCATION") {
            epw::read(&rows, &mut warnings)?
        } else if first.trim_start().starts_with("place") {
            wea::read(&rows)?
        } else {
            let expected = "LOCATION (EPW) or place (WEA)";
            return Err(ParseError::new(Position::START, quasilux_text::quoted(first), expected));
        };
        odd::tell(&weather, &places, &mut warnings);
        dark_hours::fill_in(&mut weather);
        weather.expect_a_year(&mut warnings);
        Ok(ParsedWeather { weather, warnings: warnings.into_vec() })
    }

    /// Whether there is an interval for all hours of a year, and no more.
    #[must_use]
    pub fn is_of_a_year(&self) -> bool {
        let hours = self.hours.len() as f64 * self.interval_s / HOUR_S;
        HOURS.iter().any(|year| (hours - year).abs() < 0.5)
    }

    /// Warns of a file that is not of a year.
    fn expect_a_year(&self, warnings: &mut Warnings<WeatherWarning>) {
        if !self.is_of_a_year() {
            let a_day = 24.0 * HOUR_S / self.interval_s;
            let [common, leap] = [365.0, 366.0].map(|days: f64| (days * a_day).round());
            let found = format!("{} intervals", self.hours.len());
            let expected = format!("{common} or {leap} (read as they are)");
            warnings.push(WeatherWarning::OtherThanAYear, Position::START, found, expected);
        }
    }
}

impl WeatherHour {
    fn time(&self) -> TimeOfYear {
        TimeOfYear { month: self.month, day: self.day, seconds: self.seconds }
    }
}

/// A time of day in s on a date, earlier ones first.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
struct TimeOfYear {
    month: u32,
    day: u32,
    seconds: f64,
}

/// A file with the places of its intervals, as it stands there.
struct PlacedWeather {
    weather: Weather,
    places: Vec<Position>,
}

/// The year that dates are taken to be of: files put months of many years together.
fn year_of(hours: &[WeatherHour]) -> i32 {
    let has_leap_day = hours.iter().any(|hour| (hour.month, hour.day) == (2, 29));
    if has_leap_day { LEAP_YEAR } else { COMMON_YEAR }
}

impl WeatherUnits {
    /// The largest value that one can have.
    fn most(self) -> f64 {
        match self {
            Self::Irradiance | Self::HorizontalIrradiance => MAX_IRRADIANCE_W_M2,
            Self::Illuminance => MAX_ILLUMINANCE_LX,
        }
    }
}
