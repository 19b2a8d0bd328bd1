//! What a measured surface reflects and transmits, and where its table breaks energy conservation or reciprocity.
//!
//! Tables are used as they are: these figures say by how much they are wrong.

mod energy;
mod reciprocity;

use super::distribution::upwards;
use super::{MeasuredBsdf, Side, Way};
pub use energy::EnergyBalance;
use glam::DVec3;
use quasilux_sampling::warp::sample_disk;
pub use reciprocity::Reciprocity;

/// Figures of a measured surface.
#[derive(Clone, Debug, PartialEq)]
pub struct BsdfAnalysis {
    /// For each side that light arrives on and that scatters.
    pub energy: Vec<EnergyBalance>,
    /// Reflection off each side, and transmission where both sides have one.
    pub reciprocity: Vec<Reciprocity>,
}

/// An incident direction that stands for a part of diffuse light.
#[derive(Clone, Copy, Debug)]
pub(super) struct Incident {
    pub(super) wi: DVec3,
    /// Parts add up to 1.
    pub(super) part: f64,
}

impl BsdfAnalysis {
    /// How far f of light that arrives on `side` and goes `way` is from that of exchanged directions; `None` where one of the two is
    /// missing.
    #[must_use]
    pub fn reciprocity(&self, side: Side, way: Way) -> Option<&Reciprocity> {
        // Of transmission there is one figure for both sides.
        let is_meant = |found: &&Reciprocity| {
            found.way == way && (way == Way::Transmission || found.side == side)
        };
        self.reciprocity.iter().find(is_meant)
    }

    /// Figures of a surface; [`MeasuredBsdf::analysis`] keeps them.
    #[must_use]
    pub fn of(bsdf: &MeasuredBsdf) -> Self {
        let energy = Side::ALL.into_iter().filter_map(|side| EnergyBalance::of(bsdf, side));
        Self { energy: energy.collect(), reciprocity: reciprocity::all(bsdf) }
    }
}

/// Point `index` of `count` in the unit square: a lattice of rank 1, its generator the golden section (Roberts 2018), moved by
/// `shift`.
pub(super) fn lattice(index: usize, count: usize, shift: f64) -> [f64; 2] {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let turns = index as f64 * GOLDEN + shift;
    [(index as f64 + 0.5) / count as f64, turns - turns.floor()]
}

/// Well-spread directions that stand for equal projected solid angles.
fn spread(count: usize) -> impl Iterator<Item = DVec3> {
    (0..count).map(move |index| upwards(sample_disk(lattice(index, count, 0.0))))
}
