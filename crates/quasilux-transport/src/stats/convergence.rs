//! How fast half-widths shrink, and what that predicts.
//!
//! Half-widths of independent samples shrink like N^(-1/2); those of quasi-random points faster, as
//! far as the values let them. The exponent is measured while a run goes. Points that are done get
//! no more samples, so half-widths are compared from one checkpoint to the next, over the points
//! that grew, and the ratios chained:
//!
//! ```text
//! y_0 = 0,   y_(k+1) = y_k + mean( ln h_(k+1) - ln h_k ) + 1/2 luck_k,   h half-width over value
//! ```
//!
//! The slope is that of the line through (ln N_k, y_k) with the least squares. The chain begins
//! where half-widths can be compared: there are none before anything is found.
//!
//! A half-width from R replicates has a logarithm with the variance v = 1 / (2 (R - 1)), so few
//! checkpoints tell little of a slope: its variance is s^2 = v / sum (ln N_k - mean)^2 where
//! targets err together. What is predicted therefore uses the mean of the measured slope and of
//! -1/2, weighted by the inverse of s^2 and of P^2, the variance of slopes among scenes (the
//! posterior mean where all are normal). Bounds on light that no sample met shrink like N^(-1).
//!
//! Points that go on are those that seemed worst, in part by chance, and look better the next time.
//! That part of their half-widths is estimated as empirical Bayes does (B. Efron and C. Morris,
//! Journal of the American Statistical Association 68, 1973): where the logarithms of all points
//! before the choice vary by T^2 around a mean, the points that were chosen owe v / T^2 of their
//! distance from it to luck. Half of it is lost at the next checkpoint, for half of the samples are
//! the same.

use crate::settings::Settings;
use crate::stats::estimates::{Convergence, Estimates};
use crate::stats::schedule::{MAX_SAMPLES, Schedule};
use crate::stats::tolerance::Standing;
use quasilux_sampling::quality::fit_power_law;
use serde::{Deserialize, Serialize};

/// Checkpoints that a slope is fitted to at least.
const MIN_CHECKPOINTS: usize = 3;
/// Checkpoints after which a prediction is compared with what came.
const LATER: usize = 2;
/// The slope where none is measured: that of independent samples.
const EXPECTED_SLOPE: f64 = -0.5;
/// P: how far slopes of scenes lie from that, a standard deviation.
const SPREAD_OF_SLOPES: f64 = 0.25;
/// Exponents that predictions are limited to.
const SLOPES: std::ops::RangeInclusive<f64> = -1.5..=-0.4;

/// The checkpoints of a run so far.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct History {
    /// Checkpoints that the chain of half-widths goes through.
    checkpoints: Vec<Checkpoint>,
    /// How predictions did.
    outcomes: Outcomes,
    /// Each target at the last checkpoint.
    #[serde(skip)]
    widths: Vec<TargetWidth>,
    #[serde(skip)]
    samples: u64,
    #[serde(skip)]
    rays: u64,
}

/// How well a target is known, and from how many samples.
#[derive(Clone, Copy, Debug)]
struct TargetWidth {
    /// Half-width over value; `None` without an interval.
    relative: Option<f64>,
    /// Indices per replicate.
    samples: u64,
}

impl TargetWidth {
    /// The logarithm of a half-width that is neither zero nor infinite.
    fn logarithm(&self) -> Option<f64> {
        self.relative.filter(|width| *width > 0.0 && width.is_finite()).map(libm::log)
    }
}

/// Estimates of a checkpoint, and how its targets stand.
#[derive(Clone, Copy)]
pub(crate) struct Finding<'e> {
    pub(crate) estimates: &'e Estimates,
    pub(crate) standing: &'e Standing,
    /// Whether converged targets get no more samples.
    pub(crate) is_adaptive: bool,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
struct Checkpoint {
    samples: u64,
    /// exp y: half-widths in units of those at the first checkpoint.
    width: f64,
    /// Exponent that later half-widths were predicted with; `None` before a slope was measured.
    exponent: Option<f64>,
}

/// Logarithms of half-widths over what was predicted for them.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct Outcomes {
    targets: f64,
    sum: f64,
}

/// How logarithms of half-widths changed on average, and over how many targets.
struct Change {
    mean: f64,
    targets: f64,
}

