//! Photon receivers: the interface of sensors and maps to photons in flight.

use crate::lights::images::LightPathClass;
use crate::world::Interaction;
use crate::world::flight::Flight;
use glam::DVec3;
use quasilux_sampling::Sampler;

/// A photon as receivers see it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SeenPhoton<S> {
    /// Its colour, of luminance one or near it.
    pub(crate) weight: S,
    /// Reflections behind it.
    pub(crate) bounces: u32,
    /// How it came, if over specular surfaces alone from a light that no path runs into.
    pub(crate) specular_class: Option<LightPathClass>,
}

/// Sensors and maps that see photons on their way.
pub(crate) trait PhotonReceiver<S> {
    /// Whether photons end where [`LightPathClass::Found`] begins: the receiver needs them no
    /// further.
    const SPECULAR_ONLY: bool = false;

    /// Announces the photon with this sampler, until the next call.
    fn follow(&mut self, sampler: &Sampler<'_>) {
        let _ = sampler;
    }

    /// A photon flies freely, perhaps endlessly.
    fn flight(&mut self, flight: &Flight, photon: &SeenPhoton<S>) {
        let _ = (flight, photon);
    }

    /// A photon lands on a surface that keeps illuminance.
    fn landing(&mut self, at: &Interaction, photon: &SeenPhoton<S>) {
        let _ = (at, photon);
    }

    /// Nothing more is to come; how many contributions were not finite, negative or too large to be
    /// counted.
    fn finish(self) -> u64
    where
        Self: Sized,
    {
        0
    }
}

/// The end of a flight.
pub(crate) struct Arrival<'a> {
    /// Along which the photon flew.
    pub(crate) direction: DVec3,
    pub(crate) found: Option<&'a Interaction>,
    /// Before this one, since it began.
    pub(crate) bounces: u32,
    /// Whether no flight led here: the place was drawn, from those whose light goes on.
    pub(crate) is_drawn: bool,
}

/// Receives nothing, or what the inner one receives.
impl<S, R: PhotonReceiver<S>> PhotonReceiver<S> for Option<R> {
    const SPECULAR_ONLY: bool = R::SPECULAR_ONLY;

    fn follow(&mut self, sampler: &Sampler<'_>) {
        if let Some(receiver) = self {
            receiver.follow(sampler);
        }
    }

    fn flight(&mut self, flight: &Flight, photon: &SeenPhoton<S>) {
        if let Some(receiver) = self {
            receiver.flight(flight, photon);
        }
    }

    fn landing(&mut self, at: &Interaction, photon: &SeenPhoton<S>) {
        if let Some(receiver) = self {
            receiver.landing(at, photon);
        }
    }

    fn finish(self) -> u64 {
        self.map_or(0, R::finish)
    }
}
