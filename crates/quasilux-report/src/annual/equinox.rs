//! Sheets of the equinoxes: what points get from 9 to 15 h on clear days near them, as rating
//! systems ask (LEED v4, daylight, option 2).

use super::calendar::{Calendar, Interval};
use super::point::PointOfHours;
use crate::number::exact;
use quasilux_scene::Sensor;
use quasilux_sky::LocalTime;
use std::fmt::Write;

/// Months and days of the equinoxes, and how many days off the clear day may be.
const EQUINOXES: [[u32; 2]; 2] = [[3, 20], [9, 22]];
const DAYS_AROUND: u32 = 15;
/// A year that has all dates.
const LEAP_YEAR: i32 = 2028;
/// Hours of the clock that are listed.
const HOURS: std::ops::RangeInclusive<f64> = 9.0..=15.0;

/// Illuminances with their half-widths, in lx, by point and by interval of the sheets.
#[derive(Clone, Debug, Default)]
pub struct EquinoxSheets {
    /// Numbers of the intervals.
    intervals: Vec<usize>,
    points: Vec<Vec<[f32; 2]>>,
}

impl EquinoxSheets {
    /// Those of a calendar, without points. A file that has no such days makes empty ones.
    #[must_use]
    pub fn begin(calendar: &Calendar) -> Self {
        let of_day = |[month, day]: [u32; 2]| {
            let equinox = day_of_year(month, day);
            let near = |it: &Interval| day_of(it).abs_diff(equinox) <= DAYS_AROUND;
            // What the sun gives in all of the hours that are listed, day by day.
            let mut days: Vec<(u32, f64)> = Vec::new();
            for interval in calendar.intervals.iter().filter(|it| near(it) && is_listed(it)) {
                let day = day_of(interval);
                let sky = interval.sky.map(|sky| &calendar.skies[sky]);
                let lx = sky.map_or(0.0, |sky| sky.sun_normal_illuminance_lx);
                match days.iter_mut().find(|(known, _)| *known == day) {
                    Some((_, sum)) => *sum += lx,
                    None => days.push((day, lx)),
                }
            }
            let clearest = days.into_iter().max_by(|a, b| a.1.total_cmp(&b.1));
            clearest.filter(|(_, lx)| *lx > 0.0).map(|(day, _)| day)
        };
        let days = EQUINOXES.map(of_day);
        let is_own = |it: &Interval| is_listed(it) && days.contains(&Some(day_of(it)));
        let all = calendar.intervals.iter().enumerate();
        let intervals = all.filter(|(_, it)| is_own(it)).map(|(number, _)| number).collect();
        Self { intervals, points: Vec::new() }
    }

    /// Adds the next point.
    pub(super) fn push(&mut self, point: &PointOfHours) {
        let value = |number: &usize| [point.illuminance_lx[*number], point.half_width_lx[*number]];
        self.points.push(self.intervals.iter().map(value).collect());
    }

    /// Of a sensor whose points start at a number: a line each, where it is, and each interval
    /// with its half-width. `None` without intervals.
    #[must_use]
    pub fn csv(&self, sensor: &Sensor, first: usize, calendar: &Calendar) -> Option<String> {
        if self.intervals.is_empty() {
            return None;
        }
        let mut text = "x_m,y_m,z_m,nx,ny,nz".to_owned();
        for interval in self.intervals.iter().map(|number| &calendar.intervals[*number]) {
            let Interval { month, day, middle_h, .. } = interval;
            let minutes = (60.0 * middle_h).round() as u32;
            let time = format!("{month:02}-{day:02}T{:02}:{:02}", minutes / 60, minutes % 60);
            write!(text, ",{time}_lx,{time}_half_width_lx").expect("strings grow");
        }
        text.push('\n');
        for (place, lx) in sensor.points().iter().zip(self.points.get(first..).unwrap_or_default())
        {
            let place = place.position.to_array().into_iter().chain(place.normal.to_array());
            let finite = |x: &f32| if x.is_finite() { exact(f64::from(*x)) } else { String::new() };
            let fields: Vec<String> =
                place.map(exact).chain(lx.as_flattened().iter().map(finite)).collect();
            text += &(fields.join(",") + "\n");
        }
        Some(text)
    }
}

fn day_of(interval: &Interval) -> u32 {
    day_of_year(interval.month, interval.day)
}

/// The day of a leap year; 0 for dates that no weather file has.
fn day_of_year(month: u32, day: u32) -> u32 {
    LocalTime::new(LEAP_YEAR, month, day, 0.0).map_or(0, |time| time.day_of_year())
}

fn is_listed(interval: &Interval) -> bool {
    HOURS.contains(&interval.middle_h)
}
