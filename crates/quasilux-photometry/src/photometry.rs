//! One measured luminaire: a table of intensities in the luminaire frame, and header facts.

use crate::{DirectionSample, LuminaireFacts, SphericalTable};
use glam::DVec3;

/// A measured luminaire.
///
/// Directions are in the luminaire frame: gamma = 0 along -z, C0 along +x, C90 along +y.
#[derive(Clone, Debug)]
pub struct Photometry {
    table: SphericalTable,
    facts: LuminaireFacts,
}

impl Photometry {
    /// A luminaire from a table of candela over (gamma, C): theta is gamma, phi is C.
    pub fn new(table: SphericalTable, facts: LuminaireFacts) -> Self {
        Self { table, facts }
    }

    /// Luminous intensity towards a unit direction of the luminaire frame, in candela.
    pub fn intensity_cd(&self, direction: DVec3) -> f64 {
        self.table.value(across_horizon(direction))
    }

    /// Luminous flux in lumens, integrated exactly from the table.
    pub fn flux_lm(&self) -> f64 {
        self.table.integral()
    }

    /// Solid angle, sr^-1: a direction with density `intensity_cd / flux_lm`; `None` only when
    /// the flux is zero.
    pub fn sample(&self, u: [f64; 2]) -> Option<DirectionSample> {
        let DirectionSample { direction, pdf_sr } = self.table.sample(u)?;
        Some(DirectionSample { direction: across_horizon(direction), pdf_sr })
    }

    /// Solid angle, sr^-1: the density of [`Self::sample`].
    pub fn pdf_sr(&self, direction: DVec3) -> f64 {
        self.table.pdf(across_horizon(direction))
    }

    /// The coordinates that [`Self::sample`] turns into `direction`.
    pub fn invert(&self, direction: DVec3) -> [f64; 2] {
        self.table.invert(across_horizon(direction))
    }

    /// The file's own flux: lamp lumens times number of lamps; `None` for absolute photometry, and
    /// where the file gives no positive number.
    pub fn rated_flux_lm(&self) -> Option<f64> {
        self.facts.rated_flux_lm()
    }

    /// What the file's header says.
    pub fn facts(&self) -> &LuminaireFacts {
        &self.facts
    }

    /// The table of candela, theta = gamma from +z and phi = C.
    pub fn table(&self) -> &SphericalTable {
        &self.table
    }
}

/// Between the luminaire frame (gamma = 0 along -z) and the frame of the table (theta = 0 along
/// +z): a reflection, its own inverse, which keeps solid angles.
fn across_horizon(direction: DVec3) -> DVec3 {
    DVec3::new(direction.x, direction.y, -direction.z)
}
