//! What a run knows at each of its checkpoints, and when: one run gives the errors of all smaller
//! ones.
//!
//! Replicates are independent randomisations, so that the spread of a run's replicates at a
//! checkpoint is the error of a single run of that many samples. Its time is that of the whole over
//! the number of replicates, all threads at work.

use quasilux_scene::Scene;
use quasilux_transport::interval::t_quantile_for;
use quasilux_transport::{Control, Estimates, Interval, Observer, Settings, simulate};
use std::time::{Duration, Instant};

/// A run up to its largest number of samples.
pub(super) struct Course {
    pub(super) snapshots: Vec<Snapshot>,
}

/// A checkpoint.
pub(super) struct Snapshot {
    /// Indices per replicate.
    pub(super) samples: u64,
    /// Time per replicate, from the start of the run.
    pub(super) seconds: f64,
    /// Rays per replicate.
    pub(super) rays: f64,
    pub(super) estimates: Estimates,
}

struct Watch {
    start: Instant,
    limit: Option<Duration>,
    replicates: f64,
    snapshots: Vec<Snapshot>,
}

impl Course {
    /// Runs to `max_samples` whatever the tolerance, or up to the checkpoint before the one that
    /// would come after the limit: the number of samples doubles from one to the next.
    #[expect(clippy::disallowed_methods, reason = "errors are shown against time")]
    pub(super) fn run(scene: &Scene, settings: &Settings, limit: Option<Duration>) -> Self {
        let settings = Settings { rel_tol: 0.0, abs_tol_lx: 0.0, ..settings.clone() };
        let replicates = f64::from(settings.effective_replicates());
        let mut watch = Watch { start: Instant::now(), limit, replicates, snapshots: Vec::new() };
        // All that is known at its end was known at the last checkpoint.
        let _ = simulate(scene, &settings, &mut watch);
        Self { snapshots: watch.snapshots }
    }

    pub(super) fn last(&self) -> &Snapshot {
        self.snapshots.last().expect("a run has a checkpoint")
    }
}

/// The 95 % interval of the mean of values from independent randomisations.
pub(super) fn mean_interval(values: &[f64]) -> Interval {
    let n = values.len() as f64;
    let value = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|x| (x - value) * (x - value)).sum();
    let t = t_quantile_for(values.len(), 0.05);
    Interval { value, half_width: t.map(|t| t * (squares / (n * (n - 1.0))).sqrt()) }
}

impl Observer for Watch {
    fn checkpoint(&mut self, estimates: &Estimates) -> Control {
        let elapsed = self.start.elapsed();
        self.snapshots.push(Snapshot {
            samples: estimates.samples,
            seconds: elapsed.as_secs_f64() / self.replicates,
            rays: estimates.rays as f64 / self.replicates,
            estimates: estimates.clone(),
        });
        match self.limit {
            Some(limit) if 2 * elapsed > limit => Control::Stop,
            _ => Control::Continue,
        }
    }
}
