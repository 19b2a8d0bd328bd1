//! Illumination maps that paths end on: none, or a growing map for each replicate.

use crate::codec::{Reader, StateError, Stored, Writer};
use crate::context::{Context, Stream};
use crate::control::observer::Snapshot;
use crate::control::watch::Watch;
use crate::importance::{self, Plan, WeightWindows};
use crate::photon::batch::{PhotonBatch, trace_photons, trace_photons_with_snapshots};
use crate::photon::counts::PhotonCounts;
use crate::photon::first_shot::decide;
use crate::photon::lit_cells::LitCells;
use crate::photon::map::{IlluminationMap, MapLayout, MapReceiver, MapTally, refined};
use crate::photon::order::PhotonOrder;
use crate::photon::trace::{PhotonSetup, Source};
use crate::sensors::Target;
use crate::settings::{EstimatorKind, Settings};
use crate::spectrum::Spectrum;
use std::ops::Range;

/// Photons that only balance the flux, where the estimator needs none.
const BALANCE_PHOTONS: u64 = 1 << 12;

/// Maps that paths end on, if any.
pub(crate) enum PathEnd<S> {
    Nothing,
    Maps(Box<OwnMaps<S>>),
}

/// A map for each replicate that grows with it.
pub(crate) struct OwnMaps<S> {
    layout: MapLayout,
    tallies: Vec<MapTally<S>>,
    /// Photons of each so far.
    photons: u64,
    /// Photons for every path of a sensor point.
    photons_per_path: u64,
    /// Where photons leave from instead of the point-like lights.
    lit_cells: Option<LitCells>,
    /// Weight windows and guides of their photons.
    windows: Option<WeightWindows>,
}

/// Facts about the maps that paths end on, for reports.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct MapFacts {
    /// Sides of elements; `None` without maps.
    pub(crate) elements: Option<u64>,
    /// Whether photons leave lit places.
    pub(crate) first_shot: bool,
    /// Whether they are guided.
    pub(crate) uses_importance: bool,
}

/// The end of the paths, and the photons that were traced for it.
pub(crate) struct Prepared<S> {
    pub(crate) end: PathEnd<S>,
    pub(crate) counts: PhotonCounts,
}

/// How paths end on a map.
pub(crate) struct MapEnd<'m, S> {
    pub(crate) layout: &'m MapLayout,
    pub(crate) map: IlluminationMap<'m, S>,
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
    pub(crate) fn illuminance_lx(&self, context: &Context<'_, S>, target: &Target) -> Option<f64> {
        let Target::Point { position, normal } = *target else { return None };
        let at = context.world.facet_under(position, normal)?;
        // With a limit, the map leaves out light that has no bounce left for the way to a sensor.
        if !context.world.bsdf(&at).keeps_illuminance() || context.max_bounces.is_some() {
            return None;
        }
        let place = self.layout.locate(&at);
        let map_lx = |tally: &MapTally<S>| tally.read(self.photon_lm).illuminance_lx(&place);
        Some(self.tallies.iter().map(|tally| map_lx(tally).luminance()).sum())
    }
}

impl<S: Spectrum> PathEnd<S> {
    /// Photons of all maps for each index.
    pub(crate) fn photons_of_an_index(&self, replicates: u32) -> u64 {
        match self {
            Self::Nothing => 0,
            Self::Maps(maps) => maps.photons_per_path.saturating_mul(u64::from(replicates)),
        }
    }
}

