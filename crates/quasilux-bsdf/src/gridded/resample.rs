//! Grids of exit directions for lobes that files give in other angles.
//!
//! Values around the mirror direction, or over half and difference angles, are taken to a grid of
//! spherical angles about the normal, whose nodes lie where those of the file do: in the plane of
//! incidence at the same distances from the mirror direction, and around the normal at azimuths of
//! the same distances. The horizon is an edge of the grid.

use glam::DVec3;
use quasilux_photometry::{Angles, Symmetry};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Widest gaps between nodes, in polar angle and in azimuth: at first, and where there would be too
/// many nodes.
const WIDEST_RAD: [[f64; 2]; 2] = [[PI / 72.0, PI / 36.0], [PI / 36.0, PI / 18.0]];

/// Closer nodes are one, in radians.
const CLOSEST_RAD: f64 = 1e-4;

/// Exit directions of a lobe, with the plane of incidence at azimuth 0.
#[derive(Clone, Debug)]
pub(crate) struct ExitGrid {
    pub(crate) theta_rad: Vec<f64>,
    pub(crate) phi_rad: Vec<f64>,
    pub(crate) symmetry: Symmetry,
}

impl ExitGrid {
    /// Nodes at distances `offsets_rad` from a mirror direction at polar angle `mirror_rad` and
    /// azimuth pi, and at such azimuths `phis_rad`; over half a turn where both halves are alike.
    /// Where that makes more than `most` directions, every other node is left out until none is
    /// left but those that fill wide gaps.
    pub(crate) fn around(
        mirror_rad: f64,
        offsets_rad: &[f64],
        phis_rad: &[f64],
        is_mirrored: bool,
        most: usize,
    ) -> Self {
        let mut step = 1;
        loop {
            let offsets = || offsets_rad.iter().copied().step_by(step);
            let thetas = offsets().flat_map(|offset| [mirror_rad - offset, mirror_rad + offset]);
            let sine = libm::sin(mirror_rad);
            // Two directions at the mirror's polar angle, `offset` apart, differ by this in
            // azimuth.
            let azimuth = |offset: f64| {
                let ratio = libm::sin(0.5 * offset.min(PI)) / sine;
                if ratio < 1.0 { 2.0 * libm::asin(ratio) } else { PI }
            };
            let around = offsets().flat_map(|offset| [PI - azimuth(offset), PI + azimuth(offset)]);
            let phis = around.chain(phis_rad.iter().copied().step_by(step));
            let last = if is_mirrored { PI } else { TAU };
            let widest_rad = WIDEST_RAD[usize::from(step > 1)];
            let theta_rad = nodes(thetas, FRAC_PI_2, widest_rad[0]);
            let phi_rad = nodes(phis, last, widest_rad[1]);
            let symmetry = if is_mirrored { Symmetry::Bilateral } else { Symmetry::None };
            if theta_rad.len() * phi_rad.len() <= most
                || step > offsets_rad.len().max(phis_rad.len())
            {
                return Self { theta_rad, phi_rad, symmetry };
            }
            step *= 2;
        }
    }

    /// The exit directions in the order of values: all azimuths at the first polar angle, then at
    /// the next.
    pub(crate) fn directions(&self) -> impl Iterator<Item = DVec3> {
        let at = |&theta_rad: &f64| {
            self.phi_rad.iter().map(move |&phi_rad| upward(Angles { theta_rad, phi_rad }))
        };
        self.theta_rad.iter().flat_map(at)
    }
}

/// Never below the horizon.
fn upward(angles: Angles) -> DVec3 {
    let DVec3 { x, y, z } = angles.direction();
    DVec3::new(x, y, z.max(0.0))
}

/// Ascending nodes from 0 to `last`, with wide gaps filled.
fn nodes(wanted: impl Iterator<Item = f64>, last: f64, widest: f64) -> Vec<f64> {
    let mut all: Vec<f64> =
        wanted.filter(|node| (CLOSEST_RAD..last - CLOSEST_RAD).contains(node)).collect();
    all.extend([0.0, last]);
    all.sort_by(f64::total_cmp);
    let mut nodes = vec![0.0];
    for node in all {
        let before = nodes[nodes.len() - 1];
        if node - before < CLOSEST_RAD {
            continue;
        }
        let parts = ((node - before) / widest).ceil().max(1.0);
        let part = |i: u32| before + (node - before) * f64::from(i) / parts;
        nodes.extend((1..parts as u32).map(part));
        nodes.push(node);
    }
    nodes
}
