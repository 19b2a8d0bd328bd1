//! A scattering distribution as lobes over a grid of incident directions.
//!
//! For each stored incidence f is the sum of its least value and of a
//! [`SphericalTable`](quasilux_photometry::SphericalTable) of what is above that, times cos(theta),
//! over exit directions, bilinear in spherical angles. Between incidences g = f cos(theta) is the
//! linear mixture of theirs, two by polar angle and, where the surface is not isotropic, two by
//! azimuth, each turned about the normal so that its plane of incidence is that of `wi`. What is
//! above the least value follows the mirror direction where neighbours have more in common so
//! (`stretch.rs`), without loss: the albedo is the mixture of the integrals; and where a file that
//! counts angles from there has but one incidence. The difference from the surface is of second
//! order in the gap between incidences; [`GriddedTable::error_between`] estimates it from the table
//! itself.
//!
//! Files with lobes measure one side, the front, and count azimuths counterclockwise as seen from
//! there. In the frame of the sheet that is clockwise: the `x` of a lobe is `-x` of the sheet.
//!
//! Sampling picks Lambert's part or a lobe by its share of the albedo with `u[0]`, which is
//! renormalised, inverts it and moves the direction. The density is that of the whole mixture, f
//! cos(theta) over the albedo: each sample weighs the same, and nothing is biased. What it costs is
//! strata: up to five maps share the unit square, so that a sequence fills each with a part of its
//! points, and one direction has several pairs of coordinates, of which `invert` returns one.

mod error;
mod lobe;
mod mixture;
mod nodes;
mod resample;
mod stretch;

use crate::hemisphere::Incident;
use crate::hemisphere::ScatterSample;
pub(super) use error::table_error;
use glam::DVec3;
pub(super) use lobe::Lobe;
use mixture::{Mixture, Part};
pub(super) use nodes::{WeightedNode, around, bracket, pair};
use nodes::{parts_of_azimuths, parts_of_polar_angles};
use quasilux_photometry::Angles;
pub(super) use resample::ExitGrid;
use std::f64::consts::TAU;
use stretch::{LobeTransform, Mirror, Stretch};

/// Incident directions of one file: more than are measured, and few enough for the grids of their
/// lobes.
pub(super) const MAX_INCIDENCES: usize = 1000;

/// Lobes over a grid of incident directions.
#[derive(Clone, Debug)]
pub struct GriddedTable {
    /// Incident polar angles, ascending.
    theta_rad: Vec<f64>,
    /// Incident azimuths, ascending within one turn; one alone where the surface is isotropic.
    phi_rad: Vec<f64>,
    /// The polar angle about which lobes lie, for each of `theta_rad`.
    specular_rad: Vec<f64>,
    /// The same as directions.
    mirrors: Vec<Mirror>,
    /// How lobes move between each polar angle and the next; of one polar angle alone, how its
    /// lobes move, if they do.
    stretches: Vec<Stretch>,
    /// All polar angles of the first azimuth, then of the next.
    lobes: Vec<Lobe>,
}

/// The lobes that mix at an incident direction.
struct TurnedMixture<'t> {
    mixture: Mixture<'t>,
    /// Cosine and sine of the azimuth of the incident direction as seen from the front: lobes are
    /// stored with it at 0.
    turn: [f64; 2],
}

/// Where lobes belong at an incident direction.
struct LobeTarget {
    /// How they get there.
    stretch: Stretch,
    mirror: Mirror,
}

