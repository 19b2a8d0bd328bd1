//! Totals of single indices, and means over scrambled nets, to draw runs from.

use super::rooms::Room;
use quasilux_sampling::{PointSet, Randomization, Sequence};
use quasilux_transport::unseen::UNSEEN_CONFIDENCE;
use quasilux_transport::{IntervalKind, Settings, simulate};

/// Replicates of one index, of 16 and of 256.
const TRIALS: u32 = 1 << 16;
const NETS: u32 = 1 << 12;
const LARGE_NETS: u32 = 1 << 10;
/// Indices of nets.
pub(super) const OF_A_NET: u64 = 16;
pub(super) const OF_A_LARGE_NET: u64 = 256;

/// Values in lx.
pub(super) struct Values {
    values: Vec<f64>,
    pub(super) mean: f64,
}

/// What runs in a room are drawn from.
pub(super) struct Pool {
    pub(super) room: &'static str,
    pub(super) what: &'static str,
    /// Of independent indices.
    pub(super) trials: Values,
    /// Means over nets of Sobol' points.
    pub(super) nets: Values,
    pub(super) large_nets: Values,
    /// K W, the most that an index is expected to add where it adds anything, in lx.
    pub(super) range_lx: f64,
    /// B of certified intervals in lx; infinite where there is none.
    pub(super) most_lx: f64,
}

impl Values {
    fn new(values: Vec<f64>) -> Self {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        Self { values, mean }
    }

    /// This many of them, by chance: those of a run.
    pub(super) fn draw(&self, run: u32, count: usize) -> Vec<f64> {
        let uniforms = PointSet::new(Sequence::Independent, Randomization::None, u64::from(run));
        let n = self.values.len();
        let one = |number: u64| {
            let place = (uniforms.coordinate(number, 0) * n as f64) as usize;
            self.values[place.min(n - 1)]
        };
        (0..count as u64).map(one).collect()
    }

    pub(super) fn all(&self) -> &[f64] {
        &self.values
    }

    /// The largest.
    pub(super) fn most(&self) -> f64 {
        self.values.iter().copied().fold(0.0, f64::max)
    }
}

impl Pool {
    /// Light that no sample of this many indices met, at most, over the truth.
    pub(super) fn unseen_share(&self, indices: usize) -> f64 {
        rule_of_three() * self.range_lx / (indices as f64 * self.trials.mean)
    }

    pub(super) fn new(room: &Room, seed: u64) -> Self {
        Self::with_part(room, seed, 1)
    }

    /// A sixteenth of it.
    #[cfg(test)]
    pub(super) fn small(room: &Room, seed: u64) -> Self {
        Self::with_part(room, seed, 16)
    }

    fn with_part(room: &Room, seed: u64, part: u32) -> Self {
        let settings = |sequence, replicates: u32, samples| Settings {
            sequence,
            replicates: replicates / part,
            max_samples: Some(samples),
            rel_tol: 0.0,
            seed,
            interval: IntervalKind::Certified,
            ..Settings::default()
        };
        let found = |settings: &Settings| simulate(&room.scene, settings, &mut ());
        let values = |settings: &Settings| {
            let replicates = found(settings).sensors.swap_remove(0).replicate_lx;
            Values::new(replicates.iter().map(|row| row[0]).collect())
        };
        let single = settings(Sequence::Independent, TRIALS, 1);
        let mut estimates = found(&single);
        let sensor = estimates.sensors.swap_remove(0);
        let unseen = sensor.unseen.expect("the default estimator has bounds");
        let trials = sensor.replicate_lx.len() as f64;
        Self {
            room: room.name,
            what: room.what,
            trials: Values::new(sensor.replicate_lx.iter().map(|row| row[0]).collect()),
            nets: values(&settings(Sequence::Sobol, NETS, OF_A_NET)),
            large_nets: values(&settings(Sequence::Sobol, LARGE_NETS, OF_A_LARGE_NET)),
            range_lx: unseen.point_lx[0] * trials / rule_of_three(),
            most_lx: unseen.totals.expect("they were asked for").most_lx[0],
        }
    }
}

/// Expected samples in a set of paths that is left without any with a probability of 5 %.
fn rule_of_three() -> f64 {
    -libm::log(1.0 - UNSEEN_CONFIDENCE)
}
