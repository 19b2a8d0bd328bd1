//! Integrals over boxes of angles by Gauss quadrature: nothing shared with the closed forms.

use quasilux_photometry::{Angles, SphericalTable};
use std::f64::consts::TAU;

/// Nodes and weights of Gauss-Legendre quadrature on [-1, 1].
pub(crate) const GAUSS_5: [(f64, f64); 5] = [
    (0.0, 128.0 / 225.0),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

/// Ascending borders of boxes in polar angle and azimuth.
pub(crate) struct Boxes {
    pub(crate) theta_rad: Vec<f64>,
    /// Within [0, one turn].
    pub(crate) phi_rad: Vec<f64>,
}

impl Boxes {
    /// The integral over solid angle of the table's value over each box, row by row: five Gauss
    /// nodes in theta between neighbouring nodes and borders; in phi, where the value is linear,
    /// midpoints.
    pub(crate) fn integrals(&self, table: &SphericalTable) -> Vec<f64> {
        let azimuths: Vec<f64> = table.phi_rad().map(|phi| phi.rem_euclid(TAU)).collect();
        let columns: Vec<Vec<[f64; 2]>> =
            self.phi_rad.windows(2).map(|ends| panels(ends, &azimuths)).collect();
        let mut integrals = Vec::new();
        for ends in self.theta_rad.windows(2) {
            let mut row = vec![0.0; columns.len()];
            for [start, end] in panels(ends, table.theta_rad()) {
                for (x, weight) in GAUSS_5 {
                    let theta_rad = 0.5 * (start + end) + 0.5 * (end - start) * x;
                    let ring = 0.5 * (end - start) * weight * libm::sin(theta_rad);
                    for (sum, panels) in row.iter_mut().zip(&columns) {
                        for [start, end] in panels {
                            let phi_rad = 0.5 * (start + end);
                            let value = table.value_at(Angles { theta_rad, phi_rad });
                            *sum += ring * (end - start) * value;
                        }
                    }
                }
            }
            integrals.append(&mut row);
        }
        integrals
    }

    /// The box that holds a direction, counted row by row; the nearest one outside.
    pub(crate) fn place(&self, angles: Angles) -> usize {
        let cell = |edges: &[f64], x: f64| {
            (edges.partition_point(|&edge| edge <= x).max(1) - 1).min(edges.len() - 2)
        };
        let column = cell(&self.phi_rad, angles.phi_rad.rem_euclid(TAU));
        cell(&self.theta_rad, angles.theta_rad) * (self.phi_rad.len() - 1) + column
    }
}

/// Pieces between `ends` and the nodes inside.
fn panels(ends: &[f64], nodes: &[f64]) -> Vec<[f64; 2]> {
    let inside = nodes.iter().copied().filter(|k| *k > ends[0] + 1e-12 && *k < ends[1] - 1e-12);
    let mut edges: Vec<f64> = inside.chain([ends[0], ends[1]]).collect();
    edges.sort_by(f64::total_cmp);
    edges.windows(2).map(|pair| [pair[0], pair[1]]).collect()
}
