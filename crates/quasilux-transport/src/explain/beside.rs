//! Photons beside paths as a pilot sees them: what each gives to the sensor points whose paths are looked at.
//!
//! What steered photons split off draws coordinates that belong to no block.

use super::{Pilot, Points, Walk, WalkKind};
use crate::context::{Stage, Stream};
use crate::estimator::connection::Joined;
use crate::spectrum::Spectrum;
use quasilux_sampling::Sampler;

/// Photons.
const SAMPLES: u64 = 1 << 13;

/// What photons beside paths are for.
#[derive(Clone, Copy)]
pub(super) enum Role {
    /// To be counted by the cell they land in.
    Counted,
    /// To be joined to the sensor points.
    Joined,
}

pub(super) struct BesideWalk<'w, S> {
    pub(super) stage: &'w Stage<'w, S>,
    pub(super) joined: &'w Joined,
    pub(super) role: Role,
    /// Illuminance of each target, from all that there is.
    pub(super) whole_lx: Vec<f64>,
}

impl<S: Spectrum> BesideWalk<'_, S> {
    /// How many of them go with a path.
    pub(super) fn for_each_path(&self) -> u64 {
        match self.role {
            Role::Counted => self.joined.joining.coarse_photons(),
            Role::Joined => self.joined.joining.photons(),
        }
    }
}

impl<S: Spectrum> Walk for BesideWalk<'_, S> {
    fn kind(&self) -> WalkKind {
        match self.role {
            Role::Counted => WalkKind::CountedPhotons,
            Role::Joined => WalkKind::JoinedPhotons,
        }
    }

    fn samples(&self) -> u64 {
        SAMPLES
    }

    fn whole_lx(&self) -> Option<&[f64]> {
        Some(&self.whole_lx)
    }

    fn trace(&self, samples: u64, points: &Points<'_>) -> Pilot {
        let [counted, joined, places] =
            [Stream::CoarsePhotons, Stream::JoinedPhotons(0), Stream::JoinedPlaces(0)].map(points);
        Pilot::of_photons(samples, self.whole_lx.len(), |index, counts| match self.role {
            Role::Counted => {
                let sampler = Sampler::new(&counted, index);
                self.joined.of_counted_lx(self.stage, sampler, counts)
            }
            Role::Joined => {
                let sampler = Sampler::new(&joined, index);
                self.joined.of_joined_lx(self.stage, sampler, places, counts)
            }
        })
    }
}
