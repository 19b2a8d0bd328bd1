//! From coordinates to a direction of the luminaire, in two ways.

use super::batwing::Luminaire;
use glam::DVec3;
use quasilux_sampling::Sampler;
use quasilux_sampling::warp::sample_uniform_hemisphere;

/// A way to make directions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Method {
    /// Two coordinates, by the table's inverse transform.
    InverseTransform,
    /// Uniform directions below the horizon, where all the light goes, accepted with probability
    /// intensity over maximum: three coordinates a trial, all of the same point.
    Rejection,
}

impl Method {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::InverseTransform => "inverse transform",
            Self::Rejection => "rejection",
        }
    }

    /// A direction of the luminaire's frame, its density in proportion to intensity.
    pub(super) fn direction(self, luminaire: &Luminaire, sampler: &mut Sampler<'_>) -> DVec3 {
        let photometry = &luminaire.photometry;
        match self {
            Self::InverseTransform => {
                let sample = photometry.sample(sampler.next_2d());
                sample.expect("the luminaire gives light").direction
            }
            Self::Rejection => loop {
                let [x, y, up] = sample_uniform_hemisphere(sampler.next_2d());
                let direction = DVec3::new(x, y, -up);
                let share = photometry.intensity_cd(direction) / luminaire.maximum_cd;
                if sampler.next_1d() < share {
                    return direction;
                }
            },
        }
    }
}
