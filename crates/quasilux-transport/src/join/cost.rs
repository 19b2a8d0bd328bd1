//! What a run costs whose targets have given variances.
//!
//! With variances v of one sample, in units of the error that is wanted squared, a target needs a number of samples in
//! proportion to its v. Paths of a target that is done cost nothing more, so they cost the mean of v times
//! what a sample of all of them costs. Photons serve all targets at once and fly until the last is done, so they
//! cost the largest v. Where no target is done before the others, because the number of samples is given or averages
//! alone are to be known, everything costs in proportion to the mean: the squared error times the rays.

use crate::settings::{Settings, ToleranceOn};

/// How variances become costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cost {
    /// Every target goes on until its own error is small enough.
    UntilEachIsDone,
    /// All targets get the same.
    ForAll,
}

impl Cost {
    /// As these settings end a run.
    pub(super) fn of(settings: &Settings) -> Self {
        if settings.has_tolerance() && settings.tolerance_on == ToleranceOn::Points {
            Self::UntilEachIsDone
        } else {
            Self::ForAll
        }
    }

    /// With so many rays for one sample of paths from all targets, and of the photons beside them.
    pub(super) fn rays(self, variances: &[f64], of_paths: f64, of_photons: f64) -> f64 {
        let mean = variances.iter().sum::<f64>() / variances.len().max(1) as f64;
        let of_last = match self {
            // The largest of many that are known badly is too large: it is taken half way to the mean.
            Self::UntilEachIsDone => 0.5 * (mean + variances.iter().copied().fold(mean, f64::max)),
            Self::ForAll => mean,
        };
        mean * of_paths + of_last * of_photons
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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

    #[test]
    fn targets_are_done_one_by_one_only_with_a_tolerance_of_their_own() {
        let settings = Settings::default();
        assert_eq!(Cost::of(&settings), Cost::UntilEachIsDone);
        let summary = Settings { tolerance_on: ToleranceOn::Summary, ..settings.clone() };
        let given = Settings { rel_tol: 0.0, abs_tol_lx: 0.0, ..settings };
        assert_eq!([summary, given].map(|settings| Cost::of(&settings)), [Cost::ForAll; 2]);
    }
}
