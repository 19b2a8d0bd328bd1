//! Selection of the estimator for `bidirectional` by pilot runs: path tracing alone, on a frozen
//! map, or beside light vertex connections.
//!
//! It has three ways. Paths go alone to their ends; or they end on a frozen map, which some of them
//! correct ([`crate::estimator::control_variate`]); or photons are connected to the targets and
//! share the light with them ([`crate::estimator::connection`]). All three have the right mean, so
//! any choice is right, and the cheapest is best: by the rays of the whole run, foreseen from
//! variances and rays of trials ([`ErrorTarget`]). Trials themselves cost rays, most of all those
//! of connected photons, for which the scene is surveyed. So a few paths are tried first, and a map
//! of a few photons; photons are only connected where what is best without them takes many rays, or
//! where paths do not find the light that photons do.

use crate::context::Context;
use crate::estimator::connection::{ConnectionPilots, LightVertexConnections, PathsAlone};
use crate::estimator::control_variate::{MapPilot, Outcome, PathPilot, PathTrial};
use crate::estimator::pilot::{ErrorTarget, PilotCost, Request, Sample, Trial};
use crate::path::frozen_map::TracedMap;
use crate::photon::counts::PhotonCounts;
use crate::settings::Settings;
use crate::spectrum::Spectrum;
use crate::stats::watch::Watch;
use quasilux_sampling::Sequence;

/// Shorter runs, in rays, do without a survey and pilots of connected photons, which take a quarter
/// to a half of that and seldom save three quarters of the rest.
const TRYING_TO_JOIN: f64 = (1 << 22) as f64;
/// In a run, the variance of paths falls to about this part of what it is in the trial, beyond what
/// more of them bring: quasi-random points. Random ones bring nothing.
const LATER: f64 = 0.5;

/// The selected estimator, and the cost of the selection. Without connected photons and map, paths
/// go alone.
#[derive(Default)]
pub(crate) struct Decision<S> {
    pub(crate) light_vertices: Option<LightVertexConnections>,
    /// With its photons.
    pub(crate) frozen: Option<TracedMap<S>>,
    /// Photons of a map that was not taken, if they left the lights.
    pub(crate) photons: Option<PhotonCounts>,
    /// Rays of all trials, and of what connected photons need beforehand; but for those of photons
    /// above.
    pub(crate) rays: u64,
}

/// Tries the estimators that the settings leave open, and decides.
pub(crate) fn decide<S: Spectrum>(
    context: &Context<'_, S>,
    request: &Request<'_>,
    watch: &mut Watch<'_>,
) -> Decision<S> {
    let settings = request.settings;
    let is_possible = settings.estimator.is_selected_by_pilots()
        && settings.max_bounces != Some(0)
        && !request.targets.is_empty();
    if !is_possible {
        return Decision::default();
    }
    let connections = settings.connections();
    let tried = Tried::new(context, request);
    let mut rays = tried.traced as u64;
    let tries_map = connections != Some(true);
    let choice = if tries_map { tried.map_pilot(context, settings, watch) } else { None };
    let of_plain = tried.rays(&tried.plain());
    let of_map = choice.as_ref().map_or(f64::INFINITY, |choice| tried.rays(&choice.pilot_cost()));
    let best = of_plain.min(of_map);
    let misses_light = choice.as_ref().is_some_and(|choice| choice.misses_light);
    let finds_light = tried.paths.finds_light && !misses_light;
    if connections.unwrap_or(best > TRYING_TO_JOIN || !finds_light) {
        let pilots = ConnectionPilots::new(context, request, &tried.sample, watch);
        rays += pilots.rays;
        let alone = PathsAlone { trial: &tried.paths.trial, part: tried.part(best), finds_light };
        if let Some(light_vertices) = pilots.select(context, request, &tried.sample, &alone) {
            rays += light_vertices.rays;
            let photons = choice.and_then(|choice| choice.give_up(&mut rays));
            return Decision { light_vertices: Some(light_vertices), frozen: None, photons, rays };
        }
    }
    match choice {
        Some(choice) if connections == Some(false) || of_map < of_plain => {
            let importance = tried.importance_per_lx(context, request, &mut rays);
            let frozen = choice.freeze(context, importance, watch);
            Decision { frozen: Some(frozen), rays, ..Decision::default() }
        }
        unused => {
            let photons = unused.and_then(|choice| choice.give_up(&mut rays));
            Decision { photons, rays, ..Decision::default() }
        }
    }
}

