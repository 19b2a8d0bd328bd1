//! A date and a time of day.

use crate::error::SkyError;

/// A time by the clock of a site's time zone, in the Gregorian calendar.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct LocalTime {
    year: i32,
    month: u32,
    day: u32,
    seconds: f64,
}

/// Days of the months of a year that is none of 366 days.
const DAYS: [u32; 12] = [31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];

impl LocalTime {
    /// A date from 1583 to 3000 and a time of day in seconds from midnight, below 86 400.
    ///
    /// # Errors
    /// For dates that no calendar has and times that no day has.
    pub fn new(year: i32, month: u32, day: u32, seconds: f64) -> Result<Self, SkyError> {
        let date = || format!("{year:04}-{month:02}-{day:02}");
        if !(1583..=3000).contains(&year) {
            return Err(SkyError::new("the date", date(), "a year from 1583 to 3000"));
        }
        let days = DAYS.get((month as usize).wrapping_sub(1)).copied().unwrap_or(0);
        let is_leap_day = month == 2 && day == 29 && is_leap_year(year);
        if (day < 1 || day > days) && !is_leap_day {
            return Err(SkyError::new("the date", date(), "a day of the calendar"));
        }
        if !(0.0..86_400.0).contains(&seconds) {
            return Err(SkyError::new("the time of day in s", seconds, "0 to below 86400"));
        }
        Ok(Self { year, month, day, seconds })
    }

    /// The year.
    #[must_use]
    pub fn year(&self) -> i32 {
        self.year
    }

    /// The month, from 1.
    #[must_use]
    pub fn month(&self) -> u32 {
        self.month
    }

    /// The day of the month, from 1.
    #[must_use]
    pub fn day(&self) -> u32 {
        self.day
    }

    /// Seconds from midnight.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        self.seconds
    }

    /// The day of the year, from 1.
    #[must_use]
    pub fn day_of_year(&self) -> u32 {
        let before: u32 = DAYS[..self.month as usize - 1].iter().sum();
        before + self.day + u32::from(self.month > 2 && is_leap_year(self.year))
    }

    /// The Julian date where the clock is this many hours ahead of Greenwich.
    pub(crate) fn julian_date(&self, time_zone_h: f64) -> f64 {
        // J. Meeus, "Astronomical algorithms" (1998), chapter 7, with March as the first month.
        let from_march = (self.month + 9) % 12;
        let year = i64::from(self.year) - i64::from(self.month < 3);
        let days = 365 * year + year.div_euclid(4) - year.div_euclid(100)
            + year.div_euclid(400)
            + i64::from((153 * from_march + 2) / 5)
            + i64::from(self.day);
        days as f64 + 1_721_118.5 + (self.seconds / 3600.0 - time_zone_h) / 24.0
    }
}

/// Whether a year has a 29th of February.
fn is_leap_year(year: i32) -> bool {
    year % 4 == 0 && (year % 100 != 0 || year % 400 == 0)
}

impl std::fmt::Display for LocalTime {
    /// `2026-03-20T12:00:00`; parts of a second are left out.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { year, month, day, seconds } = *self;
        let whole = seconds as u32;
        let (hour, minute, second) = (whole / 3600, whole / 60 % 60, whole % 60);
        write!(f, "{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}")
    }
}

impl std::str::FromStr for LocalTime {
    type Err = SkyError;

    /// `2026-03-20T12:00:00`, or without seconds.
    fn from_str(text: &str) -> Result<Self, SkyError> {
        let wrong = || SkyError::new("the time", format!("{text:?}"), "2026-03-20T12:00:00");
        let (date, time) = text.split_once(['T', ' ']).ok_or_else(wrong)?;
        let [year, month, day] = numbers(date, '-', [4, 2, 2]).ok_or_else(wrong)?;
        let [hour, minute, second] = numbers(time, ':', [2, 2, 2])
            .or_else(|| numbers(time, ':', [2, 2]).map(|[hour, minute]| [hour, minute, 0]))
            .ok_or_else(wrong)?;
        if hour > 23 || minute > 59 || second > 59 {
            return Err(wrong());
        }
        let seconds = f64::from((hour * 60 + minute) * 60 + second);
        Self::new(i32::try_from(year).map_err(|_| wrong())?, month, day, seconds)
    }
}

/// Unsigned numbers of this many digits.
fn numbers<const N: usize>(text: &str, separator: char, digits: [usize; N]) -> Option<[u32; N]> {
    let mut fields = text.split(separator);
    let mut found = [0; N];
    for (number, digits) in found.iter_mut().zip(digits) {
        let field = fields.next()?;
        let is_whole = field.len() == digits && field.bytes().all(|byte| byte.is_ascii_digit());
        *number = if is_whole { field.parse().ok()? } else { return None };
    }
    fields.next().is_none().then_some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Examples of J. Meeus, "Astronomical algorithms", chapter 7.
    #[test]
    fn julian_dates_are_those_of_meeus() {
        let known = [
            ("2000-01-01T12:00", 2_451_545.0),
            ("1999-01-01T00:00", 2_451_179.5),
            ("1987-01-27T00:00", 2_446_822.5),
            ("1988-06-19T12:00", 2_447_332.0),
            ("1600-12-31T00:00", 2_305_812.5),
        ];
        for (text, expected) in known {
            let time: LocalTime = text.parse().unwrap();
            assert_eq!(time.julian_date(0.0), expected, "{text}");
            assert!((time.julian_date(-6.0) - expected - 0.25).abs() < 1e-9);
        }
    }

    #[test]
    fn days_are_counted_from_new_year() {
        for (text, expected) in [("2025-12-31", 365), ("2024-12-31", 366), ("2024-03-01", 61)] {
            let time: LocalTime = format!("{text}T00:00:00").parse().unwrap();
            assert_eq!(time.day_of_year(), expected, "{text}");
        }
    }

    #[test]
    fn what_is_no_moment_is_refused() {
        for text in [
            "",
            "2026-03-20",
            "2026-3-20T12:00",
            "2026-02-29T12:00",
            "2026-13-01T00:00",
            "x",
            "2026-03-20T24:00",
            "2026-03-20T12:60",
            "2026-03-20T12:00:60",
            "2026-03-20T12:00:00Z",
            "1500-01-01T00:00",
            "+026-01-01T00:00",
            "2026-00-10T00:00",
            "2026-01-00T00:00",
        ] {
            assert!(text.parse::<LocalTime>().is_err(), "{text}");
        }
        assert!(LocalTime::new(2024, 2, 29, 86_399.5).is_ok());
        assert!(LocalTime::new(2024, 2, 29, f64::NAN).is_err());
    }
}
