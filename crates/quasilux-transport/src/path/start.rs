//! Start of a path: a sensor point or a pixel, and the quantity measured there.

use crate::path::daylight::DaylightSearch;
use crate::path::end::MapEnd;
use crate::photon::caustics::CausticLookup;
use crate::spectrum::Spectrum;
use crate::world::RayOrigin;
use crate::world::vertex::Vertex;
use glam::DVec3;
use quasilux_sampling::Sampler;

/// Where a path starts, and on what.
pub(crate) struct Start<'p, S> {
    pub(crate) from: RayOrigin,
    pub(crate) measurement: Measurement,
    pub(crate) maps: PathMaps<'p, S>,
    /// Where what comes from outside is kept apart, how.
    pub(crate) daylight: Option<DaylightSearch<'p>>,
    pub(crate) sampler: Sampler<'p>,
}

/// Maps of photons that a path takes light from.
pub(crate) struct PathMaps<'p, S> {
    /// The map that it may end on.
    pub(crate) end: Option<&'p MapEnd<'p, S>>,
    /// Light that it cannot find by itself.
    pub(crate) caustics: Option<CausticLookup<'p, S>>,
}

/// Quantity that a path measures.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Measurement {
    /// The illuminance on the side `n`.
    Illuminance {
        n: DVec3,
        /// Whether with the direct light of the point-like lights.
        tests_pointlikes: bool,
    },
    /// The luminance seen along this unit vector.
    Luminance { direction: DVec3 },
}

impl<S: Spectrum> Start<'_, S> {
    /// The start where it wants all point-like lights tested.
    pub(crate) fn vertex_that_tests_pointlikes(&self) -> Option<Vertex<'static, S>> {
        match self.measurement {
            Measurement::Illuminance { n, tests_pointlikes: true } => {
                Some(Vertex::sensor(self.from, n))
            }
            _ => None,
        }
    }
}
