//! Lobes around the specular direction, taken to the frame of the normal.

use super::Block;
use super::header::{Header, SpecularSymmetry, Unit};
use crate::gridded::ExitGrid;
use crate::gridded::GriddedTable;
use crate::gridded::Lobe;
use crate::gridded::around;
use crate::gridded::bracket;
use crate::gridded::table_error;
use glam::DVec3;
use quasilux_photometry::Angles;
use std::f64::consts::TAU;

/// Exit directions of all lobes together, or as many as values where those are more.
const MIN_DIRECTIONS: usize = 1 << 18;

/// The values of a file over spherical angles about the normal.
pub(super) struct Resampled {
    pub(super) table: GriddedTable,
    /// The mean of the difference from the file over the mean of its values, at its incidences.
    pub(super) error: f64,
}

/// The table of a file; `None` where its values make none.
pub(super) fn resample(header: &Header, blocks: &[Block]) -> Option<Resampled> {
    let (thetas, phis) = (header.theta_rad.len(), header.phi_rad.len());
    let values = header.incidences() * thetas * phis;
    let most = values.max(MIN_DIRECTIONS) / header.incidences();
    let is_mirrored = header.symmetry != SpecularSymmetry::None;
    let (mut lobes, mut factors) = (Vec::new(), Vec::new());
    for incidence in 0..header.planes() * header.sigma_rad.len() {
        let sigma = incidence % header.sigma_rad.len();
        let measured = Measured { header, blocks, incidence, start: incidence * thetas * phis };
        // About the normal itself the azimuths are those of the file.
        let around: &[f64] = if sigma == 0 { &header.phi_rad } else { &[] };
        let specular_rad = header.specular_rad[sigma];
        let grid = ExitGrid::around(specular_rad, &header.theta_rad, around, is_mirrored, most);
        let channel =
            |channel: usize| grid.directions().map(|wo| measured.value(wo, channel)).collect();
        let mut channels: Vec<Vec<f64>> = (0..blocks.len()).map(channel).collect();
        let mut factor = [1.0; 3];
        for (channel, values) in channels.iter_mut().enumerate() {
            if header.unit == Unit::Relative {
                let [albedo, ..] = Lobe::new(&grid, std::slice::from_ref(values))?.albedo();
                let scale = blocks[channel].scales[incidence];
                factor[channel] = if albedo > 0.0 { scale / albedo } else { 0.0 };
                values.iter_mut().for_each(|value| *value *= factor[channel]);
            }
        }
        factors.push(factor);
        lobes.push(Lobe::new(&grid, &channels)?);
    }
    let table = GriddedTable::new(
        header.sigma_rad.clone(),
        header.psi_rad[..header.planes()].to_vec(),
        header.specular_rad.clone(),
        lobes,
    )?
    .following_the_mirror();
    let error = error(&table, header, blocks, &factors);
    Some(Resampled { table, error })
}

/// At the stored incidences; what is between them only neighbours tell, see
/// [`GriddedTable::error_between`]. Its values are multiplied by `factors`.
fn error(table: &GriddedTable, header: &Header, blocks: &[Block], factors: &[[f64; 3]]) -> f64 {
    let per_incidence = header.theta_rad.len() * header.phi_rad.len();
    let error = |incidence: usize| {
        let measured = Measured { header, blocks, incidence, start: incidence * per_incidence };
        let [sigma, psi] = [incidence % header.sigma_rad.len(), incidence / header.sigma_rad.len()];
        let phi_rad = header.psi_rad[psi];
        let wi = Angles { theta_rad: header.sigma_rad[sigma], phi_rad }.direction();
        let (sin, cos) = libm::sincos(phi_rad);
        let exact = |_: DVec3, wo: DVec3| {
            let wo = DVec3::new(cos * wo.x + sin * wo.y, cos * wo.y - sin * wo.x, wo.z);
            [0, 1, 2].map(|channel| {
                let channel = channel.min(blocks.len() - 1);
                factors[incidence][channel] * measured.value(wo, channel)
            })
        };
        table_error(table, &[wi], exact)
    };
    let incidences = header.planes() * header.sigma_rad.len();
    let looked_at = (0..incidences).step_by(incidences.div_ceil(16));
    let count = looked_at.clone().count() as f64;
    looked_at.map(error).sum::<f64>() / count
}

/// The values of one incidence.
struct Measured<'h> {
    header: &'h Header,
    blocks: &'h [Block],
    incidence: usize,
    /// Of its first value.
    start: usize,
}

impl Measured<'_> {
    /// f towards a direction, with the plane of incidence at azimuth 0: bilinear in both angles
    /// about the specular direction, zero beyond the last of them.
    fn value(&self, wo: DVec3, channel: usize) -> f64 {
        let Header { symmetry, unit, phi_rad, theta_rad, .. } = self.header;
        let sigma = self.incidence % self.header.sigma_rad.len();
        let (sin, cos) = libm::sincos(self.header.specular_rad[sigma]);
        // The specular direction is at (-sin, 0, cos); phi = 0 leads from it towards the normal.
        let about = DVec3::new(cos * wo.x + sin * wo.z, wo.y, cos * wo.z - sin * wo.x);
        let Angles { theta_rad: theta, phi_rad: phi } = Angles::from_direction(about);
        if theta > theta_rad[theta_rad.len() - 1] + 1e-9 {
            return 0.0;
        }
        let phi = match symmetry {
            SpecularSymmetry::Axis => phi_rad[0],
            SpecularSymmetry::Plane => phi.abs(),
            SpecularSymmetry::None => phi.rem_euclid(TAU),
        };
        let is_turn = *symmetry == SpecularSymmetry::None;
        let columns = if is_turn { around(phi_rad, phi) } else { bracket(phi_rad, phi) };
        let rows = bracket(theta_rad, theta);
        let block = &self.blocks[channel];
        let mut sum = 0.0;
        for column in columns {
            for row in rows {
                let index = self.start + column.index * theta_rad.len() + row.index;
                sum += column.weight * row.weight * block.values[index];
            }
        }
        sum * if *unit == Unit::Absolute { block.scales[self.incidence] } else { 1.0 }
    }
}
