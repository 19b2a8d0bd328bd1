//! One run: its intervals at the first checkpoint and where it stops, against the truth.

use super::count::{Figure, Moment};
use super::known_scene::KnownScene;
use quasilux_transport::{
    Control, Estimates, Interval, Observer, PointOfYear, Settings, YearHours, YearRun, simulate,
    simulate_year,
};

/// Paths at the first look at hours.
const FIRST_OF_HOURS: u64 = 128;

/// Errors over half-widths of all figures, in the order of [`Figure::all`].
pub(super) struct Trial {
    fixed: End,
    stop: End,
}

/// What is known at a moment.
struct End {
    /// Indices per replicate behind each figure: a point that is done gets no more.
    samples: Vec<u64>,
    errors: Vec<f64>,
}

/// Keeps what is known at the first checkpoint.
#[derive(Default)]
struct First(Option<Estimates>);

impl Observer for First {
    fn checkpoint(&mut self, estimates: &Estimates) -> Control {
        self.0.get_or_insert_with(|| estimates.clone());
        Control::Continue
    }
}

impl Trial {
    pub(super) fn run(known: &KnownScene, settings: &Settings) -> Self {
        if !known.hours.is_empty() {
            let first =
                Settings { rel_tol: 0.0, max_samples: Some(FIRST_OF_HOURS), ..settings.clone() };
            return Self { fixed: hours(known, &first), stop: hours(known, settings) };
        }
        let mut first = First::default();
        let stopped = simulate(&known.scene, settings, &mut first);
        let end = |mut estimates: Estimates, moment: Moment| {
            if moment == Moment::Fixed {
                // No run stops here, so the interval need not pay for looks.
                estimates.miss_probability = 1.0 - estimates.confidence;
            }
            End { samples: samples(&estimates), errors: errors(known, &estimates) }
        };
        let first = first.0.unwrap_or_else(|| stopped.clone());
        Self { fixed: end(first, Moment::Fixed), stop: end(stopped, Moment::Stop) }
    }

    /// Distance from the truth over half-width.
    pub(super) fn error(&self, moment: Moment, figure: Figure) -> f64 {
        figure.pick(&self.end(moment).errors)
    }

    /// Indices per replicate.
    pub(super) fn samples(&self, moment: Moment, figure: Figure) -> u64 {
        figure.pick(&self.end(moment).samples)
    }

    fn end(&self, moment: Moment) -> &End {
        match moment {
            Moment::Fixed => &self.fixed,
            Moment::Stop => &self.stop,
        }
    }
}

/// Of figures of all points, those of the run.
fn samples(estimates: &Estimates) -> Vec<u64> {
    let of_points = estimates.sensors[0].samples.iter().copied();
    of_points.chain([estimates.samples; 2]).collect()
}

fn errors(known: &KnownScene, estimates: &Estimates) -> Vec<f64> {
    let points = estimates.point_intervals(0);
    errors_of(known, points, [estimates.average(0), estimates.minimum(0)])
}

/// Of points, average and minimum.
fn errors_of(known: &KnownScene, points: Vec<Interval>, all: [Interval; 2]) -> Vec<f64> {
    let truth_lx = &known.truth_lx;
    let average_lx = truth_lx.iter().sum::<f64>() / truth_lx.len() as f64;
    let minimum_lx = truth_lx.iter().copied().fold(f64::INFINITY, f64::min);
    let truth_lx = truth_lx.iter().copied().chain([average_lx, minimum_lx]);
    let error = |(interval, truth_lx): (Interval, f64)| {
        let half_width = interval.half_width.unwrap_or(f64::NAN);
        (interval.value - truth_lx).abs() / half_width
    };
    points.into_iter().chain(all).zip(truth_lx).map(error).collect()
}

/// A run over hours: each of a point is a point, and the least of them, far below the others, the
/// minimum.
fn hours(known: &KnownScene, settings: &Settings) -> End {
    let year = YearHours { skies: &known.hours, other_rooms: &[] };
    let mut points: Vec<PointOfYear> = Vec::new();
    let run = YearRun {
        scene: &known.scene,
        hours: year,
        points: 0..usize::MAX,
        settings,
        digest: &|it| it,
        goes_on: &|_| true,
    };
    simulate_year(run, &mut points);
    let hours = known.hours.len();
    let all: Vec<Interval> = points.iter().flat_map(PointOfYear::intervals_lx).collect();
    let mean = |replicate: usize| {
        let values = points.iter().flat_map(|point| &point.illuminance_lx[replicate]);
        values.map(|lx| f64::from(*lx)).sum::<f64>() / all.len() as f64
    };
    let t = points.first().and_then(PointOfYear::t);
    let average = Interval::of_mean((0..settings.replicates as usize).map(mean), t);
    let least = all.iter().copied().min_by(|a, b| a.value.total_cmp(&b.value));
    let least = least.expect("a scene with hours has points");
    let most = points.iter().map(|point| point.samples).max().unwrap_or_default();
    let samples = points.iter().flat_map(|point| vec![point.samples; hours]);
    End {
        samples: samples.chain([most; 2]).collect(),
        errors: errors_of(known, all, [average, least]),
    }
}
