//! One sensor point over a year: its measures, with their intervals.
//!
//! A measure that counts hours is off by no more than the hours that may be on the other side of a
//! threshold, each by its own interval: where few hours are near it, replicates that are left out
//! seldom tell of them. So an hour is surely above, surely below, or undecided.
//!
//! Other measures are smooth functions of the mean illuminances of all hours. Left out one after
//! the other, replicates change them a little; that makes their intervals (B. Efron and C. Stein,
//! "The jackknife estimate of variance", Annals of Statistics 9, 1981), which count that all hours
//! share their paths.
//!
//! Both are wider by what intervals of which nothing is known may change.

use super::calendar::Calendar;
use super::measures::{Measure, measures, off_by_missing};
use crate::Figure;
use quasilux_scene::Thresholds;
use quasilux_transport::{Interval, PointOfYear};
use serde::{Deserialize, Serialize};

/// What one sensor point has of a year.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PointSummary {
    /// In the order of [`Measure::ALL`].
    pub measures: [Figure; Measure::ALL.len()],
    /// The occupied hours by whether there is enough light.
    pub hours: HourCounts,
    /// Paths in each replicate.
    pub samples: u64,
    /// The root mean square over hours with light of half-width over value.
    pub relative_half_width: Option<f64>,
    /// Whether that is within the tolerance.
    pub is_done: bool,
}

/// Intervals of a year, by what is known of their illuminance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct HourCounts {
    /// The whole interval of confidence is above the threshold.
    pub above: u32,
    /// The whole interval is below.
    pub below: u32,
    /// The threshold is within.
    pub undecided: u32,
}

/// The same with its hours.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PointOfHours {
    /// What is kept of it.
    pub summary: PointSummary,
    /// Illuminances in lx, interval by interval of the calendar; not a number where nothing is
    /// known.
    pub illuminance_lx: Vec<f32>,
    /// Their half-widths.
    pub half_width_lx: Vec<f32>,
    /// Illuminances in lx straight from the sun with all blinds open, in the same order; empty
    /// where a point was kept, and read again.
    #[serde(skip)]
    pub sun_lx: Vec<f32>,
    /// Half-width over standard error of its intervals; `None` of a single replicate.
    pub(super) t: Option<f64>,
    /// Illuminances in lx by replicate and hour with light; empty where nobody needs them any more.
    pub(super) by_replicate: Vec<Vec<f32>>,
}

impl PointSummary {
    /// A measure.
    #[must_use]
    pub fn measure(&self, measure: Measure) -> Figure {
        self.measures[measure.place()]
    }
}

impl PointOfHours {
    /// Whether it has the hours of a calendar, and those of its replicates or none.
    #[must_use]
    pub fn fits(&self, calendar: &Calendar, has_replicates: bool) -> bool {
        let intervals = calendar.intervals.len();
        let is_whole = |hours: &Vec<f32>| hours.len() == calendar.skies.len();
        [&self.illuminance_lx, &self.half_width_lx].iter().all(|hours| hours.len() == intervals)
            && self.by_replicate.iter().all(is_whole)
            && self.by_replicate.is_empty() != has_replicates
    }

    /// Without the hours of its replicates, which electric light alone needs.
    #[must_use]
    pub fn slimmed(self) -> Self {
        Self { by_replicate: Vec::new(), ..self }
    }

    /// What a point that was simulated has of the year, with intervals like those that it was
    /// judged by.
    #[must_use]
    pub fn new(point: PointOfYear, calendar: &Calendar, thresholds: &Thresholds) -> Self {
        let t = point.t();
        let of_year = Replicates::new(&point.illuminance_lx);
        let of_sun = Replicates::new(&point.sun_lx);
        let values = measures(calendar, thresholds, &of_year.means, &of_sun.means);
        let errors = jackknife(calendar, thresholds, [&of_year, &of_sun], &values);
        let width = |interval: Interval| interval.half_width.unwrap_or(0.0);
        let half_widths: Vec<f64> = point.intervals_lx().into_iter().map(width).collect();
        let of_sun_widths = of_sun.half_widths(t.unwrap_or(0.0));
        let of_hours = occupied(calendar, &of_year.means, &half_widths);
        let of_sunlight = occupied(calendar, &of_sun.means, &of_sun_widths);
        let half_width = |measure: Measure, t: f64| match measure.counted_lx(thresholds) {
            Some(lx) if measure == Measure::SunlitHours => {
                undecided(&of_sunlight, lx) * calendar.interval_h
            }
            Some(lx) => undecided(&of_hours, lx) / of_hours.len().max(1) as f64,
            None => t * errors[measure.place()],
        };
        let figure = |measure: Measure| Figure {
            value: Some(values[measure.place()]),
            half_width: t.and_then(|t| {
                let value = values[measure.place()];
                let missing = off_by_missing(measure, value, calendar, &of_year.means)?;
                Some(half_width(measure, t) + missing)
            }),
        };
        let by_interval = |values: &[f64]| -> Vec<f32> {
            let value = |it: &super::Interval| match it.sky {
                Some(sky) => values[sky] as f32,
                None if it.is_known => 0.0,
                None => f32::NAN,
            };
            calendar.intervals.iter().map(value).collect()
        };
        Self {
            summary: PointSummary {
                measures: Measure::ALL.map(figure),
                hours: count(&of_hours, thresholds.enough_lx),
                samples: point.samples,
                relative_half_width: point.relative_half_width,
                is_done: point.is_done,
            },
            illuminance_lx: by_interval(&of_year.means),
            half_width_lx: by_interval(&half_widths),
            sun_lx: by_interval(&of_sun.means),
            t,
            by_replicate: point.illuminance_lx,
        }
    }
}

