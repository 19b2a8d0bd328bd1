//! One map that is frozen before the first path, which all paths end on, and which some of them correct.
//!
//! A path may end at every diffuse surface that it comes to. With probability q it goes on instead and takes along
//! the difference between what it finds and what the map said, weighted by 1 / q: the map is a control variate, so its
//! mean is right for any map and any q, as long as neither knows the path's coordinates. What q is best is a matter of
//! variance and rays. A path that ended or went on by chance at a surface where a lux counts w at its start, where the
//! map has M lux and the path would find F, has
//!
//! ```text
//! variance = (1 / q - 1) w^2 (F - M)^2 + (1 / q) variance of what lies beyond
//! rays     = q (rays of what lies beyond)
//! ```
//!
//! so q should grow in proportion to `w |F - M|`, relative to what the path's start wants to know
//! ([`survival`]). A pilot traces paths that hardly end and notes what they found beyond each surface ([`Note`]);
//! these foretell what paths alone would cost, which end by chance without a map, what any q would have cost ([`walk`]), and the noise of the map says what more photons would mend.
//! Of all these the pair is taken that asks for the fewest rays in all ([`pilot`]).

mod pilot;
mod survival;
#[cfg(test)]
mod tests;
mod trips;
mod walk;

pub(crate) use pilot::{Choice, MOST_PHOTONS, of_plan};
pub(crate) use survival::Survival;
pub(crate) use trips::{Outcome, Walks};

use crate::map::{IlluminationMap, MapLayout, MapTally, Place};
use crate::path_end::MapFacts;
use crate::spectrum::Spectrum;
use crate::state::{Stored, Writer};
use crate::world::Interaction;

/// With so many wanted bounces or fewer, the map keeps light apart by its bounces, so that paths may end on it
/// anywhere; with more, only at the first surface.
pub(crate) const MOST_LAYERS: u32 = 16;

/// A map with what is known of how good it is.
pub(crate) struct FrozenMap<S> {
    pub(super) layout: MapLayout,
    pub(super) tally: MapTally<S>,
    /// Flux of a photon.
    pub(super) photon_lm: f64,
    /// Whether its photons left lit places.
    pub(super) first_shot: bool,
    pub(super) survival: Survival,
    /// What a lux at each target counts: one over the error that matters there.
    pub(super) worth_per_lx: Vec<f64>,
}

/// How paths of one target end on it.
pub(crate) struct FrozenEnd<'m, S> {
    pub(crate) layout: &'m MapLayout,
    pub(crate) map: IlluminationMap<'m, S>,
    survival: &'m Survival,
    worth_per_lx: f64,
}

/// What a path found beyond a diffuse surface.
#[derive(Clone, Debug)]
pub(crate) struct Note<S> {
    pub(super) at: Interaction,
    /// What a lux there counts at the start of the path.
    pub(super) weight: S,
    /// With what probability a path that ends on no map goes on, where this one did for certain.
    pub(super) alone: f64,
    /// Reflections before it, and rays up to it.
    pub(super) bounces: u32,
    pub(super) flights: u32,
    /// What had been found by the next surface, of light that came straight from lights to this one and before; then what
    /// was found in the end beyond that.
    found: Option<S>,
}

impl<S: Spectrum> Note<S> {
    pub(crate) fn new(
        at: &Interaction,
        weight: S,
        alone: f64,
        (bounces, flights): (u32, u32),
    ) -> Self {
        Self { at: *at, weight, alone, bounces, flights, found: None }
    }

    /// All that was found so far has nothing to do with the map at its surface, unless that was said before.
    pub(crate) fn begin(&mut self, found: S) {
        self.found.get_or_insert(found);
    }

    /// This is all that the path found.
    pub(crate) fn end(&mut self, found: S) {
        let before = self.found.unwrap_or(found);
        self.found = Some(found + before * -1.0);
    }

    /// What it found beyond, as a luminance or illuminance at its start.
    pub(super) fn beyond(&self) -> f64 {
        let found = self.found.map_or(0.0, |found| found.luminance());
        // The run counts and reports what is no number.
        if found.is_finite() { found } else { 0.0 }
    }
}

impl<S: Spectrum> FrozenMap<S> {
    /// Layers that tell apart what is to be told apart, of which the last counts all that bounced more often.
    pub(super) fn layers(max_bounces: Option<u32>, listed_terms: u32) -> u32 {
        match max_bounces {
            Some(most) if most <= MOST_LAYERS => most.saturating_sub(1).max(1),
            _ => listed_terms.saturating_sub(1).max(1),
        }
    }

    pub(crate) fn end(&self, target: usize) -> FrozenEnd<'_, S> {
        let Self { layout, tally, photon_lm, survival, worth_per_lx, .. } = self;
        let map = tally.read(*photon_lm);
        FrozenEnd { layout, map, survival, worth_per_lx: worth_per_lx[target] }
    }

    pub(crate) fn facts(&self) -> MapFacts {
        let elements = Some(self.layout.len() as u64);
        MapFacts { elements, first_shot: self.first_shot, is_steered: false }
    }

    /// Puts it among the decisions.
    pub(crate) fn put(&self, out: &mut Writer) {
        let Self { layout, tally, photon_lm, first_shot, survival, worth_per_lx } = self;
        layout.put(out);
        tally.put(out);
        out.f64(*photon_lm);
        out.bool(*first_shot);
        survival.put(out);
        out.f64s(worth_per_lx);
    }
}

impl<S: Spectrum> FrozenEnd<'_, S> {
    /// Most bounces of light on the map that may come to a start by a surface that was met after `bounces`; `None`
    /// where paths do not end on it.
    pub(crate) fn bounces_left(&self, max_bounces: Option<u32>, bounces: u32) -> Option<u32> {
        bounces_left(max_bounces, bounces)
    }

    /// With what probability a path goes on from a place where a lux counts `weight` at its start, and the map has
    /// so much `light` by that measure.
    pub(crate) fn chance(&self, place: &Place, weight: f64, light: f64) -> f64 {
        let [weight, light] = [weight, light].map(|lx| lx * self.worth_per_lx);
        self.survival.chance(place.element, weight, light)
    }
}

/// See [`FrozenEnd::bounces_left`].
fn bounces_left(max_bounces: Option<u32>, bounces: u32) -> Option<u32> {
    let Some(most) = max_bounces else { return Some(u32::MAX) };
    let left = most.saturating_sub(bounces + 1);
    (left > 0 && (most <= MOST_LAYERS || bounces == 0)).then_some(left)
}
