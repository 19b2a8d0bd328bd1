//! Frozen illumination map as a control variate: paths end on it, and those that go on correct it.
//!
//! `estimator/control_variate/` decides how many photons it gets, and with what probability paths
//! go on ([`survival`]).

pub(crate) mod survival;

use crate::codec::{Stored, Writer};
use crate::photon::counts::PhotonCounts;
use crate::photon::map::{IlluminationMap, MapLayout, MapPoint, MapTally};
use crate::spectrum::Spectrum;
use survival::Survival;

/// Up to these numbers of bounces and of sides of elements, the map keeps light apart by its
/// bounces, so that paths may end on it anywhere; else only at the first surface.
const MAX_LAYERS: u32 = 16;
const MAX_LAYERED_SIDES: u64 = 1 << 21;

/// Facts about the map that paths end on, for reports.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct MapFacts {
    /// Sides of elements; `None` without a map.
    pub(crate) elements: Option<u64>,
    /// Whether photons of maps that grow leave lit places.
    pub(crate) first_shot: bool,
    /// Whether they are guided.
    pub(crate) uses_importance: bool,
}

/// A map with an estimate of its error.
pub(crate) struct FrozenMap<S> {
    pub(crate) layout: MapLayout,
    pub(crate) tally: MapTally<S>,
    /// Flux of a photon.
    pub(crate) photon_lm: f64,
    /// Whether its photons left lit places.
    pub(crate) first_shot: bool,
    pub(crate) survival: Survival,
    /// What a lux at each target counts: one over the error that matters there, 0 where that is not
    /// known.
    pub(crate) importance_per_lx: Vec<f64>,
}

/// A frozen map with the counts of its photons.
pub(crate) struct TracedMap<S> {
    pub(crate) map: FrozenMap<S>,
    pub(crate) counts: PhotonCounts,
}

/// How paths of one target end on it.
pub(crate) struct FrozenEnd<'m, S> {
    pub(crate) layout: &'m MapLayout,
    pub(crate) map: IlluminationMap<'m, S>,
    survival: &'m Survival,
    importance_per_lx: f64,
}

impl<S: Spectrum> FrozenMap<S> {
    pub(crate) fn end(&self, target: usize) -> FrozenEnd<'_, S> {
        let Self { layout, tally, photon_lm, survival, importance_per_lx, .. } = self;
        let map = tally.read(*photon_lm);
        FrozenEnd { layout, map, survival, importance_per_lx: importance_per_lx[target] }
    }

    pub(crate) fn facts(&self) -> MapFacts {
        let elements = Some(self.layout.len() as u64);
        MapFacts { elements, first_shot: self.first_shot, uses_importance: false }
    }

    /// Puts it among the decisions.
    pub(crate) fn put(&self, out: &mut Writer) {
        let Self { layout, tally, photon_lm, first_shot, survival, importance_per_lx } = self;
        layout.put(out);
        tally.put(out);
        out.value(photon_lm);
        out.value(first_shot);
        survival.put(out);
        out.value(importance_per_lx);
    }
}

impl<S: Spectrum> FrozenEnd<'_, S> {
    /// With what probability a path goes on from a place where a lux counts `weight` at its start,
    /// and the map has so much `light` by that measure; `None` where nothing is known of that.
    pub(crate) fn survival_probability(
        &self,
        place: &MapPoint,
        weight: f64,
        light: f64,
    ) -> Option<f64> {
        let [weight, light] = [weight, light].map(|lx| lx * self.importance_per_lx);
        self.survival.survival_probability(place.element, weight, light)
    }
}

/// Number of layers that the limit on bounces and the listed terms ask for, of a map with `sides`;
/// the last counts all that bounced more often.
pub(crate) fn layers(max_bounces: Option<u32>, listed_terms: u32, sides: u64) -> u32 {
    match max_bounces {
        Some(most) if is_layered(most, sides) => most.saturating_sub(1).max(1),
        _ => listed_terms.saturating_sub(1).max(1),
    }
}

/// Largest number of bounces of light, on a map with `sides`, that may come to a start by a surface
/// that was met after `bounces`; `None` where paths do not end on it.
pub(crate) fn bounces_left(max_bounces: Option<u32>, bounces: u32, sides: u64) -> Option<u32> {
    let Some(most) = max_bounces else { return Some(u32::MAX) };
    let left = most.saturating_sub(bounces + 1);
    (left > 0 && (is_layered(most, sides) || bounces == 0)).then_some(left)
}

fn is_layered(max_bounces: u32, sides: u64) -> bool {
    max_bounces <= MAX_LAYERS && sides <= MAX_LAYERED_SIDES
}
