//! What a run over a year finds.

use crate::settings::Settings;
use crate::stats::interval::{Interval, t_quantile_for};
use crate::stats::sequential::Stopping;

/// Illuminances of one sensor point by the hour, in all replicates.
#[derive(Clone, Debug)]
pub struct PointOfYear {
    /// The number of the point, through all sensors.
    pub number: usize,
    /// Illuminances in lx by replicate and hour, in the order of the hours that were given.
    pub illuminance_lx: Vec<Vec<f32>>,
    /// Illuminances in lx straight from the sun with the blinds open, whether they are or not, by
    /// replicate and hour.
    pub sun_lx: Vec<Vec<f32>>,
    /// Skylight in lx, hour by hour, that may come by ways on which no path lay, at most, with
    /// [`UNSEEN_CONFIDENCE`](crate::unseen::UNSEEN_CONFIDENCE).
    pub unseen_lx: Vec<f32>,
    /// Paths in each replicate, of all states of the blinds.
    pub samples: u64,
    /// The root mean square over hours of half-width over value; `None` with fewer than two
    /// replicates.
    pub relative_half_width: Option<f64>,
    /// Whether that is within the tolerance.
    pub is_done: bool,
    /// Contributions that could not be added.
    pub invalid: u64,
    /// Of the intervals that the point was judged by: less than what remains to the confidence of
    /// the settings where looks had a choice, which makes up for it.
    pub miss_probability: f64,
}

/// How far a run is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct YearProgress {
    /// Points before this number are over.
    pub over: usize,
    /// Up to which number they are simulated.
    pub of: usize,
    /// Work so far.
    pub work: YearWork,
}

/// Counts of the work of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct YearWork {
    /// Rays of all kinds.
    pub rays: u64,
    /// Paths of all points in all replicates.
    pub paths: u64,
    /// Whether it came to its end.
    pub is_complete: bool,
}

impl PointOfYear {
    /// A point of which nothing is known yet.
    pub(super) fn blank(number: usize, settings: &Settings, hours: usize) -> Self {
        let none = vec![vec![0.0; hours]; settings.effective_replicates() as usize];
        Self {
            number,
            illuminance_lx: none.clone(),
            sun_lx: none,
            unseen_lx: vec![0.0; hours],
            samples: 0,
            relative_half_width: Some(0.0),
            is_done: true,
            invalid: 0,
            miss_probability: Stopping::new(settings).miss_probability,
        }
    }

    /// Half-width over standard error of what replicates say; `None` of fewer than two.
    #[must_use]
    pub fn t(&self) -> Option<f64> {
        t_quantile_for(self.illuminance_lx.len(), self.miss_probability)
    }

    /// The hours in lx. Where all replicates found nothing, `unseen_lx` is the half-width.
    #[must_use]
    pub fn intervals_lx(&self) -> Vec<Interval> {
        intervals_lx(&self.illuminance_lx, &self.unseen_lx, self.t())
    }
}

/// The hours that replicates have in lx, with what may come by ways on which no path lay.
pub(super) fn intervals_lx(
    by_replicate: &[Vec<f32>],
    unseen_lx: &[f32],
    t: Option<f64>,
) -> Vec<Interval> {
    let of_hour = |(hour, unseen_lx): (usize, &f32)| {
        let values = by_replicate.iter().map(|values| f64::from(values[hour]));
        Interval::of_mean(values, t).or_unseen(f64::from(*unseen_lx))
    };
    unseen_lx.iter().enumerate().map(of_hour).collect()
}
