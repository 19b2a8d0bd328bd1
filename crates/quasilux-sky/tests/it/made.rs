//! Weather files made at random, whose light is known without reading them.
//!
//! The sun is that of J. W. Spencer, "Fourier series representation of the position of the sun"
//! (Search 2, 1971), within half a degree; days are clear, broken or overcast.

use libm::{acos, cos, exp, sin};
use quasilux_sky::{ParsedWeather, Weather, WeatherWarning};
use quasilux_stats::SplitMix64;
use std::f64::consts::{PI, TAU};

/// Fields of a line of an EPW file.
pub(crate) const MINUTE: usize = 4;
pub(crate) const DIRECT: usize = 14;
pub(crate) const DIFFUSE: usize = 15;

const MONTHS: [u32; 12] = [31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];

/// A place and its clock.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Station {
    pub(crate) latitude_deg: f64,
    pub(crate) longitude_deg: f64,
    pub(crate) zone_h: f64,
}

impl Station {
    /// Anywhere up to this latitude, by a clock that is up to an hour off.
    pub(crate) fn random(dice: &mut SplitMix64, most_deg: f64) -> Self {
        let longitude_deg = dice.within(-165.0, 165.0);
        let zone_h = (longitude_deg / 15.0 + dice.within(-0.5, 0.5)).round();
        Self { latitude_deg: dice.within(-most_deg, most_deg), longitude_deg, zone_h }
    }

    /// The altitude of the sun in degrees on a day of the year, from 0, at an hour by the clock.
    fn altitude_deg(&self, day: u32, hour: f64) -> f64 {
        let g = TAU * (f64::from(day) + hour / 24.0 - 0.5) / 365.0;
        let declination = 0.006_918 - 0.399_912 * cos(g) + 0.070_257 * sin(g)
            - 0.006_758 * cos(2.0 * g)
            + 0.000_907 * sin(2.0 * g)
            - 0.002_697 * cos(3.0 * g)
            + 0.001_48 * sin(3.0 * g);
        let equation_h = 229.18 / 60.0
            * (0.000_075 + 0.001_868 * cos(g)
                - 0.032_077 * sin(g)
                - 0.014_615 * cos(2.0 * g)
                - 0.040_849 * sin(2.0 * g));
        let solar_h = hour + equation_h + self.longitude_deg / 15.0 - self.zone_h;
        let latitude = self.latitude_deg.to_radians();
        let sine = sin(latitude) * sin(declination)
            + cos(latitude) * cos(declination) * cos(PI * (solar_h - 12.0) / 12.0);
        90.0 - acos(sine.clamp(-1.0, 1.0)).to_degrees()
    }
}

/// An interval and its mean light in W/m2.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slot {
    pub(crate) month: u32,
    pub(crate) day: u32,
    /// Its middle by the clock, in h.
    pub(crate) middle_h: f64,
    pub(crate) altitude_deg: f64,
    pub(crate) direct: f64,
    pub(crate) diffuse: f64,
}

/// Exposures in Wh/m2, and for how long nothing is known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Exposure {
    pub(crate) direct: f64,
    pub(crate) diffuse: f64,
    pub(crate) unknown_h: f64,
}

impl Exposure {
    /// What the reader has.
    pub(crate) fn read(weather: &Weather) -> Self {
        let hours = weather.interval_s / 3600.0;
        let mut sum = Self::default();
        for hour in &weather.hours {
            match hour.light {
                Some(light) => {
                    sum.direct += light.direct * hours;
                    sum.diffuse += light.diffuse * hours;
                }
                None => sum.unknown_h += hours,
            }
        }
        sum
    }

    /// Whether both are the same but for decimals that are left out.
    pub(crate) fn is(&self, other: &Self) -> bool {
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-3 * b.abs() + 1e-9;
        near(self.direct, other.direct)
            && near(self.diffuse, other.diffuse)
            && near(self.unknown_h, other.unknown_h)
    }
}

/// Some days of a place.
#[derive(Clone, Debug)]
pub(crate) struct Made {
    pub(crate) place: Station,
    /// Intervals.
    pub(crate) an_hour: u32,
    pub(crate) slots: Vec<Slot>,
}

/// Which days, and how many intervals an hour.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Span {
    /// The first day of the year, from 0, and how many.
    pub(crate) first: u32,
    pub(crate) days: u32,
    pub(crate) has_leap_day: bool,
    pub(crate) an_hour: u32,
}

impl Span {
    pub(crate) const YEAR: Self = Self { first: 0, days: 365, has_leap_day: false, an_hour: 1 };
}

impl Made {
    pub(crate) fn random(dice: &mut SplitMix64, place: Station, span: Span) -> Self {
        let Span { first, days, has_leap_day, an_hour } = span;
        let mut dates = Vec::new();
        for (month, length) in (1..).zip(MONTHS) {
            let length = length + u32::from(month == 2 && has_leap_day);
            dates.extend((1..=length).map(|day| [month, day]));
        }
        let mut slots = Vec::new();
        for (number, [month, day]) in (0..).zip(dates).skip(first as usize).take(days as usize) {
            // Of some days the sky is clear, of some overcast.
            let clearness = dice.pick(&[0.0, 0.3, 0.75, 0.75]) * dice.within(0.9, 1.0);
            for part in 0..24 * an_hour {
                let middle_h = (f64::from(part) + 0.5) / f64::from(an_hour);
                let altitude_deg = place.altitude_deg(number, middle_h);
                let sine = sin(altitude_deg.to_radians()).max(0.0);
                let direct = 1150.0 * clearness * exp(-0.13 / (sine + 0.05));
                let direct = if sine > 0.0 { direct } else { 0.0 };
                let dusk = if altitude_deg > -3.0 { 4.0 } else { 0.0 };
                let diffuse = 1200.0 * sine * dice.within(0.08, 0.2 + 0.3 * (1.0 - clearness));
                let [direct, diffuse] = [direct, diffuse + dusk].map(f64::round);
                slots.push(Slot { month, day, middle_h, altitude_deg, direct, diffuse });
            }
        }
        Self { place, an_hour, slots }
    }

