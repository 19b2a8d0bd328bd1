//! What can be said to `quasilux sky`.

use super::values::whole;
use clap::Args;
use quasilux_sky::{LocalTime, Site, SkyError};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct SkyArguments {
    /// The project file; without one, --type, --weather or --site say what is outside
    #[arg(
        required_unless_present_any = ["cie", "site", "weather"],
        conflicts_with_all = ["cie", "site", "weather"],
    )]
    pub(crate) project: Option<PathBuf>,
    /// The CIE standard general sky of this number, or with 16 the traditional overcast sky
    #[arg(long = "type", value_name = "N", value_parser = whole::<u8>(1..=16))]
    pub(crate) cie: Option<u8>,
    /// The altitude of that sky's sun in degrees
    #[arg(
        long,
        value_name = "DEGREES",
        requires_all = ["cie", "azimuth"],
        allow_hyphen_values = true,
        value_parser = |text: &str| degrees(text, 90.0),
    )]
    pub(crate) altitude: Option<f64>,
    /// The azimuth of that sky's sun in degrees, clockwise from north
    #[arg(
        long,
        value_name = "DEGREES",
        requires_all = ["cie", "altitude"],
        allow_hyphen_values = true,
        value_parser = |text: &str| degrees(text, 360.0),
    )]
    pub(crate) azimuth: Option<f64>,
    /// The illuminance that that sky gives on a horizontal plane
    #[arg(
        long,
        value_name = "LUX",
        default_value = "10000",
        requires = "cie",
        value_parser = super::values::illuminance,
    )]
    pub(crate) lx: f64,
    /// What shines by a weather file, EPW or WEA, with the sun's disk, at --time
    #[arg(long, value_name = "FILE", conflicts_with_all = ["cie", "site"])]
    pub(crate) weather: Option<PathBuf>,
    /// A time of the weather file by the clock of its site, like 2026-03-20T12:30; the year does
    /// not matter
    #[arg(long, value_name = "TIME", requires = "weather", value_parser = time)]
    pub(crate) time: Option<LocalTime>,
    /// Where on the earth: degrees north, degrees east and the clock's hours ahead of Greenwich
    #[arg(
        long,
        value_name = "LATITUDE,LONGITUDE,ZONE",
        requires = "positions",
        allow_hyphen_values = true,
        value_parser = site,
    )]
    pub(crate) site: Option<Site>,
    /// Also list where the sun is, hour by hour: on a day like 2026-06-21, or on the 21st of each
    /// month of a year like 2026
    #[arg(long, value_name = "DATE|YEAR", value_parser = days)]
    pub(crate) positions: Option<Days>,
    /// Write these places of the sun to a file
    #[arg(long, value_name = "FILE", requires = "positions")]
    pub(crate) csv: Option<PathBuf>,
    /// Draw the luminances of the sky in false colours, as a picture
    #[arg(long, value_name = "FILE")]
    pub(crate) png: Option<PathBuf>,
    /// The same, coarser, as a drawing
    #[arg(long, value_name = "FILE")]
    pub(crate) svg: Option<PathBuf>,
    /// Print a document in JSON, format "quasilux-sky/1", and nothing else
    #[arg(long)]
    pub(crate) json: bool,
}

/// Days of a list of solar positions: year, month and day.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Days(pub(crate) Vec<[u32; 3]>);

fn days(text: &str) -> Result<Days, String> {
    let expected = || "expected a date like 2026-06-21 or a year, 1583 to 3000".to_owned();
    let is_year = text.len() == 4 && text.bytes().all(|byte| byte.is_ascii_digit());
    let first = if is_year { format!("{text}-01-21T00:00") } else { format!("{text}T00:00") };
    let first: LocalTime = first.parse().map_err(|_| expected())?;
    let year = u32::try_from(first.year()).map_err(|_| expected())?;
    let day = |month| [year, month, first.day()];
    Ok(Days(if is_year { (1..=12).map(day).collect() } else { vec![day(first.month())] }))
}

fn time(text: &str) -> Result<LocalTime, String> {
    text.parse().map_err(|error: SkyError| format!("expected {}", error.expected))
}

fn site(text: &str) -> Result<Site, String> {
    let expected = || {
        "expected degrees north, degrees east and hours ahead of Greenwich, like 52.5,13.4,1"
            .to_owned()
    };
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|text| text.trim().parse()).collect();
    let numbers = numbers.map_err(|_| expected())?;
    let &[latitude_deg, longitude_deg, time_zone_h] = numbers.as_slice() else {
        return Err(expected());
    };
    Site::new(latitude_deg, longitude_deg, time_zone_h).map_err(|error| error.to_string())
}

fn degrees(text: &str, most: f64) -> Result<f64, String> {
    let number = text.trim().parse::<f64>().ok().filter(|degrees| degrees.abs() <= most);
    number.ok_or_else(|| format!("expected degrees from -{most} to {most}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_years_and_sites_are_read() {
        assert_eq!(days("2024-02-29"), Ok(Days(vec![[2024, 2, 29]])));
        let year = days("2026").unwrap().0;
        assert_eq!((year.len(), year[0], year[11]), (12, [2026, 1, 21], [2026, 12, 21]));
        for bad in ["2026-02-29", "26", "1500", "3001", "2026-6-1", "", "2026-06", "20260621"] {
            assert!(days(bad).is_err(), "{bad}");
        }
        assert_eq!(site("52.5, -13.4,1"), Ok(Site::new(52.5, -13.4, 1.0).unwrap()));
        for bad in ["", "1,2", "1,2,3,4", "91,0,0", "0,181,0", "0,0,16", "x,0,0", "nan,0,0"] {
            assert!(site(bad).is_err(), "{bad}");
        }
        assert!(degrees("-90", 90.0).is_ok() && degrees("91", 90.0).is_err());
    }
}
