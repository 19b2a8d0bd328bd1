//! Tallies of the photons of caustics: on map elements, on disks around sensor points, on cells.

use super::{CellReceiver, Key, Receivers};
use crate::lights::images::LightPathClass;
use crate::photon::map::QUANTA_PER_PHOTON;
use crate::photon::receiver::{PhotonReceiver, ReceiverCounts};
use crate::spectrum::Spectrum;
use crate::stats::tally::checked_quanta;
use crate::world::flight::Flight;
use crate::world::{Interaction, World};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicI64, Ordering};
use std::sync::{Mutex, PoisonError};

/// Photons counted in one replicate, in quanta.
pub(super) struct Tally {
    pub(super) landings: Mutex<BTreeMap<Key, [i64; 3]>>,
    /// By number of bounces, where terms are listed, and by target.
    pub(super) targets: Vec<Vec<AtomicI64>>,
}

/// Counts the photons that no image shows.
pub(super) struct HiddenReceiver<'a, S> {
    pub(super) world: &'a World<S>,
    pub(super) element_m: f64,
    pub(super) receivers: &'a Receivers,
    pub(super) ends: &'a [Option<u64>],
    pub(super) tally: &'a Tally,
    pub(super) tells_bounces: bool,
    /// Contributions that the tally refused.
    pub(super) invalid: u64,
}

impl Tally {
    pub(super) fn new(targets: usize, listed_terms: u32) -> Self {
        let zeros = || (0..targets).map(|_| AtomicI64::new(0)).collect();
        let targets = (0..=listed_terms).map(|_| zeros()).collect();
        Self { landings: Mutex::new(BTreeMap::new()), targets }
    }

    /// Adds to a target; 1 where the contribution was refused.
    fn count(&self, target: usize, photons: f64, bounces: u32) -> u64 {
        let Some(quanta) = checked_quanta(photons, QUANTA_PER_PHOTON) else { return 1 };
        let term = (self.targets.len() - 1).min(bounces as usize);
        self.targets[term][target].fetch_add(quanta, Ordering::Relaxed);
        0
    }

    /// Adds to an element, channel by channel; how many of them were refused.
    fn land<S: Spectrum>(&self, key: Key, weight: S) -> u64 {
        let mut landings = self.landings.lock().unwrap_or_else(PoisonError::into_inner);
        let counts = landings.entry(key).or_default();
        let mut refused = 0;
        for (channel, count) in counts.iter_mut().enumerate().take(S::CHANNELS) {
            match checked_quanta(weight.channel(channel), QUANTA_PER_PHOTON) {
                Some(quanta) => *count += quanta,
                None => refused += 1,
            }
        }
        refused
    }
}

impl<S> HiddenReceiver<'_, S> {
    fn count(&mut self, target: usize, photons: f64, bounces: u32) {
        if self.ends[target].is_none() {
            self.invalid += self.tally.count(target, photons, bounces);
        }
    }
}

impl<S: Spectrum> PhotonReceiver<S> for HiddenReceiver<'_, S> {
    const SPECULAR_ONLY: bool = true;

    fn flight(&mut self, _: &Flight, _: S, _: u32) {}

    fn landing(&mut self, _: &Interaction, _: S, _: u32) {}

    fn specular_flight(
        &mut self,
        flight: &Flight,
        weight: S,
        bounces: u32,
        path_class: LightPathClass,
    ) {
        if path_class != LightPathClass::Caustic {
            return;
        }
        let receivers = self.receivers;
        for CellReceiver { plane, behind, first_target, cells } in &receivers.planes {
            for plane in std::iter::once(plane).chain(behind) {
                if let Some(cell) = plane.cell(flight).filter(|cell| cells.contains(cell)) {
                    let photons = weight.luminance() * plane.tilt_factor(flight.direction);
                    self.count(first_target + cell - cells.start, photons, bounces);
                }
            }
        }
        for disc in receivers.discs.iter().filter(|disc| disc.is_met(flight)) {
            self.count(disc.target, weight.luminance(), bounces);
        }
    }

    fn specular_landing(
        &mut self,
        at: &Interaction,
        weight: S,
        bounces: u32,
        path_class: LightPathClass,
    ) {
        if path_class != LightPathClass::Caustic {
            return;
        }
        let bounces = if self.tells_bounces { bounces } else { 0 };
        let key = Key::new(self.world, at, self.element_m, bounces);
        self.invalid += self.tally.land(key, weight);
    }

    fn finish(self) -> ReceiverCounts {
        ReceiverCounts { rays: 0, invalid: self.invalid }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasilux_scene::Rgb;

    #[test]
    fn invalid_photons_are_refused_and_counted() {
        let (tally, key) = (Tally::new(1, 0), Key { facet: 0, element: 0, bounces: 0 });
        for bad in [f64::NAN, f64::INFINITY, -1.0] {
            assert_eq!((tally.count(0, bad, 0), tally.land(key, bad)), (1, 1), "{bad}");
        }
        assert_eq!(tally.land(key, Rgb([1.0, f64::NAN, -1.0])), 2);
        assert_eq!(tally.targets[0][0].load(Ordering::Relaxed), 0);
        let one = QUANTA_PER_PHOTON as i64;
        assert_eq!(tally.landings.into_inner().unwrap()[&key], [one, 0, 0]);
    }
}
