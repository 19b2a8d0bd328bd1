//! The weather of `examples/daylight-office/`: a year that is made up, at the place of Berlin.
//!
//! Clouds wander from hour to hour, denser in winter; they decide what sun and sky give by the
//! formulas of F. Kasten and G. Czeplak ("Solar and terrestrial radiation dependent on the amount
//! and type of cloud", Solar Energy 24, 1980). The sun stands by the Fourier series of J. W.
//! Spencer ("Fourier series representation of the position of the sun", Search 2, 1971). Values are
//! means of the hour before the stamp, as EPW has them; what the file lacks has EPW's code for it.

use crate::generated::{self, File};
use libm::{cos, log, pow, sin};
use std::f64::consts::{PI, TAU};
use std::fmt::Write;
use std::path::Path;
use xtask::workspace::Failure;

const LATITUDE_DEG: f64 = 52.5;
const LONGITUDE_DEG: f64 = 13.4;
const TIME_ZONE_H: f64 = 1.0;
const DAYS_OF_MONTHS: [u32; 12] = [31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];
/// How much of the deviation of clouds from their mean is left an hour later, and the standard
/// deviation of what is new.
const MEMORY: f64 = 0.93;
const GUST: f64 = 0.17;

/// Name below `examples/daylight-office/` and content.
fn files() -> [File; 1] {
    [("made-up.epw".to_owned(), epw())]
}

/// Writes the generated file.
pub(crate) fn write(root: &Path) -> Result<(), Failure> {
    generated::write(&root.join("examples/daylight-office"), &files())
}

fn epw() -> String {
    let mut text = format!(
        "LOCATION,Made-up Berlin,-,DEU,made up,000000,{LATITUDE_DEG},{LONGITUDE_DEG},\
         {TIME_ZONE_H:.1},34.0\n\
         DESIGN CONDITIONS,0\nTYPICAL/EXTREME PERIODS,0\nGROUND TEMPERATURES,0\n\
         HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\n\
         COMMENTS 1,made up by `cargo xtask weather`: measured nowhere\nCOMMENTS 2,\n\
         DATA PERIODS,1,1,Data,Thursday,1/1,12/31\n"
    );
    let mut clouds = Clouds { numbers: Numbers(2003), deviation: 0.0 };
    let mut day_of_year = 0;
    for (month, days) in (1..).zip(DAYS_OF_MONTHS) {
        for day in 1..=days {
            for hour in 0..24 {
                let middle_h = f64::from(hour) + 0.5;
                let cover = clouds.next(day_of_year);
                let date = format!("2026,{month},{day},{},0", hour + 1);
                writeln!(text, "{date},{}", row(day_of_year, middle_h, cover))
                    .expect("strings grow");
            }
            day_of_year += 1;
        }
    }
    text
}

/// An hour from the sixth field on.
fn row(day_of_year: u32, middle_h: f64, cover: f64) -> String {
    let season = cos(TAU * (f64::from(day_of_year) - 20.0) / 365.0);
    let sine = sine_of_altitude(day_of_year, middle_h);
    let global = (910.0 * sine - 30.0).max(0.0) * (1.0 - 0.75 * pow(cover, 3.4));
    let diffuse = global * (0.3 + 0.7 * cover * cover);
    let direct = if sine > 0.0 { (global - diffuse) / sine } else { 0.0 };
    let warmth = 4.0 * cos(TAU * (middle_h - 15.0) / 24.0) * (1.2 - cover);
    let temperature_c = 10.0 - 9.5 * season + warmth;
    let humidity = 55.0 + 30.0 * cover;
    // Magnus: dew point by relative humidity.
    let gamma = log(humidity / 100.0) + 17.62 * temperature_c / (243.12 + temperature_c);
    let dew_point_c = 243.12 * gamma / (17.62 - gamma);
    let tenths = (10.0 * cover).round();
    format!(
        "?9,{temperature_c:.1},{dew_point_c:.1},\
         {humidity:.0},101000,9999,9999,9999,{global:.0},{direct:.0},{diffuse:.0},999999,999999,\
         999999,9999,999,999,{tenths},{tenths},9999,99999,9,999999999,999,.999,999,99,.2,0,0"
    )
}

