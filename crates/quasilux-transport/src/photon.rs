//! One photon, from its light to its end.
//!
//! Photons carry equal flux. At each surface they survive with the probability that keeps their
//! luminance: what is absorbed is absorbed whole, so counting photons balances the flux exactly,
//! and on grey surfaces the weight never changes (Voloboy, Dmitriev and Kopylov 2003).

use crate::lights::Emission;
use crate::spectrum::Spectrum;
use crate::stage::Stage;
use crate::world::{Interaction, Scattering, mirrored, to_world};
use glam::DVec3;
use quasilux_sampling::warp::sample_cosine_hemisphere;
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
    /// A photon flies freely from `from` along `direction` for `length_m`, perhaps endlessly, after
    /// `bounces` reflections. Its luminance is that of one whole photon.
    fn flight(&mut self, from: DVec3, direction: DVec3, length_m: f64, bounces: u32);

    /// A photon lands on a diffuse surface; `weight` is its colour, of luminance one.
    fn landing(&mut self, at: &Interaction, weight: S, bounces: u32);
}

/// How a photon ended.
enum End {
    Absorbed,
    Lost,
    Cut,
    Endless,
}

/// Traces the photon of one index.
pub(crate) fn trace_photon<S: Spectrum>(
    stage: &Stage<'_, S>,
    cursor: &mut SampleCursor<'_>,
    receiver: &mut impl PhotonReceiver<S>,
    counts: &mut PhotonCounts,
) {
    let Some(emission) = stage.lights.emit(&stage.world, cursor) else { return };
    counts.emitted += 1;
    match fly(stage, emission, cursor, receiver, &mut counts.rays) {
        End::Absorbed => counts.absorbed += 1,
        End::Lost => counts.lost += 1,
        End::Cut => counts.cut += 1,
        End::Endless => counts.endless += 1,
    }
    counts.dimensions.record(cursor.used());
}

fn fly<S: Spectrum>(
    stage: &Stage<'_, S>,
    Emission { mut from, mut direction }: Emission,
    cursor: &mut SampleCursor<'_>,
    receiver: &mut impl PhotonReceiver<S>,
    rays: &mut u64,
) -> End {
    let mut weight = S::white();
    for bounces in 0..MOST_EVENTS {
        *rays += 1;
        let Some(at) = stage.world.trace(from, direction) else {
            receiver.flight(from.position(), direction, f64::INFINITY, bounces);
            return End::Lost;
        };
        receiver.flight(from.position(), direction, at.distance_m, bounces);
        let scattering = stage.world.facet(&at).scattering;
        if let Scattering::Diffuse(_) = scattering {
            receiver.landing(&at, weight, bounces);
        }
        let reflected = weight * scattering.reflectance();
        let survival = reflected.luminance();
        if !cursor.choose_bool(survival) {
            return End::Absorbed;
        }
        if stage.max_bounces.is_some_and(|most| bounces >= most) {
            return End::Cut;
        }
        weight = reflected * (1.0 / survival);
        direction = match scattering {
            Scattering::Mirror(_) => mirrored(direction, at.n),
            Scattering::Diffuse(_) => {
                to_world(at.n, sample_cosine_hemisphere([cursor.rest_1d(), cursor.next_1d()]))
            }
        };
        from = stage.world.vantage(&at);
    }
    End::Endless
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
    fn flight(&mut self, from: DVec3, direction: DVec3, length_m: f64, bounces: u32) {
        if let Some(receiver) = self {
            receiver.flight(from, direction, length_m, bounces);
        }
    }

    fn landing(&mut self, at: &Interaction, weight: S, bounces: u32) {
        if let Some(receiver) = self {
            receiver.landing(at, weight, bounces);
        }
    }
}