impl<S: Spectrum> PathEnd<S> {
    /// Prepares the end of paths of these settings; traces the photons that say where the flux
    /// goes.
    pub(crate) fn prepare(
        context: &Context<'_, S>,
        settings: &Settings,
        targets: &[Target],
        watch: &mut Watch<'_>,
    ) -> Prepared<S> {
        // Before the first checkpoint the observer stops nothing, so there are always counts.
        let balance = |watch: &mut Watch<'_>| {
            let batch = PhotonBatch::for_plan(Source::Lights, 0..BALANCE_PHOTONS);
            let none: Option<MapReceiver<'_, S>> = None;
            trace_photons(context, &batch, |_| none, watch).unwrap_or_default()
        };
        if settings.estimator != EstimatorKind::BidirectionalMap || settings.max_bounces == Some(0)
        {
            return Prepared { end: Self::Nothing, counts: balance(watch) };
        }
        let mut counts = PhotonCounts::default();
        let lit_cells = decide(context, settings, u64::MAX, &mut counts);
        if lit_cells.is_some() {
            counts += balance(watch);
        }
        let source = Source::from_lit_cells(lit_cells.as_ref());
        let layout = refined(context, settings, watch, &mut counts);
        let Plan { windows, rays, .. } = importance::plan(context, targets, settings.importance);
        counts.rays += rays;
        let lightest = windows.as_ref().map_or(source.usual_weight(), WeightWindows::lightest);
        let replicates = 0..settings.effective_replicates();
        // Light of b bounces on the map has b + 1 at the sensor.
        let layers = context.listed_terms.saturating_sub(1).max(1);
        let tallies = replicates.map(|_| MapTally::new(&layout, lightest, layers)).collect();
        let photons_per_path = u64::from(settings.map_photons.max(1));
        let maps = OwnMaps { layout, tallies, photons: 0, photons_per_path, lit_cells, windows };
        let end = Self::Maps(Box::new(maps));
        Prepared { end, counts }
    }

    /// Photons of each map that grows, from those so far to those that this many paths of a sensor
    /// point ask for; `None` where no map grows.
    pub(crate) fn photons(&self, samples: u64) -> Option<Range<u64>> {
        match self {
            Self::Nothing => None,
            Self::Maps(maps) => {
                let OwnMaps { photons, photons_per_path, .. } = &**maps;
                Some(*photons..samples.saturating_mul(*photons_per_path))
            }
        }
    }

    /// Facts about it, for reports.
    pub(crate) fn facts(&self) -> MapFacts {
        match self {
            Self::Nothing => MapFacts::default(),
            Self::Maps(maps) => MapFacts {
                elements: Some(maps.layout.len() as u64),
                first_shot: maps.lit_cells.is_some(),
                uses_importance: maps.windows.is_some(),
            },
        }
    }

    /// Puts out what was decided before the first path.
    pub(crate) fn put_decisions(&self, out: &mut Writer) {
        match self {
            Self::Nothing => {}
            Self::Maps(maps) => {
                let OwnMaps { layout, lit_cells, windows, .. } = &**maps;
                layout.put(out);
                lit_cells.iter().for_each(|cells| cells.put(out));
                windows.iter().for_each(|windows| windows.put(out));
            }
        }
    }

    /// Adds the photons up to `end` to maps that grow; `look` sees them grow. `None` when the
    /// observer stopped it.
    pub(crate) fn grow(
        &mut self,
        context: &Context<'_, S>,
        end: u64,
        look: impl Fn(&GrowingMaps<'_, S>) -> Option<Snapshot>,
        watch: &mut Watch<'_>,
    ) -> Option<PhotonCounts> {
        let Self::Maps(maps) = self else { return Some(PhotonCounts::default()) };
        let OwnMaps { layout, tallies, photons, lit_cells, windows, .. } = &mut **maps;
        let indices = *photons..end;
        let receiver = |r: u32| Some(MapReceiver::new(context, layout, &tallies[r as usize]));
        let source = Source::from_lit_cells(lit_cells.as_ref());
        let batch = PhotonBatch {
            stream: Stream::Photons,
            replicates: 0..tallies.len() as u32,
            indices,
            order: PhotonOrder::CoherentWaves,
            setup: PhotonSetup::by_chance(source, windows.as_ref()),
        };
        let before = batch.indices.start * tallies.len() as u64;
        let look = |emitted: u64| {
            let photon_lm = context.lights.flux_lm / (before + emitted) as f64;
            look(&GrowingMaps { layout, tallies, photon_lm })
        };
        let counts = trace_photons_with_snapshots(context, &batch, receiver, look, watch)?;
        *photons = end;
        Some(source.counted(counts))
    }

    /// Where the paths of one replicate end.
    pub(crate) fn map_end(
        &self,
        context: &Context<'_, S>,
        replicate: u32,
    ) -> Option<MapEnd<'_, S>> {
        let Self::Maps(maps) = self else { return None };
        let OwnMaps { layout, tallies, photons, .. } = &**maps;
        let flux_lm = context.lights.flux_lm / *photons as f64;
        Some(MapEnd { layout, map: tallies[replicate as usize].read(flux_lm) })
    }
}

/// Maps that grow.
impl<S> Stored for PathEnd<S> {
    fn put(&self, out: &mut Writer) {
        if let Self::Maps(maps) = self {
            out.value(&maps.photons);
            maps.tallies.as_slice().put(out);
        }
    }

    fn merge_from(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        match self {
            Self::Nothing => Ok(()),
            Self::Maps(maps) => {
                from.add_count(&mut maps.photons)?;
                maps.tallies.as_mut_slice().merge_from(from)
            }
        }
    }
}
