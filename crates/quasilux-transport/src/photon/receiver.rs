//! Photon receivers: the interface of sensors, maps and connections to photons in flight.

use crate::lights::images::LightPathClass;
use crate::world::Interaction;
use crate::world::flight::Flight;
use glam::DVec3;
use quasilux_sampling::Sampler;

/// What sees photons on their way.
pub(crate) trait PhotonReceiver<S> {
    /// Whether photons end where [`LightPathClass::Found`] begins: nobody looks at them further.
    const SPECULAR_ONLY: bool = false;

    /// All that it sees from here on is of the photon whose coordinates come from there.
    fn follow(&mut self, sampler: &Sampler<'_>) {
        let _ = sampler;
    }

    /// A photon flies freely from `from` along `direction` for `length_m`, perhaps endlessly, after
    /// `bounces` reflections; `weight` is its colour, of luminance one or near it.
    fn flight(&mut self, flight: &Flight, weight: S, bounces: u32);

    /// A photon lands on a surface that keeps illuminance.
    fn landing(&mut self, at: &Interaction, weight: S, bounces: u32);

    /// The flight of a photon that came by specular surfaces alone from a light that nothing runs
    /// into; a flight like others unless somebody sees such light in another way.
    fn specular_flight(
        &mut self,
        flight: &Flight,
        weight: S,
        bounces: u32,
        path_class: LightPathClass,
    ) {
        let _ = path_class;
        self.flight(flight, weight, bounces);
    }

    /// The landing of such a photon.
    fn specular_landing(
        &mut self,
        at: &Interaction,
        weight: S,
        bounces: u32,
        path_class: LightPathClass,
    ) {
        let _ = path_class;
        self.landing(at, weight, bounces);
    }

    /// Nothing more is to come.
    fn finish(self) -> ReceiverCounts
    where
        Self: Sized,
    {
        ReceiverCounts::default()
    }
}

/// Work of a receiver, and contributions that it refused.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ReceiverCounts {
    /// Rays that it traced itself.
    pub(crate) rays: u64,
    /// Contributions that were not finite, negative or too large to be counted.
    pub(crate) invalid: u64,
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

    fn flight(&mut self, flight: &Flight, weight: S, bounces: u32) {
        if let Some(receiver) = self {
            receiver.flight(flight, weight, bounces);
        }
    }

    fn landing(&mut self, at: &Interaction, weight: S, bounces: u32) {
        if let Some(receiver) = self {
            receiver.landing(at, weight, bounces);
        }
    }

    fn specular_flight(
        &mut self,
        flight: &Flight,
        weight: S,
        bounces: u32,
        path_class: LightPathClass,
    ) {
        if let Some(receiver) = self {
            receiver.specular_flight(flight, weight, bounces, path_class);
        }
    }

    fn specular_landing(
        &mut self,
        at: &Interaction,
        weight: S,
        bounces: u32,
        path_class: LightPathClass,
    ) {
        if let Some(receiver) = self {
            receiver.specular_landing(at, weight, bounces, path_class);
        }
    }

    fn finish(self) -> ReceiverCounts {
        self.map_or_else(ReceiverCounts::default, R::finish)
    }
}