/// A trial of paths that hardly end, and what it predicts of those that do.
struct Tried<S> {
    sample: Sample,
    paths: PathTrial<S>,
    wanted: ErrorTarget,
    /// Variances of these paths in a run.
    recorded: Vec<f64>,
    /// Of paths that end by Russian roulette, on no map.
    plain: Outcome,
    /// Rays of all trials.
    traced: f64,
}

impl<S: Spectrum> Tried<S> {
    fn new(context: &Context<'_, S>, request: &Request<'_>) -> Self {
        let settings = request.settings;
        let sample = Sample::new(request.targets, request.exact);
        let paths = PathTrial::new(context, &sample, request.quantum);
        let trial = &paths.trial;
        let found_lx = |(target, exact_lx): (usize, &f64)| exact_lx + trial.moments(target).mean;
        let means_lx = sample.exact_lx.iter().enumerate().map(found_lx).collect();
        let wanted = ErrorTarget::new(settings, &sample, means_lx);
        let later = if settings.sequence == Sequence::Independent { 1.0 } else { LATER };
        let recorded: Vec<f64> = wanted.variances(trial).iter().map(|v| later * v).collect();
        let mut traced = paths.trial.rays;
        let plain = if context.shows_emitters_past_specular() {
            // They ask for more than recorded ones do.
            let trial = Trial::of_paths(context, &sample, None, request.quantum);
            traced += trial.rays;
            let variances = wanted.variances(&trial).iter().map(|v| later * v).collect();
            Outcome { variances, rays: trial.rays }
        } else {
            let Outcome { variances, rays } = paths.records.alone(&wanted);
            let variances = recorded.iter().zip(variances).map(|(v, more)| v + more).collect();
            Outcome { variances, rays }
        };
        Self { sample, paths, wanted, recorded, plain, traced }
    }

    fn recorded(&self) -> PilotCost<'_> {
        PilotCost::of_paths(&self.recorded, self.paths.trial.rays)
    }

    fn plain(&self) -> PilotCost<'_> {
        PilotCost::of_paths(&self.plain.variances, self.plain.rays)
    }

    /// Rays of a whole run of this cost.
    fn rays(&self, pilot_cost: &PilotCost<'_>) -> f64 {
        self.wanted.rays(&self.plain(), pilot_cost)
    }

    /// A map that these paths would end on.
    fn map_pilot(
        &self,
        context: &Context<'_, S>,
        settings: &Settings,
        watch: &mut Watch<'_>,
    ) -> Option<MapPilot<S>> {
        let (recorded, alone) = (&self.recorded(), &self.plain());
        let paths = PathPilot { records: &self.paths.records, recorded, alone };
        MapPilot::new(context, settings, &paths, &self.wanted, watch)
    }

    /// Ratio of `rays` to the rays of the recorded paths.
    fn part(&self, rays: f64) -> f64 {
        let of_recorded = self.rays(&self.recorded());
        if of_recorded > 0.0 { rays / of_recorded } else { 1.0 }
    }

    /// What a lux counts at each target, by a short look at those that are not in the trial.
    fn importance_per_lx(
        &self,
        context: &Context<'_, S>,
        request: &Request<'_>,
        rays: &mut u64,
    ) -> Vec<f64> {
        let &Request { targets, exact, quantum, .. } = request;
        if self.sample.step == 1 {
            return (0..targets.len())
                .map(|target| self.wanted.importance_per_lx(target))
                .collect();
        }
        let trial = Trial::of_one_replicate(context, targets, quantum);
        *rays += trial.rays as u64;
        let found = exact.iter().zip(&trial.lx);
        found.map(|(exact, lx)| self.wanted.importance_of(exact.sum_lx() + lx)).collect()
    }
}
