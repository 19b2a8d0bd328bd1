//! A scattering distribution as lobes over a grid of incident directions.
//!
//! For each stored incidence there is a [`SphericalTable`] of g = f cos(theta) over exit directions, bilinear in spherical
//! angles. Between incidences f is the linear mixture of their lobes, two by polar angle and, where the surface is not
//! isotropic, two by azimuth, each turned about the normal so that its plane of incidence is that of `wi`. The albedo is the
//! mixture of the integrals.
//!
//! Files with lobes measure one side, the front, and count azimuths counterclockwise as seen from there. In the frame of the
//! sheet that is clockwise: the `x` of a lobe is `-x` of the sheet.
//!
//! Sampling picks a lobe by its share of the albedo with `u[0]`, which is renormalised, and inverts that lobe. The
//! density is that of the whole mixture, f cos(theta) over the albedo: each sample weighs the same, and nothing is biased. What it
//! costs is strata: up to four maps share the unit square, so that a sequence fills each with a part of its points,
//! and one direction has several pairs of coordinates, of which [`GriddedTable::invert`] returns one.

mod knots;
mod resample;

use super::analysis::Incident;
use super::distribution::{INSIDE, ScatterSample, luminance};
use crate::{Angles, Grid, SphericalTable};
use glam::DVec3;
pub(super) use knots::{around, bracket};
use knots::{parts_of_azimuths, parts_of_polar_angles};
pub(super) use resample::{ExitKnots, table_error};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Incident directions of one file: more than are measured, and few enough for the grids of their lobes.
pub(super) const MOST_INCIDENCES: usize = 1000;

/// Lobes over a grid of incident directions.
#[derive(Clone, Debug)]
pub struct GriddedTable {
    /// Incident polar angles, ascending.
    theta_rad: Vec<f64>,
    /// Incident azimuths, ascending within one turn; one alone where the surface is isotropic.
    phi_rad: Vec<f64>,
    /// All polar angles of the first azimuth, then of the next.
    lobes: Vec<Lobe>,
}

/// What one incident direction is scattered to, its azimuth being 0.
#[derive(Clone, Debug)]
pub(super) struct Lobe {
    /// The luminance of g, in sr^-1.
    luminance: SphericalTable,
    /// g by linear RGB, where it is not grey.
    channels: Option<[SphericalTable; 3]>,
}

/// The lobes that mix at an incident direction; some have no weight.
#[derive(Clone, Copy)]
struct Mixture<'t> {
    lobes: [&'t Lobe; 4],
    weights: [f64; 4],
    /// Cosine and sine of the azimuth of `wi` as seen from the front: lobes are stored with it at 0.
    turn: [f64; 2],
}

impl Lobe {
    /// A lobe from f at exit directions: one list for grey, three for linear RGB, each all azimuths at the first polar angle, then
    /// at the next. `None` where they are no grid.
    pub(super) fn new(knots: &ExitKnots, channels: &[Vec<f64>]) -> Option<Self> {
        let columns = knots.phi_rad.len();
        // At the horizon f may be anything, and g is zero.
        let cosine = |index: usize| libm::cos(knots.theta_rad[index / columns]).max(0.0);
        let is_horizon = |index: usize| knots.theta_rad[index / columns] >= FRAC_PI_2;
        let g = |values: &[f64]| -> Vec<f64> {
            let of_index =
                |(index, f): (usize, &f64)| if is_horizon(index) { 0.0 } else { f * cosine(index) };
            values.iter().enumerate().map(of_index).collect()
        };
        let table = |values: Vec<f64>| {
            let (theta_rad, phi_rad) = (knots.theta_rad.clone(), knots.phi_rad.clone());
            SphericalTable::new(Grid { theta_rad, phi_rad, symmetry: knots.symmetry, values }).ok()
        };
        let [red, green, blue] = match channels {
            [grey] => return Some(Self { luminance: table(g(grey))?, channels: None }),
            [red, green, blue] => [red, green, blue].map(|values| g(values)),
            _ => return None,
        };
        let weighted = |index: usize| {
            let rgb = [red[index], green[index], blue[index]];
            luminance(rgb)
        };
        let luminance = table((0..red.len()).map(weighted).collect())?;
        Some(Self { luminance, channels: Some([table(red)?, table(green)?, table(blue)?]) })
    }

