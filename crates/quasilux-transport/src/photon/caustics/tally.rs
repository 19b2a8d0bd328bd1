//! Tallies of caustic photons: on elements of an illumination map, on discs around sensor points,
//! on grid cells.

use super::{CellReceiver, Receivers};
use crate::lights::images::LightPathClass;
use crate::photon::map::{MapLayout, MapTally, QUANTA_PER_PHOTON};
use crate::photon::receiver::{PhotonReceiver, SeenPhoton};
use crate::spectrum::Spectrum;
use crate::stats::tally::checked_quanta;
use crate::world::Interaction;
use crate::world::flight::Flight;
use std::sync::atomic::{AtomicI64, Ordering};

/// Photons counted in one replicate.
pub(super) struct CausticTally<S> {
    pub(super) map: MapTally<S>,
    /// Quanta by number of bounces, where terms are listed, and by target.
    pub(super) targets: Vec<Vec<AtomicI64>>,
}

/// Counts the photons of [`LightPathClass::Caustic`].
pub(super) struct CausticReceiver<'a, S> {
    pub(super) layout: &'a MapLayout,
    pub(super) receivers: &'a Receivers,
    pub(super) ends: &'a [Option<u64>],
    pub(super) tally: &'a CausticTally<S>,
    /// Contributions that the tally refused.
    pub(super) invalid: u64,
}

impl<S: Spectrum> CausticTally<S> {
    pub(super) fn new(layout: &MapLayout, layers: u32, targets: usize, listed_terms: u32) -> Self {
        let zeros = || (0..targets).map(|_| AtomicI64::new(0)).collect();
        let targets = (0..=listed_terms).map(|_| zeros()).collect();
        Self { map: MapTally::new(layout, 1.0, layers), targets }
    }
}

impl<S> CausticReceiver<'_, S> {
    /// Adds to a target that is not frozen.
    fn count(&mut self, target: usize, photons: f64, bounces: u32) {
        if self.ends[target].is_some() {
            return;
        }
        let terms = &self.tally.targets;
        match checked_quanta(photons, QUANTA_PER_PHOTON) {
            Some(quanta) => {
                let term = &terms[(terms.len() - 1).min(bounces as usize)];
                term[target].fetch_add(quanta, Ordering::Relaxed);
            }
            None => self.invalid += 1,
        }
    }
}

impl<S: Spectrum> PhotonReceiver<S> for CausticReceiver<'_, S> {
    const SPECULAR_ONLY: bool = true;

    fn flight(&mut self, flight: &Flight, photon: &SeenPhoton<S>) {
        let &SeenPhoton { weight, bounces, specular_class } = photon;
        if specular_class != Some(LightPathClass::Caustic) {
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

    fn landing(&mut self, at: &Interaction, photon: &SeenPhoton<S>) {
        let &SeenPhoton { weight, bounces, specular_class } = photon;
        if specular_class == Some(LightPathClass::Caustic) {
            self.invalid += self.tally.map.add(&self.layout.locate(at), weight, bounces);
        }
    }

    fn finish(self) -> u64 {
        self.invalid
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::photon::map::fixture;
    use crate::settings::Settings;

    #[test]
    fn invalid_photons_are_refused_and_counted() {
        let layout = MapLayout::new(&fixture::square(), &Settings::default());
        let tally = CausticTally::<f64>::new(&layout, 1, 1, 0);
        let receivers = Receivers { planes: Vec::new(), discs: Vec::new(), areas_m2: vec![1.0] };
        let (layout, receivers, tally, ends) = (&layout, &receivers, &tally, &[None]);
        let mut receiver = CausticReceiver { layout, receivers, ends, tally, invalid: 0 };
        for bad in [f64::NAN, f64::INFINITY, -1.0] {
            receiver.count(0, bad, 0);
        }
        assert_eq!((receiver.invalid, tally.targets[0][0].load(Ordering::Relaxed)), (3, 0));
        receiver.count(0, 1.0, 0);
        let counted = tally.targets[0][0].load(Ordering::Relaxed);
        assert_eq!((receiver.invalid, counted), (3, QUANTA_PER_PHOTON as i64));
    }
}
