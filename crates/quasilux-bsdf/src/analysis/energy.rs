//! Shares of light: what is reflected, what passes, and the greatest sum of both.

use crate::color::luminance;
use crate::distribution::Distribution;
use crate::hemisphere::upwards;
use crate::hemisphere::{Incident, spread};
use crate::klems::KlemsTable;
use crate::side::ScatteringMode;
use crate::side::Side;
use crate::tables::ScatteringTables;
use glam::DVec3;

/// Directions where sums of two tables are looked at that have nothing in common.
const SPREAD: usize = 4096;

/// Where light of one side goes.
#[derive(Clone, Debug, PartialEq)]
pub struct EnergyBalance {
    /// The side that light arrives on.
    pub side: Side,
    /// Luminous reflectance and transmittance for light along the normal.
    pub normal: [f64; 2],
    /// The same for diffuse light: means over projected solid angle, exact for what the tables say.
    pub diffuse: [f64; 2],
    /// The greatest sum of both over all incidences, of the strongest colour channel.
    ///
    /// It is the maximum itself: of tables that are constant in cells a value of one of their
    /// cells, of lobes, whose shares are linear between nodes, one at a node, and of adjoint
    /// trees one at the edge of a ring, to 1e-5 of its width. Only where both tables are of
    /// different kinds, or two grids of lobes have azimuths apart, it is the greatest of 4096
    /// directions and of all cells.
    pub worst: f64,
    /// The incidence where that is.
    pub worst_wi: DVec3,
}

impl EnergyBalance {
    /// The balance of one side; `None` where it scatters nothing.
    pub(super) fn new(tables: &ScatteringTables, side: Side) -> Option<Self> {
        let tables = ScatteringMode::ALL.map(|mode| tables.get(side, mode));
        let share = |mode: usize, wi| tables[mode].map_or([0.0; 3], |found| found.albedo(wi));
        let total = |wi| {
            let (reflected, passed) = (share(0, wi), share(1, wi));
            (0..3).map(|channel| reflected[channel] + passed[channel]).fold(0.0, f64::max)
        };
        let parts = tables.map(|table| table.map_or_else(Vec::new, Distribution::parts));
        let mean = |mode: usize| {
            let of_part = |part: &Incident| part.part * luminance(share(mode, part.wi));
            // Of nothing zero, which a sum of no numbers is not: that is -0.
            parts[mode].iter().map(of_part).fold(0.0, |sum, of_part| sum + of_part)
        };
        let diffuse = [mean(0), mean(1)];
        let looked_at = parts.into_iter().flatten().map(|part| part.wi);
        let further = match tables {
            [Some(reflected), Some(passed)] => common(reflected, passed),
            [None, None] => return None,
            [Some(one), None] | [None, Some(one)] => common(one, one),
        };
        let mut worst = (total(DVec3::Z), DVec3::Z);
        for wi in looked_at.chain(further) {
            let total = total(wi);
            if total > worst.0 {
                worst = (total, wi);
            }
        }
        let normal = [0, 1].map(|mode| luminance(share(mode, DVec3::Z)));
        Some(Self { side, normal, diffuse, worst: worst.0, worst_wi: worst.1 })
    }
}

/// Incidences where the sum of shares of two tables has its maximum, besides those of each.
fn common(one: &Distribution, other: &Distribution) -> Vec<DVec3> {
    match (one, other) {
        (Distribution::Klems(one), Distribution::Klems(other)) => {
            KlemsTable::common_incidences(one, other)
        }
        // Boxes lie in each other: the smaller one is what both have in common.
        (Distribution::TensorTree(a), Distribution::TensorTree(b))
            if a.is_isotropic() == b.is_isotropic() =>
        {
            vec![]
        }
        (one, other) if ring_width(one).is_some() && ring_width(other).is_some() => {
            let width = ring_width(one).into_iter().chain(ring_width(other)).fold(1.0, f64::min);
            edges(width)
        }
        (Distribution::Gridded(a), Distribution::Gridded(b)) if a.shares_azimuths(b) => vec![],
        _ => spread(SPREAD).collect(),
    }
}

/// In rings of the sine that wide what an isotropic tree sends is monotonic; `None` of others.
fn ring_width(table: &Distribution) -> Option<f64> {
    match table {
        Distribution::TensorTree(tree) if tree.is_isotropic() => {
            Some(2.0 / tree.resolution() as f64)
        }
        Distribution::AdjointTree(tree) => Some(2.0 / tree.resolution() as f64),
        _ => None,
    }
}

/// Incidences at the edges of rings, on either side.
fn edges(width: f64) -> Vec<DVec3> {
    let rings = (1.0 / width).round() as u32;
    let at = |ring: u32| [1e-5, 1.0 - 1e-5].map(|part| (f64::from(ring) + part) * width);
    (0..rings).flat_map(at).map(|sine| upwards([sine.min(1.0), 0.0])).collect()
}
