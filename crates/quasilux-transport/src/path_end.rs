//! What the paths of a run end on: nothing, one frozen map, or a map for each replicate.

use crate::first_shot::{LitCells, decide};
use crate::map::{IlluminationMap, MapLayout, MapReceiver, MapTally, refined};
use crate::observer::Snapshot;
use crate::path::survival_factor;
use crate::photon::{PhotonCounts, Source};
use crate::photons::{PhotonBatch, trace_photons, trace_photons_in_view};
use crate::settings::{Estimator, Settings};
use crate::spectrum::Spectrum;
use crate::stage::{Stage, Stream};
use crate::state::{Reader, StateError, Stored, Writer};
use crate::steering::{self, Plan, Windows};
use crate::targets::Target;
use crate::trial::Way;
use crate::watch::Watch;
use crate::world::Interaction;
use quasilux_sampling::SampleCursor;
use std::ops::Range;

/// Surfaces that paths pass before they end on a map that is corrected: the light that comes from the
/// first two is most of the light, and maps are too coarse for it.
const PASSES: u32 = 2;
/// Photons for each element side of such a map. It has few elements, which many photons make smooth: the
/// correction takes out their bias, and would have to take out their noise.
const PHOTONS_PER_ELEMENT: u64 = 64;
/// Bounds on the photons of such a map.
const PLAN_PHOTONS: std::ops::RangeInclusive<u64> = 1 << 14..=1 << 19;
/// Photons that only balance the flux, where the estimator needs none.
const BALANCE_PHOTONS: u64 = 1 << 12;

/// What the paths end on.
pub(crate) enum PathEnd<S> {
    Nothing,
    /// One map, frozen before the first path, whose error is corrected.
    Plan {
        layout: MapLayout,
        tally: MapTally<S>,
        /// Flux of a photon.
        flux_lm: f64,
        /// Whether its photons left lit places.
        first_shot: bool,
    },
    /// A map for each replicate that grows with it.
    Own {
        layout: MapLayout,
        tallies: Vec<MapTally<S>>,
        /// Photons of each so far.
        photons: u64,
        /// Photons for every path of a sensor point.
        photons_per_path: u64,
        /// Where photons leave from instead of the point-like lights.
        lit_cells: Option<LitCells>,
        /// What steers their photons.
        windows: Option<Windows>,
    },
}

/// Where the light at the first diffuse surface comes from, but for the direct light.
pub(crate) enum Rest<'m, S> {
    /// From the path itself.
    Path,
    /// From the map.
    Map(MapEnd<'m, S>),
}

/// How paths end on a map.
pub(crate) struct MapEnd<'m, S> {
    pub(crate) layout: &'m MapLayout,
    pub(crate) map: IlluminationMap<'m, S>,
    /// Surfaces that keep illuminance to pass before.
    pub(crate) passes: u32,
    /// Whether survivors go on to correct the map.
    corrected: bool,
}

/// What is to know of what the paths end on.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct MapFacts {
    /// Sides of elements; `None` without a map.
    pub(crate) elements: Option<u64>,
    /// Whether photons of maps that grow leave lit places.
    pub(crate) first_shot: bool,
    /// Whether they are steered.
    pub(crate) is_steered: bool,
}

/// The maps of all replicates at a moment when no photon flies.
pub(crate) struct GrowingMaps<'m, S> {
    layout: &'m MapLayout,
    tallies: &'m [MapTally<S>],
    /// Flux of a photon, were all of them one replicate's.
    photon_lm: f64,
}

impl<S: Spectrum> GrowingMaps<'_, S> {
    /// Illuminance in lx by light that bounced, at a target that lies on a surface with a map.
    pub(crate) fn illuminance_lx(&self, stage: &Stage<'_, S>, target: &Target) -> Option<f64> {
        let Target::Point { position, normal } = *target else { return None };
        let at = stage.world.facet_under(position, normal)?;
        // With a limit, the map leaves out light that has no bounce left for the way to a sensor.
        if !stage.world.bsdf(&at).keeps_illuminance() || stage.max_bounces.is_some() {
            return None;
        }
        let place = self.layout.locate(&at);
        let map_lx = |tally: &MapTally<S>| tally.read(self.photon_lm).illuminance_lx(&place);
        Some(self.tallies.iter().map(|tally| map_lx(tally).luminance()).sum())
    }
}

