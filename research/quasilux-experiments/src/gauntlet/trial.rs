//! One run of one estimator in one room, against the references.

use super::{Room, RoomReferences};
use quasilux_scene::Scene;
use quasilux_transport::interval::t_quantile_for;
use quasilux_transport::{
    Control, Estimates, EstimatorKind, Observer, Progress, Settings, check, simulate,
};
use std::time::{Duration, Instant};

/// Half-width over value that runs go for.
const TOLERANCE: f64 = 0.03;

/// What is run.
#[derive(Clone, Copy)]
pub(super) struct Ask {
    pub(super) estimator: EstimatorKind,
    pub(super) seed: u64,
    pub(super) limit: Duration,
    /// Of each replicate at most.
    pub(super) max_samples: Option<u64>,
}

/// A run.
pub(super) struct Trial {
    pub(super) room: u64,
    pub(super) family: &'static str,
    pub(super) estimator: EstimatorKind,
    pub(super) seed: u64,
    pub(super) result: TrialResult,
}

/// What came of it.
pub(super) enum TrialResult {
    /// The settings mean nothing in this room, and why.
    Refused(String),
    /// It ran.
    Done(Run),
}

/// A run that came to an end.
pub(super) struct Run {
    pub(super) seconds: f64,
    pub(super) samples: u64,
    pub(super) tolerance_reached: bool,
    /// The probability that intervals are to cover the truth with.
    pub(super) confidence: f64,
    pub(super) points: Vec<Point>,
}

/// A sensor point at the end.
pub(super) struct Point {
    pub(super) lx: f64,
    pub(super) reference_lx: f64,
    pub(super) reference_error_lx: f64,
    /// `None` where the point was withdrawn.
    pub(super) interval: Option<Judged>,
}

/// An interval held against the truth.
#[derive(Clone, Copy)]
pub(super) struct Judged {
    pub(super) half_width_lx: f64,
    /// Distance from the reference over the standard error of both together.
    pub(super) sigmas: f64,
    /// Whether the interval, widened by the error of the reference, holds it.
    pub(super) covers: bool,
}

/// Stops a run at its time limit.
struct Watch {
    start: Instant,
    limit: Duration,
}

impl Observer for Watch {
    fn progress(&mut self, progress: &Progress) -> Control {
        // Before the first checkpoint there is nothing to end with.
        if progress.samples > 0 { self.verdict() } else { Control::Continue }
    }

    fn checkpoint(&mut self, _estimates: &Estimates) -> Control {
        self.verdict()
    }
}

impl Watch {
    fn verdict(&self) -> Control {
        if self.start.elapsed() > self.limit { Control::Stop } else { Control::Continue }
    }
}

impl Trial {
    #[expect(clippy::disallowed_methods, reason = "runs have a time limit")]
    pub(super) fn run(room: &Room, scene: &Scene, references: &RoomReferences, ask: &Ask) -> Self {
        let settings = Settings {
            estimator: ask.estimator,
            seed: ask.seed,
            rel_tol: TOLERANCE,
            max_samples: ask.max_samples,
            ..Settings::default()
        };
        let result = match check(scene, &settings) {
            Err(error) => TrialResult::Refused(error.to_string()),
            Ok(()) => {
                let mut watch = Watch { start: Instant::now(), limit: ask.limit };
                let estimates = simulate(scene, &settings, &mut watch);
                let seconds = watch.start.elapsed().as_secs_f64();
                TrialResult::Done(Run::new(&estimates, references, seconds))
            }
        };
        let &Ask { estimator, seed, .. } = ask;
        Self { room: room.number, family: room.family, estimator, seed, result }
    }

    /// The run, if there was one.
    pub(super) fn done(&self) -> Option<&Run> {
        match &self.result {
            TrialResult::Done(run) => Some(run),
            TrialResult::Refused(_) => None,
        }
    }
}

impl Run {
    fn new(estimates: &Estimates, references: &RoomReferences, seconds: f64) -> Self {
        let replicates = estimates.sensors[0].replicate_lx.len();
        let t = t_quantile_for(replicates, estimates.miss_probability).unwrap_or(f64::NAN);
        let intervals = estimates.point_intervals(0);
        let point = |(interval, reference): (_, &super::Reference)| {
            let quasilux_transport::Interval { value, half_width } = interval;
            let distance = (value - reference.lx).abs();
            let error = reference.standard_error_lx;
            let judged = |half_width_lx: f64| {
                let own = half_width_lx / t;
                let both = (own * own + error * error).sqrt();
                // Where nothing is drawn, rounding is all the error.
                let sigmas = distance / both.max(1e-6 * reference.lx);
                Judged { half_width_lx, sigmas, covers: sigmas <= t }
            };
            Point {
                lx: value,
                reference_lx: reference.lx,
                reference_error_lx: error,
                interval: half_width.map(judged),
            }
        };
        Self {
            seconds,
            samples: estimates.samples,
            tolerance_reached: estimates.tolerance_reached,
            confidence: estimates.confidence,
            points: intervals.into_iter().zip(&references.points).map(point).collect(),
        }
    }
}
