//! One sensor point over a year: its measures, with intervals by the jackknife over replicates.
//!
//! A measure is a function of the mean illuminances of all hours. Left out one after the other,
//! replicates change it a little; that makes its interval (B. Efron and C. Stein, "The jackknife
//! estimate of variance", Annals of Statistics 9, 1981), which counts that all hours share their
//! paths. Hours are counted beside it by their own intervals: surely above, surely below,
//! undecided.

use super::calendar::Calendar;
use super::measures::{Measure, Thresholds, measures};
use crate::Figure;
use quasilux_transport::PointOfYear;
use quasilux_transport::interval::t_quantile_for;
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

    /// What a point that was simulated has of the year, with intervals of this level of confidence.
    #[must_use]
    pub fn new(
        point: PointOfYear,
        calendar: &Calendar,
        thresholds: &Thresholds,
        confidence: f64,
    ) -> Self {
        let replicates = point.illuminance_lx.len();
        let t = t_quantile_for(replicates, 1.0 - confidence);
        let of_year = Replicates::new(&point.illuminance_lx);
        let of_sun = Replicates::new(&point.sun_lx);
        let of = |illuminance_lx: &[f64], sun_lx: &[f64]| {
            measures(calendar, thresholds, illuminance_lx, sun_lx)
        };
        let values = of(&of_year.means, &of_sun.means);
        let mut squares = [0.0; Measure::ALL.len()];
        if t.is_some() {
            for replicate in 0..replicates {
                let others = of(&of_year.without(replicate), &of_sun.without(replicate));
                for ((square, other), value) in squares.iter_mut().zip(others).zip(values) {
                    *square += (other - value) * (other - value);
                }
            }
        }
        let n = replicates as f64;
        let figure = |(value, square): (f64, f64)| Figure {
            value: Some(value),
            half_width: t.map(|t| t * (square * (n - 1.0) / n).sqrt()),
        };
        let mut figures = values.into_iter().zip(squares).map(figure);
        let measures = std::array::from_fn(|_| figures.next().unwrap_or_default());
        let half_widths: Vec<f64> = (0..of_year.means.len())
            .map(|hour| of_year.half_width(hour, t.unwrap_or(0.0)))
            .collect();
        let hours = count(calendar, thresholds.enough_lx, &of_year.means, &half_widths);
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
                measures,
                hours,
                samples: point.samples,
                relative_half_width: point.relative_half_width,
                is_done: point.is_done,
            },
            illuminance_lx: by_interval(&of_year.means),
            half_width_lx: by_interval(&half_widths),
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

    fn half_width(&self, hour: usize, t: f64) -> f64 {
        let (n, mean) = (self.values.len() as f64, self.means[hour]);
        let square = |replicate: &Vec<f32>| {
            let off = f64::from(replicate[hour]) - mean;
            off * off
        };
        t * (self.values.iter().map(square).sum::<f64>() / (n * (n - 1.0).max(1.0))).sqrt()
    }
}

/// Counts the occupied hours by what is known of them.
fn count(calendar: &Calendar, lx: f64, means: &[f64], half_widths: &[f64]) -> HourCounts {
    let mut counts = HourCounts::default();
    for interval in calendar.intervals.iter().filter(|interval| interval.is_occupied) {
        let (mean, half_width) = interval.sky.map_or((0.0, 0.0), |it| (means[it], half_widths[it]));
        let kind = match mean {
            mean if mean - half_width >= lx => &mut counts.above,
            mean if mean + half_width < lx => &mut counts.below,
            _ => &mut counts.undecided,
        };
        *kind += 1;
    }
    counts
}
