//! A measured sheet.

use glam::DVec3;
use quasilux_bsdf::{EnergyBalance, MeasuredBsdf, ScatteringMode, Side};
use std::sync::Arc;

/// A thin sheet whose scattering was measured: tables for light that arrives on its two sides.
///
/// The front of the table is on the front of the facets. A table of one side alone that lets
/// nothing through is that of an opaque sample, and holds for both sides.
#[derive(Clone, Debug)]
pub struct Measured {
    table: Arc<MeasuredBsdf>,
    up: Option<DVec3>,
    /// The side that the table knows of, where that is one and nothing passes.
    only_side: Option<Side>,
    /// The share of diffuse light that is not absorbed, on the side where that is more.
    most_kept: f64,
}

impl Measured {
    /// The sheet of a table. `up` is the direction of the table's `y` axis, in so far as it lies in
    /// a facet; `None` only where the table is isotropic.
    #[must_use]
    pub fn new(table: Arc<MeasuredBsdf>, up: Option<DVec3>) -> Self {
        let kept = |balance: &EnergyBalance| balance.diffuse.iter().sum();
        let most_kept = table.analysis().energy.iter().map(kept).fold(0.0, f64::max);
        let only_side = only_side(&table);
        Self { table, up, only_side, most_kept }
    }

    /// How it scatters.
    #[must_use]
    pub fn table(&self) -> &MeasuredBsdf {
        &self.table
    }

    /// Which side of the table is on that side of a facet.
    #[must_use]
    pub fn side(&self, front: bool) -> Side {
        self.only_side.unwrap_or(if front { Side::Front } else { Side::Back })
    }

    /// The direction of the table's `y` axis in the world, of any length.
    #[must_use]
    pub const fn up(&self) -> Option<DVec3> {
        self.up
    }

    /// Whether it treats all channels alike.
    #[must_use]
    pub fn is_grey(&self) -> bool {
        !self.table.is_coloured()
    }

    /// Whether light passes through to the other side.
    #[must_use]
    pub fn transmits(&self) -> bool {
        self.table.distributions().any(|it| it.mode == ScatteringMode::Transmission)
    }

    /// The share of diffuse light that is not absorbed, on the side where that is more; above 1
    /// where the table breaks the conservation of energy.
    #[must_use]
    pub const fn most_kept(&self) -> f64 {
        self.most_kept
    }
}

/// The one side that an opaque sample was measured from.
fn only_side(table: &MeasuredBsdf) -> Option<Side> {
    let is_opaque = table.distributions().all(|it| it.mode == ScatteringMode::Reflection);
    let mut sides = table.distributions().map(|it| it.side);
    let first = sides.next()?;
    (is_opaque && sides.all(|side| side == first)).then_some(first)
}

/// Of the same table, turned alike.
impl PartialEq for Measured {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.table, &other.table) && self.up == other.up
    }
}
