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

use crate::correction::{Choice, FrozenMap};
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
    let sample = Sample::new(targets, exact);
    let (alone, walks) = Trial::of_noted_paths(stage, &sample, quantum);
    let mut rays = alone.rays as u64;
    let found_lx = |target: usize| sample.exact_lx[target] + alone.moments(target).mean;
    let wanted = Wanted::new(settings, (0..sample.targets.len()).map(found_lx).collect());
    let noted: Vec<f64> = wanted.variances(&alone).iter().map(|v| LATER * v).collect();
    let plain = walks.alone(alone.rays, &wanted);
    let of_plain: Vec<f64> = noted.iter().zip(&plain.of_chances).map(|(v, of)| v + of).collect();
    let noted = Promise::of_paths(&noted, alone.rays);
    let plain = Promise::of_paths(&of_plain, plain.rays);
    let of_plain = wanted.rays(&plain, &plain);
    let tries_map = match joins {
        Some(joins) => !joins,
        None => of_plain > TRYING_A_MAP || !alone.finds_light(),
    };
    let choice = if tries_map {
        Choice::new(stage, settings, (&walks, &noted, &plain), &wanted, watch)
    } else {
        None
    };
    let of_map = choice.as_ref().map(|choice| wanted.rays(&plain, &choice.promise()));
    let best = of_map.map_or(of_plain, |of_map| of_map.min(of_plain));
    let tries_to_join = match joins {
        Some(joins) => joins,
        None => best > TRYING_TO_JOIN || !alone.finds_light(),
    };
    if tries_to_join {
        let ways = join::Ways::try_all(stage, settings, targets, (exact, &sample), quantum, watch);
        rays += ways.rays;
        let of_noted = wanted.rays(&plain, &noted);
        // What paths do not find, a map seems to do without.
        let is_known = alone.finds_light() && of_noted > 0.0;
        let part = if is_known { best / of_noted } else { 1.0 };
        if let Some(joined) = ways.choose(stage, settings, (&alone, part), targets, quantum) {
            rays += joined.rays + choice.map_or(0, |choice: Choice<S>| choice.rays_so_far());
            return Decision { joined: Some(joined), frozen: None, rays };
        }
    }
    let keeps_map = joins == Some(false) || of_map.is_some_and(|of_map| of_map < of_plain);
    let Some(choice) = choice else { return Decision { rays, ..Decision::default() } };
    if !keeps_map {
        rays += choice.rays_so_far();
        return Decision { rays, ..Decision::default() };
    }
    let worth = (0..targets.len()).map(|target| wanted.worth_per_lx(target / sample.step));
    let frozen = choice.freeze(stage, worth.collect(), watch);
    Decision { joined: None, frozen: Some(frozen), rays }
}
