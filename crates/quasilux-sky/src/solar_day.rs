//! Where the sun is on a day, hour by hour, and when it is above the horizon.

use crate::error::SkyError;
use crate::local_time::LocalTime;
use crate::point::SkyPoint;
use crate::sun::Site;

/// Seconds of a day, and of an hour.
const DAY_S: f64 = 86_400.0;
const HOUR_S: f64 = 3600.0;
/// The sun is looked at in steps of this, in s: it is not missed when it is up for longer.
const STEP_S: f64 = 300.0;
/// Rise, set and noon are found to this, in s.
const PRECISE_S: f64 = 0.5;
/// What a step of the search for the highest place leaves of its interval: one over the golden
/// ratio.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// A day of a site by its clock, from 0:00 to 24:00.
#[derive(Clone, Debug, PartialEq)]
pub struct SolarDay {
    /// At 0:00, 1:00 and so on to 23:00.
    pub hours: Vec<SolarPosition>,
    /// From when to when the centre of the sun is above the horizon, in s from midnight,
    /// ascending; without refraction. Empty where the sun does not rise, and 0 to 86 400 where it
    /// does not set.
    pub up_s: Vec<[f64; 2]>,
    /// When it is highest.
    pub highest: SolarPosition,
}

/// The sun at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolarPosition {
    /// By the clock of the site.
    pub time: LocalTime,
    /// Its centre, without refraction.
    pub sun: SkyPoint,
}

impl Site {
    /// The way of the sun on a day of the calendar.
    ///
    /// # Errors
    /// For dates that no calendar has.
    pub fn solar_day(&self, year: i32, month: u32, day: u32) -> Result<SolarDay, SkyError> {
        let at = |seconds: f64| -> Result<SolarPosition, SkyError> {
            // The last instant of the day stands for its end.
            let time = LocalTime::new(year, month, day, seconds.min(DAY_S.next_down()))?;
            Ok(SolarPosition { time, sun: self.sun_at(&time)? })
        };
        let altitude = |seconds: f64| Ok(at(seconds)?.sun.altitude_deg);
        let hours = (0..24).map(|hour| at(f64::from(hour) * HOUR_S)).collect::<Result<_, _>>()?;
        let steps = (DAY_S / STEP_S) as u32;
        let times: Vec<f64> = (0..=steps).map(|step| f64::from(step) * STEP_S).collect();
        let altitudes =
            times.iter().map(|time| altitude(*time)).collect::<Result<Vec<f64>, _>>()?;
        let up_s = times_above(&times, &altitudes, &altitude)?;
        let top = (0..times.len()).max_by(|&i, &j| altitudes[i].total_cmp(&altitudes[j]));
        let top = times[top.unwrap_or(0)];
        let highest = highest([(top - STEP_S).max(0.0), (top + STEP_S).min(DAY_S)], &altitude)?;
        Ok(SolarDay { hours, up_s, highest: at(highest)? })
    }
}

/// The intervals of positive altitudes, their ends found by bisection.
fn times_above(
    times: &[f64],
    altitudes: &[f64],
    altitude: &impl Fn(f64) -> Result<f64, SkyError>,
) -> Result<Vec<[f64; 2]>, SkyError> {
    let mut found = Vec::new();
    let mut since = altitudes.first().filter(|altitude| **altitude > 0.0).map(|_| times[0]);
    for (pair, heights) in times.windows(2).zip(altitudes.windows(2)) {
        let is_up = [heights[0] > 0.0, heights[1] > 0.0];
        if is_up[0] == is_up[1] {
            continue;
        }
        let [mut low, mut high] = [pair[0], pair[1]];
        while high - low > PRECISE_S {
            let middle = 0.5 * (low + high);
            if (altitude(middle)? > 0.0) == is_up[0] { low = middle } else { high = middle }
        }
        match since.take() {
            Some(rise) => found.push([rise, high]),
            None => since = Some(high),
        }
    }
    if let (Some(rise), Some(end)) = (since, times.last()) {
        found.push([rise, *end]);
    }
    Ok(found)
}

/// Where a function with one maximum in an interval has it, by golden sections.
fn highest(
    [mut low, mut high]: [f64; 2],
    altitude: &impl Fn(f64) -> Result<f64, SkyError>,
) -> Result<f64, SkyError> {
    while high - low > PRECISE_S {
        let width = GOLDEN * (high - low);
        let [left, right] = [high - width, low + width];
        if altitude(left)? > altitude(right)? { high = right } else { low = left }
    }
    Ok(0.5 * (low + high))
}