impl History {
    /// Adds a checkpoint.
    pub(crate) fn record(
        &mut self,
        finding: Finding<'_>,
        schedule: &Schedule,
        settings: &Settings,
    ) -> Convergence {
        let Finding { estimates, standing, is_adaptive } = finding;
        let now = widths(estimates, standing);
        let noise = 0.5 / (f64::from(settings.effective_replicates()) - 1.0).max(1.0);
        let exponent = self.chain(&now, estimates.samples, noise);
        let slope = self.slope();
        let steepness = exponent.unwrap_or(EXPECTED_SLOPE).abs();
        let ends: Vec<Option<u64>> = (0..now.len())
            .map(|target| {
                if standing.done[target] && schedule.is_look() {
                    return Some(now[target].samples);
                }
                let excess = standing.excess[target].filter(|excess| excess.is_finite())?;
                // Bounds on unseen light shrink like 1/N.
                let of_unseen = standing.unseen_excess[target].unwrap_or(0.0);
                let more = libm::pow(excess.max(1.0), 1.0 / steepness).max(of_unseen);
                let wanted = estimates.samples as f64 * more;
                let is_possible = wanted <= MAX_SAMPLES as f64;
                is_possible
                    .then(|| schedule.look_at_or_after((wanted as u64).max(estimates.samples)))
            })
            .collect();
        let grown = now.iter().filter(|own| own.samples == estimates.samples).count();
        let end = ends.iter().copied().try_fold(0, |end: u64, own| Some(end.max(own?)));
        let rays = end.map(|end| {
            // At the first checkpoint surveys and pilots count as if they came again.
            let step = estimates.samples.saturating_sub(self.samples).max(1) as f64;
            let rays = estimates.rays.saturating_sub(self.rays) as f64;
            let rays_per_index = rays / (step * grown.max(1) as f64);
            let own_end = |own: &Option<u64>| own.filter(|_| is_adaptive).unwrap_or(end);
            let left = |own| own_end(own).saturating_sub(estimates.samples) as f64;
            let indices: f64 = ends.iter().map(left).sum();
            estimates.rays.saturating_add((indices * rays_per_index) as u64)
        });
        self.widths = now;
        self.samples = estimates.samples;
        self.rays = estimates.rays;
        let against_prediction = self.outcomes.ratio();
        Convergence { slope, samples: end, rays, against_prediction }
    }

    /// The stored history of a run whose last checkpoint had these estimates: everything but the
    /// checkpoints follows from them.
    pub(crate) fn resumed(self, last: &Estimates, settings: &Settings) -> Self {
        let widths = widths(last, &Standing::new(last, settings));
        Self { widths, samples: last.samples, rays: last.rays, ..self }
    }

    /// Adds a checkpoint to the chain. Where nothing can be compared with the last checkpoint, one
    /// that has not begun begins here, and one that has is at its end: what others told stands for
    /// targets that had nothing before. `noise` is the variance of logarithms of half-widths by
    /// chance. The exponent that is predicted with from now on.
    fn chain(&mut self, now: &[TargetWidth], samples: u64, noise: f64) -> Option<f64> {
        let change = self.change(now, noise);
        let width = match (&change, self.checkpoints.last()) {
            (Some(change), Some(last)) if last.samples == self.samples => {
                last.width * libm::exp(change.mean)
            }
            (_, Some(last)) if self.checkpoints.len() > 1 => return last.exponent,
            _ => {
                self.checkpoints.clear();
                1.0
            }
        };
        if let Some((Change { targets, .. }, logarithm)) =
            change.zip(self.against_prediction(samples, width))
        {
            self.outcomes.targets += targets;
            self.outcomes.sum += targets * logarithm;
        }
        self.checkpoints.push(Checkpoint { samples, width, exponent: None });
        let exponent = self.slope().map(|slope| self.predicted_with(slope, noise));
        if let Some(last) = self.checkpoints.last_mut() {
            last.exponent = exponent;
        }
        exponent
    }

    /// How the logarithms of half-widths changed since the last checkpoint, over the targets that
    /// grew; `None` without any. `noise` is their variance by chance.
    fn change(&self, now: &[TargetWidth], noise: f64) -> Option<Change> {
        let (mut all, mut chosen, mut change) = (Moments::default(), Moments::default(), 0.0);
        for (before, now) in self.widths.iter().zip(now) {
            // Targets that ended long ago have fewer samples than the others.
            let grew = 2 * before.samples > self.samples;
            let Some(log_before) = before.logarithm().filter(|_| grew) else { continue };
            all.add(log_before);
            if let Some(log_now) = now.logarithm().filter(|_| now.samples > before.samples) {
                chosen.add(log_before);
                change += log_now - log_before;
            }
        }
        if chosen.count == 0.0 {
            return None;
        }
        let by_chance = (noise / all.variance().max(noise)).min(1.0);
        let luck = by_chance * (chosen.mean() - all.mean());
        Some(Change { mean: change / chosen.count + 0.5 * luck, targets: chosen.count })
    }

