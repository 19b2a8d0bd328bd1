//! One photon, from its light to its end: what happens to it at each step.
//!
//! Photons start with equal flux. At each surface they survive with the probability that keeps their
//! luminance: what is absorbed is absorbed whole, so counting photons balances the flux exactly,
//! and on grey surfaces the weight never changes (Voloboy, Dmitriev and Kopylov 2003). Only rough
//! surfaces, whose directions cannot be drawn in exact proportion, leave it slightly changed.

use crate::bsdf::Mode;
use crate::lights::Emission;
use crate::spectrum::Spectrum;
use crate::specular::Trail;
use crate::stage::Stage;
use crate::world::Interaction;
use glam::DVec3;
use quasilux_sampling::{DimensionHistogram, SampleCursor};
use std::ops::AddAssign;

/// After this many events a photon or path is cut: only halls of perfect mirrors get there.
pub(crate) const MOST_EVENTS: u32 = 4096;

/// How photons ended, and what they cost.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct PhotonCounts {
    pub(crate) emitted: u64,
    pub(crate) absorbed: u64,
    pub(crate) lost: u64,
    /// Cut after the wanted number of bounces.
    pub(crate) cut: u64,
    /// Cut after [`MOST_EVENTS`].
    pub(crate) endless: u64,
    pub(crate) rays: u64,
    /// Coordinates that each of them used.
    pub(crate) dimensions: DimensionHistogram,
}

/// What sees photons on their way.
pub(crate) trait PhotonReceiver<S> {
    /// Whether photons end where [`Trail::Found`] begins: nobody looks at them further.
    const SPECULAR_ONLY: bool = false;

    /// A photon flies freely from `from` along `direction` for `length_m`, perhaps endlessly, after
    /// `bounces` reflections; `weight` is its colour, of luminance one or near it.
    fn flight(&mut self, flight: &Flight, weight: S, bounces: u32);

    /// A photon lands on a surface that keeps illuminance.
    fn landing(&mut self, at: &Interaction, weight: S, bounces: u32);

    /// The flight of a photon that came by specular surfaces alone from a light that nothing runs
    /// into; a flight like others unless somebody sees such light in another way.
    fn specular_flight(&mut self, flight: &Flight, weight: S, bounces: u32, trail: Trail) {
        let _ = trail;
        self.flight(flight, weight, bounces);
    }

    /// The landing of such a photon.
    fn specular_landing(&mut self, at: &Interaction, weight: S, bounces: u32, trail: Trail) {
        let _ = trail;
        self.landing(at, weight, bounces);
    }
}

/// A straight piece of a photon's way.
pub(crate) struct Flight {
    pub(crate) from: DVec3,
    pub(crate) direction: DVec3,
    /// Infinite where it leaves the scene.
    pub(crate) length_m: f64,
}

/// A photon on its way, but for where it flies.
pub(crate) struct Photon<'p, S> {
    pub(crate) cursor: SampleCursor<'p>,
    /// Its colour: the flux that it carries, as a share of that of one photon at its start.
    pub(crate) weight: S,
    pub(crate) trail: Trail,
    /// Whether it ends where paths find it.
    specular_only: bool,
}

/// What becomes of a photon at a surface.
pub(crate) enum Fate {
    GoesOn(Emission),
    Ends(End),
}

/// How a photon ended.
pub(crate) enum End {
    Absorbed,
    Lost,
    Cut,
    Endless,
}

/// Traces the photon of one index by itself: the slow twin of [`crate::photon_wave::PhotonWave`].
pub(crate) fn trace_photon<S: Spectrum>(
    stage: &Stage<'_, S>,
    cursor: SampleCursor<'_>,
    receiver: &mut impl PhotonReceiver<S>,
    counts: &mut PhotonCounts,
) {
    let mut photon = Photon::new(cursor).for_receiver(receiver);
    let Some(mut start) = photon.emit(stage) else { return };
    counts.emitted += 1;
    for bounces in 0..MOST_EVENTS {
        counts.rays += 1;
        let Emission { from, direction } = start;
        let found = stage.world.trace(from, direction);
        photon.show(stage, from.position(), direction, found.as_ref(), bounces, receiver);
        match photon.scatter(stage, direction, found.as_ref(), bounces) {
            Fate::GoesOn(next) => start = next,
            Fate::Ends(end) => return counts.end(&photon, &end),
        }
    }
    counts.end(&photon, &End::Endless);
}