/// The sine of the sun's altitude, without refraction.
fn sine_of_altitude(day_of_year: u32, middle_h: f64) -> f64 {
    let turn = TAU * (f64::from(day_of_year) + middle_h / 24.0) / 365.0;
    let [c1, c2, c3] = [1.0, 2.0, 3.0].map(|k| cos(k * turn));
    let [s1, s2, s3] = [1.0, 2.0, 3.0].map(|k| sin(k * turn));
    let declination = 0.006_918 - 0.399_912 * c1 + 0.070_257 * s1 - 0.006_758 * c2 + 0.000_907 * s2
        - 0.002_697 * c3
        + 0.001_480 * s3;
    let equation_of_time =
        0.000_075 + 0.001_868 * c1 - 0.032_077 * s1 - 0.014_615 * c2 - 0.040_849 * s2;
    let hour_angle =
        PI / 12.0 * (middle_h - TIME_ZONE_H - 12.0) + LONGITUDE_DEG.to_radians() + equation_of_time;
    let latitude = LATITUDE_DEG.to_radians();
    sin(latitude) * sin(declination) + cos(latitude) * cos(declination) * cos(hour_angle)
}

/// Cloud cover from hour to hour, from 0 to 1.
struct Clouds {
    numbers: Numbers,
    deviation: f64,
}

impl Clouds {
    fn next(&mut self, day_of_year: u32) -> f64 {
        // About normal: the sum of twelve even numbers less six.
        let gust = (0..12).map(|_| self.numbers.next()).sum::<f64>() - 6.0;
        self.deviation = MEMORY * self.deviation + GUST * gust;
        let mean = 0.68 + 0.12 * cos(TAU * f64::from(day_of_year) / 365.0);
        (mean + self.deviation).clamp(0.0, 1.0)
    }
}

/// Pseudo-random numbers in [0, 1), by a linear congruence.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_889);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use libm::asin;
    use xtask::workspace::root as workspace_root;

    #[test]
    fn the_committed_weather_is_the_generated_one() {
        let folder = workspace_root().join("examples/daylight-office");
        generated::assert_committed(&folder, &files(), "weather");
    }

    /// At noon of the solstices the sun is as high as latitude and obliquity have it; it rises
    /// when the almanac has it (Berlin, 21 June: 3:43 by this clock, refraction and disk included).
    #[test]
    fn the_sun_is_where_it_belongs() {
        let noon_h = 12.0 + TIME_ZONE_H - LONGITUDE_DEG / 15.0;
        let altitude_deg = |day, hour| asin(sine_of_altitude(day, hour)).to_degrees();
        let highest = |day| altitude_deg(day, noon_h);
        assert!((highest(171) - (90.0 - LATITUDE_DEG + 23.44)).abs() < 0.1, "{}", highest(171));
        assert!((highest(354) - (90.0 - LATITUDE_DEG - 23.44)).abs() < 0.1, "{}", highest(354));
        assert!((altitude_deg(171, 3.0 + 43.0 / 60.0) + 0.83).abs() < 0.3);
    }

    /// Sums of a year are those of the climate: Berlin has about 1000 kWh/m2.
    #[test]
    fn the_year_is_plausible() {
        let text = epw();
        let rows: Vec<Vec<&str>> =
            text.lines().skip(8).map(|row| row.split(',').collect()).collect();
        assert!(rows.len() == 8760 && rows.iter().all(|row| row.len() == 35));
        let sum = |column: usize| -> f64 {
            rows.iter().map(|row| row[column].parse::<f64>().unwrap()).sum::<f64>() / 1000.0
        };
        let (global, direct, diffuse) = (sum(13), sum(14), sum(15));
        assert!((900.0..1150.0).contains(&global), "{global}");
        assert!((700.0..1200.0).contains(&direct) && (450.0..650.0).contains(&diffuse));
    }
}
