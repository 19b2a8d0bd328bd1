//! One run: its intervals at the first checkpoint and where it stops, against the truth.

use super::count::{Figure, Moment};
use super::scenes::KnownScene;
use quasilux_transport::{Control, Estimates, Interval, Observer, Settings, simulate};

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
    let truth_lx = &known.truth_lx;
    let average_lx = truth_lx.iter().sum::<f64>() / truth_lx.len() as f64;
    let minimum_lx = truth_lx.iter().copied().fold(f64::INFINITY, f64::min);
    let error = |interval: Interval, truth_lx: f64| {
        let half_width = interval.half_width.unwrap_or(f64::NAN);
        (interval.value - truth_lx).abs() / half_width
    };
    let points = estimates.point_intervals(0);
    let of_points =
        points.into_iter().zip(truth_lx).map(|(point, truth_lx)| error(point, *truth_lx));
    of_points
        .chain([error(estimates.average(0), average_lx), error(estimates.minimum(0), minimum_lx)])
        .collect()
}