    fn slope(&self) -> Option<f64> {
        let points: Vec<[f64; 2]> = self
            .checkpoints
            .iter()
            .map(|checkpoint| [checkpoint.samples as f64, checkpoint.width])
            .collect();
        let fit = fit_power_law(&points).filter(|_| points.len() >= MIN_CHECKPOINTS);
        fit.map(|line| line.exponent)
    }

    /// The exponent to predict with where this slope was measured.
    fn predicted_with(&self, slope: f64, noise: f64) -> f64 {
        let mut places = Moments::default();
        self.checkpoints.iter().for_each(|at| places.add(libm::log(at.samples as f64)));
        let spread = places.count * places.variance() * SPREAD_OF_SLOPES * SPREAD_OF_SLOPES;
        let trust = spread / (spread + noise);
        let exponent = EXPECTED_SLOPE + trust * (slope - EXPECTED_SLOPE);
        exponent.clamp(*SLOPES.start(), *SLOPES.end())
    }

    /// The logarithm of the next checkpoint's half-widths over what was predicted for them.
    fn against_prediction(&self, samples: u64, width: f64) -> Option<f64> {
        let then = self.checkpoints.iter().rev().nth(LATER - 1)?;
        let more = samples as f64 / then.samples as f64;
        Some(libm::log(width / (then.width * libm::pow(more, then.exponent?))))
    }
}

impl Outcomes {
    /// The mean of half-widths over what was predicted; `None` where nothing was.
    fn ratio(&self) -> Option<f64> {
        (self.targets > 0.0).then(|| libm::exp(self.sum / self.targets))
    }
}

/// The half-widths of all targets.
fn widths(estimates: &Estimates, standing: &Standing) -> Vec<TargetWidth> {
    let samples = estimates.sensors.iter().flat_map(|sensor| sensor.samples.iter().copied());
    let widths = standing.relative_widths.iter().zip(samples);
    widths.map(|(relative, samples)| TargetWidth { relative: *relative, samples }).collect()
}

/// Sums of numbers.
#[derive(Default)]
struct Moments {
    count: f64,
    sum: f64,
    squares: f64,
}

impl Moments {
    fn add(&mut self, x: f64) {
        self.count += 1.0;
        self.sum += x;
        self.squares += x * x;
    }

    fn mean(&self) -> f64 {
        self.sum / self.count
    }

