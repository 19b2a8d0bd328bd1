//! How the estimator `bidirectional` goes about a scene, by what pilots measure.
//!
//! It has three ways. Paths go alone to their ends; or they end on a frozen map, which some of them correct
//! ([`crate::correction`]); or photons are joined to the targets and share the light with them ([`crate::join`]). All
//! three have the right mean, so any choice is right, and the cheapest is best: by the rays of the whole run,
//! foreseen from variances and rays of trials ([`Wanted`]). Trials themselves cost rays, most of all those of joined photons, for
//! which the scene is surveyed. So plain paths are tried first; where they promise a short run,
//! nothing else is, and photons are only joined where what is best without them takes many rays, or where paths
//! do not find the light.

mod cost;
mod trial;
mod wanted;

pub(crate) use cost::Promise;
pub(crate) use trial::{REPLICATES, SAMPLES, Sample, Trial};
pub(crate) use wanted::Wanted;

use crate::correction::{Choice, FrozenMap, Outcome, Walks};
use crate::gathering::Exact;
use crate::join::{self, Joined};
use crate::photon::PhotonCounts;
use crate::settings::{Estimator, Settings};
use crate::spectrum::Spectrum;
use crate::stage::Stage;
use crate::tally::Quantum;
use crate::targets::Target;
use crate::watch::Watch;

/// Runs of fewer rays are not worth a map.
const TRYING_A_MAP: f64 = (1 << 17) as f64;
/// Nor are those of fewer worth a survey, which takes about as many.
const TRYING_TO_JOIN: f64 = (1 << 20) as f64;

/// In a run, the variance of paths falls to about this part of what it is in the trial, beyond what more of them
/// bring: quasi-random points.
const LATER: f64 = 0.5;

/// Of a lux where light may be that the trial did not find.
const UNKNOWN_WORTH: f64 = 1e100;

/// What was decided, and what it took. Without joined photons and map, paths go alone.
pub(crate) struct Decision<S> {
    pub(crate) joined: Option<Joined>,
    /// With its photons.
    pub(crate) frozen: Option<(FrozenMap<S>, PhotonCounts)>,
    /// Rays of all that is not used.
    pub(crate) rays: u64,
}

impl<S> Default for Decision<S> {
    fn default() -> Self {
        Self { joined: None, frozen: None, rays: 0 }
    }
}

/// Tries what the settings leave open, and decides.
pub(crate) fn decide<S: Spectrum>(
    stage: &Stage<'_, S>,
    settings: &Settings,
    (targets, exact): (&[Target], &[Exact]),
    quantum: Quantum,
    watch: &mut Watch<'_>,
) -> Decision<S> {
    let is_possible = settings.estimator == Estimator::Bidirectional
        && settings.max_bounces != Some(0)
        && !targets.is_empty();
    if !is_possible {
        return Decision::default();
    }
    let joins = settings.joins();
    let tried = Tried::new(stage, settings, (targets, exact), quantum);
    let mut rays = tried.trial.rays as u64;
    let of_plain = tried.rays(&tried.plain());
    let tries_map = match joins {
        Some(joins) => !joins,
        None => of_plain > TRYING_A_MAP || !tried.finds_light,
    };
    let choice = if tries_map { tried.map(stage, settings, watch) } else { None };
    let of_map = choice.as_ref().map_or(f64::INFINITY, |choice| tried.rays(&choice.promise()));
    let best = of_plain.min(of_map);
    if joins.unwrap_or(best > TRYING_TO_JOIN || !tried.finds_light) {
        let given = (targets, exact, &tried.sample);
        let ways = join::Ways::try_all(stage, settings, given, quantum, watch);
        rays += ways.rays;
        let part = tried.part(best);
        if let Some(joined) = ways.choose(stage, settings, (&tried.trial, part), targets, quantum) {
            rays += joined.rays + choice.as_ref().map_or(0, Choice::rays_so_far);
            return Decision { joined: Some(joined), frozen: None, rays };
        }
    }
    match choice {
        Some(choice) if joins == Some(false) || of_map < of_plain => {
            let worth = tried.worth_per_lx(targets.len());
            let frozen = choice.freeze(stage, worth, watch);
            Decision { joined: None, frozen: Some(frozen), rays }
        }
        unused => {
            rays += unused.as_ref().map_or(0, Choice::rays_so_far);
            Decision { joined: None, frozen: None, rays }
        }
    }
}

/// A trial of paths that hardly end, and what it foretells of those that do.
struct Tried<S> {
    sample: Sample,
    trial: Trial,
    walks: Walks<S>,
    wanted: Wanted,
    /// Whether their spread tells anything.
    finds_light: bool,
    /// Variances of these paths in a run.
    noted: Vec<f64>,
    /// Of paths alone, and their rays in a trial.
    plain: (Vec<f64>, f64),
}

impl<S: Spectrum> Tried<S> {
    fn new(
        stage: &Stage<'_, S>,
        settings: &Settings,
        (targets, exact): (&[Target], &[Exact]),
        quantum: Quantum,
    ) -> Self {
        let sample = Sample::new(targets, exact);
        let (trial, walks) = Trial::of_noted_paths(stage, &sample, quantum);
        let found_lx = |(target, exact_lx): (usize, &f64)| exact_lx + trial.moments(target).mean;
        let means_lx = sample.exact_lx.iter().enumerate().map(found_lx).collect();
        let wanted = Wanted::new(settings, means_lx);
        let noted: Vec<f64> = wanted.variances(&trial).iter().map(|v| LATER * v).collect();
        let Outcome { of_chances, rays } = walks.alone(trial.rays, &wanted);
        let plain = noted.iter().zip(of_chances).map(|(v, of_chances)| v + of_chances).collect();
        let finds_light = trial.finds_light();
        Self { sample, trial, walks, wanted, finds_light, noted, plain: (plain, rays) }
    }

    fn noted(&self) -> Promise<'_> {
        Promise::of_paths(&self.noted, self.trial.rays)
    }

    fn plain(&self) -> Promise<'_> {
        Promise::of_paths(&self.plain.0, self.plain.1)
    }

    /// Of a run that keeps a promise.
    fn rays(&self, promise: &Promise<'_>) -> f64 {
        self.wanted.rays(&self.plain(), promise)
    }

    /// A map that these paths would end on.
    fn map(
        &self,
        stage: &Stage<'_, S>,
        settings: &Settings,
        watch: &mut Watch<'_>,
    ) -> Option<Choice<S>> {
        let promises = (&self.walks, &self.noted(), &self.plain());
        Choice::new(stage, settings, promises, &self.wanted, watch)
    }

    /// So many rays over those of paths like these.
    fn part(&self, rays: f64) -> f64 {
        let of_noted = self.rays(&self.noted());
        // What paths do not find, a map seems to do without.
        if self.finds_light && of_noted > 0.0 { rays / of_noted } else { 1.0 }
    }

    /// What a lux counts at each target: what it does at the one that was looked at before it; so much that every path goes on
    /// where nothing was found.
    fn worth_per_lx(&self, targets: usize) -> Vec<f64> {
        let of = |target: usize| match self.wanted.worth_per_lx(target / self.sample.step) {
            0.0 => UNKNOWN_WORTH,
            worth => worth,
        };
        (0..targets).map(of).collect()
    }
}
