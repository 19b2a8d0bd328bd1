//! Counts of photons: the balance of their flux, rays and coordinates.

use crate::codec::{Reader, StateError, Stored, Writer};
use quasilux_sampling::DimensionHistogram;
use std::ops::AddAssign;

/// Flux is counted in this many steps a photon: 2^39 photons fit.
pub(super) const QUANTA_PER_PHOTON: f64 = (1 << 24) as f64;

/// How photons ended, and what they cost. Flux is in quanta.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct PhotonCounts {
    /// Photons that began, until those from lit places are [taken out](Self::apart_from_flux):
    /// those that left lights.
    pub(crate) emitted: u64,
    /// Those from lit places too; what splitting added is not among them.
    pub(crate) begun: u64,
    /// Absorbed, less what splitting added.
    pub(crate) absorbed: i64,
    pub(crate) lost: i64,
    /// Cut after the wanted number of bounces.
    pub(crate) cut: i64,
    /// Photons cut because they would not [end](crate::cutoff).
    pub(crate) endless: u64,
    /// The same of photons that are not in the balance of the flux.
    pub(crate) trapped: u64,
    /// Photons, and contributions of photons to receivers, that were refused: not finite, negative
    /// or too large to be counted.
    pub(crate) invalid: u64,
    pub(crate) rays: u64,
    /// Rays among them that join photons to sensors.
    pub(crate) connections: u64,
    /// Surfaces that photons came to.
    pub(crate) events: u64,
    /// Coordinates that each of them used, children of splits by themselves.
    pub(crate) dimensions: DimensionHistogram,
}

impl PhotonCounts {
    /// What they cost, without where their flux went: those from lit cells do not carry all of it.
    pub(crate) fn apart_from_flux(self) -> Self {
        let trapped = self.trapped + self.endless;
        let Self { begun, invalid, rays, connections, events, dimensions, .. } = self;
        Self { begun, trapped, invalid, rays, connections, events, dimensions, ..Self::default() }
    }

    /// Flux of some quanta, as a share of all that was emitted.
    pub(crate) fn share(&self, quanta: i64) -> f64 {
        quanta as f64 / (self.emitted.max(1) as f64 * QUANTA_PER_PHOTON)
    }
}

impl AddAssign for PhotonCounts {
    fn add_assign(&mut self, other: Self) {
        self.emitted += other.emitted;
        self.begun += other.begun;
        self.absorbed += other.absorbed;
        self.lost += other.lost;
        self.cut += other.cut;
        self.endless += other.endless;
        self.trapped += other.trapped;
        self.invalid += other.invalid;
        self.rays += other.rays;
        self.connections += other.connections;
        self.events += other.events;
        self.dimensions.merge(&other.dimensions);
    }
}

impl Stored for PhotonCounts {
    fn put(&self, out: &mut Writer) {
        let Self {
            emitted,
            begun,
            absorbed,
            lost,
            cut,
            endless,
            trapped,
            invalid,
            rays,
            connections,
            events,
            dimensions,
        } = self;
        [emitted, begun, endless, trapped, invalid, rays, connections, events]
            .into_iter()
            .for_each(|count| out.u64(*count));
        [absorbed, lost, cut].into_iter().for_each(|quanta| out.i64(*quanta));
        dimensions.put(out);
    }

    fn merge_from(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        let Self {
            emitted,
            begun,
            absorbed,
            lost,
            cut,
            endless,
            trapped,
            invalid,
            rays,
            connections,
            events,
            dimensions,
        } = self;
        let counts = [emitted, begun, endless, trapped, invalid, rays, connections, events];
        counts.into_iter().try_for_each(|count| from.add_u64(count))?;
        [absorbed, lost, cut].into_iter().try_for_each(|quanta| from.add_i64(quanta))?;
        dimensions.merge_from(from)
    }
}