/// The hours of all replicates.
struct Replicates<'r> {
    values: &'r [Vec<f32>],
    /// The mean of each hour.
    means: Vec<f64>,
}

impl<'r> Replicates<'r> {
    fn new(values: &'r [Vec<f32>]) -> Self {
        let mut means = vec![0.0; values.first().map_or(0, Vec::len)];
        for replicate in values {
            means.iter_mut().zip(replicate).for_each(|(sum, x)| *sum += f64::from(*x));
        }
        means.iter_mut().for_each(|sum| *sum /= values.len() as f64);
        Self { values, means }
    }

    /// The means of the others.
    fn without(&self, replicate: usize) -> Vec<f64> {
        let n = self.values.len() as f64;
        let own = self.means.iter().zip(&self.values[replicate]);
        own.map(|(mean, x)| (n * mean - f64::from(*x)) / (n - 1.0)).collect()
    }

    /// Half-widths of `t` standard errors, hour by hour.
    fn half_widths(&self, t: f64) -> Vec<f64> {
        let of = |hour| self.values.iter().map(move |values| f64::from(values[hour]));
        let half_width = |hour| Interval::of_mean(of(hour), Some(t)).half_width;
        (0..self.means.len()).filter_map(half_width).collect()
    }
}

/// An hour, as far as it is known.
#[derive(Clone, Copy)]
struct Hour {
    lx: f64,
    half_width: f64,
}

/// The occupied hours.
fn occupied(calendar: &Calendar, means: &[f64], half_widths: &[f64]) -> Vec<Hour> {
    let occupied = calendar.intervals.iter().filter(|interval| interval.is_occupied);
    let known = |sky: usize| Hour { lx: means[sky], half_width: half_widths[sky] };
    let dark = Hour { lx: 0.0, half_width: 0.0 };
    occupied.map(|interval| interval.sky.map_or(dark, known)).collect()
}

/// Standard errors of all measures with these values, of the illuminances and of those straight
/// from the sun.
fn jackknife(
    calendar: &Calendar,
    thresholds: &Thresholds,
    [of_year, of_sun]: [&Replicates<'_>; 2],
    values: &[f64; Measure::ALL.len()],
) -> [f64; Measure::ALL.len()] {
    let replicates = of_year.values.len();
    let mut squares = [0.0; Measure::ALL.len()];
    // Of one replicate nothing is left.
    for replicate in (0..replicates).filter(|_| replicates > 1) {
        let [lx, sun_lx] = [of_year, of_sun].map(|all| all.without(replicate));
        let others = measures(calendar, thresholds, &lx, &sun_lx);
        for ((square, other), value) in squares.iter_mut().zip(others).zip(values) {
            *square += (other - value) * (other - value);
        }
    }
    let n = replicates as f64;
    squares.map(|square| (square * (n - 1.0) / n).sqrt())
}

/// By how many the hours between two illuminances may be more or fewer.
fn undecided(hours: &[Hour], [from_lx, to_lx]: [f64; 2]) -> f64 {
    let is_between = |lx: f64| (from_lx..to_lx).contains(&lx);
    let (mut more, mut fewer) = (0.0_f64, 0.0_f64);
    for &Hour { lx, half_width } in hours {
        let (low, high) = (lx - half_width, lx + half_width);
        if is_between(lx) {
            fewer += f64::from(u8::from(!is_between(low) || !is_between(high)));
        } else {
            more += f64::from(u8::from(high >= from_lx && low < to_lx));
        }
    }
    more.max(fewer)
}

/// Counts the occupied hours by what is known of them.
fn count(hours: &[Hour], enough_lx: f64) -> HourCounts {
    let mut counts = HourCounts::default();
    for &Hour { lx, half_width } in hours {
        let kind = match lx {
            lx if lx - half_width >= enough_lx => &mut counts.above,
            lx if lx + half_width < enough_lx => &mut counts.below,
            _ => &mut counts.undecided,
        };
        *kind += 1;
    }
    counts
}
