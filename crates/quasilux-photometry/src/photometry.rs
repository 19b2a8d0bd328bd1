//! One measured luminaire: a table of intensities in the luminaire frame, and header facts.

use crate::{DirectionSample, LuminaireFacts, SphericalTable, Standard, Tilt, TiltFactor, Web};
use glam::DVec3;

/// Integrated and stated flux may differ by this part without a warning.
pub(crate) const FLUX_TOLERANCE: f64 = 0.01;
/// Luminaires give no smaller part of the light of their lamps: of published files the darkest
/// louvres give a quarter.
const MIN_OUTPUT: f64 = 0.1;

/// A measured luminaire.
///
/// Directions are in the luminaire frame: gamma = 0 along -z, C0 along +x, C90 along +y, whatever
/// the photometric type: see [`Web`] for where the angles of types A and B lie in it.
#[derive(Clone, Debug)]
pub struct Photometry {
    table: SphericalTable,
    facts: LuminaireFacts,
    name: String,
}

impl Photometry {
    /// A luminaire from a table of candela in the frame that [`Web`] gives the photometric type of
    /// `facts`: for type C theta is gamma and phi is C.
    pub fn new(table: SphericalTable, facts: LuminaireFacts) -> Self {
        Self { table, facts, name: String::new() }
    }

    /// The same luminaire under the name by which messages and pictures are to call it: that of
    /// its file.
    #[must_use]
    pub fn with_name(mut self, name: &str) -> Self {
        name.clone_into(&mut self.name);
        self
    }

    /// The name that [`Self::with_name`] gave it; empty without one.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Luminous intensity towards a unit direction of the luminaire frame, in candela.
    pub fn intensity_cd(&self, direction: DVec3) -> f64 {
        self.table.value(self.web().table_from_luminaire(direction))
    }

    /// Luminous flux in lumens, integrated exactly from the table.
    pub fn flux_lm(&self) -> f64 {
        self.table.integral()
    }

    /// Solid angle, sr^-1: a direction with density `intensity_cd / flux_lm`; `None` only when
    /// the flux is zero.
    pub fn sample(&self, u: [f64; 2]) -> Option<DirectionSample> {
        let DirectionSample { direction, pdf_sr } = self.table.sample(u)?;
        Some(DirectionSample { direction: self.web().luminaire_from_table(direction), pdf_sr })
    }

    /// The direction of [`Self::sample`] alone: nobody looks up its density.
    pub fn sample_direction(&self, u: [f64; 2]) -> Option<DVec3> {
        Some(self.web().luminaire_from_table(self.table.sample_direction(u)?))
    }

    /// Solid angle, sr^-1: the density of [`Self::sample`].
    pub fn pdf_sr(&self, direction: DVec3) -> f64 {
        self.table.pdf(self.web().table_from_luminaire(direction))
    }

    /// The coordinates that [`Self::sample`] turns into `direction`.
    pub fn invert(&self, direction: DVec3) -> [f64; 2] {
        self.table.invert(self.web().table_from_luminaire(direction))
    }

    /// The file's own flux: lamp lumens times number of lamps; `None` for absolute photometry, and
    /// where the file gives no positive number.
    pub fn rated_flux_lm(&self) -> Option<f64> {
        self.facts.rated_flux_lm()
    }

    /// Whether it gives less light than its lamps, as luminaires do: the lumens of an LM-63 file
    /// are those of bare lamps.
    pub fn has_usual_losses(&self) -> bool {
        let output = self.facts.lamps_flux_lm().map(|lamps_lm| self.flux_lm() / lamps_lm);
        matches!(self.facts.standard, Standard::Lm63(_))
            && output.is_some_and(|output| (MIN_OUTPUT..1.0).contains(&output))
    }

    /// The same luminaire with tilt factors that stand in another file: see
    /// [`read_tilt`](crate::read_tilt).
    #[must_use]
    pub fn with_tilt(mut self, tilt: Tilt) -> Self {
        self.facts.tilt = tilt;
        self
    }

    /// The factor on all intensities when straight down is the unit vector `down` of the luminaire
    /// frame: the lamps' output at that tilt. Intensities, flux and density here are those at
    /// factor 1.
    pub fn tilt_factor(&self, down: DVec3) -> TiltFactor {
        self.facts.tilt.factor(down)
    }

    /// What the file's header says.
    pub fn facts(&self) -> &LuminaireFacts {
        &self.facts
    }

    /// The web of angles that the file's intensities are given in.
    pub fn web(&self) -> Web {
        Web::new(self.facts.photometric_type)
    }

    /// The table of candela, in its own frame. Only for type C are theta and phi gamma and C: ask
    /// [`Web::table_angles`], or [`Self::intensity_cd`] at a [`Web::direction`], for any type.
    pub fn table(&self) -> &SphericalTable {
        &self.table
    }
}
