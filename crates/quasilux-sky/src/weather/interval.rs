//! Which interval of a weather file a time belongs to.

use super::{Weather, WeatherHour};

/// Seconds of an hour: the longest interval.
const HOUR_S: f64 = 3600.0;
/// Two middles that are nearer than this, in s, are of the same interval: decimals of hours are
/// rounded in files.
const SAME_S: f64 = 1.0;

impl Weather {
    /// How long an interval is, in s: the shortest way from the middle of one to that of the next
    /// on the same day, at most an hour.
    #[must_use]
    pub fn interval_s(&self) -> f64 {
        let is_same_day = |a: &WeatherHour, b: &WeatherHour| (a.month, a.day) == (b.month, b.day);
        let pairs = self.hours.windows(2).filter(|pair| is_same_day(&pair[0], &pair[1]));
        let steps = pairs.map(|pair| pair[1].seconds - pair[0].seconds);
        steps.filter(|step| *step > SAME_S).fold(HOUR_S, f64::min)
    }

    /// The number of the first interval, in the order of the file, that contains a time of day in
    /// s on a date of any year; it begins with its first instant. `None` where the file has none.
    #[must_use]
    pub fn interval_at(&self, month: u32, day: u32, seconds: f64) -> Option<usize> {
        let half_s = 0.5 * self.interval_s();
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
    fn a_time_belongs_to_the_interval_around_it() {
        let hourly = weather("1 1 10.5 1 1\n1 1 11.5 1 1\n1 2 10.5 1 1\n");
        assert_eq!(hourly.interval_s(), 3600.0);
        let at = |h: f64| hourly.interval_at(1, 1, 3600.0 * h);
        assert_eq!([at(9.99), at(10.0), at(10.99), at(11.0)], [None, Some(0), Some(0), Some(1)]);
        assert_eq!((at(11.999), at(12.0)), (Some(1), None));
        assert_eq!(hourly.interval_at(1, 2, 36_000.0), Some(2));
        assert_eq!(hourly.interval_at(2, 29, 36_000.0), None);
        let quarters = weather("1 1 10.125 1 1\n1 1 10.375 1 1\n1 1 11.875 1 1\n");
        assert_eq!(quarters.interval_s(), 900.0);
        assert_eq!(quarters.interval_at(1, 1, 3600.0 * 10.3), Some(1));
        assert_eq!(quarters.interval_at(1, 1, 3600.0 * 11.0), None);
        assert_eq!(weather("1 1 0.5 1 1\n").interval_at(1, 1, 0.0), Some(0));
    }
}
