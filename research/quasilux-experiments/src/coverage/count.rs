//! How often one interval covers the truth, and whether that is often enough.

use quasilux_sampling::Sequence;
use std::collections::BTreeMap;

/// A coverage between these is what is promised; of a minimum, the first is, since its interval
/// allows for any other of the points to be the least.
const PROMISED: [f64; 2] = [0.935, 0.965];
/// The probability that any of the counts fails though all coverages are as promised.
const SIGNIFICANCE: f64 = 0.01;

/// Where more runs than this share stop at the same look, stopping is not tested.
const MAX_AT_ONE_LOOK: f64 = 0.9;

/// When the interval is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Moment {
    /// After a fixed number of samples.
    Fixed,
    /// Where the run stops by itself.
    Stop,
}

/// What the interval is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Figure {
    /// The illuminance at one point.
    Point(usize),
    /// The average of the sensor.
    Average,
    /// Its minimum.
    Minimum,
}

/// The intervals of one figure in all runs of a setup.
pub(super) struct Count {
    pub(super) scene: &'static str,
    pub(super) sequence: Sequence,
    pub(super) moment: Moment,
    pub(super) figure: Figure,
    /// Distance from the truth over half-width; not a number where there is no interval.
    pub(super) errors: Vec<f64>,
    /// Indices per replicate that each interval is from.
    pub(super) samples: Vec<u64>,
}

/// What the test says of all counts.
pub(super) struct Verdict {
    /// Of each count, how probable it or a worse one is at the nearest coverage that is promised.
    pub(super) p_values: Vec<f64>,
    level: f64,
}

impl Moment {
    pub(super) const ALL: [Self; 2] = [Self::Fixed, Self::Stop];

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Fixed => "fixed N",
            Self::Stop => "at the stop",
        }
    }
}

impl Figure {
    /// Those of a sensor with this many points.
    pub(super) fn all(points: usize) -> impl Iterator<Item = Self> {
        (0..points).map(Self::Point).chain([Self::Average, Self::Minimum])
    }

    /// Its own of values of all figures, in the order of [`Figure::all`].
    pub(super) fn pick<T: Copy>(self, values: &[T]) -> T {
        let points = values.len() - 2;
        values[match self {
            Self::Point(number) => number,
            Self::Average => points,
            Self::Minimum => points + 1,
        }]
    }

    /// The least and the most coverage that is promised.
    fn promised(self) -> [f64; 2] {
        let [least, most] = PROMISED;
        [least, if self == Self::Minimum { 1.0 } else { most }]
    }

    pub(super) fn name(self) -> String {
        match self {
            Self::Point(number) => format!("point {number}"),
            Self::Average => "average".to_owned(),
            Self::Minimum => "minimum".to_owned(),
        }
    }
}

impl Count {
    /// Numbers of indices per replicate, each with how many intervals have it, from the fewest on.
    pub(super) fn ends(&self) -> BTreeMap<u64, usize> {
        let mut ends = BTreeMap::new();
        for &samples in &self.samples {
            *ends.entry(samples).or_insert(0) += 1;
        }
        ends
    }

    /// The share of the commonest of them.
    pub(super) fn commonest_end(&self) -> f64 {
        let most = self.ends().into_values().max().unwrap_or(0);
        most as f64 / self.samples.len() as f64
    }

    /// Whether runs stop at several looks.
    pub(super) fn has_looks(&self) -> bool {
        self.commonest_end() <= MAX_AT_ONE_LOOK
    }

    /// Runs in which intervals of `scale` times the width cover the truth.
    pub(super) fn covered(&self, scale: f64) -> usize {
        self.errors.iter().filter(|error| **error <= scale).count()
    }

    /// The share of them.
    pub(super) fn coverage(&self, scale: f64) -> f64 {
        self.covered(scale) as f64 / self.errors.len() as f64
    }

    /// Whether it says where runs stop.
    pub(super) fn is_of_runs(&self) -> bool {
        self.moment == Moment::Stop && self.figure == Figure::Average
    }

    /// What it counts, in words.
    pub(super) fn label(&self) -> String {
        let (scene, figure) = (self.scene, self.figure.name());
        let (sequence, moment) = (self.sequence.name(), self.moment.name());
        format!("{scene}, {figure}, {sequence}, {moment}: {:.4}", self.coverage(1.0))
    }
}

impl Verdict {
    /// Judges intervals of `scale` times the width.
    pub(super) fn new(counts: &[Count], scale: f64) -> Self {
        let p_value = |count: &Count| {
            p_value(count.covered(scale), count.errors.len(), count.figure.promised())
        };
        let tests = counts.len().max(1) as f64;
        Self {
            p_values: counts.iter().map(p_value).collect(),
            level: -libm::expm1(libm::log1p(-SIGNIFICANCE) / tests),
        }
    }

    pub(super) fn fails(&self, number: usize) -> bool {
        self.p_values[number] < self.level
    }

    pub(super) fn failed(&self) -> usize {
        (0..self.p_values.len()).filter(|&number| self.fails(number)).count()
    }

    /// The counts that fail.
    pub(super) fn failures<'c>(&self, counts: &'c [Count]) -> impl Iterator<Item = &'c Count> {
        counts.iter().enumerate().filter(|(number, _)| self.fails(*number)).map(|(_, count)| count)
    }
}

/// The probability of this many covered runs or a worse number, at the nearest promised coverage.
fn p_value(covered: usize, runs: usize, [least, most]: [f64; 2]) -> f64 {
    let share = covered as f64 / runs as f64;
    if share < least {
        lower_tail(covered, runs, least)
    } else if share > most {
        lower_tail(runs - covered, runs, 1.0 - most)
    } else {
        1.0
    }
}

/// P(X <= k), X binomial with n trials of probability p.
fn lower_tail(k: usize, n: usize, p: f64) -> f64 {
    let factorial = |k: usize| libm::lgamma(k as f64 + 1.0);
    let probability = |i: usize| {
        let ways = factorial(n) - factorial(i) - factorial(n - i);
        libm::exp(ways + i as f64 * libm::log(p) + (n - i) as f64 * libm::log1p(-p))
    };
    (0..=k).map(probability).sum::<f64>().min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tails_of_binomials_are_exact() {
        // Of four fair coins: one of sixteen shows none, five show at most one.
        assert!((lower_tail(0, 4, 0.5) - 1.0 / 16.0).abs() < 1e-12);
        assert!((lower_tail(1, 4, 0.5) - 5.0 / 16.0).abs() < 1e-12);
        assert!((lower_tail(2000, 2000, 0.935) - 1.0).abs() < 1e-9);
    }

    #[test]
    fn what_is_promised_passes_and_what_is_far_from_it_fails() {
        let [average, minimum] = [Figure::Average, Figure::Minimum].map(Figure::promised);
        assert_eq!(p_value(1900, 2000, average), 1.0);
        assert!(p_value(1800, 2000, average) < 1e-7 && p_value(1980, 2000, average) < 1e-5);
        assert!(p_value(1860, 2000, average) > 0.05);
        assert_eq!(p_value(1980, 2000, minimum), 1.0);
        assert!(p_value(1800, 2000, minimum) < 1e-7);
    }
}
