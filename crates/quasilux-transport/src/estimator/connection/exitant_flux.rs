//! Exitant flux of a photon that landed: the intensity that a virtual point light sends to either
//! side (Keller 1997).

use super::ConnectionPlan;
use crate::bsdf::TransportMode;
use crate::context::Context;
use crate::importance::{Around, CellWeight};
use crate::spectrum::Spectrum;
use crate::world::Interaction;
use glam::DVec3;

/// Intensities that leave a surface where a photon landed.
pub(super) struct ExitantFlux {
    /// To the side that it came from, and to the other.
    pub(super) sides: [Side; 2],
}

/// Intensity to one side.
#[derive(Clone, Copy)]
pub(super) struct Side {
    /// The same in all directions, but for the cosine.
    pub(super) lm_sr: f64,
    /// The cells around the place, where anything leaves it.
    pub(super) around: Around,
}

/// The part of it that one cell counts.
pub(super) struct CellFlux {
    pub(super) cell: usize,
    pub(super) lm_sr: f64,
}

impl ExitantFlux {
    /// Exitant flux of a photon of this weight after `bounces` on a surface that keeps illuminance;
    /// `None` where no more are wanted.
    pub(super) fn new<S: Spectrum>(
        context: &Context<'_, S>,
        connection: &ConnectionPlan,
        at: &Interaction,
        weight: S,
        bounces: u32,
    ) -> Option<Self> {
        if context.max_bounces.is_some_and(|most| bounces >= most) {
            return None;
        }
        let bsdf = context.world.bsdf(at);
        let side = |n: DVec3, wi: DVec3| {
            let scattered =
                weight * bsdf.evaluate(DVec3::Z, wi, at.front, TransportMode::Importance);
            let lm_sr = scattered.luminance() * context.lights.flux_lm;
            let around = match lm_sr > 0.0 {
                true => connection.partition.landings.around(at.position, n),
                false => Around::default(),
            };
            Side { lm_sr, around }
        };
        let nothing = Side { lm_sr: 0.0, around: Around::default() };
        let behind = if bsdf.transmits() { side(-at.n, -DVec3::Z) } else { nothing };
        Some(Self { sides: [side(at.n, DVec3::Z), behind] })
    }

    /// To both sides.
    pub(super) fn lm_sr(&self) -> f64 {
        self.sides[0].lm_sr + self.sides[1].lm_sr
    }
}

impl Side {
    /// What is told to each cell around, in lm/sr, in proportion to linear interpolation: where it
    /// is told jumps nowhere.
    pub(super) fn by_cell(&self) -> impl Iterator<Item = CellFlux> {
        let flux = |part: CellWeight| CellFlux { cell: part.cell, lm_sr: part.weight * self.lm_sr };
        self.around.iter().map(flux)
    }
}
