//! Pilot of a frozen map: its number of photons and the survival probability of paths, by the
//! fewest predicted rays.

use super::PathRecords;
use super::path_record::Ending;
use super::replay::{Outcome, Replay};
use crate::context::Context;
use crate::estimator::pilot::{ErrorTarget, PilotCost};
use crate::path::frozen_map::survival::{MIN, Survival};
use crate::path::frozen_map::{FrozenMap, TracedMap, bounces_left, layers};
use crate::photon::batch::{PhotonBatch, trace_photons};
use crate::photon::counts::PhotonCounts;
use crate::photon::first_shot::decide;
use crate::photon::lit_cells::LitCells;
use crate::photon::map::{MapLayout, MapReceiver, MapTally};
use crate::photon::trace::Source;
use crate::settings::Settings;
use crate::spectrum::Spectrum;
use crate::stats::efficiency::cheapest;
use crate::stats::watch::Watch;
use std::f64::consts::SQRT_2;

/// Photons of the pilot for each side of an element, and the part of the run's rays, 1 over this,
/// that they may be.
const PHOTONS_PER_ELEMENT: u64 = 8;
const PHOTONS_SHARE: u64 = 32;
/// The part of them, 1 over this, that it may take to find where light lands.
const FIRST_SHOT_SHARE: u64 = 8;
/// Bounds on them, and on those of a map.
const PILOT_PHOTONS: [u64; 2] = [1 << 12, 1 << 16];
pub(crate) const MAX_PHOTONS: u64 = 1 << 20;
/// The search begins where paths go on with about the least probability; each step is a factor of
/// sqrt(2).
const STEPS: u32 = 16;

/// A map as a pilot left it, and what is best made of it.
pub(crate) struct MapPilot<S> {
    map: Growing<S>,
    use_of_it: Use,
    /// Whether its photons found much that the paths of the trial did not.
    pub(crate) misses_light: bool,
}

/// The paths of a trial, and their cost.
pub(crate) struct PathPilot<'p, S> {
    pub(crate) records: &'p PathRecords<S>,
    /// As they were traced, nearly without Russian roulette.
    pub(crate) recorded: &'p PilotCost<'p>,
    /// Ended by Russian roulette, on no map.
    pub(crate) alone: &'p PilotCost<'p>,
}

/// Survival probabilities and photons of a map, and the cost of a run with them.
struct Use {
    survival: Survival,
    photons: u64,
    /// Of each target that is seen, for a trial.
    variances: Vec<f64>,
    /// Rays of a trial.
    rays: f64,
    /// Rays before the first path that are still to be traced.
    beforehand: f64,
}

/// A map that gets its photons.
struct Growing<S> {
    layout: MapLayout,
    tally: MapTally<S>,
    lit_cells: Option<LitCells>,
    /// Of photons that count.
    max_bounces: u32,
    photons: u64,
    counts: PhotonCounts,
}

impl<S: Spectrum> MapPilot<S> {
    /// Tries a map on the paths of a trial; `None` where too few bounces are wanted for any.
    pub(crate) fn new(
        context: &Context<'_, S>,
        settings: &Settings,
        paths: &PathPilot<'_, S>,
        wanted: &ErrorTarget,
        watch: &mut Watch<'_>,
    ) -> Option<Self> {
        let PathPilot { records, recorded, alone } = paths;
        let affordable = wanted.rays(alone, alone) as u64;
        let mut map = Growing::new(context, settings, affordable / FIRST_SHOT_SHARE)?;
        let before = map.counts.rays;
        let pilots = PHOTONS_PER_ELEMENT * map.layout.len() as u64;
        let pilots = pilots.min(affordable / PHOTONS_SHARE);
        let [min, max] = PILOT_PHOTONS;
        let pilots = pilots.clamp(min, max).next_power_of_two();
        map.grow(context, pilots, watch);
        let rays_for_photon = (map.counts.rays - before) as f64 / pilots as f64;
        let paths =
            records.on(context, &map.layout, &map.tally.read(map.photon_lm(context)), wanted);
        let noise_share = paths.noise_share();
        let uses = candidates(&paths).into_iter().flat_map(|survival| {
            let Outcome { variances, rays } = paths.outcome(Ending::OnMap(&survival), wanted);
            let with_photons = move |doublings| {
                let photons = pilots << doublings;
                // More photons take out noise.
                let off = 1.0 - noise_share * (1.0 - pilots as f64 / photons as f64);
                let beforehand = (photons - pilots) as f64 * rays_for_photon;
                let variances = variances.iter().zip(recorded.variances);
                let variances = variances.map(|(more, v)| v + off * more).collect();
                Use { survival: survival.clone(), photons, variances, rays, beforehand }
            };
            (0..=(MAX_PHOTONS / pilots).ilog2()).map(with_photons)
        });
        let use_of_it = cheapest(uses, |tried| wanted.rays(alone, &tried.pilot_cost()))?;
        let misses_light = paths.miss_light(wanted);
        Some(Self { map, use_of_it, misses_light })
    }