impl GriddedTable {
    /// A table of lobes, all polar angles of the first azimuth, then of the next; they lie about
    /// the polar angles `specular_rad`. One azimuth alone makes it isotropic. `None` unless angles
    /// ascend and there is a lobe for each pair.
    pub(super) fn new(
        theta_rad: Vec<f64>,
        phi_rad: Vec<f64>,
        specular_rad: Vec<f64>,
        lobes: Vec<Lobe>,
    ) -> Option<Self> {
        let ascends = |angles: &[f64]| angles.windows(2).all(|pair| pair[0] < pair[1]);
        let is_full = !theta_rad.is_empty()
            && !phi_rad.is_empty()
            && specular_rad.len() == theta_rad.len()
            && lobes.len() == theta_rad.len() * phi_rad.len();
        let spans_a_turn = phi_rad.last().zip(phi_rad.first()).is_some_and(|(l, f)| l - f < TAU);
        if !(is_full && spans_a_turn && ascends(&theta_rad) && ascends(&phi_rad)) {
            return None;
        }
        let mirrors: Vec<Mirror> = specular_rad.iter().map(|&angle| Mirror::new(angle)).collect();
        let mut table =
            Self { theta_rad, phi_rad, specular_rad, mirrors, stretches: Vec::new(), lobes };
        let stretches = (1..table.theta_rad.len()).map(|above| table.stretch([above - 1, above]));
        table.stretches = stretches.collect();
        Some(table)
    }

    /// The same table, whose lobes follow the mirror direction also where there is but one incident
    /// polar angle, with no neighbour to tell: those of files that count angles from there. They
    /// keep their light, and their width in the plane of incidence.
    #[must_use]
    pub(super) fn following_the_mirror(mut self) -> Self {
        if self.theta_rad.len() == 1 {
            self.stretches = vec![Stretch::Square];
        }
        self
    }

    /// How lobes had better move between two incident polar angles.
    fn stretch(&self, thetas: [usize; 2]) -> Stretch {
        let rows = self.lobes.chunks_exact(self.theta_rad.len());
        let pairs = rows.map(|row| thetas.map(|theta| &row[theta]));
        Stretch::between(pairs, thetas.map(|theta| self.mirrors[theta]))
    }

    pub(super) fn is_isotropic(&self) -> bool {
        self.phi_rad.len() == 1
    }

    pub(super) fn is_coloured(&self) -> bool {
        self.lobes.iter().any(Lobe::is_coloured)
    }

    pub(super) fn value(&self, wi: DVec3, wo: DVec3) -> [f64; 3] {
        let TurnedMixture { mixture, turn } = self.mixture(wi);
        mixture.f(turned(wo, turn))
    }

    pub(super) fn albedo(&self, wi: DVec3) -> [f64; 3] {
        self.mixture(wi).mixture.albedo()
    }

    pub(super) fn sample(&self, wi: DVec3, u: [f64; 2]) -> Option<ScatterSample> {
        let TurnedMixture { mixture, turn } = self.mixture(wi);
        let wo = turned(mixture.sample(u)?, turn);
        // That of the direction as it is rounded: beside a peak the last bits may be much.
        let pdf_sr = mixture.pdf_sr(turned(wo, turn));
        Some(ScatterSample { wo, pdf_sr })
    }

    pub(super) fn pdf_sr(&self, wi: DVec3, wo: DVec3) -> f64 {
        let TurnedMixture { mixture, turn } = self.mixture(wi);
        mixture.pdf_sr(turned(wo, turn))
    }

    /// Of the coordinates that lead to `wo`, those of the part of the mixture that is the brightest
    /// there.
    pub(super) fn invert(&self, wi: DVec3, wo: DVec3) -> Option<[f64; 2]> {
        let TurnedMixture { mixture, turn } = self.mixture(wi);
        mixture.invert(turned(wo, turn))
    }

    /// The mixture of the greatest values of all lobes, wherever they are.
    pub(super) fn max_value(&self, wi: DVec3) -> f64 {
        self.mixture(wi).mixture.max_value()
    }

    pub(super) fn incidences(&self) -> Vec<DVec3> {
        let of_azimuth = |&phi_rad: &f64| {
            let at = move |&theta_rad: &f64| Angles { theta_rad, phi_rad }.direction();
            self.theta_rad.iter().map(at)
        };
        if !self.is_isotropic() {
            return self.phi_rad.iter().flat_map(of_azimuth).map(as_in_file).collect();
        }
        self.phi_rad.iter().flat_map(of_azimuth).collect()
    }

