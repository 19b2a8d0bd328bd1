//! The scattering distribution function of one side of a surface, reflected or transmitted: a
//! closed set of tables, one file each.

use crate::gridded::GriddedTable;
use crate::hemisphere::Incident;
use crate::hemisphere::ScatterSample;
use crate::klems::KlemsTable;
use crate::tree::AdjointTree;
use crate::tree::TensorTree;
use glam::DVec3;

/// A scattering distribution function f(wi, wo) in sr^-1, as a table.
///
/// All directions are in the frame of the [crate](crate): unit, away from the surface, with a
/// positive `z` on their own side. f does not contain the cosine of `wo`.
#[derive(Clone, Debug)]
pub enum Distribution {
    /// Constant in pairs of angular patches.
    Klems(KlemsTable),
    /// Constant in boxes of varied size.
    TensorTree(TensorTree),
    /// The adjoint of an isotropic tree of boxes, for light that travels in reverse.
    AdjointTree(AdjointTree),
    /// Lobes over a grid of incident directions.
    Gridded(GriddedTable),
}

impl Distribution {
    /// f(wi, wo) in sr^-1, without the cosine, in linear RGB; three equal channels where the table
    /// is grey. Zero where a direction is below its side.
    #[must_use]
    pub fn evaluate(&self, wi: DVec3, wo: DVec3) -> [f64; 3] {
        if wi.z < 0.0 || wo.z < 0.0 {
            return [0.0; 3];
        }
        match self {
            Self::Klems(table) => [table.value(wi, wo); 3],
            Self::TensorTree(tree) => [tree.value(wi, wo); 3],
            Self::AdjointTree(tree) => [tree.value(wi, wo); 3],
            Self::Gridded(table) => table.value(wi, wo),
        }
    }

    /// The share of light from `wi` that is scattered: the integral of f times the cosine of `wo`,
    /// exact for what [`Self::evaluate`] returns.
    #[must_use]
    pub fn albedo(&self, wi: DVec3) -> [f64; 3] {
        match self {
            Self::Klems(table) => [table.albedo(wi); 3],
            Self::TensorTree(tree) => [tree.albedo(wi); 3],
            Self::AdjointTree(tree) => [tree.albedo(wi); 3],
            Self::Gridded(table) => table.albedo(wi),
        }
    }

    /// Solid angle, sr^-1: a direction with density proportional to the luminance of f times the
    /// cosine of `wo`; `None` where the albedo is zero.
    ///
    /// `u` is in [0, 1]^2. An inverse transform: no rejection, and continuous in `u` within a cell
    /// of the table.
    #[must_use]
    pub fn sample(&self, wi: DVec3, u: [f64; 2]) -> Option<ScatterSample> {
        match self {
            Self::Klems(table) => table.sample(wi, u),
            Self::TensorTree(tree) => tree.sample(wi, u),
            Self::AdjointTree(tree) => tree.sample(wi, u),
            Self::Gridded(table) => table.sample(wi, u),
        }
    }

    /// Solid angle, sr^-1: the density of [`Self::sample`]; zero where the albedo is zero.
    #[must_use]
    pub fn pdf_sr(&self, wi: DVec3, wo: DVec3) -> f64 {
        if wi.z < 0.0 || wo.z < 0.0 {
            return 0.0;
        }
        match self {
            Self::Klems(table) => table.pdf_sr(wi, wo),
            Self::TensorTree(tree) => tree.pdf_sr(wi, wo),
            Self::AdjointTree(tree) => tree.pdf_sr(wi, wo),
            Self::Gridded(table) => table.pdf_sr(wi, wo),
        }
    }

    /// Coordinates that [`Self::sample`] turns into `wo`; `None` where it has density zero.
    #[must_use]
    pub fn invert(&self, wi: DVec3, wo: DVec3) -> Option<[f64; 2]> {
        if self.pdf_sr(wi, wo) <= 0.0 {
            return None;
        }
        match self {
            Self::Klems(table) => table.invert(wi, wo),
            Self::TensorTree(tree) => Some(tree.invert(wi, wo)),
            Self::AdjointTree(tree) => Some(tree.invert(wi, wo)),
            Self::Gridded(table) => table.invert(wi, wo),
        }
    }

    /// A bound of the luminance of f times the cosine of `wo`, in sr^-1, over all exits: what
    /// rejection would need. It is reached to within the cosine in a cell, or to within the mixture
    /// of lobes.
    #[must_use]
    pub fn max_value(&self, wi: DVec3) -> f64 {
        match self {
            Self::Klems(table) => table.max_value(wi),
            Self::TensorTree(tree) => tree.max_value(wi),
            Self::AdjointTree(tree) => tree.max_value(wi),
            Self::Gridded(table) => table.max_value(wi),
        }
    }

    /// The incident directions that the table is stored for: centres of cells or nodes of a grid,
    /// along the half-plane of positive `x` where a grid or a tree is isotropic. Trees finer than
    /// 32 cells a side are shown at that resolution.
    #[must_use]
    pub fn incidences(&self) -> Vec<DVec3> {
        match self {
            Self::Klems(table) => table.incidences(),
            Self::TensorTree(tree) => tree.incidences(),
            Self::AdjointTree(tree) => tree.original().incidences(),
            Self::Gridded(table) => table.incidences(),
        }
    }

    /// Incidences such that the mean of the albedo over projected solid angle is the sum of theirs
    /// by their parts, exactly.
    pub(super) fn parts(&self) -> Vec<Incident> {
        match self {
            Self::Klems(table) => table.parts(),
            Self::TensorTree(tree) => tree.parts(),
            Self::AdjointTree(tree) => tree.parts(),
            Self::Gridded(table) => table.parts(),
        }
    }

    /// Whether the table stays the same when both directions turn together about the normal.
    #[must_use]
    pub fn is_isotropic(&self) -> bool {
        match self {
            Self::Klems(table) => table.is_isotropic(),
            Self::TensorTree(tree) => tree.is_isotropic(),
            Self::AdjointTree(_) => true,
            Self::Gridded(table) => table.is_isotropic(),
        }
    }

    /// Whether colour channels differ.
    #[must_use]
    pub fn is_coloured(&self) -> bool {
        match self {
            Self::Klems(_) | Self::TensorTree(_) | Self::AdjointTree(_) => false,
            Self::Gridded(table) => table.is_coloured(),
        }
    }

    /// What people call the kind of table.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Klems(_) => "Klems",
            Self::TensorTree(_) | Self::AdjointTree(_) => "tensor tree",
            Self::Gridded(_) => "gridded",
        }
    }
}
