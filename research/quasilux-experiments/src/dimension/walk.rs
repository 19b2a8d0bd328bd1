//! One photon's way, with each feature on or off.

use super::room::{REFLECTANCE, Room};
use crate::closed_box::{ClosedBox, Hit};
use crate::emission::Method;
use glam::DVec3;
use quasilux_sampling::Sampler;
use quasilux_sampling::warp::{sample_cosine_hemisphere, sample_uniform_sphere};

/// What saves coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Features {
    /// The choice of a light leaves its coordinate to the direction.
    pub(super) light: bool,
    /// The choice between absorption and reflection does.
    pub(super) event: bool,
    /// Directions of luminaires by inverse transform, else by rejection.
    pub(super) inverse: bool,
}

/// A way to trace photons through a room.
pub(super) struct PhotonTracer<'a> {
    pub(super) room: &'a Room,
    pub(super) features: Features,
}

impl Features {
    pub(super) const FULL: Self = Self { light: true, event: true, inverse: true };
    /// All, without each, and without any.
    pub(super) const ALL: [(&'static str, Self); 5] = [
        ("all features", Self::FULL),
        ("no sharing at the light", Self { light: false, ..Self::FULL }),
        ("no sharing at walls", Self { event: false, ..Self::FULL }),
        ("rejection", Self { inverse: false, ..Self::FULL }),
        ("no sharing and rejection", Self { light: false, event: false, inverse: false }),
    ];

    /// Whether turning these off must be seen in the error; what superposition saves is small, and
    /// told without a claim.
    pub(super) fn must_show(self) -> bool {
        !self.inverse
    }
}

impl PhotonTracer<'_> {
    /// Sends a photon, and tells of every cell that it lands in. Returns how many coordinates the
    /// sampler had handed out before the event that absorbed it.
    pub(super) fn photon(&self, sampler: &mut Sampler<'_>, landed: &mut dyn FnMut(usize)) -> u32 {
        let (mut origin, mut direction) = self.start(sampler);
        loop {
            let hit = ClosedBox::hit(origin, direction);
            landed(hit.cell);
            let before = sampler.used();
            match self.reflected(&hit, sampler) {
                Some(on) => (origin, direction) = (hit.position, on),
                None => return before,
            }
        }
    }

    /// Place and direction at a light.
    fn start(&self, sampler: &mut Sampler<'_>) -> (DVec3, DVec3) {
        let Room { sources, by_flux, luminaire } = self.room;
        let source = match sources.as_slice() {
            [only] => *only,
            _ if self.features.light => sources[sampler.choose_leading(by_flux).index],
            _ => sources[by_flux.sample(sampler.next_1d()).index],
        };
        let direction = match luminaire {
            None => sample_uniform_sphere([sampler.remapped_1d(), sampler.next_1d()]).into(),
            Some(luminaire) if self.features.inverse => {
                let sample =
                    luminaire.photometry.sample([sampler.remapped_1d(), sampler.next_1d()]);
                sample.expect("the luminaire gives light").direction
            }
            Some(luminaire) => {
                sampler.close();
                Method::Rejection.direction(luminaire, sampler)
            }
        };
        (source, direction)
    }

    /// The direction in which a photon goes on, if it does.
    fn reflected(&self, hit: &Hit, sampler: &mut Sampler<'_>) -> Option<DVec3> {
        let goes_on = if self.features.event {
            sampler.choose_bool(REFLECTANCE)
        } else {
            sampler.next_1d() < REFLECTANCE
        };
        if !goes_on {
            sampler.close();
            return None;
        }
        let u = if self.features.event {
            [sampler.remapped_1d(), sampler.next_1d()]
        } else {
            sampler.next_2d()
        };
        let [x, y, up] = sample_cosine_hemisphere(u);
        let (tangent, bitangent) = hit.normal.any_orthonormal_pair();
        Some(tangent * x + bitangent * y + hit.normal * up)
    }
}
