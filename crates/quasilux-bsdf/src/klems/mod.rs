//! A scattering matrix over angular patches (Klems 1994; LBNL WINDOW).
//!
//! f is constant for each pair of an incident and an exit patch. With the projected solid angle W
//! of a patch, the albedo of an incident patch is the sum of f W over exit patches. Sampling takes
//! the two coordinates apart: `u[0]` picks a band by its share and, renormalised, the squared sine
//! in it; `u[1]` picks a patch of that band and, renormalised, the azimuth in it. The density in
//! projected solid angle is f over the albedo.

mod basis;

use crate::hemisphere::INSIDE;
use crate::hemisphere::Incident;
use crate::hemisphere::PickedStep;
use crate::hemisphere::ScatterSample;
use crate::hemisphere::pick;
use basis::Cell;
pub use basis::{AngleBasis, BandDefinition, ThetaBand};
use glam::DVec3;
use std::f64::consts::PI;

/// A scattering matrix.
#[derive(Clone, Debug)]
pub struct KlemsTable {
    incident: AngleBasis,
    exit: AngleBasis,
    /// f in sr^-1, all exit patches for the first incident patch, then for the next.
    values: Vec<f64>,
    /// The sums of f W before each exit patch, and of all, for each incident patch.
    share_before: Vec<f64>,
    /// Whether f is the same in all patches of a band, of incidence and of exit.
    is_isotropic: bool,
}

impl KlemsTable {
    /// A table from values for all exit patches of the first incident patch, then of the next;
    /// `None` unless there is one value, non-negative and finite, for each pair.
    #[must_use]
    pub fn new(incident: AngleBasis, exit: AngleBasis, values: Vec<f64>) -> Option<Self> {
        let pairs = incident.patches().checked_mul(exit.patches())?;
        let is_right = |value: &f64| value.is_finite() && *value >= 0.0;
        if values.len() != pairs || !values.iter().all(is_right) {
            return None;
        }
        let mut share_before = Vec::with_capacity(pairs + incident.patches());
        for row in values.chunks_exact(exit.patches()) {
            let mut sum = 0.0;
            share_before.push(sum);
            for band in exit.bands() {
                let projected_sr = band.patch_projected_sr();
                for value in &row[band.first..band.first + band.patches] {
                    sum += value * projected_sr;
                    share_before.push(sum);
                }
            }
        }
        let is_isotropic = is_isotropic(&incident, &exit, &values);
        Some(Self { incident, exit, values, share_before, is_isotropic })
    }

    /// Whether f does not depend on azimuths at all. Patches are too coarse for any other table to
    /// be the same however it is turned.
    pub(super) fn is_isotropic(&self) -> bool {
        self.is_isotropic
    }

    /// The patches of incident directions.
    #[must_use]
    pub fn incident_basis(&self) -> &AngleBasis {
        &self.incident
    }

    /// The patches of exit directions.
    #[must_use]
    pub fn exit_basis(&self) -> &AngleBasis {
        &self.exit
    }

    /// f in sr^-1: all exit patches for the first incident patch, then for the next.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The adjoint, for light that travels in reverse, from the other side: f'(wi, wo) = f(wo, wi).
    /// `None` where a patch has no counterpart at the opposite azimuth.
    pub(super) fn adjoint(&self) -> Option<Self> {
        let (opposite_in, opposite_out) = (self.incident.opposites()?, self.exit.opposites()?);
        let columns = self.exit.patches();
        let from_exit = |&out: &usize| {
            opposite_in.iter().map(move |&incident| self.values[incident * columns + out])
        };
        let values = opposite_out.iter().flat_map(from_exit).collect();
        Self::new(self.exit.clone(), self.incident.clone(), values)
    }

    pub(super) fn value(&self, wi: DVec3, wo: DVec3) -> f64 {
        let (Some(row), Some(cell)) = (self.row(wi), self.exit.cell([wo.x, wo.y])) else {
            return 0.0;
        };
        self.values[row * self.exit.patches() + self.exit.index(cell)]
    }

    pub(super) fn albedo(&self, wi: DVec3) -> f64 {
        self.row(wi).map_or(0.0, |row| self.shares(row)[self.exit.patches()])
    }

