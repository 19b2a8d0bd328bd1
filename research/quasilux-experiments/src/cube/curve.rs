//! One way, run: its errors in all replicates at each checkpoint, and what they took.

use super::bias::Bias;
use super::setup::{Points, Setup};
use super::task::Task;
use crate::course::{Course, Snapshot};
use crate::timing::{SHORT_RAYS, seconds_of_a_ray};
use quasilux_sampling::quality::fit_power_law;
use quasilux_transport::Estimates;
use std::time::{Duration, Instant};

/// What one way did.
pub(super) struct Curve {
    pub(super) setup: Setup,
    pub(super) looks: Vec<Look>,
    /// At the last checkpoint.
    pub(super) last: Estimates,
}

/// One checkpoint.
pub(super) struct Look {
    /// See [`super::setup::Form::n`].
    pub(super) n: u64,
    /// Paths from each place in a replicate.
    pub(super) paths: u64,
    /// Of a replicate, so far.
    pub(super) cost: Cost,
    /// Of each replicate: the L2 norm of the error over all places, over that of the truth.
    pub(super) errors: Vec<f64>,
    /// The same of the distance from the mean of all replicates: what is noise, and no floor.
    pub(super) spreads: Vec<f64>,
    /// What would be left of them after very many replicates.
    pub(super) bias: Bias,
}

/// What a replicate took: a share of what all took together.
#[derive(Clone, Copy)]
pub(super) struct Cost {
    pub(super) rays: f64,
    pub(super) seconds: f64,
}

/// In what cost is counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Currency {
    /// For tests, whose outcome may not depend on the machine.
    #[cfg_attr(not(test), expect(dead_code, reason = "for tests alone"))]
    Rays,
    Seconds,
}

impl Curve {
    /// Runs a way up to the largest N or the limit of time, whichever comes first.
    pub(super) fn run(setup: Setup, task: &Task) -> Self {
        let scene = task.places.scene();
        let most = setup.form.samples(task.most);
        let snapshots = |samples: u64, limit: Option<Duration>| {
            let settings = setup.settings(samples, task.replicates, task.seed);
            Course::run(&scene, &settings, limit).snapshots
        };
        if setup.points != Points::Hammersley {
            return Self::new(setup, snapshots(most, task.limit), task);
        }
        // These need their number ahead: each N is a run of its own, of which only the end counts.
        let (mut ends, mut samples) = (Vec::new(), most.min(16));
        loop {
            let start = now();
            ends.extend(snapshots(samples, None).pop());
            let is_over = task.limit.is_some_and(|limit| 4 * start.elapsed() > limit);
            if samples == most || is_over {
                return Self::new(setup, ends, task);
            }
            samples = (4 * samples).min(most);
        }
    }

    fn new(setup: Setup, mut snapshots: Vec<Snapshot>, task: &Task) -> Self {
        let looks = snapshots.iter().map(|snapshot| Look::new(setup, snapshot, task)).collect();
        let last = snapshots.pop().expect("a run has a checkpoint").estimates;
        Self { setup, looks, last }
    }

    /// Times the curves: from what a ray of each takes follows what all checkpoints take.
    pub(super) fn time(curves: &mut [Self], task: &Task) {
        let of_a_ray = seconds_of_a_ray(curves.len(), |k| curves[k].seconds_of_a_ray(task));
        for (curve, seconds) in curves.iter_mut().zip(of_a_ray) {
            for look in &mut curve.looks {
                look.cost.seconds = seconds * look.cost.rays;
            }
        }
    }

    /// By one short run.
    fn seconds_of_a_ray(&self, task: &Task) -> f64 {
        let is_short = |look: &&Look| look.cost.rays * f64::from(task.replicates) <= SHORT_RAYS;
        let look = self.looks.iter().rfind(is_short).unwrap_or(&self.looks[0]);
        let task = Task { most: look.n, limit: None, ..task.clone() };
        let Cost { rays, seconds } = Self::run(self.setup, &task).end().cost;
        seconds / rays
    }

    /// (N, root mean square of the errors over the replicates).
    pub(super) fn by_n(&self) -> Vec<[f64; 2]> {
        self.looks.iter().map(|look| [look.n as f64, look.rms()]).collect()
    }

    /// The same by cost.
    pub(super) fn by_cost(&self, currency: Currency) -> Vec<[f64; 2]> {
        self.looks.iter().map(|look| [look.cost.in_currency(currency), look.rms()]).collect()
    }

