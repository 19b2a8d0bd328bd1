//! What the paths of a run end on: nothing, one frozen map, or a map for each replicate.

use crate::map::{IlluminationMap, MapLayout, MapReceiver, MapTally, refined};
use crate::path::Onward;
use crate::photon::PhotonCounts;
use crate::photons::{PhotonBatch, trace_photons};
use crate::settings::{Estimator, Settings};
use crate::spectrum::Spectrum;
use crate::stage::{Stage, Stream};
use crate::steering::{self, Plan, Windows};
use crate::targets::Target;
use crate::trial::Way;
use crate::watch::Watch;
use crate::world::Interaction;
use quasilux_sampling::SampleCursor;
use std::ops::Range;

/// Share of the paths that correct the map. With few the error of the correction prevails (on the
/// diffuse cube a share of 0.1 takes 18 times as long to the same error as plain paths, 0.6 three
/// times); with all of them these are plain paths.
const CORRECTED_SHARE: f64 = 0.6;
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
    },
    /// A map for each replicate that grows with it.
    Own {
        layout: MapLayout,
        tallies: Vec<MapTally<S>>,
        /// Flux of a photon.
        flux_lm: f64,
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
    /// Share of the paths that go on to correct the map; `None` leaves its bias.
    pub(crate) corrected_share: Option<f64>,
}

/// What happened to the maps before more paths are traced.
pub(crate) enum Growth {
    None,
    NewMaps(PhotonCounts),
    Stopped,
}

impl<S: Spectrum> PathEnd<S> {
    /// Traces the photons that come before all paths.
    pub(crate) fn prepare(
        stage: &Stage<'_, S>,
        settings: &Settings,
        targets: &[Target],
        watch: &mut Watch<'_>,
    ) -> (Self, PhotonCounts) {
        // Before the first checkpoint the observer stops nothing, so there are always counts.
        let plan = |photons: u64, receiver: Option<MapReceiver<'_, S>>, watch: &mut Watch<'_>| {
            let batch = PhotonBatch {
                stream: Stream::PlanPhotons,
                replicates: 0..1,
                indices: 0..photons,
                way: Way::CoherentWaves,
                windows: None,
            };
            trace_photons(stage, &batch, |_| receiver, watch).unwrap_or_default()
        };
        if settings.estimator == Estimator::Path || settings.max_bounces == Some(0) {
            return (Self::Nothing, plan(BALANCE_PHOTONS, None, watch));
        }
        let (layout, mut counts) = refined(stage, settings, watch);
        if settings.estimator == Estimator::BidirectionalMap {
            let Plan { windows, rays } = steering::plan(stage, targets, settings.steering);
            counts.rays += rays;
            let lightest = windows.as_ref().map_or(1.0, Windows::lightest);
            let replicates = 0..settings.effective_replicates();
            let tallies = replicates.map(|_| MapTally::new(&layout, lightest)).collect();
            return (Self::Own { layout, tallies, flux_lm: 0.0, windows }, counts);
        }
        let photons = (2 * layout.len() as u64).next_power_of_two().clamp(1 << 14, 1 << 19);
        let tally = MapTally::new(&layout, 1.0);
        counts += plan(photons, Some(MapReceiver::new(stage, &layout, &tally)), watch);
        (Self::Plan { layout, tally, flux_lm: stage.lights.flux_lm / photons as f64 }, counts)
    }

    /// Adds the photons `indices` to maps that grow.
    pub(crate) fn grow(
        &mut self,
        stage: &Stage<'_, S>,
        indices: Range<u64>,
        watch: &mut Watch<'_>,
    ) -> Growth {
        let Self::Own { layout, tallies, flux_lm, windows } = self else { return Growth::None };
        let samples = indices.end;
        let receiver = |r: u32| Some(MapReceiver::new(stage, layout, &tallies[r as usize]));
        let batch = PhotonBatch {
            stream: Stream::Photons,
            replicates: 0..tallies.len() as u32,
            indices,
            way: Way::CoherentWaves,
            windows: windows.as_ref(),
        };
        let traced = trace_photons(stage, &batch, receiver, watch);
        let Some(counts) = traced else { return Growth::Stopped };
        *flux_lm = stage.lights.flux_lm / samples as f64;
        Growth::NewMaps(counts)
    }

    /// Where the paths of one replicate end.
    pub(crate) fn rest(&self, replicate: u32) -> Rest<'_, S> {
        match self {
            Self::Nothing => Rest::Path,
            Self::Plan { layout, tally, flux_lm } => {
                let map = tally.read(*flux_lm);
                Rest::Map(MapEnd { layout, map, corrected_share: Some(CORRECTED_SHARE) })
            }
            Self::Own { layout, tallies, flux_lm, .. } => {
                let map = tallies[replicate as usize].read(*flux_lm);
                Rest::Map(MapEnd { layout, map, corrected_share: None })
            }
        }
    }
}

impl<S: Spectrum> MapEnd<'_, S> {
    /// Illuminance in lx that the map has at a place.
    pub(crate) fn illuminance_lx(&self, at: &Interaction) -> S {
        self.map.illuminance_lx(&self.layout.locate(at))
    }

    /// Whether this path corrects the map. The direction to a light that the next surface emits is
    /// part of the direct light here, so it counts in every path.
    pub(crate) fn correct(&self, cursor: &mut SampleCursor<'_>) -> Onward {
        let Some(share) = self.corrected_share else {
            return Onward { emitted: 1.0, everything: 0.0 };
        };
        let corrects = cursor.choose_bool(share);
        Onward { emitted: 1.0, everything: if corrects { 1.0 / share } else { 0.0 } }
    }
}
