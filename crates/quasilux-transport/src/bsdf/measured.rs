//! Measured BSDF: tabulated scattering of a sheet, with one table for each side that light comes
//! from.
//!
//! Photons take the table of light that arrives as they do: its inverse transform draws their
//! directions. Paths run against the light. They need f with the light coming from where they go:
//! its adjoint. Where that is not at hand, they take the table as if it did not matter which
//! direction comes first (Helmholtz reciprocity), and a share of their directions, the `doubt`,
//! goes to all sides alike, so that none with light is missed.

use super::BsdfSample;
use super::TransportMode;
use crate::spectrum::Spectrum;
use glam::DVec3;
use quasilux_bsdf::{Distribution, MeasuredBsdf, ScatteringMode, Side};
use quasilux_sampling::Sampler;
use quasilux_sampling::warp::{pdf_cosine_hemisphere, sample_cosine_hemisphere};
use quasilux_scene::{Rgb, bsdf as scene};

/// The doubt is the mean defect, within these bounds.
const MIN_DOUBT: f64 = 0.05;
const MAX_DOUBT: f64 = 0.5;

/// The sheet.
#[derive(Clone, Debug)]
pub(crate) struct Measured {
    sheet: scene::Measured,
    /// The share of directions of paths that do not come from a table, by the side that they look
    /// at and the way that light reaches them.
    doubts: [[f64; 2]; 2],
}

/// One way that light goes on.
struct Lobe<'t> {
    table: Option<&'t Distribution>,
    /// The share of directions that do not come from the table.
    doubt: f64,
}

impl Measured {
    pub(super) fn new(sheet: scene::Measured) -> Self {
        let of_side = |side| ScatteringMode::ALL.map(|way| doubt(sheet.table(), side, way));
        let doubts = Side::ALL.map(of_side);
        Self { sheet, doubts }
    }

    /// The direction in the world along which the local y axis lies.
    pub(crate) fn up(&self) -> Option<DVec3> {
        self.sheet.up()
    }

    pub(super) fn transmits(&self) -> bool {
        self.sheet.transmits()
    }

    /// The share of light that goes on; of paths an estimate where adjoint tables are not at
    /// hand.
    pub(super) fn albedo<S: Spectrum>(&self, wo: DVec3, front: bool, mode: TransportMode) -> S {
        let side = self.sheet.side(front);
        let share = |way: ScatteringMode| self.lobe(side, way, mode).share(in_table(wo, side));
        let [reflected, passed] = ScatteringMode::ALL.map(share);
        S::from_rgb(reflected + passed)
    }

    pub(super) fn sample<S: Spectrum>(
        &self,
        wo: DVec3,
        front: bool,
        mode: TransportMode,
        sampler: &mut Sampler<'_>,
    ) -> Option<BsdfSample<S>> {
        let side = self.sheet.side(front);
        let from = in_table(wo, side);
        let p_reflected = self.p_reflected(from, side, mode)?;
        let is_reflected = sampler.choose_bool(p_reflected);
        let way =
            if is_reflected { ScatteringMode::Reflection } else { ScatteringMode::Transmission };
        let to = self.lobe(side, way, mode).sample(from, sampler)?;
        let wi = out_of_table(to, side, way);
        let pdf_sr = self.pdf_of(wo, wi, front, mode);
        let value: S = self.evaluate(wo, wi, front, mode);
        Some(BsdfSample { wi, weight: value * (wi.z.abs() / pdf_sr), pdf_sr: Some(pdf_sr) })
    }

    pub(super) fn evaluate<S: Spectrum>(
        &self,
        wo: DVec3,
        wi: DVec3,
        front: bool,
        mode: TransportMode,
    ) -> S {
        let (side, way) = (self.sheet.side(front), way(wi));
        let (own, other) = (in_table(wo, side), in_table(wi, side));
        let value = match mode {
            TransportMode::Importance => {
                self.sheet.table().scattering(side, way).map(|f| f.evaluate(own, other))
            }
            TransportMode::Radiance => {
                let table = self.sheet.table().scattering(source(side, way), way);
                table.map(|f| f.evaluate(other, own))
            }
        };
        value.map_or(S::black(), |rgb| S::from_rgb(Rgb(rgb)))
    }

    /// Of paths.
    pub(super) fn pdf_sr(&self, wo: DVec3, wi: DVec3, front: bool) -> f64 {
        self.pdf_of(wo, wi, front, TransportMode::Radiance)
    }

