//! Which hours of a weather file count for what.

use quasilux_scene::Occupancy;
use quasilux_sky::{SkyError, Weather, WeatherSky};

/// The intervals of a weather file.
#[derive(Clone, Debug)]
pub struct Calendar {
    /// All intervals, in the order of the file.
    pub intervals: Vec<Interval>,
    /// The skies of those with light, in the same order.
    pub skies: Vec<WeatherSky>,
    /// How long an interval lasts, in h.
    pub interval_h: f64,
    /// Whether there is an interval for all hours of a year.
    pub is_of_a_year: bool,
    /// The intervals of which nothing is known while people are there.
    pub unknown_occupied: usize,
}

/// An interval of a weather file, most often an hour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The month, from 1.
    pub month: u32,
    /// The day of the month, from 1.
    pub day: u32,
    /// The middle, in h from midnight by the clock of the site.
    pub middle_h: f64,
    /// The number of its sky among those with light; `None` at night, and where it is unknown.
    pub sky: Option<usize>,
    /// Whether the file says what shines, or the sun is far below the horizon.
    pub is_known: bool,
    /// Whether people are there.
    pub is_occupied: bool,
    /// Whether it is in the brighter half of the year, by the illuminance of the sky without the
    /// sun: EN 17037 counts these 4380 hours as those with daylight.
    pub is_daylit: bool,
}

impl Calendar {
    /// The calendar of a file, and when people are there.
    ///
    /// # Errors
    /// For dates that no year has, which no file that could be read has.
    pub fn new(weather: &Weather, occupancy: &Occupancy) -> Result<Self, SkyError> {
        let (mut skies, mut unknown_occupied) = (Vec::new(), 0);
        let mut intervals = Vec::with_capacity(weather.hours.len());
        for (number, hour) in weather.hours.iter().enumerate() {
            let sky = weather.sky_of(hour)?;
            let middle_h = hour.seconds / 3600.0;
            let is_known = hour.light.is_some() || weather.is_night(hour)?;
            let day_of_year = weather.time_of(hour)?.day_of_year();
            let has_people = occupancy.holds(number, day_of_year, middle_h);
            unknown_occupied += usize::from(has_people && !is_known);
            intervals.push(Interval {
                month: hour.month,
                day: hour.day,
                middle_h,
                sky: sky.as_ref().map(|_| skies.len()),
                is_known,
                is_occupied: is_known && has_people,
                is_daylit: false,
            });
            skies.extend(sky);
        }
        let (interval_h, is_of_a_year) = (weather.interval_s / 3600.0, weather.is_of_a_year());
        let mut calendar = Self { intervals, skies, interval_h, is_of_a_year, unknown_occupied };
        calendar.mark_daylit();
        Ok(calendar)
    }

    /// Marks the brighter half; of equally bright hours the earlier ones.
    fn mark_daylit(&mut self) {
        let sky_lx = |interval: &Interval| {
            interval.sky.map_or(0.0, |sky| self.skies[sky].sky.horizontal_illuminance_lx())
        };
        let lx: Vec<f64> = self.intervals.iter().map(sky_lx).collect();
        let mut order: Vec<usize> = (0..lx.len()).collect();
        order.retain(|&interval| self.intervals[interval].is_known);
        order.sort_by(|&a, &b| lx[b].total_cmp(&lx[a]).then(a.cmp(&b)));
        order.truncate(order.len().div_ceil(2));
        order.into_iter().for_each(|interval| self.intervals[interval].is_daylit = true);
    }

    /// How many intervals are of a kind.
    #[must_use]
    pub fn count(&self, is_of_kind: impl Fn(&Interval) -> bool) -> usize {
        self.intervals.iter().filter(|interval| is_of_kind(interval)).count()
    }
}
