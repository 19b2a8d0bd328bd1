//! One photon's way between walls of one table.

use crate::closed_box::{ClosedBox, HALF_M};
use glam::DVec3;
use quasilux_bsdf::{AngleBasis, Distribution, KlemsTable};
use quasilux_sampling::Sampler;
use quasilux_sampling::warp::{sample_uniform_hemisphere, sample_uniform_sphere};
use std::f64::consts::{FRAC_1_PI, PI};

/// Patches of the table.
const BASIS: &str = "LBNL/Klems Full";
/// Shares of light that are scattered evenly, and around the mirrored direction.
const DIFFUSE: f64 = 0.2;
const GLOSSY: f64 = 0.5;
/// Power of the cosine to the mirrored direction.
const POWER: f64 = 20.0;
/// Where the light is, in half sides of the box.
const LIGHT: DVec3 = DVec3::new(0.3, -0.4, 0.5);

/// A way to make directions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Method {
    /// Uniform directions, accepted with probability f times the cosine over its bound: three
    /// coordinates a trial, all of the same point.
    Rejection,
    /// Two coordinates, one of them what the choice between absorption and scattering left.
    InverseTransform,
}

/// The table of the walls.
pub(super) struct Glossy {
    table: Distribution,
}

impl Method {
    pub(super) const ALL: [Self; 2] = [Self::Rejection, Self::InverseTransform];

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Rejection => "rejection",
            Self::InverseTransform => "inverse transform",
        }
    }
}

impl Glossy {
    /// From Phong's lobe in the form of E. P. Lafortune and Y. D. Willems (1994), which is
    /// reciprocal, at the middles of the patches.
    pub(super) fn new() -> Self {
        let basis = AngleBasis::known(BASIS).expect("a basis");
        let even = vec![1.0; basis.patches() * basis.patches()];
        let even = KlemsTable::new(basis.clone(), basis.clone(), even).expect("a value a pair");
        let middles = Distribution::Klems(even).incidences();
        let pairs = middles.iter().flat_map(|&wi| middles.iter().map(move |&wo| (wi, wo)));
        let values = pairs.map(|(wi, wo)| f_sr(wi, wo)).collect();
        let table = KlemsTable::new(basis.clone(), basis, values).expect("a value a pair");
        Self { table: Distribution::Klems(table) }
    }

    /// The share of light along the normal that is scattered.
    pub(super) fn albedo(&self) -> f64 {
        self.table.albedo(DVec3::Z)[0]
    }

    /// Sends a photon, and tells of every cell that it lands in.
    pub(super) fn photon(
        &self,
        method: Method,
        sampler: &mut Sampler<'_>,
        landed: &mut dyn FnMut(usize),
    ) {
        let mut origin = HALF_M * LIGHT;
        let mut direction =
            sample_uniform_sphere([sampler.remapped_1d(), sampler.next_1d()]).into();
        loop {
            let hit = ClosedBox::hit(origin, direction);
            landed(hit.cell);
            let (tangent, bitangent) = hit.normal.any_orthonormal_pair();
            let local = |w: DVec3| DVec3::new(tangent.dot(w), bitangent.dot(w), hit.normal.dot(w));
            let Some(on) = self.scattered(method, local(-direction), sampler) else { return };
            (origin, direction) =
                (hit.position, tangent * on.x + bitangent * on.y + hit.normal * on.z);
        }
    }

    /// The direction in which a photon goes on, if it does.
    fn scattered(&self, method: Method, wi: DVec3, sampler: &mut Sampler<'_>) -> Option<DVec3> {
        if !sampler.choose_bool(self.table.albedo(wi)[0]) {
            sampler.close();
            return None;
        }
        if method == Method::InverseTransform {
            let sample = self.table.sample(wi, [sampler.remapped_1d(), sampler.next_1d()]);
            return Some(sample.expect("light is scattered from everywhere").wo);
        }
        sampler.close();
        let bound = self.table.max_value(wi);
        loop {
            let wo: DVec3 = sample_uniform_hemisphere(sampler.next_2d()).into();
            if sampler.next_1d() < self.table.evaluate(wi, wo)[0] * wo.z / bound {
                return Some(wo);
            }
        }
    }
}

fn f_sr(wi: DVec3, wo: DVec3) -> f64 {
    let mirrored = DVec3::new(-wi.x, -wi.y, wi.z);
    let lobe = libm::pow(mirrored.dot(wo).max(0.0), POWER);
    DIFFUSE * FRAC_1_PI + GLOSSY * (POWER + 2.0) / (2.0 * PI) * lobe
}