impl<'p, S: Spectrum> Photon<'p, S> {
    /// The photon that takes its coordinates from `cursor`.
    pub(crate) fn new(cursor: SampleCursor<'p>) -> Self {
        Self { cursor, weight: S::white(), trail: Trail::Found, specular_only: false }
    }

    /// The photon as a receiver wants it.
    pub(crate) fn for_receiver<R: PhotonReceiver<S>>(self, _: &R) -> Self {
        Self { specular_only: R::SPECULAR_ONLY, ..self }
    }

    /// Leaves its light; `None` where nothing emits.
    pub(crate) fn emit(&mut self, stage: &Stage<'_, S>) -> Option<Emission> {
        let emitted = stage.lights.emit(&stage.world, &mut self.cursor)?;
        self.trail = emitted.trail;
        Some(emitted.emission)
    }

    /// Shows a flight to the receiver, and where it landed.
    pub(crate) fn show(
        &self,
        stage: &Stage<'_, S>,
        from: DVec3,
        direction: DVec3,
        found: Option<&Interaction>,
        bounces: u32,
        receiver: &mut impl PhotonReceiver<S>,
    ) {
        let length_m = found.map_or(f64::INFINITY, |at| at.distance_m);
        let flight = Flight { from, direction, length_m };
        let landing = found.filter(|at| stage.world.bsdf(at).keeps_illuminance());
        if self.trail == Trail::Found || bounces == 0 {
            receiver.flight(&flight, self.weight, bounces);
            if let Some(at) = landing {
                receiver.landing(at, self.weight, bounces);
            }
        } else {
            receiver.specular_flight(&flight, self.weight, bounces, self.trail);
            if let Some(at) = landing {
                receiver.specular_landing(at, self.weight, bounces, self.trail);
            }
        }
    }

    /// Survives a flight along `direction` or not, and goes on.
    pub(crate) fn scatter(
        &mut self,
        stage: &Stage<'_, S>,
        direction: DVec3,
        found: Option<&Interaction>,
        bounces: u32,
    ) -> Fate {
        let Some(at) = found else { return Fate::Ends(End::Lost) };
        let (bsdf, frame) = (stage.world.bsdf(at), at.frame());
        let wo = frame.to_local(-direction);
        let survival =
            (self.weight * bsdf.albedo(wo, at.front)).luminance() / self.weight.luminance();
        if !self.cursor.choose_bool(survival) {
            return Fate::Ends(End::Absorbed);
        }
        if stage.max_bounces.is_some_and(|most| bounces >= most) {
            return Fate::Ends(End::Cut);
        }
        let Some(next) = bsdf.sample(wo, at.front, Mode::Flux, &mut self.cursor) else {
            return Fate::Ends(End::Absorbed);
        };
        self.weight = self.weight * next.weight * (1.0 / survival);
        self.trail = self.trail.after(&stage.images, bsdf, at.facet, next.wi.z > 0.0);
        if self.specular_only && self.trail == Trail::Found {
            return Fate::Ends(End::Cut);
        }
        let from =
            if next.wi.z > 0.0 { stage.world.vantage(at) } else { stage.world.vantage_behind(at) };
        Fate::GoesOn(Emission { from, direction: frame.to_world(next.wi) })
    }
}

impl PhotonCounts {
    /// Counts a photon that ended.
    pub(crate) fn end<S>(&mut self, photon: &Photon<'_, S>, end: &End) {
        match end {
            End::Absorbed => self.absorbed += 1,
            End::Lost => self.lost += 1,
            End::Cut => self.cut += 1,
            End::Endless => self.endless += 1,
        }
        self.dimensions.record(photon.cursor.used());
    }
}

impl AddAssign for PhotonCounts {
    fn add_assign(&mut self, other: Self) {
        self.emitted += other.emitted;
        self.absorbed += other.absorbed;
        self.lost += other.lost;
        self.cut += other.cut;
        self.endless += other.endless;
        self.rays += other.rays;
        self.dimensions.merge(&other.dimensions);
    }
}

/// Receives nothing, or what the inner one receives.
impl<S, R: PhotonReceiver<S>> PhotonReceiver<S> for Option<R> {
    const SPECULAR_ONLY: bool = R::SPECULAR_ONLY;

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

    fn specular_flight(&mut self, flight: &Flight, weight: S, bounces: u32, trail: Trail) {
        if let Some(receiver) = self {
            receiver.specular_flight(flight, weight, bounces, trail);
        }
    }

    fn specular_landing(&mut self, at: &Interaction, weight: S, bounces: u32, trail: Trail) {
        if let Some(receiver) = self {
            receiver.specular_landing(at, weight, bounces, trail);
        }
    }
}