    /// Nodes, each for the light of which its lobe has the share: shares are linear in both angles
    /// between them.
    pub(super) fn parts(&self) -> Vec<Incident> {
        let of_theta = parts_of_polar_angles(&self.theta_rad);
        let of_phi = parts_of_azimuths(&self.phi_rad);
        let parts = of_phi.iter().flat_map(|phi| of_theta.iter().map(move |theta| phi * theta));
        let at = |(wi, part)| Incident { wi, part };
        self.incidences().into_iter().zip(parts).map(at).collect()
    }

    /// Whether the greatest sum of shares of both is at a node of one of them.
    pub(super) fn shares_azimuths(&self, other: &Self) -> bool {
        let are_isotropic = self.is_isotropic() && other.is_isotropic();
        are_isotropic || self.phi_rad == other.phi_rad
    }

    /// The lobes that mix at an incident direction.
    fn mixture(&self, wi: DVec3) -> TurnedMixture<'_> {
        let horizontal = (wi.x * wi.x + wi.y * wi.y).sqrt();
        let turn =
            if horizontal > 0.0 { [-wi.x / horizontal, wi.y / horizontal] } else { [1.0, 0.0] };
        let theta_rad = libm::atan2(horizontal, wi.z);
        let thetas = bracket(&self.theta_rad, theta_rad);
        let phis = if self.is_isotropic() {
            pair(0, 0, 0.0)
        } else {
            around(&self.phi_rad, libm::atan2(turn[1], turn[0]))
        };
        let LobeTarget { stretch, mirror } = self.mirror(theta_rad, thetas);
        let transforms =
            thetas.map(|theta| LobeTransform::new(self.mirrors[theta.index], mirror, stretch));
        let part = |i: usize| Part {
            lobe: &self.lobes[phis[i / 2].index * self.theta_rad.len() + thetas[i % 2].index],
            weight: phis[i / 2].weight * thetas[i % 2].weight,
            transform: transforms[i % 2],
        };
        TurnedMixture { mixture: Mixture { parts: [0, 1, 2, 3].map(part) }, turn }
    }

    /// Where lobes belong at an incident polar angle between two nodes, or beyond the ends.
    fn mirror(&self, theta_rad: f64, nodes: [WeightedNode; 2]) -> LobeTarget {
        let [low, high] = nodes.map(|node| node.index);
        let [below, above] = nodes.map(|node| node.weight);
        if low != high {
            let specular_rad = below * self.specular_rad[low] + above * self.specular_rad[high];
            let stretch = self.stretches[low];
            // At a node nothing moves.
            let mirror = if above == 0.0 { self.mirrors[low] } else { Mirror::new(specular_rad) };
            return LobeTarget { stretch, mirror };
        }
        // The two nodes are one beyond the ends, and where there is but one.
        let stretch = if low == 0 { self.stretches.first() } else { self.stretches.last() };
        let off_rad = theta_rad - self.theta_rad[low];
        let stretch = stretch.copied().filter(|_| off_rad != 0.0).unwrap_or(Stretch::None);
        let mirror = Mirror::new((self.specular_rad[low] + off_rad).max(0.0));
        // From one incidence alone lobes go all the way.
        let is_alone = self.theta_rad.len() == 1;
        let mirror = if is_alone { mirror } else { mirror.near(self.mirrors[low]) };
        LobeTarget { stretch, mirror }
    }
}

/// A direction in the frame of the lobes, from one of the sheet, and back.
fn turned(direction: DVec3, [cos, sin]: [f64; 2]) -> DVec3 {
    let DVec3 { x, y, z } = direction;
    // Rounding at the horizon must not lead below it.
    DVec3::new(sin * y - cos * x, sin * x + cos * y, z.max(0.0))
}

/// A direction in the frame of the file, which is seen from the front, from one of the sheet, and
/// back.
pub(super) fn as_in_file(direction: DVec3) -> DVec3 {
    DVec3::new(-direction.x, direction.y, direction.z)
}
