//! The error that the settings ask for, target by target, and the shortfall of a pilot from it.

use super::cost::{Budget, PilotCost};
use super::trial::{Sample, Trial};
use crate::settings::{Settings, ToleranceOn};

/// A shortfall up to this multiple of the variance of means is not significant.
pub(crate) const BY_CHANCE: f64 = 4.0;

/// Paths miss light where other estimators find this many times as much.
pub(crate) const MUCH_MORE: f64 = 2.0;

/// The quantities asked for and their tolerated errors.
pub(crate) struct ErrorTarget {
    budget: Budget,
    settings: Settings,
    /// The illuminance at each target that is looked at, as far as known.
    means_lx: Vec<f64>,
    /// The mean of these.
    average_lx: f64,
}

impl ErrorTarget {
    /// Of a sample whose targets have these means.
    pub(crate) fn new(settings: &Settings, sample: &Sample, means_lx: Vec<f64>) -> Self {
        let average_lx = means_lx.iter().sum::<f64>() / means_lx.len().max(1) as f64;
        let budget = Budget::new(settings, sample);
        Self { budget, settings: settings.clone(), means_lx, average_lx }
    }

    /// What an error is compared with where the illuminance is this: its tolerance, that of the
    /// average where only averages are wanted, or itself where there is none.
    fn scale_lx(&self, mean_lx: f64) -> f64 {
        let Self { settings, average_lx, .. } = self;
        match settings.tolerance_on {
            _ if !settings.has_tolerance() => mean_lx,
            ToleranceOn::Points => settings.tolerance_lx(mean_lx),
            ToleranceOn::Summary => settings.tolerance_lx(*average_lx),
        }
    }

    /// How many targets are looked at.
    pub(crate) fn targets(&self) -> usize {
        self.means_lx.len()
    }

    /// Those where there is light.
    pub(crate) fn seen(&self) -> impl Iterator<Item = usize> {
        (0..self.means_lx.len()).filter(|target| self.means_lx[*target] > 0.0)
    }

    /// What a lux counts at a target; nothing where there is none.
    pub(crate) fn importance_per_lx(&self, target: usize) -> f64 {
        self.importance_of(self.means_lx[target])
    }

    /// The same where the illuminance is this.
    pub(crate) fn importance_of(&self, mean_lx: f64) -> f64 {
        let scale_lx = self.scale_lx(mean_lx);
        if mean_lx > 0.0 && scale_lx > 0.0 { 1.0 / scale_lx } else { 0.0 }
    }

    /// Of what a trial finds, over the scales squared; one for each target that is seen.
    pub(crate) fn variances(&self, trial: &Trial) -> Vec<f64> {
        let relative = |target: usize| {
            let scale_lx = self.scale_lx(self.means_lx[target]);
            trial.moments(target).variance / (scale_lx * scale_lx)
        };
        self.seen().map(relative).collect()
    }

    /// How much a trial is short of the means, over the scales and squared, mean over the targets:
    /// as far as it cannot be by chance, where means have this variance.
    pub(crate) fn shortfall(&self, found_lx: impl Fn(usize) -> f64, noise: f64) -> f64 {
        let (sum, count) = self.seen().fold((0.0, 0.0), |(sum, count), target| {
            let mean_lx = self.means_lx[target];
            let missing = (mean_lx - found_lx(target)) / self.scale_lx(mean_lx);
            (sum + missing * missing, count + 1.0)
        });
        if count > 0.0 { (sum / count - BY_CHANCE * noise).max(0.0) } else { 0.0 }
    }

    /// Cost of an estimator, see [`Budget::effort`].
    pub(crate) fn effort(&self, pilot_cost: &PilotCost<'_>) -> f64 {
        self.budget.effort(pilot_cost)
    }

    /// Rays of a whole run, see [`Budget::rays`].
    pub(crate) fn rays(&self, plain: &PilotCost<'_>, pilot_cost: &PilotCost<'_>) -> f64 {
        self.budget.rays(plain, pilot_cost)
    }
}
