//! Predicted cost of a run, in rays, whose targets have given variances.
//!
//! With variances v of one trial, in units of the error that is wanted squared, a target needs a
//! number of samples in proportion to its v. Paths of a target that is done cost nothing more, so
//! they cost the mean of v times what a trial of all of them costs. Photons serve all targets at
//! once and fly until the last is done, so they cost the largest v. Where no target is done before
//! the others, because the number of samples is given or averages alone are to be known, everything
//! costs in proportion to the mean: the squared error times the rays. How long the run is says how
//! much that is beside what comes before the first path ([`Budget`]).

use super::trial::{REPLICATES, SAMPLES, Sample};
use crate::settings::{Settings, ToleranceOn};
use crate::stats::interval::t_quantile_for;
use crate::stats::schedule::MIN_SAMPLES;
use crate::stats::sequential::miss_probability_of_a_look;

/// Samples that a run is taken to have where no tolerance says how many it needs.
const EXPECTED_SAMPLES: f64 = 4096.0;

/// How variances become costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Cost {
    /// Every target goes on until its own error is small enough.
    UntilEachIsDone,
    /// All targets get the same.
    ForAll,
}

/// How long a run is. Limits on samples or rays have no part in it: they only say which checkpoint
/// is the last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Budget {
    cost: Cost,
    /// Trials for each unit of variance, where a tolerance ends the run.
    trials_for_variance: Option<f64>,
    /// Trials that are made however small the error is, or all where no tolerance ends the run.
    trials: f64,
    /// What the paths of a trial cost beside their rays, in rays.
    beside_rays: f64,
    /// Targets for each that is in the trial.
    targets: f64,
    /// Targets whose average alone is wanted; else 1.
    averaged: f64,
}

/// Variances and rays that a trial predicts for an estimator.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PilotCost<'v> {
    /// Of each target.
    pub(crate) variances: &'v [f64],
    /// Rays of a trial's paths, and of the photons beside them.
    pub(crate) of_paths: f64,
    pub(crate) of_photons: f64,
    /// Rays before the first path.
    pub(crate) beforehand: f64,
}

impl<'v> PilotCost<'v> {
    /// Of paths that need nothing beforehand.
    pub(crate) fn of_paths(variances: &'v [f64], rays: f64) -> Self {
        Self { variances, of_paths: rays, of_photons: 0.0, beforehand: 0.0 }
    }
}

impl Budget {
    /// As these settings end a run of all targets of which these are in the trial.
    pub(crate) fn new(settings: &Settings, sample: &Sample) -> Self {
        let fixed = settings.sequence.points();
        let is_tolerance = settings.has_tolerance() && fixed.is_none();
        let for_points = is_tolerance && settings.tolerance_on == ToleranceOn::Points;
        let replicates = settings.effective_replicates();
        let samples = match fixed {
            Some(points) => points as f64,
            None if is_tolerance => MIN_SAMPLES as f64,
            None => EXPECTED_SAMPLES,
        };
        // The half-width `t sqrt(variance / replicates)` is to be one, in units of the tolerance.
        let miss_probability = miss_probability_of_a_look(1.0 - settings.confidence, replicates);
        let t = t_quantile_for(replicates as usize, miss_probability).unwrap_or(2.0);
        let in_trial = REPLICATES.len() as f64;
        Self {
            cost: if for_points { Cost::UntilEachIsDone } else { Cost::ForAll },
            trials_for_variance: is_tolerance.then_some(t * t / in_trial),
            trials: samples / SAMPLES as f64 * f64::from(replicates) / in_trial,
            beside_rays: sample.beside_rays(),
            targets: sample.targets_for_each(),
            averaged: if is_tolerance && !for_points { sample.all as f64 } else { 1.0 },
        }
    }

    /// Squared error times rays, in units that all ways of one trial share.
    pub(crate) fn effort(&self, pilot_cost: &PilotCost<'_>) -> f64 {
        let PilotCost { variances, of_paths, of_photons, .. } = *pilot_cost;
        self.cost.rays(variances, of_paths + self.beside_rays, of_photons)
    }

    /// Rays to an error as small as the tolerance, or to that of plain paths.
    pub(crate) fn rays(&self, plain: &PilotCost<'_>, pilot_cost: &PilotCost<'_>) -> f64 {
        let each = pilot_cost.of_paths + self.beside_rays + pilot_cost.of_photons;
        let sampled = if let Some(trials) = self.trials_for_variance {
            // Paths of different targets are independent, and photons are the same for many of
            // them.
            let averaged = if pilot_cost.of_photons > 0.0 { 1.0 } else { self.averaged };
            (trials * self.effort(pilot_cost) / averaged).max(self.trials * each)
        } else {
            let [mean, of_plain] =
                [pilot_cost, plain].map(|p| Cost::ForAll.rays(p.variances, 1.0, 0.0));
            self.trials * each * if of_plain > 0.0 { mean / of_plain } else { 1.0 }
        };
        self.targets * sampled + pilot_cost.beforehand
    }
}

