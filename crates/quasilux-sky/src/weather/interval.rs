//! Which interval of a weather file a time belongs to.

use super::{HOUR_S, TimeOfYear, Weather};
use std::collections::BTreeMap;

/// Two middles that are nearer than this, in s, are of the same interval: decimals of hours are
/// rounded in files.
const SAME_S: f64 = 1.0;
/// What steps between hours of two decimals are off at most, in s: 36, and what sums of them lose.
const ROUNDED_S: f64 = 36.5;
/// The same as a part of steps that are of no usual part of an hour.
const ROUNDED: f64 = 0.02;
/// Into how many whole minutes hours are divided.
const PARTS: [u32; 12] = [1, 2, 3, 4, 5, 6, 10, 12, 15, 20, 30, 60];

/// How long intervals are in s by the times at which one ends or is in its middle: by the step from
/// one to the next that most of them have, if it is a part of an hour. `None` where no two are of
/// one day.
///
/// Files of hours with the sun up leave out nights, some have odd times around sunrise: neither
/// makes an interval longer or shorter.
pub(super) fn usual_interval_s(times: impl Iterator<Item = TimeOfYear> + Clone) -> Option<f64> {
    let mut steps = BTreeMap::<u32, usize>::new();
    let mut all = 0;
    for (time, next) in times.clone().zip(times.skip(1)) {
        let step_s = next.seconds - time.seconds;
        if (time.month, time.day) == (next.month, next.day) && step_s > SAME_S {
            all += 1;
            if let Some(an_hour) = steps_an_hour(step_s) {
                *steps.entry(an_hour).or_default() += 1;
            }
        }
    }
    let usual = steps.into_iter().max_by_key(|(_, count)| *count);
    let usual = usual.filter(|(_, count)| 2 * count >= all);
    (all > 0).then(|| usual.map_or(HOUR_S, |(an_hour, _)| HOUR_S / f64::from(an_hour)))
}

/// How many such steps make an hour, whose times may be rounded.
fn steps_an_hour(step_s: f64) -> Option<u32> {
    let off_s = |an_hour: u32| (HOUR_S / f64::from(an_hour) - step_s).abs();
    let nearest = PARTS.into_iter().min_by(|&a, &b| off_s(a).total_cmp(&off_s(b)))?;
    if off_s(nearest) <= ROUNDED_S {
        return Some(nearest);
    }
    let whole = (HOUR_S / step_s).round() as u32;
    (whole > 0 && off_s(whole) < ROUNDED * step_s).then_some(whole)
}

impl Weather {
    /// The number of the first interval, in the order of the file, that contains a time of day in
    /// s on a date of any year; it begins with its first instant. `None` where the file has none.
    #[must_use]
    pub fn interval_at(&self, month: u32, day: u32, seconds: f64) -> Option<usize> {
        let half_s = 0.5 * self.interval_s;
        self.hours.iter().position(|hour| {
            let since_middle = seconds - hour.seconds;
            (hour.month, hour.day) == (month, day) && (-half_s..half_s).contains(&since_middle)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn weather(rows: &str) -> Weather {
        let head = "place X\nlatitude 1\nlongitude 2\ntime_zone 0\nsite_elevation 3\n\
            weather_data_file_units 1\n";
        Weather::parse(format!("{head}{rows}").as_bytes()).unwrap().weather
    }

    #[test]
    fn odd_times_are_hours_too() {
        let interval_s = |rows: &str| weather(rows).interval_s;
        // Sun-up hours, the first of each day with a time of its own.
        let sunrise = "1 1 7.8 1 1\n1 1 8.5 1 1\n1 1 9.5 1 1\n1 1 10.5 1 1\n1 2 7.9 1 1\n\
            1 2 8.5 1 1\n1 2 9.5 1 1\n";
        assert_eq!(interval_s(sunrise), 3600.0);
        // Every second hour, and times that are of no part of an hour.
        assert_eq!(interval_s("1 1 8.5 1 1\n1 1 10.5 1 1\n1 1 12.5 1 1\n"), 3600.0);
        assert_eq!(interval_s("1 1 8.0 1 1\n1 1 8.7 1 1\n1 1 9.4 1 1\n"), 3600.0);
        assert_eq!(interval_s("1 1 8.1 1 1\n1 1 8.2 1 1\n1 1 8.3 1 1\n"), 360.0);
        assert_eq!(interval_s("1 1 8.5 1 1\n1 2 8.5 1 1\n"), 3600.0);
        // Thirds of an hour, rounded.
        assert_eq!(interval_s("1 1 8.167 1 1\n1 1 8.5 1 1\n1 1 8.833 1 1\n"), 1200.0);
        assert_eq!(interval_s("1 1 8.17 1 1\n1 1 8.5 1 1\n1 1 8.83 1 1\n"), 1200.0);
    }

    #[test]
    fn a_time_belongs_to_the_interval_around_it() {
        let hourly = weather("1 1 10.5 1 1\n1 1 11.5 1 1\n1 2 10.5 1 1\n");
        assert_eq!(hourly.interval_s, 3600.0);
        let at = |h: f64| hourly.interval_at(1, 1, 3600.0 * h);
        assert_eq!([at(9.99), at(10.0), at(10.99), at(11.0)], [None, Some(0), Some(0), Some(1)]);
        assert_eq!((at(11.999), at(12.0)), (Some(1), None));
        assert_eq!(hourly.interval_at(1, 2, 36_000.0), Some(2));
        assert_eq!(hourly.interval_at(2, 29, 36_000.0), None);
        let quarters = weather("1 1 10.125 1 1\n1 1 10.375 1 1\n1 1 11.875 1 1\n");
        assert_eq!(quarters.interval_s, 900.0);
        assert_eq!(quarters.interval_at(1, 1, 3600.0 * 10.3), Some(1));
        assert_eq!(quarters.interval_at(1, 1, 3600.0 * 11.0), None);
        assert_eq!(weather("1 1 0.5 1 1\n").interval_at(1, 1, 0.0), Some(0));
    }
}
