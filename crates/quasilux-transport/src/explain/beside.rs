//! Photons beside paths as a pilot sees them: what each gives to the sensor points whose paths are
//! looked at.
//!
//! What guided photons split off draws coordinates that belong to no block.

use super::{Pilot, Points, SampleKind, SampleSource};
use crate::context::{Context, Stream};
use crate::estimator::connection::LightVertexConnections;
use crate::spectrum::Spectrum;
use quasilux_sampling::Sampler;

/// Photons.
const SAMPLES: u64 = 1 << 13;

/// What photons beside paths are for.
#[derive(Clone, Copy)]
pub(super) enum Role {
    /// To be counted by the cell they land in.
    Counted,
    /// To be connected to the sensor points.
    LightVertexConnections,
}

pub(super) struct BesideSource<'w, S> {
    pub(super) context: &'w Context<'w, S>,
    pub(super) light_vertices: &'w LightVertexConnections,
    pub(super) role: Role,
    /// Illuminance of each target, from all that there is.
    pub(super) whole_lx: Vec<f64>,
}

impl<S: Spectrum> BesideSource<'_, S> {
    /// How many of them go with a path.
    pub(super) fn for_each_path(&self) -> u64 {
        match self.role {
            Role::Counted => self.light_vertices.connection.cell_photons(),
            Role::LightVertexConnections => self.light_vertices.connection.photons(),
        }
    }
}

impl<S: Spectrum> SampleSource for BesideSource<'_, S> {
    fn kind(&self) -> SampleKind {
        match self.role {
            Role::Counted => SampleKind::CountedPhotons,
            Role::LightVertexConnections => SampleKind::ConnectedPhotons,
        }
    }

    fn samples(&self) -> u64 {
        SAMPLES
    }

    fn whole_lx(&self) -> Option<&[f64]> {
        Some(&self.whole_lx)
    }

    fn trace(&self, samples: u64, points: &Points<'_>) -> Pilot {
        let [counted, light_vertices, places] =
            [Stream::CellPhotons, Stream::ConnectedPhotons(0), Stream::ConnectionPlaces(0)]
                .map(points);
        Pilot::of_photons(samples, self.whole_lx.len(), |index, counts| match self.role {
            Role::Counted => {
                let sampler = Sampler::new(&counted, index);
                self.light_vertices.of_counted_lx(self.context, sampler, counts)
            }
            Role::LightVertexConnections => {
                let sampler = Sampler::new(&light_vertices, index);
                self.light_vertices.of_connected_lx(self.context, sampler, places, counts)
            }
        })
    }
}