impl Cost {
    /// Variance times rays, of which a trial takes `of_paths` for paths and `of_photons` for
    /// photons.
    fn rays(self, variances: &[f64], of_paths: f64, of_photons: f64) -> f64 {
        let mean = variances.iter().sum::<f64>() / variances.len().max(1) as f64;
        let of_last = match self {
            // The largest of many that are known badly is too large: it is taken half way to the
            // mean.
            Self::UntilEachIsDone => 0.5 * (mean + variances.iter().copied().fold(mean, f64::max)),
            Self::ForAll => mean,
        };
        mean * of_paths + of_last * of_photons
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::targets::Target;
    use glam::DVec3;

    #[test]
    fn photons_fly_for_the_last_target() {
        let even = [2.0; 4];
        let uneven = [1.0, 1.0, 1.0, 5.0];
        for cost in [Cost::UntilEachIsDone, Cost::ForAll] {
            assert_eq!(cost.rays(&even, 10.0, 100.0), 220.0);
            assert_eq!(cost.rays(&uneven, 10.0, 0.0), 20.0);
        }
        assert_eq!(Cost::UntilEachIsDone.rays(&uneven, 0.0, 100.0), 350.0);
        assert_eq!(Cost::ForAll.rays(&uneven, 0.0, 100.0), 200.0);
    }

    /// Every so many-th of nine targets.
    fn sample(step: usize) -> Sample {
        let target = Target::Point { position: DVec3::ZERO, normal: DVec3::Z };
        let targets = vec![target; 9usize.div_ceil(step)];
        Sample { all: 9, step, exact_lx: vec![0.0; targets.len()], targets }
    }

    #[test]
    fn targets_are_done_one_by_one_only_with_a_tolerance_of_their_own() {
        let settings = Settings::default();
        assert_eq!(Budget::new(&settings, &sample(1)).cost, Cost::UntilEachIsDone);
        let summary = Settings { tolerance_on: ToleranceOn::Summary, ..settings.clone() };
        let given = Settings { rel_tol: 0.0, abs_tol_lx: 0.0, ..settings };
        assert_eq!(
            [summary, given].map(|settings| Budget::new(&settings, &sample(1)).cost),
            [Cost::ForAll; 2]
        );
    }

    /// Trials of 8 replicates and 16 samples that take 8000 rays, with what paths cost beside them;
    /// 16 replicates.
    #[test]
    fn a_run_is_as_long_as_its_settings_say() {
        let rays_for = |step: usize, settings: &Settings, variance: f64| {
            let sample = sample(step);
            let of_paths = 8000.0 - sample.beside_rays();
            let [plain, variances] = [[1000.0], [variance]];
            let [plain, pilot_cost] = [&plain, &variances].map(|variances| PilotCost {
                beforehand: 1000.0,
                ..PilotCost::of_paths(variances, of_paths)
            });
            Budget::new(settings, &sample).rays(&plain, &pilot_cost)
        };
        let rays = |settings: &Settings, variance: f64| rays_for(1, settings, variance);
        let open = Settings::default();
        // t of a look is 2.25, and the variance of 16 samples falls to 16 / t^2 after 16 * 1000 t^2
        // / 16 samples.
        let t = t_quantile_for(16, miss_probability_of_a_look(0.05, 16)).unwrap();
        let all = 1000.0 * t * t * 1000.0 + 1000.0;
        assert!((rays(&open, 1000.0) / all - 1.0).abs() < 1e-4, "{}", rays(&open, 1000.0));
        // 128 samples at least.
        assert_eq!(rays(&open, 1e-9), 128.0 * 16.0 * 8000.0 / 128.0 + 1000.0);
        assert_eq!(rays_for(3, &open, 1e-9), 3.0 * 128.0 * 16.0 * 8000.0 / 128.0 + 1000.0);
        let averages = Settings { tolerance_on: ToleranceOn::Summary, ..open.clone() };
        assert!((rays(&averages, 1000.0) / (1000.0 + (all - 1000.0) / 9.0) - 1.0).abs() < 1e-9);
        // Without a tolerance 4096 samples, or as many as leave the error of 4096 plain ones;
        // limits do not matter.
        let given = Settings { max_samples: Some(64), rel_tol: 0.0, ..open };
        assert_eq!(rays(&given, 1000.0), 4096.0 * 16.0 * 8000.0 / 128.0 + 1000.0);
        assert_eq!(rays(&given, 500.0), 2048.0 * 16.0 * 8000.0 / 128.0 + 1000.0);
    }
}