    /// The order of convergence of errors or spreads, of no more than this N.
    pub(super) fn slope(&self, most: u64, of_look: fn(&Look) -> &[f64]) -> Option<f64> {
        let fitted = self.looks.iter().filter(|look| look.n <= most);
        let points: Vec<[f64; 2]> =
            fitted.map(|look| [look.n as f64, root_mean_square(of_look(look))]).collect();
        fit_power_law(&points).map(|law| law.exponent)
    }

    /// Errors or spreads of all replicates at a cost, on straight lines in logarithms between
    /// checkpoints; `None` before the first and after the last.
    pub(super) fn at(
        &self,
        cost: f64,
        currency: Currency,
        of_look: fn(&Look) -> &[f64],
    ) -> Option<Vec<f64>> {
        let of = |look: &Look| libm::log(look.cost.in_currency(currency));
        let cost = libm::log(cost);
        let pair =
            self.looks.windows(2).find(|pair| of(&pair[0]) <= cost && cost <= of(&pair[1]))?;
        let share = (cost - of(&pair[0])) / (of(&pair[1]) - of(&pair[0]));
        let between =
            |(a, b): (&f64, &f64)| libm::exp((1.0 - share) * libm::log(*a) + share * libm::log(*b));
        Some(of_look(&pair[0]).iter().zip(of_look(&pair[1])).map(between).collect())
    }

    /// The checkpoint at this N.
    pub(super) fn look(&self, n: u64) -> Option<&Look> {
        self.looks.iter().find(|look| look.n == n)
    }

    pub(super) fn end(&self) -> &Look {
        self.looks.last().expect("a run has a checkpoint at least")
    }
}

impl Look {
    fn new(setup: Setup, snapshot: &Snapshot, task: &Task) -> Self {
        let rows = &snapshot.estimates.sensors[0].replicate_lx;
        let replicates = rows.len() as f64;
        let mean_of = |place: usize| rows.iter().map(|row| row[place]).sum::<f64>() / replicates;
        let mean: Vec<f64> = (0..rows[0].len()).map(mean_of).collect();
        let scale = (replicates / (replicates - 1.0)).sqrt();
        Self {
            n: setup.form.n(snapshot.samples),
            paths: setup.form.paths(snapshot.samples),
            cost: Cost { rays: snapshot.rays, seconds: snapshot.seconds },
            errors: rows.iter().map(|row| distance(row, &task.truth_lx, task)).collect(),
            spreads: rows.iter().map(|row| scale * distance(row, &mean, task)).collect(),
            bias: Bias::new(rows, task),
        }
    }

    /// Standard deviation of the logarithm of a single run's error.
    pub(super) fn scatter(&self) -> f64 {
        let n = self.errors.len() as f64;
        let mean = self.errors.iter().map(|error| libm::log(*error)).sum::<f64>() / n;
        let square = |error: &f64| (libm::log(*error) - mean) * (libm::log(*error) - mean);
        (self.errors.iter().map(square).sum::<f64>() / (n - 1.0)).sqrt()
    }

    pub(super) fn rms(&self) -> f64 {
        root_mean_square(&self.errors)
    }
}

impl Currency {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Rays => "rays",
            Self::Seconds => "time",
        }
    }
}

impl Cost {
    pub(super) fn in_currency(self, currency: Currency) -> f64 {
        match currency {
            Currency::Rays => self.rays,
            Currency::Seconds => self.seconds,
        }
    }
}

pub(super) fn root_mean_square(values: &[f64]) -> f64 {
    (values.iter().map(|x| x * x).sum::<f64>() / values.len() as f64).sqrt()
}

#[expect(clippy::disallowed_methods, reason = "errors are shown against time")]
fn now() -> Instant {
    Instant::now()
}

/// The L2 norm of the distance over that of the truth.
fn distance(row: &[f64], from: &[f64], task: &Task) -> f64 {
    let (mut squares, mut truth_squares) = (0.0, 0.0);
    for (((value, from), truth), place) in
        row.iter().zip(from).zip(&task.truth_lx).zip(task.places.iter())
    {
        squares += place.weight * (value - from) * (value - from);
        truth_squares += place.weight * truth * truth;
    }
    (squares / truth_squares).sqrt()
}
