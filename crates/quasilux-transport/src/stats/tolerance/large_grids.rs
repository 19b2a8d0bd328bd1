//! Points that end one by one where light is rare, and what that does to the figures of all.

use super::Standing;
use crate::settings::Settings;
use crate::stats::estimates::{Estimates, SensorEstimates};
use crate::stats::interval::Interval;
use crate::stats::point_status::Evidence;
use crate::stats::schedule::Schedule;
use crate::stats::sequential::miss_probability_of_a_look;
use quasilux_sampling::{PointSet, Randomization, Sequence};

const POINTS: usize = 400;
const REPLICATES: usize = 16;
/// One sample in 50 meets the light, which all of them are in truth 1 lx of.
const RATE: f64 = 0.02;
const RUNS: u32 = 250;

/// A made-up run of independent samples.
struct Run {
    points: PointSet,
    drawn: u64,
    /// Samples that met the light, by replicate and point.
    hits: Vec<Vec<f64>>,
    samples: Vec<u64>,
}

impl Run {
    fn new(number: u32) -> Self {
        Self {
            points: PointSet::new(Sequence::Independent, Randomization::None, number.into()),
            drawn: 0,
            hits: vec![vec![0.0; POINTS]; REPLICATES],
            samples: vec![0; POINTS],
        }
    }

    /// A Poisson number, by inversion.
    fn poisson(&mut self, mean: f64) -> f64 {
        let u = self.points.coordinate(self.drawn, 0);
        self.drawn += 1;
        let (mut count, mut probability, mut sum) = (0.0, libm::exp(-mean), libm::exp(-mean));
        while sum < u && count < 10.0 * mean + 20.0 {
            count += 1.0;
            probability *= mean / count;
            sum += probability;
        }
        count
    }

    fn advance(&mut self, samples: u64, ended: &[bool]) {
        for point in (0..POINTS).filter(|point| !ended[*point]) {
            let more = RATE * (samples - self.samples[point]) as f64;
            for replicate in 0..REPLICATES {
                self.hits[replicate][point] += self.poisson(more);
            }
            self.samples[point] = samples;
        }
    }

    fn estimates(&self, samples: u64, miss_probability: f64) -> Estimates {
        let row = |hits: &Vec<f64>| {
            hits.iter().zip(&self.samples).map(|(hits, n)| hits / (RATE * *n as f64)).collect()
        };
        let sensor = SensorEstimates {
            replicate_lx: self.hits.iter().map(row).collect(),
            direct_lx: vec![0.0; POINTS],
            evidence: vec![Evidence::Sound; POINTS],
            samples: self.samples.clone(),
            average: None,
            terms: Vec::new(),
            unseen: None,
        };
        Estimates { sensors: vec![sensor], samples, miss_probability, ..Estimates::default() }
    }

    /// Last estimates of a run whose points end as they are known well enough.
    fn end(mut self) -> Estimates {
        let settings = Settings { rel_tol: 0.1, ..Settings::default() };
        let miss_probability = miss_probability_of_a_look(0.05, REPLICATES as u32);
        let mut schedule = Schedule::new(64, Some(4096));
        let mut ended = vec![false; POINTS];
        let mut before: Option<Estimates> = None;
        loop {
            self.advance(schedule.next_checkpoint(), &ended);
            let mut now = self.estimates(schedule.next_checkpoint(), miss_probability);
            if let Some(before) = &before {
                now.sensors[0].keep_average(&before.sensors[0]);
            }
            let standing = Standing::new(&now, &settings);
            if schedule.is_look() {
                ended = standing.done;
            }
            if !schedule.advance() {
                return now;
            }
            before = Some(now);
        }
    }
}

/// How far values are from the truth in standard errors, over many runs.
#[derive(Default)]
struct Errors {
    sum: f64,
    covered: f64,
}

impl Errors {
    fn add(&mut self, interval: Interval, truth: f64) {
        let half_width = interval.half_width.unwrap();
        self.sum += (interval.value - truth) / half_width;
        self.covered += f64::from((interval.value - truth).abs() <= half_width) / f64::from(RUNS);
    }

    /// The mean error in half-widths.
    fn mean(&self) -> f64 {
        self.sum / f64::from(RUNS)
    }
}

/// Half-widths are 2.3 standard errors, so a mean over 250 runs is known to 0.03 of them.
#[test]
fn averages_are_right_where_points_end_one_by_one() {
    let [mut average, mut of_ends, mut minimum, mut uniformity] =
        std::array::from_fn(|_| Errors::default());
    for run in 0..RUNS {
        let estimates = Run::new(run).end();
        average.add(estimates.average(0), 1.0);
        let mean = |lx: &[f64]| lx.iter().sum::<f64>() / lx.len() as f64;
        of_ends.add(estimates.interval_of(0, mean), 1.0);
        minimum.add(estimates.minimum(0), 1.0);
        uniformity.add(estimates.uniformity(0), 1.0);
    }
    assert!(average.mean().abs() < 0.1, "{}", average.mean());
    assert!((0.92..=0.99).contains(&average.covered), "{}", average.covered);
    assert!(minimum.covered >= 0.92, "{}", minimum.covered);
    assert!(uniformity.covered >= 0.92, "{}", uniformity.covered);
    assert!(of_ends.mean().abs() > 0.3, "the test has lost its power: {}", of_ends.mean());
}