    /// What it promises.
    pub(crate) fn pilot_cost(&self) -> PilotCost<'_> {
        self.use_of_it.pilot_cost()
    }

    /// Its photons where it is not taken, if they left the lights and so say where the flux goes;
    /// of others it adds the rays.
    pub(crate) fn give_up(self, rays: &mut u64) -> Option<PhotonCounts> {
        let Growing { lit_cells, counts, .. } = self.map;
        if lit_cells.is_some() {
            *rays += counts.rays;
        }
        lit_cells.is_none().then_some(counts)
    }

    /// The map with all its photons, for targets with these weights of a lux.
    pub(crate) fn freeze(
        mut self,
        context: &Context<'_, S>,
        importance_per_lx: Vec<f64>,
        watch: &mut Watch<'_>,
    ) -> TracedMap<S> {
        let Use { survival, photons, .. } = self.use_of_it;
        self.map.grow(context, photons, watch);
        let photon_lm = self.map.photon_lm(context);
        let Growing { layout, tally, lit_cells, counts, .. } = self.map;
        let first_shot = lit_cells.is_some();
        let map = FrozenMap { layout, tally, photon_lm, first_shot, survival, importance_per_lx };
        TracedMap { map, counts }
    }
}

impl Use {
    fn pilot_cost(&self) -> PilotCost<'_> {
        let Self { variances, rays, beforehand, .. } = self;
        PilotCost { variances, of_paths: *rays, of_photons: 0.0, beforehand: *beforehand }
    }
}

/// Survival probabilities from low ones to nearly one.
fn candidates(paths: &Replay) -> Vec<Survival> {
    let survival = paths.survival();
    let usual = paths.usual_loss(&survival);
    let first = if usual > 0.0 { MIN / usual } else { 0.0 };
    let sureness = |step: u32| first * libm::pow(SQRT_2, f64::from(step));
    (0..=STEPS).map(|step| survival.with_sureness(sureness(step))).collect()
}

impl<S: Spectrum> Growing<S> {
    fn new(context: &Context<'_, S>, settings: &Settings, max_rays: u64) -> Option<Self> {
        let layout = MapLayout::coarsest(&context.world, settings);
        let sides = layout.len() as u64;
        let max_bounces = bounces_left(context.max_bounces, 0, sides)?;
        let mut counts = PhotonCounts::default();
        let lit_cells = decide(context, settings, max_rays, &mut counts);
        let layers = layers(context.max_bounces, context.listed_terms, sides);
        let lightest = Source::from_lit_cells(lit_cells.as_ref()).usual_weight();
        let tally = MapTally::new(&layout, lightest, layers);
        Some(Self { layout, tally, lit_cells, max_bounces, photons: 0, counts })
    }

    /// Adds photons up to this one.
    fn grow(&mut self, context: &Context<'_, S>, photons: u64, watch: &mut Watch<'_>) {
        let Self { layout, tally, lit_cells, max_bounces, .. } = &*self;
        let source = Source::from_lit_cells(lit_cells.as_ref());
        let receiver = MapReceiver::up_to(*max_bounces, context.map_dimensions, layout, tally);
        let batch = PhotonBatch::for_plan(source, self.photons..photons);
        // Before the first checkpoint the observer stops nothing, so there are always counts.
        let counts = trace_photons(context, &batch, |_| receiver, watch).unwrap_or_default();
        self.counts += source.counted(counts);
        self.photons = photons;
    }

    /// Flux of a photon.
    fn photon_lm(&self, context: &Context<'_, S>) -> f64 {
        context.lights.flux_lm / self.photons as f64
    }
}