    fn pdf_of(&self, wo: DVec3, wi: DVec3, front: bool, mode: TransportMode) -> f64 {
        let side = self.sheet.side(front);
        let (from, to) = (in_table(wo, side), in_table(wi, side));
        let Some(p_reflected) = self.p_reflected(from, side, mode) else { return 0.0 };
        let p = if wi.z > 0.0 { p_reflected } else { 1.0 - p_reflected };
        p * self.lobe(side, way(wi), mode).pdf_sr(from, to)
    }

    /// By the light that goes each way; `None` where none does.
    fn p_reflected(&self, from: DVec3, side: Side, mode: TransportMode) -> Option<f64> {
        let share = |way: ScatteringMode| self.lobe(side, way, mode).share(from).luminance();
        let [reflected, passed] = ScatteringMode::ALL.map(share);
        let sum = reflected + passed;
        (sum > 0.0).then(|| reflected / sum)
    }

    fn lobe(&self, side: Side, way: ScatteringMode, mode: TransportMode) -> Lobe<'_> {
        let sheet = self.sheet.table();
        let table = sheet.scattering(side, way);
        match mode {
            TransportMode::Importance => Lobe { table, doubt: 0.0 },
            TransportMode::Radiance => {
                let adjoint = sheet.adjoint(source(side, way), way);
                Lobe { table: adjoint.or(table), doubt: self.doubts[side as usize][way as usize] }
            }
        }
    }
}

impl Lobe<'_> {
    /// The share of light from a direction that goes this way, as far as paths can know.
    fn share(&self, from: DVec3) -> Rgb {
        Rgb(self.albedo(from)) * (1.0 - self.doubt) + Rgb::grey(self.doubt)
    }

    fn albedo(&self, from: DVec3) -> [f64; 3] {
        self.table.map_or([0.0; 3], |table| table.albedo(from))
    }

    /// How many of the directions come from the table.
    fn p_table(&self, from: DVec3) -> f64 {
        if self.doubt == 0.0 {
            return 1.0;
        }
        let share = (1.0 - self.doubt) * Rgb(self.albedo(from)).luminance();
        share / (share + self.doubt)
    }

    fn sample(&self, from: DVec3, sampler: &mut Sampler<'_>) -> Option<DVec3> {
        let is_from_table = self.doubt == 0.0 || sampler.choose_bool(self.p_table(from));
        let u = [sampler.remapped_1d(), sampler.next_1d()];
        match self.table.filter(|_| is_from_table) {
            Some(table) => Some(table.sample(from, u)?.wo),
            None => Some(sample_cosine_hemisphere(u).into()),
        }
    }

    fn pdf_sr(&self, from: DVec3, to: DVec3) -> f64 {
        let p_table = self.p_table(from);
        let sharp = self.table.map_or(0.0, |table| table.pdf_sr(from, to));
        p_table * sharp + (1.0 - p_table) * pdf_cosine_hemisphere(to.to_array())
    }
}

/// How many directions of paths that look at a side had better not come from a table.
fn doubt(table: &MeasuredBsdf, side: Side, way: ScatteringMode) -> f64 {
    let source = source(side, way);
    if table.scattering(source, way).is_none() || table.adjoint(source, way).is_some() {
        return 0.0;
    }
    // A look at some directions cannot tell that a table is reciprocal everywhere.
    let defect = table.analysis().reciprocity(side, way).map(|found| found.mean);
    defect.map_or(1.0, |defect| defect.clamp(MIN_DOUBT, MAX_DOUBT))
}

/// The side that light arrives on which goes on from `side` after it went that way.
fn source(side: Side, way: ScatteringMode) -> Side {
    match way {
        ScatteringMode::Reflection => side,
        ScatteringMode::Transmission => side.other(),
    }
}

fn way(wi: DVec3) -> ScatteringMode {
    if wi.z > 0.0 { ScatteringMode::Reflection } else { ScatteringMode::Transmission }
}

/// A local direction as tables have it. Their x axis points to the right for who sees the back, and
/// z is positive on either side.
fn in_table(local: DVec3, side: Side) -> DVec3 {
    let x = match side {
        Side::Front => -local.x,
        Side::Back => local.x,
    };
    DVec3::new(x, local.y, local.z.abs())
}

fn out_of_table(direction: DVec3, side: Side, way: ScatteringMode) -> DVec3 {
    let local = in_table(direction, side);
    match way {
        ScatteringMode::Reflection => local,
        ScatteringMode::Transmission => DVec3::new(local.x, local.y, -local.z),
    }
}
