//! One map that is frozen before the first path, which paths end on, and which some of them correct.
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
//! ([`survival`]). A trial traces paths that hardly end, and notes what they found beyond each surface ([`Note`]). By
//! the two lines above each of them predicts what it would have cost with any q, and what it would have cost alone, with
//! nothing in place of M and the albedo in place of q ([`walk`], [`trips`]). The noise of the map says what more photons
//! would mend. The q and the number of photons are taken that promise the fewest rays in all ([`pilot`]).

mod pilot;
mod survival;
#[cfg(test)]
mod tests;
mod trips;
mod walk;

pub(crate) use pilot::{Choice, MAX_PHOTONS, of_plan};
pub(crate) use trips::{Outcome, RayCounts, Walks};

use crate::codec::{Stored, Writer};
use crate::path::end::MapFacts;
use crate::photon::map::{IlluminationMap, MapLayout, MapTally, Place};
use crate::spectrum::Spectrum;
use crate::world::Interaction;
use survival::Survival;

/// With so many wanted bounces or fewer, and no more sides of elements, the map keeps light apart by its bounces, so that
/// paths may end on it anywhere; else only at the first surface.
const MAX_LAYERS: u32 = 16;
const MAX_LAYERED_SIDES: u64 = 1 << 21;

/// A map with what is known of how good it is.
pub(crate) struct FrozenMap<S> {
    layout: MapLayout,
    tally: MapTally<S>,
    /// Flux of a photon.
    photon_lm: f64,
    /// Whether its photons left lit places.
    first_shot: bool,
    survival: Survival,
    /// What a lux at each target counts: one over the error that matters there, 0 where that is not known.
    importance_per_lx: Vec<f64>,
}

/// How paths of one target end on it.
pub(crate) struct FrozenEnd<'m, S> {
    pub(crate) layout: &'m MapLayout,
    pub(crate) map: IlluminationMap<'m, S>,
    survival: &'m Survival,
    importance_per_lx: f64,
}

/// What a path found beyond a surface.
#[derive(Clone, Debug)]
pub(crate) struct Note<S> {
    pub(crate) at: Interaction,
    /// What a lux there counts at the start of the path; `None` where no map is.
    pub(crate) weight: Option<S>,
    /// With what probability a path without a map goes on, where this one did for certain.
    pub(crate) alone: f64,
    /// Reflections before it, and rays up to it.
    pub(crate) bounces: u32,
    pub(crate) flights: u32,
    /// What had been found by the next surface: before and with what that emits.
    pub(crate) before: Option<[S; 2]>,
    /// What was found after that: what a path without a map would miss if it ended here, and one with.
    pub(crate) beyond: [S; 2],
}

impl<S: Spectrum> Note<S> {
    /// So much was found by the next surface, unless that was said before.
    pub(crate) fn begin(&mut self, found: [S; 2]) {
        self.before.get_or_insert(found);
    }

    /// This is all that the path found.
    pub(crate) fn end(&mut self, found: S) {
        if let Some(before) = self.before {
            self.beyond = before.map(|before| found + before * -1.0);
        }
    }
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
        out.f64(*photon_lm);
        out.bool(*first_shot);
        survival.put(out);
        out.f64s(importance_per_lx);
    }
}

impl<S: Spectrum> FrozenEnd<'_, S> {
    /// With what probability a path goes on from a place where a lux counts `weight` at its start, and the map has
    /// so much `light` by that measure; `None` where nothing is known of that.
    pub(crate) fn chance(&self, place: &Place, weight: f64, light: f64) -> Option<f64> {
        let [weight, light] = [weight, light].map(|lx| lx * self.importance_per_lx);
        self.survival.chance(place.element, weight, light)
    }
}

/// Layers of a map with so many sides of elements that tell apart what is to be told apart; the last counts all that
/// bounced more often.
pub(crate) fn layers(max_bounces: Option<u32>, listed_terms: u32, sides: u64) -> u32 {
    match max_bounces {
        Some(most) if is_layered(most, sides) => most.saturating_sub(1).max(1),
        _ => listed_terms.saturating_sub(1).max(1),
    }
}

/// Most bounces of light on a map with so many sides of elements that may come to a start by a surface that was met after
/// `bounces`; `None` where paths do not end on it.
pub(crate) fn bounces_left(max_bounces: Option<u32>, bounces: u32, sides: u64) -> Option<u32> {
    let Some(most) = max_bounces else { return Some(u32::MAX) };
    let left = most.saturating_sub(bounces + 1);
    (left > 0 && (is_layered(most, sides) || bounces == 0)).then_some(left)
}

fn is_layered(max_bounces: u32, sides: u64) -> bool {
    max_bounces <= MAX_LAYERS && sides <= MAX_LAYERED_SIDES
}
