//! Directions that a point light shines in, drawn nearly in proportion to its intensity.

use crate::light::{Candela, PointLight};
use crate::random::Xoshiro;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Widest ring in rad.
const WIDEST_RAD: f64 = PI / 180.0;
/// Fewest rings between two angles of a table.
const FEWEST: usize = 8;

/// The directions of one light: rings about its aim.
#[derive(Clone, Debug)]
pub(crate) struct Emission {
    rings: Vec<Ring>,
    /// Of all rings in lm.
    pub(crate) flux_lm: f64,
}

#[derive(Clone, Copy, Debug)]
struct Ring {
    /// `1 - cos` of its edges.
    depth: [f64; 2],
    probability: f64,
    /// The sum up to and with it.
    up_to: f64,
}

/// `1 - cos`, with all digits.
fn depth(gamma_rad: f64) -> f64 {
    let sine = libm::sin(0.5 * gamma_rad);
    2.0 * sine * sine
}

fn edges_rad(candela: &Candela) -> Vec<f64> {
    let corners = match candela {
        Candela::Constant(_) => return vec![0.0, PI],
        Candela::Cone { half_angle_rad, .. } => return vec![0.0, *half_angle_rad],
        Candela::Cosine(_) => vec![0.0, FRAC_PI_2],
        Candela::Table(rows) => rows.iter().map(|row| row.gamma_rad).collect(),
    };
    let mut edges = Vec::new();
    for pair in corners.windows(2) {
        let steps = (((pair[1] - pair[0]) / WIDEST_RAD).ceil() as usize).max(FEWEST);
        edges.extend((0..steps).map(|i| pair[0] + (pair[1] - pair[0]) * i as f64 / steps as f64));
    }
    edges.extend(corners.last());
    edges
}

impl Emission {
    pub(crate) fn new(light: &PointLight) -> Self {
        let edges = edges_rad(&light.candela);
        let ring = |pair: &[f64]| {
            let at = |way: f64| light.candela.at_angle(pair[0] + way * (pair[1] - pair[0]));
            // Ends of a cone or a table are sharp: ask within.
            let mean_cd = (at(1e-9) + 4.0 * at(0.5) + at(1.0 - 1e-9)) / 6.0;
            let depth = [depth(pair[0]), depth(pair[1])];
            let flux_lm = TAU * (depth[1] - depth[0]) * mean_cd;
            Ring { depth, probability: flux_lm, up_to: 0.0 }
        };
        let mut rings: Vec<Ring> = edges.windows(2).map(ring).collect();
        rings.retain(|ring| ring.probability > 0.0);
        let flux_lm: f64 = rings.iter().map(|ring| ring.probability).sum();
        let mut sum = 0.0;
        for ring in &mut rings {
            ring.probability /= flux_lm;
            sum += ring.probability;
            ring.up_to = sum;
        }
        Self { rings, flux_lm }
    }

    /// A unit direction about the aim.
    pub(crate) fn sample(&self, aim: DVec3, random: &mut Xoshiro) -> DVec3 {
        let choice = random.uniform();
        let number = self.rings.partition_point(|ring| ring.up_to <= choice);
        let [near, far] = self.rings[number.min(self.rings.len() - 1)].depth;
        let depth = near + (far - near) * random.uniform();
        let radius = (depth * (2.0 - depth)).max(0.0).sqrt();
        let (sin, cos) = libm::sincos(TAU * random.uniform());
        let (s, t) = aim.any_orthonormal_pair();
        (s * (radius * cos) + t * (radius * sin) + aim * (1.0 - depth)).normalize()
    }

    /// Its density in solid angle.
    pub(crate) fn pdf(&self, aim: DVec3, direction: DVec3) -> f64 {
        let depth = 0.5 * (direction - aim).length_squared();
        let number = self.rings.partition_point(|ring| ring.depth[1] < depth);
        match self.rings.get(number) {
            Some(ring) if ring.depth[0] <= depth => {
                ring.probability / (TAU * (ring.depth[1] - ring.depth[0]))
            }
            _ => 0.0,
        }
    }
}