    /// The luminance of the share that is scattered.
    pub(super) fn albedo(&self) -> f64 {
        self.luminance.integral()
    }

    fn g(&self, direction: DVec3) -> [f64; 3] {
        match &self.channels {
            Some(channels) => [0, 1, 2].map(|channel| channels[channel].value(direction)),
            None => [self.luminance.value(direction); 3],
        }
    }

    fn integrals(&self) -> [f64; 3] {
        match &self.channels {
            Some(channels) => [0, 1, 2].map(|channel| channels[channel].integral()),
            None => [self.luminance.integral(); 3],
        }
    }
}

impl GriddedTable {
    /// A table of lobes, all polar angles of the first azimuth, then of the next. One azimuth alone makes it isotropic.
    /// `None` unless angles ascend and there is a lobe for each pair.
    pub(super) fn new(theta_rad: Vec<f64>, phi_rad: Vec<f64>, lobes: Vec<Lobe>) -> Option<Self> {
        let ascends = |angles: &[f64]| angles.windows(2).all(|pair| pair[0] < pair[1]);
        let is_full = !theta_rad.is_empty()
            && !phi_rad.is_empty()
            && lobes.len() == theta_rad.len() * phi_rad.len();
        let spans_a_turn = phi_rad.last().zip(phi_rad.first()).is_some_and(|(l, f)| l - f < TAU);
        let is_grid = is_full && spans_a_turn && ascends(&theta_rad) && ascends(&phi_rad);
        is_grid.then_some(Self { theta_rad, phi_rad, lobes })
    }

    pub(super) fn is_isotropic(&self) -> bool {
        self.phi_rad.len() == 1
    }

    pub(super) fn is_coloured(&self) -> bool {
        self.lobes.iter().any(|lobe| lobe.channels.is_some())
    }

    pub(super) fn value(&self, wi: DVec3, wo: DVec3) -> [f64; 3] {
        let mixture = self.mixture(wi);
        let wo_of_lobe = turned(wo, mixture.turn);
        let g = mixture.sum(|lobe| lobe.g(wo_of_lobe));
        g.map(|g| if g > 0.0 { g / wo.z } else { 0.0 })
    }

    pub(super) fn albedo(&self, wi: DVec3) -> [f64; 3] {
        self.mixture(wi).sum(Lobe::integrals)
    }

    pub(super) fn sample(&self, wi: DVec3, u: [f64; 2]) -> Option<ScatterSample> {
        let mixture = self.mixture(wi);
        let shares = mixture.shares();
        let total: f64 = shares.iter().sum();
        if total <= 0.0 {
            return None;
        }
        let mut target = u[0] * total;
        let last = shares.iter().rposition(|&share| share > 0.0)?;
        let mut index = 0;
        while index < last && target >= shares[index] {
            target -= shares[index];
            index += 1;
        }
        // At the edges of a lobe, the horizon among them, its density may be zero.
        let inside = [target / shares[index], u[1]].map(|u| u.clamp(INSIDE, 1.0 - INSIDE));
        let direction = mixture.lobes[index].luminance.sample_direction(inside)?;
        let pdf_sr = mixture.luminance(direction) / total;
        Some(ScatterSample { wo: turned(direction, mixture.turn), pdf_sr })
    }

    pub(super) fn pdf_sr(&self, wi: DVec3, wo: DVec3) -> f64 {
        let mixture = self.mixture(wi);
        let total: f64 = mixture.shares().iter().sum();
        if total > 0.0 { mixture.luminance(turned(wo, mixture.turn)) / total } else { 0.0 }
    }

