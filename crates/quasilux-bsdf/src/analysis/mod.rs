//! What a measured surface reflects and transmits, and where its table breaks energy conservation
//! or reciprocity.
//!
//! Tables are used as they are: these figures say by how much they are wrong.

mod energy;
mod reciprocity;

use crate::side::ScatteringMode;
use crate::side::Side;
use crate::tables::ScatteringTables;
pub use energy::EnergyBalance;
pub use reciprocity::Reciprocity;

/// Figures of a measured surface.
#[derive(Clone, Debug, PartialEq)]
pub struct BsdfAnalysis {
    /// For each side that light arrives on and that scatters.
    pub energy: Vec<EnergyBalance>,
    /// Reflection off each side, and transmission where both sides have one.
    pub reciprocity: Vec<Reciprocity>,
}

impl BsdfAnalysis {
    /// How far f of light that arrives on `side` and is scattered in `mode` is from that of swapped
    /// directions; `None` where one of the two is missing.
    #[must_use]
    pub fn reciprocity(&self, side: Side, mode: ScatteringMode) -> Option<&Reciprocity> {
        // Of transmission there is one figure for both sides.
        let is_meant = |found: &&Reciprocity| {
            found.mode == mode && (mode == ScatteringMode::Transmission || found.side == side)
        };
        self.reciprocity.iter().find(is_meant)
    }

    /// Figures of a surface; [`MeasuredBsdf::analysis`](crate::MeasuredBsdf::analysis) keeps them.
    pub(crate) fn new(tables: &ScatteringTables) -> Self {
        let energy = Side::ALL.into_iter().filter_map(|side| EnergyBalance::new(tables, side));
        Self { energy: energy.collect(), reciprocity: reciprocity::all(tables) }
    }
}
