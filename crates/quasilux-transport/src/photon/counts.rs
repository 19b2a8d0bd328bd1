//! Counts of photons: the balance of their flux, rays and coordinates.

use crate::codec::{Sums, add_count, add_quanta, histogram};
use crate::stats::caveat::Caveat;
use crate::stats::estimates::FluxBalance;
use quasilux_sampling::DimensionHistogram;
use serde::{Deserialize, Serialize};
use std::ops::AddAssign;

/// Flux is counted in this many steps a photon: 2^39 photons fit.
pub(super) const QUANTA_PER_PHOTON: f64 = (1 << 24) as f64;

/// How photons ended, and what they cost. Flux is in quanta.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct PhotonCounts {
    /// Photons that began, until those from lit places are [taken out](Self::apart_from_flux):
    /// those that left lights.
    pub(crate) emitted: u64,
    /// Photons that began, those from lit places too, without those that splitting added.
    pub(crate) begun: u64,
    /// Quanta by which photons that left lights fell short of those of a photon of all lights: none
    /// where only lamps shine.
    pub(crate) withheld: i64,
    /// Absorbed, less what splitting added.
    pub(crate) absorbed: i64,
    pub(crate) lost: i64,
    /// Cut after the wanted number of bounces.
    pub(crate) cut: i64,
    /// Photons cut because they would not [end](crate::cutoff).
    pub(crate) endless: u64,
    /// Photons cut because they would not end, of those that are not in the balance of the flux.
    pub(crate) trapped: u64,
    /// Photons, and contributions of photons to receivers, that were refused: not finite, negative
    /// or too large to be counted.
    pub(crate) invalid: u64,
    pub(crate) rays: u64,
    /// Surfaces that photons came to.
    pub(crate) events: u64,
    /// Coordinates that each of them used, children of splits by themselves.
    #[serde(with = "histogram")]
    pub(crate) dimensions: DimensionHistogram,
}

impl PhotonCounts {
    /// Counts of the work alone, without the balance of the flux: photons from lit cells do not
    /// carry all of it.
    pub(crate) fn apart_from_flux(self) -> Self {
        let trapped = self.trapped + self.endless;
        let Self { begun, invalid, rays, events, dimensions, .. } = self;
        Self { begun, trapped, invalid, rays, events, dimensions, ..Self::default() }
    }

    /// Flux of some quanta, as a share of all that was emitted.
    pub(crate) fn share(&self, quanta: i64) -> f64 {
        quanta as f64 / (self.emitted.max(1) as f64 * QUANTA_PER_PHOTON)
    }

    /// Where the flux of the lights went, by the shares of the photons; that from outside is what
    /// they found to come into the scene.
    pub(crate) fn balance(&self, emitted_lm: f64) -> FluxBalance {
        let of = |quanta: i64| emitted_lm * self.share(quanta);
        FluxBalance {
            emitted_lm: emitted_lm - of(self.withheld),
            absorbed_lm: of(self.absorbed),
            lost_lm: of(self.lost),
            cut_lm: of(self.cut),
        }
    }

    /// Caveat of terminated photons, if there are any.
    pub(crate) fn caveat(&self) -> Option<Caveat> {
        Caveat::of_photons(self.endless + self.trapped)
    }
}

impl AddAssign for PhotonCounts {
    fn add_assign(&mut self, other: Self) {
        self.checked_add(&other).expect("the counts of one run fit 64 bits");
    }
}

impl Sums for PhotonCounts {
    fn checked_add(&mut self, other: &Self) -> Option<()> {
        add_count(&mut self.emitted, other.emitted)?;
        add_count(&mut self.begun, other.begun)?;
        add_quanta(&mut self.withheld, other.withheld)?;
        add_quanta(&mut self.absorbed, other.absorbed)?;
        add_quanta(&mut self.lost, other.lost)?;
        add_quanta(&mut self.cut, other.cut)?;
        add_count(&mut self.endless, other.endless)?;
        add_count(&mut self.trapped, other.trapped)?;
        add_count(&mut self.invalid, other.invalid)?;
        add_count(&mut self.rays, other.rays)?;
        add_count(&mut self.events, other.events)?;
        histogram::checked_add(&mut self.dimensions, &other.dimensions)
    }
}