    /// Of the coordinates that lead to `wo`, those of the lobe that is the brightest there.
    pub(super) fn invert(&self, wi: DVec3, wo: DVec3) -> Option<[f64; 2]> {
        let mixture = self.mixture(wi);
        let direction = turned(wo, mixture.turn);
        let at_wo =
            [0, 1, 2, 3].map(|i| mixture.weights[i] * mixture.lobes[i].luminance.value(direction));
        let brightest = (0..4).max_by(|&a, &b| at_wo[a].total_cmp(&at_wo[b]))?;
        let [within, u1] = mixture.lobes[brightest].luminance.invert(direction);
        let shares = mixture.shares();
        let before: f64 = shares[..brightest].iter().sum();
        let u0 = (before + within * shares[brightest]) / shares.iter().sum::<f64>();
        Some([u0.clamp(0.0, 1.0), u1])
    }

    /// The mixture of the greatest values of all lobes, wherever they are.
    pub(super) fn greatest(&self, wi: DVec3) -> f64 {
        self.mixture(wi).sum(|lobe| [lobe.luminance.maximum().value, 0.0, 0.0])[0]
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

    /// Knots, each for the light of which its lobe has the share: shares are linear in both angles between them.
    pub(super) fn parts(&self) -> Vec<Incident> {
        let of_theta = parts_of_polar_angles(&self.theta_rad);
        let of_phi = parts_of_azimuths(&self.phi_rad);
        let parts = of_phi.iter().flat_map(|phi| of_theta.iter().map(move |theta| phi * theta));
        let at = |(wi, part)| Incident { wi, part };
        self.incidences().into_iter().zip(parts).map(at).collect()
    }

    /// Whether the greatest sum of shares of both is at a knot of one of them.
    pub(super) fn shares_azimuths(&self, other: &Self) -> bool {
        let are_isotropic = self.is_isotropic() && other.is_isotropic();
        are_isotropic || self.phi_rad == other.phi_rad
    }

    fn mixture(&self, wi: DVec3) -> Mixture<'_> {
        let horizontal = (wi.x * wi.x + wi.y * wi.y).sqrt();
        let turn =
            if horizontal > 0.0 { [-wi.x / horizontal, wi.y / horizontal] } else { [1.0, 0.0] };
        let thetas = bracket(&self.theta_rad, libm::atan2(horizontal, wi.z));
        let phis = if self.is_isotropic() {
            [(0, 1.0), (0, 0.0)]
        } else {
            around(&self.phi_rad, libm::atan2(turn[1], turn[0]))
        };
        let lobe = |i: usize| &self.lobes[phis[i / 2].0 * self.theta_rad.len() + thetas[i % 2].0];
        let weights = [0, 1, 2, 3].map(|i| phis[i / 2].1 * thetas[i % 2].1);
        Mixture { lobes: [0, 1, 2, 3].map(lobe), weights, turn }
    }
}

impl Mixture<'_> {
    /// The sum of a quantity of the lobes by their weights.
    fn sum(&self, quantity: impl Fn(&Lobe) -> [f64; 3]) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (lobe, &weight) in self.lobes.iter().zip(&self.weights) {
            // Of lobes without weight nothing is looked up.
            let of_lobe = if weight > 0.0 { quantity(lobe) } else { [0.0; 3] };
            sum = [0, 1, 2].map(|channel| sum[channel] + weight * of_lobe[channel]);
        }
        sum
    }

    /// The share of each lobe in the luminance of the albedo.
    fn shares(&self) -> [f64; 4] {
        [0, 1, 2, 3].map(|i| self.weights[i] * self.lobes[i].luminance.integral())
    }

    /// The luminance of g towards a direction of the lobes' frame.
    fn luminance(&self, direction: DVec3) -> f64 {
        self.sum(|lobe| [lobe.luminance.value(direction), 0.0, 0.0])[0]
    }
}

/// A direction in the frame of the lobes, from one of the sheet; and the other way round.
fn turned(direction: DVec3, [cos, sin]: [f64; 2]) -> DVec3 {
    let DVec3 { x, y, z } = direction;
    // Rounding at the horizon must not lead below it.
    DVec3::new(sin * y - cos * x, sin * x + cos * y, z.max(0.0))
}

/// A direction in the frame of the file, which is seen from the front, from one of the sheet; and the other way
/// round.
pub(super) fn as_in_file(direction: DVec3) -> DVec3 {
    DVec3::new(-direction.x, direction.y, direction.z)
}