impl<S: Spectrum> PathEnd<S> {
    /// Traces the photons that come before all paths. Where others are joined to the sensors, hardly a path
    /// goes far enough for a map, and so there is none.
    pub(crate) fn prepare(
        stage: &Stage<'_, S>,
        settings: &Settings,
        targets: &[Target],
        is_joined: bool,
        watch: &mut Watch<'_>,
    ) -> (Self, PhotonCounts) {
        // Before the first checkpoint the observer stops nothing, so there are always counts.
        let plan = |photons: u64,
                    source: Source<'_>,
                    receiver: Option<MapReceiver<'_, S>>,
                    watch: &mut Watch<'_>| {
            let batch = PhotonBatch {
                stream: Stream::PlanPhotons,
                replicates: 0..1,
                indices: 0..photons,
                way: Way::CoherentWaves,
                source,
                windows: None,
                certain_weight: f64::INFINITY,
            };
            trace_photons(stage, &batch, |_| receiver, watch).unwrap_or_default()
        };
        let is_path = match settings.estimator {
            Estimator::Path => true,
            Estimator::Bidirectional => is_joined,
            Estimator::Photon | Estimator::BidirectionalMap => false,
        };
        if is_path || settings.max_bounces == Some(0) {
            return (Self::Nothing, plan(BALANCE_PHOTONS, Source::Lights, None, watch));
        }
        let mut counts = PhotonCounts::default();
        let lit_cells = decide(stage, settings, &mut counts);
        if lit_cells.is_some() {
            // Those of the lit cells do not say where the flux of the lights goes.
            counts += plan(BALANCE_PHOTONS, Source::Lights, None, watch);
        }
        let source = Source::of(lit_cells.as_ref());
        if settings.estimator == Estimator::BidirectionalMap {
            let (layout, pilots) = refined(stage, settings, watch);
            counts += pilots;
            let Plan { windows, rays, .. } = steering::plan(stage, targets, settings.steering);
            counts.rays += rays;
            let lightest = windows.as_ref().map_or(source.usual_weight(), Windows::lightest);
            let replicates = 0..settings.effective_replicates();
            let tallies =
                replicates.map(|_| MapTally::new(&layout, lightest, layers(stage, 0))).collect();
            let photons_per_path = u64::from(settings.map_photons.max(1));
            let own =
                Self::Own { layout, tallies, photons: 0, photons_per_path, lit_cells, windows };
            return (own, counts);
        }
        // Of wanted bounces, the first are found by the paths.
        let most_bounces = match stage.max_bounces {
            None => u32::MAX,
            Some(most) if most > PASSES + 1 => most - 1 - PASSES,
            Some(_) => return (Self::Nothing, plan(BALANCE_PHOTONS, Source::Lights, None, watch)),
        };
        let layout = MapLayout::coarsest(&stage.world, settings);
        let wanted = (PHOTONS_PER_ELEMENT * layout.len() as u64).next_power_of_two();
        let photons = wanted.clamp(*PLAN_PHOTONS.start(), *PLAN_PHOTONS.end());
        let tally = MapTally::new(&layout, source.usual_weight(), layers(stage, PASSES));
        let receiver = MapReceiver::up_to(most_bounces, stage.map_dimensions, &layout, &tally);
        counts += source.counted(plan(photons, source, Some(receiver), watch));
        let flux_lm = stage.lights.flux_lm / photons as f64;
        (Self::Plan { layout, tally, flux_lm, first_shot: lit_cells.is_some() }, counts)
    }

    /// Photons of each map that grows, from those so far to those that so many paths of a sensor point ask for;
    /// `None` where no map grows.
    pub(crate) fn photons(&self, samples: u64) -> Option<Range<u64>> {
        match self {
            Self::Nothing | Self::Plan { .. } => None,
            Self::Own { photons, photons_per_path, .. } => {
                Some(*photons..samples.saturating_mul(*photons_per_path))
            }
        }
    }

    /// What there is to know of it.
    pub(crate) fn facts(&self) -> MapFacts {
        match self {
            Self::Nothing => MapFacts::default(),
            Self::Plan { layout, first_shot, .. } => MapFacts {
                elements: Some(layout.len() as u64),
                first_shot: *first_shot,
                is_steered: false,
            },
            Self::Own { layout, lit_cells, windows, .. } => MapFacts {
                elements: Some(layout.len() as u64),
                first_shot: lit_cells.is_some(),
                is_steered: windows.is_some(),
            },
        }
    }

    /// Puts out what was decided before the first path, a frozen map included.
    pub(crate) fn put_decisions(&self, out: &mut Writer) {
        match self {
            Self::Nothing => {}
            Self::Plan { layout, tally, flux_lm, first_shot } => {
                layout.put(out);
                tally.put(out);
                out.f64(*flux_lm);
                out.bool(*first_shot);
            }
            Self::Own { layout, lit_cells, windows, .. } => {
                layout.put(out);
                lit_cells.iter().for_each(|cells| cells.put(out));
                windows.iter().for_each(|windows| windows.put(out));
            }
        }
    }

    /// Adds the photons up to `end` to maps that grow; `look` sees them grow. `None` when the observer
    /// stopped it.
    pub(crate) fn grow(
        &mut self,
        stage: &Stage<'_, S>,
        end: u64,
        look: impl Fn(&GrowingMaps<'_, S>) -> Option<Snapshot>,
        watch: &mut Watch<'_>,
    ) -> Option<PhotonCounts> {
        let Self::Own { layout, tallies, photons, lit_cells, windows, .. } = self else {
            return Some(PhotonCounts::default());
        };
        let indices = *photons..end;
        let receiver = |r: u32| Some(MapReceiver::new(stage, layout, &tallies[r as usize]));
        let source = Source::of(lit_cells.as_ref());
        let batch = PhotonBatch {
            stream: Stream::Photons,
            replicates: 0..tallies.len() as u32,
            indices,
            way: Way::CoherentWaves,
            source,
            windows: windows.as_ref(),
            certain_weight: f64::INFINITY,
        };
        let before = batch.indices.start * tallies.len() as u64;
        let look = |emitted: u64| {
            let photon_lm = stage.lights.flux_lm / (before + emitted) as f64;
            look(&GrowingMaps { layout, tallies, photon_lm })
        };
        let counts = trace_photons_in_view(stage, &batch, receiver, look, watch)?;
        *photons = end;
        Some(source.counted(counts))
    }

    /// Where the paths of one replicate end.
    pub(crate) fn rest(&self, stage: &Stage<'_, S>, replicate: u32) -> Rest<'_, S> {
        match self {
            Self::Nothing => Rest::Path,
            Self::Plan { layout, tally, flux_lm, .. } => {
                let map = tally.read(*flux_lm);
                Rest::Map(MapEnd { layout, map, passes: PASSES, corrected: true })
            }
            Self::Own { layout, tallies, photons, .. } => {
                let flux_lm = stage.lights.flux_lm / *photons as f64;
                let map = tallies[replicate as usize].read(flux_lm);
                Rest::Map(MapEnd { layout, map, passes: 0, corrected: false })
            }
        }
    }
}

/// Maps that grow.
impl<S> Stored for PathEnd<S> {
    fn put(&self, out: &mut Writer) {
        if let Self::Own { tallies, photons, .. } = self {
            out.u64(*photons);
            tallies.as_slice().put(out);
        }
    }

    fn take_in(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        match self {
            Self::Nothing | Self::Plan { .. } => Ok(()),
            Self::Own { tallies, photons, .. } => {
                from.add_u64(photons)?;
                tallies.as_mut_slice().take_in(from)
            }
        }
    }
}

impl<S: Spectrum> MapEnd<'_, S> {
    /// Illuminance in lx that the map has at a place.
    pub(crate) fn illuminance_lx(&self, at: &Interaction) -> S {
        self.map.illuminance_lx(&self.layout.locate(at))
    }

    /// The parts of it by the number of bounces of the photons, the last of so many and more.
    pub(crate) fn terms_lx(&self, at: &Interaction) -> impl Iterator<Item = (u32, S)> {
        self.map.terms_lx(self.layout.locate(at))
    }

    /// How many times what lies beyond a surface of this albedo counts, 0 for paths that end here.
    pub(crate) fn goes_on(&self, albedo: f64, cursor: &mut SampleCursor<'_>) -> f64 {
        if self.corrected { survival_factor(albedo, cursor) } else { 0.0 }
    }
}

impl<S> Rest<'_, S> {
    /// Surfaces that keep illuminance to pass before the first that a path may end on.
    pub(crate) fn passes(&self) -> u32 {
        match self {
            Self::Path => u32::MAX,
            Self::Map(end) => end.passes,
        }
    }
}

/// Layers of a map that tell the listed terms apart, for paths that end on it after this many surfaces
/// or more: light of b bounces on the map has b + 1 more than these.
fn layers<S>(stage: &Stage<'_, S>, passes: u32) -> u32 {
    stage.listed_terms.saturating_sub(1 + passes).max(1)
}