    fn variance(&self) -> f64 {
        self.squares / self.count - self.mean() * self.mean()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::Settings;
    use crate::stats::estimates::SensorEstimates;
    use crate::stats::point_status::Evidence;

    /// Two targets with half-widths of `scale * N^slope` over value each, the first done at `done`.
    struct MadeUp {
        slope: f64,
        scales: [f64; 2],
        done: u64,
        /// Bounds on unseen light with one sample, over their tolerance.
        unseen: Option<f64>,
    }

    impl MadeUp {
        /// Convergence at the last checkpoint up to `last`.
        fn known(&self, last: u64) -> Convergence {
            let settings = Settings { rel_tol: 0.01, ..Settings::default() };
            let (mut history, mut schedule) = (History::default(), Schedule::new(16, None));
            let mut rays = 0;
            loop {
                let n = schedule.next_checkpoint();
                rays += if n > self.done { n / 2 } else { n };
                let estimates = self.estimates(n, rays);
                let standing = self.standing(&estimates.sensors[0].samples, &settings);
                let finding =
                    Finding { estimates: &estimates, standing: &standing, is_adaptive: true };
                let convergence = history.record(finding, &schedule, &settings);
                if n >= last {
                    return convergence;
                }
                schedule.advance();
            }
        }

        fn estimates(&self, n: u64, rays: u64) -> Estimates {
            Estimates {
                sensors: vec![SensorEstimates {
                    replicate_lx: Vec::new(),
                    direct_lx: Vec::new(),
                    evidence: vec![Evidence::Sound; 2],
                    samples: vec![n.min(self.done), n],
                    average: None,
                    terms: Vec::new(),
                    unseen: None,
                }],
                samples: n,
                rays,
                ..Estimates::default()
            }
        }

        fn standing(&self, samples: &[u64], settings: &Settings) -> Standing {
            let at = |(scale, n): (&f64, &u64)| scale * libm::pow(*n as f64, self.slope);
            let widths: Vec<f64> = self.scales.iter().zip(samples).map(at).collect();
            let unseen_excess = |n: &u64| self.unseen.map(|unseen| unseen / *n as f64);
            Standing {
                relative_widths: widths.iter().copied().map(Some).collect(),
                excess: widths.iter().map(|width| Some(width / settings.rel_tol)).collect(),
                unseen_excess: samples.iter().map(unseen_excess).collect(),
                done: widths.iter().map(|width| *width <= settings.rel_tol).collect(),
                statuses: Vec::new(),
                unresolved: 0,
                is_reached: false,
                may_end: false,
            }
        }
    }

    fn known(slope: f64, scales: [f64; 2], done: u64, last: u64) -> Convergence {
        MadeUp { slope, scales, done, unseen: None }.known(last)
    }

    /// Half-widths are to be reached at 1024 samples, bounds of 8 at 64 samples at 512 or 4096.
    #[test]
    fn bounds_on_unseen_light_shrink_like_one_over_the_samples() {
        let scale = 0.08 * 4.0;
        let end = |unseen| {
            let made_up = MadeUp { slope: -0.5, scales: [scale; 2], done: 1 << 20, unseen };
            made_up.known(64).samples
        };
        assert_eq!(end(Some(512.0)), end(None));
        assert_eq!(end(Some(4096.0)), Some(4096));
        assert_eq!(end(Some(f64::INFINITY)), None);
    }

    #[test]
    fn a_power_law_is_found_though_points_stop() {
        for slope in [-0.5, -0.8, -1.0] {
            let scale = 0.01 * libm::pow(256.0, -slope);
            let Convergence { slope: got, against_prediction, samples, .. } =
                known(slope, [0.5 * scale, 4.0 * scale], 128, 512);
            // Half-widths without noise: a little is taken for luck.
            assert!((got.unwrap() - slope).abs() < 0.02, "{got:?}");
            // At first a slope is half believed, so what is steep does better than predicted.
            let least = if slope == -0.5 { 0.95 } else { 0.75 };
            let ratio = against_prediction.unwrap();
            assert!((least..=1.05).contains(&ratio), "{slope}: {ratio}");
            let wanted = 256.0 * libm::pow(4.0, -1.0 / slope);
            let ratio = samples.unwrap() as f64 / wanted;
            assert!((0.5..=2.01).contains(&ratio), "{samples:?} {wanted}");
        }
    }

    /// The first checkpoint already says how many rays it takes, as if half-widths shrank like
    /// those of random points.
    #[test]
    fn the_first_checkpoint_predicts() {
        let scale = 0.08 * 4.0;
        let first = known(-0.5, [scale, scale], 1 << 20, 16);
        assert_eq!(first.slope, None);
        assert_eq!(first.samples, Some(1024));
        assert_eq!(first.rays, Some(1024));
    }

    /// Checkpoints without a half-width say nothing of how half-widths shrink.
    #[test]
    fn the_chain_begins_where_something_is_found() {
        let mut history = History::default();
        let mut record = |samples: u64, width: Option<f64>| {
            let target = TargetWidth { relative: width, samples };
            history.chain(&[target], samples, 1e-9);
            history.widths = vec![target];
            history.samples = samples;
            history.slope()
        };
        for samples in [16, 32, 64, 128] {
            assert_eq!(record(samples, None), None);
        }
        assert_eq!(record(256, Some(1.0)), None);
        assert_eq!(record(512, Some(0.5)), None);
        assert!((record(1024, Some(0.25)).unwrap() + 1.0).abs() < 1e-9);
        // Nor do targets that nothing is found at when all others are done, or those that are found
        // then.
        for (samples, width) in [(2048, None), (4096, None), (8192, Some(3.0)), (16_384, Some(2.0))]
        {
            assert!((record(samples, width).unwrap() + 1.0).abs() < 1e-9);
        }
    }

    /// Three checkpoints of one target and 16 replicates, v = 1/30, say about as much of its slope
    /// as slopes of other scenes do; many say all.
    #[test]
    fn a_slope_of_few_checkpoints_is_half_believed() {
        let of = |checkpoints: u32| {
            let mut history = History::default();
            for k in 0..checkpoints {
                let samples = 16 << k;
                let width = 1.0 / f64::from(1 << k);
                history.checkpoints.push(Checkpoint { samples, width, exponent: None });
            }
            history.predicted_with(history.slope().unwrap(), 1.0 / 30.0)
        };
        // 2 ln(2)^2 P^2 / (2 ln(2)^2 P^2 + v) = 0.6431.
        assert!((of(3) + 0.5 + 0.5 * 0.6431).abs() < 1e-4);
        assert!((-1.0..-0.99).contains(&of(12)));
    }

    /// With slope -1/2 the targets end at 64 and 4096 indices; each index of each target takes a
    /// ray.
    #[test]
    fn rays_are_those_of_targets_that_go_on() {
        let scale = 0.01 * 45.0_f64.sqrt();
        let at = |last| known(-0.5, [scale, 8.0 * scale], 64, last).rays.unwrap();
        let all = at(4096);
        for last in [64, 256, 1024] {
            let predicted = at(last) as f64;
            assert!((predicted / all as f64 - 1.0).abs() < 0.1, "{last}: {predicted} {all}");
        }
    }
}
