//! What the terms are, measured in four ways.
//!
//! Term k is the light of k bounces. Photons of one bounce less that go on are the flux that lands
//! as term k in a closed room: what `max_bounces` cuts. Paths and photons each list terms of the
//! illuminance of a plane; runs cut after n bounces must give their sums.

use super::{CUTS, Effort, room};
use crate::course::mean_interval;
use crate::significance::each_of;
use quasilux_transport::interval::t_quantile_for;
use quasilux_transport::{Estimates, EstimatorKind, Interval, Settings, Switch, simulate};

/// Terms that are told apart; light of more bounces is the rest.
pub(super) const LISTED: u32 = 6;

/// All figures but the pictures'.
pub(super) struct Terms {
    /// Flux that lands on all surfaces, term by term, in lm: one value a run.
    pub(super) landing_lm: Vec<Vec<f64>>,
    /// Illuminance of the plane by paths and by photons: a term and the rest each, one value a
    /// replicate, in lx.
    pub(super) by_paths_lx: Vec<Vec<f64>>,
    pub(super) by_photons_lx: Vec<Vec<f64>>,
    /// The same of runs that are cut after this many bounces, or not at all.
    pub(super) cut_lx: Vec<(Option<u32>, Vec<f64>)>,
    /// Indices a replicate of the runs above: paths of each cell, and photons.
    pub(super) paths: u64,
    pub(super) photons: u64,
}

/// How far two independent means are apart.
#[derive(Clone, Copy, Debug)]
pub(super) struct Distance {
    /// In standard errors.
    pub(super) standard_errors: f64,
    /// Over the second.
    pub(super) relative: f64,
}

impl Terms {
    pub(super) fn measure(effort: &Effort) -> Self {
        let scene = room::measured();
        let settings = |estimator, seed: u64| Settings {
            estimator,
            rel_tol: 0.0,
            importance: Switch::Off,
            replicates: effort.replicates,
            max_samples: Some(effort.paths),
            seed: 1000 * effort.seed + seed,
            ..Settings::default()
        };
        let listed = |estimator, seed, samples| {
            let settings = Settings {
                list_terms: LISTED,
                max_samples: Some(samples),
                ..settings(estimator, seed)
            };
            let estimates = simulate(&scene, &settings, &mut ());
            let terms = &estimates.sensors[0].terms;
            terms.iter().map(|term| means(&term.replicate_lx)).collect::<Vec<_>>()
        };
        let cut = |(number, max_bounces): (usize, Option<u32>)| {
            let seed = 3 + number as u64;
            let settings = Settings { max_bounces, ..settings(EstimatorKind::Path, seed) };
            (max_bounces, means(&simulate(&scene, &settings, &mut ()).sensors[0].replicate_lx))
        };
        Self {
            landing_lm: landing_lm(effort),
            by_paths_lx: listed(EstimatorKind::Path, 1, effort.paths),
            by_photons_lx: listed(EstimatorKind::Photon, 2, effort.photons),
            cut_lx: CUTS.into_iter().enumerate().map(cut).collect(),
            paths: effort.paths,
            photons: effort.photons,
        }
    }

    /// By paths, the sum of the terms up to the cut, or of all and the rest.
    pub(super) fn sum_lx(&self, cut: Option<u32>) -> Vec<f64> {
        let terms = cut.map_or(self.by_paths_lx.len(), |most| most as usize + 1);
        let sum = |r: usize| self.by_paths_lx[..terms].iter().map(|term| term[r]).sum();
        (0..self.by_paths_lx[0].len()).map(sum).collect()
    }

    /// Each landing term over the one before, one value a run.
    pub(super) fn ratios(&self) -> Vec<Interval> {
        let ratio = |pair: &[Vec<f64>]| {
            let ratios: Vec<f64> = pair[1].iter().zip(&pair[0]).map(|(b, a)| b / a).collect();
            mean_interval(&ratios)
        };
        self.landing_lm.windows(2).map(ratio).collect()
    }
}

impl Distance {
    /// Of the means of independent values.
    pub(super) fn between(a: &[f64], b: &[f64]) -> Self {
        let [x, y] = [a, b].map(mean_interval);
        let error = |interval: Interval, values: &[f64]| {
            let t = t_quantile_for(values.len(), 0.05).unwrap_or(f64::NAN);
            interval.half_width.unwrap_or(f64::NAN) / t
        };
        let apart = (x.value - y.value).abs();
        Self {
            // Both may be exact.
            standard_errors: match apart == 0.0 {
                true => 0.0,
                false => apart / libm::hypot(error(x, a), error(y, b)),
            },
            relative: apart / y.value.abs(),
        }
    }

    /// What is allowed for all of a family together at a significance of 1 %, by Sidak (1967) and
    /// Student's t with the degrees of one.
    pub(super) fn allowed(family: usize, values: usize) -> f64 {
        t_quantile_for(values, each_of(family)).unwrap_or(f64::NAN)
    }
}

/// One run of each cut sees the photons of the one before, and lets them go on once more.
fn landing_lm(effort: &Effort) -> Vec<Vec<f64>> {
    let scene = room::measured();
    let run = |max_bounces: u32, seed: u64| -> Estimates {
        let settings = Settings {
            estimator: EstimatorKind::Photon,
            importance: Switch::Off,
            max_bounces: Some(max_bounces),
            rel_tol: 0.0,
            replicates: 1,
            max_samples: Some(effort.photons),
            seed: 1000 * effort.seed + 100 + seed,
            ..Settings::default()
        };
        simulate(&scene, &settings, &mut ())
    };
    let all = vec![scene.flux_lm(); effort.flux_runs as usize];
    let later = (0..LISTED)
        .map(|bounces| (0..effort.flux_runs).map(|seed| run(bounces, seed).flux.cut_lm).collect());
    std::iter::once(all).chain(later).collect()
}

/// The mean of all cells, one a replicate.
fn means(rows: &[Vec<f64>]) -> Vec<f64> {
    rows.iter().map(|row| row.iter().sum::<f64>() / row.len() as f64).collect()
}