    pub(crate) fn exposure(&self) -> Exposure {
        let hours = 1.0 / f64::from(self.an_hour);
        let sum = |of: fn(&Slot) -> f64| self.slots.iter().map(|slot| of(slot) * hours).sum();
        Exposure {
            direct: sum(|slot| slot.direct),
            diffuse: sum(|slot| slot.diffuse),
            unknown_h: 0.0,
        }
    }

    /// Intervals with the sun at least so high.
    pub(crate) fn above(&self, altitude_deg: f64) -> Vec<usize> {
        let numbers = 0..self.slots.len();
        numbers.filter(|&number| self.slots[number].altitude_deg > altitude_deg).collect()
    }

    /// As EPW, values times `unit`, minutes those of the end.
    pub(crate) fn epw(&self, unit: f64) -> File {
        let Station { latitude_deg, longitude_deg, zone_h } = self.place;
        let [first, last] = [self.slots[0], self.slots[self.slots.len() - 1]];
        let head = format!(
            "LOCATION,Nowhere,-,-,made up,000000,{latitude_deg:.2},{longitude_deg:.2},\
             {zone_h:.1},9\nDESIGN CONDITIONS,0\nTYPICAL/EXTREME PERIODS,0\nGROUND TEMPERATURES,0\n\
             HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\nCOMMENTS 1,made up\nCOMMENTS 2,\n\
             DATA PERIODS,1,{},Data,Sunday,{}/{},{}/{}",
            self.an_hour, first.month, first.day, last.month, last.day
        );
        let fields = |slot: &Slot| {
            let Slot { month, day, middle_h, direct, diffuse, .. } = slot;
            let hour = libm::floor(*middle_h);
            let minute = 60.0 * (middle_h - hour + 0.5 / f64::from(self.an_hour));
            let (hour, minute) = (hour + 1.0, minute.round());
            let [direct, diffuse] = [direct, diffuse].map(|value| decimals(value * unit));
            format!(
                "2005,{month},{day},{hour},{minute},?9?9,9.0,7.0,87,102000,0,0,305,0,{direct},\
                 {diffuse},0,0,0,0,180,2.1,5,5,9.9,77777,9,999999999,10,0.1,0,88,0.2,0.0,0.0"
            )
        };
        File::new(&head, self.slots.iter().map(fields), ',')
    }

    /// As WEA in one of its units: of illuminances 100 lm/W.
    pub(crate) fn wea(&self, units: u32) -> File {
        let Station { latitude_deg, longitude_deg, zone_h } = self.place;
        let head = format!(
            "place Nowhere\nlatitude {latitude_deg:.2}\nlongitude {:.2}\ntime_zone {}\n\
             site_elevation 9.0\nweather_data_file_units {units}",
            -longitude_deg,
            -15.0 * zone_h
        );
        let fields = |slot: &Slot| {
            let Slot { month, day, middle_h, direct, diffuse, .. } = slot;
            let [direct, diffuse] = [*direct, *diffuse].map(|value| match units {
                3 => decimals(100.0 * value),
                _ => decimals(value),
            });
            format!("{month} {day} {middle_h:.3} {direct} {diffuse}")
        };
        File::new(&head, self.slots.iter().map(fields), ' ')
    }
}

/// Six decimals, none where there are none.
fn decimals(value: f64) -> String {
    let text = format!("{value:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A file in lines and fields, to be spoilt.
#[derive(Clone, Debug)]
pub(crate) struct File {
    pub(crate) header: Vec<String>,
    pub(crate) rows: Vec<Vec<String>>,
    pub(crate) separator: char,
    pub(crate) line_end: &'static str,
}

impl File {
    fn new(head: &str, rows: impl Iterator<Item = String>, separator: char) -> Self {
        let fields = |row: String| row.split(separator).map(str::to_owned).collect();
        let header = head.lines().map(str::to_owned).collect();
        Self { header, rows: rows.map(fields).collect(), separator, line_end: "\n" }
    }

    /// Puts other text in the header.
    pub(crate) fn say(mut self, old: &str, new: &str) -> Self {
        let line = self.header.iter_mut().find(|line| line.contains(old)).expect("such a line");
        *line = line.replacen(old, new, 1);
        self
    }

    pub(crate) fn text(&self) -> String {
        let separator = self.separator.to_string();
        let rows = self.rows.iter().map(|row| row.join(&separator));
        self.header.iter().cloned().chain(rows).map(|line| line + self.line_end).collect()
    }

    /// # Panics
    /// Where it is refused.
    pub(crate) fn read(&self) -> ParsedWeather {
        Weather::parse(self.text().as_bytes()).unwrap_or_else(|error| panic!("{error}"))
    }
}

/// What is told of it.
pub(crate) fn told(parsed: &ParsedWeather) -> Vec<WeatherWarning> {
    parsed.warnings.iter().map(|warning| warning.kind()).collect()
}