    pub(super) fn sample(&self, wi: DVec3, u: [f64; 2]) -> Option<ScatterSample> {
        let row = self.row(wi)?;
        let shares = self.shares(row);
        let albedo = shares[self.exit.patches()];
        if albedo <= 0.0 {
            return None;
        }
        let bands = self.exit.bands();
        let before_band = |band: usize| match bands.get(band) {
            Some(found) => shares[found.first],
            None => albedo,
        };
        let PickedStep { index: band, u_remapped: along_sin2 } =
            pick(bands.len(), u[0], before_band);
        let first = bands[band].first;
        let PickedStep { index: patch, u_remapped: along_phi } =
            pick(bands[band].patches, u[1], |patch| shares[first + patch]);
        let cell = Cell { band, patch, fraction: [along_sin2, along_phi].map(inside) };
        let wo = DVec3::from_array(self.exit.place(cell));
        let value = self.values[row * self.exit.patches() + self.exit.index(cell)];
        Some(ScatterSample { wo, pdf_sr: value * wo.z / albedo })
    }

    pub(super) fn pdf_sr(&self, wi: DVec3, wo: DVec3) -> f64 {
        let albedo = self.albedo(wi);
        if albedo > 0.0 { self.value(wi, wo) * wo.z / albedo } else { 0.0 }
    }

    pub(super) fn invert(&self, wi: DVec3, wo: DVec3) -> Option<[f64; 2]> {
        let shares = self.shares(self.row(wi)?);
        let cell = self.exit.cell([wo.x, wo.y])?;
        let band = &self.exit.bands()[cell.band];
        let [first, end] = [band.first, band.first + band.patches];
        let before =
            |share: f64, [low, high]: [f64; 2], fraction: f64| share + fraction * (high - low);
        let within_all = before(shares[first], [shares[first], shares[end]], cell.fraction[0]);
        let [low, high] = [first + cell.patch, first + cell.patch + 1].map(|i| shares[i]);
        let within_band = before(low, [low, high], cell.fraction[1]) - shares[first];
        let u =
            [within_all / shares[self.exit.patches()], within_band / (shares[end] - shares[first])];
        Some(u.map(|u| u.clamp(0.0, 1.0)))
    }

    /// With the cosine at the nearer edge of each patch.
    pub(super) fn max_value(&self, wi: DVec3) -> f64 {
        let Some(row) = self.row(wi) else {
            return 0.0;
        };
        let values = &self.values[row * self.exit.patches()..(row + 1) * self.exit.patches()];
        let of_band = |band: &ThetaBand| {
            let of_band = &values[band.first..band.first + band.patches];
            libm::cos(band.lower_rad) * of_band.iter().copied().fold(0.0, f64::max)
        };
        self.exit.bands().iter().map(of_band).fold(0.0, f64::max)
    }

    pub(super) fn incidences(&self) -> Vec<DVec3> {
        self.parts().into_iter().map(|part| part.wi).collect()
    }

    /// The centres of incident patches, each for its projected solid angle; the light beyond the
    /// last band is not scattered.
    pub(super) fn parts(&self) -> Vec<Incident> {
        let has_cap = self.incident.bands()[0].patches == 1;
        let of_cell = |cell: Cell| {
            let [x, y, z] = self.incident.place(cell);
            let is_cap = has_cap && cell.band == 0;
            let wi = if is_cap { DVec3::Z } else { DVec3::new(-x, -y, z) };
            let part = self.incident.bands()[cell.band].patch_projected_sr() / PI;
            Incident { wi, part }
        };
        self.incident.cells().map(of_cell).collect()
    }

    /// An incidence in each piece that a patch of one table and one of the other have in common;
    /// none where both have the same patches.
    pub(super) fn common_incidences(one: &Self, other: &Self) -> Vec<DVec3> {
        if one.incident.bands() == other.incident.bands() {
            return vec![];
        }
        let onwards = one.incident.common_places(&other.incident);
        onwards.into_iter().map(|[x, y, z]| DVec3::new(-x, -y, z)).collect()
    }

    /// The incident patch: by where light goes to.
    fn row(&self, wi: DVec3) -> Option<usize> {
        self.incident.cell([-wi.x, -wi.y]).map(|cell| self.incident.index(cell))
    }

    fn shares(&self, row: usize) -> &[f64] {
        let columns = self.exit.patches() + 1;
        &self.share_before[row * columns..(row + 1) * columns]
    }
}

fn is_isotropic(incident: &AngleBasis, exit: &AngleBasis, values: &[f64]) -> bool {
    let columns = exit.patches();
    incident.bands().iter().all(|band_in| {
        let first = &values[band_in.first * columns..][..columns];
        let has_even_bands = exit.bands().iter().all(|band| {
            let of_band = &first[band.first..band.first + band.patches];
            of_band.iter().all(|value| *value == of_band[0])
        });
        let mut rows =
            values[band_in.first * columns..].chunks_exact(columns).take(band_in.patches);
        has_even_bands && rows.all(|row| row == first)
    })
}

/// Not too near to the edges of a patch.
fn inside(fraction: f64) -> f64 {
    fraction.clamp(INSIDE, 1.0 - INSIDE)
}
