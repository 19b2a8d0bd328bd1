//! Directions between which light is interpolated: rings around the vertical, and the zenith.
//!
//! What comes from a direction is shared by the nodes around it, in proportion to how near they
//! are: linearly in azimuth on the rings above and below it, then linearly in altitude. Each
//! replicate has rings elsewhere, so that what interpolation gets wrong differs between replicates,
//! and their spread tells. On average over places of the nodes, what is interpolated is blurred by
//! a tent as wide as two spacings h; values at nodes are sharpened by h^2 / 12 of the second
//! derivative before, which leaves an error of the fourth order.

use glam::DVec3;
use libm::{asin, atan2, cos, sin};
use std::f64::consts::{FRAC_PI_2, TAU};

/// How far apart the nodes are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spacing {
    /// Along rings, and between them far from the horizon, in rad.
    pub(super) usual: f64,
    /// Between rings at the horizon.
    pub(super) at_horizon: f64,
}

/// How much further apart rings are for each radian of altitude.
const SPREADING: f64 = 0.4;
/// Nodes of a ring at least.
const MIN_NODES: f64 = 4.0;

/// Nodes, and how they share directions.
#[derive(Clone, Debug)]
pub(super) struct Mesh {
    rings: Vec<Ring>,
    nodes: usize,
}

#[derive(Clone, Copy, Debug)]
struct Ring {
    altitude: f64,
    /// The number of its first node.
    first: usize,
    nodes: usize,
    /// The azimuth of its first node, counter-clockwise from x in rad.
    azimuth: f64,
}

/// One over this many of the second difference sharpens.
const SHARPENING: f64 = 12.0;

/// A node with its share of a direction.
pub(super) type Share = (usize, f64);

impl Mesh {
    /// The mesh that two coordinates in [0, 1) place: the rings, and the nodes on them. The lowest
    /// two rings lie below the horizon.
    pub(super) fn new(spacing: Spacing, [up, around]: [f64; 2]) -> Self {
        let Spacing { usual, at_horizon } = spacing;
        let mut rings: Vec<Ring> = Vec::new();
        let mut altitude = (up - 2.0) * at_horizon;
        let mut first = 0;
        while altitude < FRAC_PI_2 - 0.5 * usual {
            let nodes = (TAU * cos(altitude) / usual).ceil().max(MIN_NODES);
            // Nodes of neighbouring rings do not stand above one another.
            let azimuth = TAU / nodes * (around + 0.5 * (rings.len() % 2) as f64);
            rings.push(Ring { altitude, first, nodes: nodes as usize, azimuth });
            first += nodes as usize;
            altitude += (at_horizon + SPREADING * altitude.max(0.0)).min(usual);
        }
        rings.push(Ring { altitude: FRAC_PI_2, first, nodes: 1, azimuth: 0.0 });
        Self { rings, nodes: first + 1 }
    }

    pub(super) fn len(&self) -> usize {
        self.nodes
    }

    /// Where the nodes are, unit vectors of the world.
    pub(super) fn directions(&self) -> impl Iterator<Item = DVec3> {
        self.rings.iter().flat_map(|ring| {
            let (up, aside) = (sin(ring.altitude), cos(ring.altitude));
            (0..ring.nodes).map(move |node| {
                let azimuth = ring.azimuth + TAU * node as f64 / ring.nodes as f64;
                DVec3::new(aside * cos(azimuth), aside * sin(azimuth), up)
            })
        })
    }

    /// The nodes around a unit vector with their shares, which add up to 1.
    pub(super) fn shares(&self, direction: DVec3) -> [Share; 4] {
        let altitude = asin(direction.z.clamp(-1.0, 1.0));
        let azimuth = atan2(direction.y, direction.x);
        let above = self.rings.partition_point(|ring| ring.altitude <= altitude);
        let above = above.clamp(1, self.rings.len() - 1);
        let (low, high) = (self.rings[above - 1], self.rings[above]);
        let part = (altitude - low.altitude) / (high.altitude - low.altitude);
        let part = part.clamp(0.0, 1.0);
        let ([a, b], [c, d]) = (low.shares(azimuth), high.shares(azimuth));
        let times = |(node, share): Share, factor: f64| (node, share * factor);
        [times(a, 1.0 - part), times(b, 1.0 - part), times(c, part), times(d, part)]
    }

    /// Sums over values at nodes nearby that stand for the value at each node.
    pub(super) fn sharpened(&self) -> Vec<Vec<Share>> {
        let of_ring = |(number, ring): (usize, &Ring)| {
            (0..ring.nodes).map(move |node| self.sharpened_node(number, node)).collect::<Vec<_>>()
        };
        self.rings.iter().enumerate().flat_map(of_ring).collect()
    }

    fn sharpened_node(&self, number: usize, node: usize) -> Vec<Share> {
        let ring = self.rings[number];
        let mut all = vec![(ring.first + node, 1.0)];
        if ring.nodes > 1 {
            let beside = |by: usize| ring.first + (node + by) % ring.nodes;
            all[0].1 += 2.0 / SHARPENING;
            all.extend([1, ring.nodes - 1].map(|by| (beside(by), -1.0 / SHARPENING)));
        }
        let neighbours = number.checked_sub(1).map(|below| self.rings[below]);
        if let Some((low, high)) = neighbours.zip(self.rings.get(number + 1)) {
            let azimuth = ring.azimuth + TAU * node as f64 / ring.nodes as f64;
            let (up, down) = (high.altitude - ring.altitude, ring.altitude - low.altitude);
            let mut add = |of: &Ring, factor: f64| {
                let factor = -2.0 * factor / (SHARPENING * (up + down));
                all.extend(of.shares(azimuth).map(|(node, share)| (node, share * factor)));
            };
            add(&low, up);
            add(high, down);
            all[0].1 += 2.0 / SHARPENING;
        }
        all
    }

    /// The integrals over solid angle of the nodes' shares, in sr.
    pub(super) fn solid_angles_sr(&self) -> Vec<f64> {
        let mut all = Vec::with_capacity(self.nodes);
        for (number, ring) in self.rings.iter().enumerate() {
            let below = number.checked_sub(1).map(|below| self.rings[below].altitude);
            let above = self.rings.get(number + 1).map(|above| above.altitude);
            let ramps = [below, above].into_iter().flatten();
            let ramps: f64 = ramps.map(|end| ramp(end, ring.altitude)).sum();
            all.extend((0..ring.nodes).map(|_| ramps * TAU / ring.nodes as f64));
        }
        all
    }
}

impl Ring {
    fn shares(&self, azimuth: f64) -> [Share; 2] {
        let place = (azimuth - self.azimuth) / TAU * self.nodes as f64;
        let (before, part) = (place.floor(), place - place.floor());
        let node = |place: f64| self.first + place.rem_euclid(self.nodes as f64) as usize;
        [(node(before), 1.0 - part), (node(before + 1.0), part)]
    }
}

/// The integral of cos(t) over what is 0 at the end and 1 at the top of a ramp.
fn ramp(end: f64, top: f64) -> f64 {
    let width = top - end;
    // By parts; the sign of the width takes care of ramps that fall.
    (sin(top) + (cos(top) - cos(end)) / width) * width.signum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn meshes() -> impl Iterator<Item = Mesh> {
        let spacings = [(0.1, 0.03), (0.13, 0.13), (0.5, 0.2)];
        let places = [[0.0, 0.0], [0.3, 0.8], [0.99, 0.5]];
        spacings.into_iter().flat_map(move |(usual, at_horizon)| {
            places.map(|place| Mesh::new(Spacing { usual, at_horizon }, place))
        })
    }

    fn upper_directions() -> impl Iterator<Item = DVec3> {
        (0..2000).map(|i| {
            let z = (f64::from(i) + 0.5) / 2000.0;
            let azimuth = 2.399_963 * f64::from(i);
            let aside = (1.0 - z * z).sqrt();
            DVec3::new(aside * cos(azimuth), aside * sin(azimuth), z)
        })
    }

    #[test]
    fn shares_add_up_and_nodes_own_their_place() {
        for mesh in meshes() {
            for direction in upper_directions() {
                let shares = mesh.shares(direction);
                assert!(shares.iter().all(|&(node, share)| node < mesh.len() && share >= 0.0));
                assert!((shares.iter().map(|share| share.1).sum::<f64>() - 1.0).abs() < 1e-12);
            }
            assert_eq!(mesh.directions().count(), mesh.len());
            for (node, direction) in mesh.directions().enumerate() {
                let own = mesh.shares(direction).into_iter().filter(|&(other, _)| other == node);
                assert!((own.map(|share| share.1).sum::<f64>() - 1.0).abs() < 1e-9, "{node}");
            }
        }
    }

    /// Functions that are linear in altitude alone are interpolated exactly, smooth ones nearly.
    #[test]
    fn smooth_functions_are_interpolated() {
        let mesh = Mesh::new(Spacing { usual: 0.1, at_horizon: 0.03 }, [0.4, 0.7]);
        let smooth = |w: DVec3| 1.0 + 0.5 * w.x - 0.3 * w.y * w.z + w.z * w.z;
        let at_nodes: Vec<f64> = mesh.directions().map(smooth).collect();
        for direction in upper_directions() {
            let shares = mesh.shares(direction);
            let value: f64 = shares.iter().map(|&(node, share)| share * at_nodes[node]).sum();
            assert!((value - smooth(direction)).abs() < 8e-3, "{direction}: {value}");
        }
    }

    /// Sharpening keeps constants, and is undone by the blur of a tent.
    #[test]
    fn sharpened_values_are_blurred_to_exact_ones() {
        let spacing = Spacing { usual: 0.2, at_horizon: 0.2 };
        let wave = |w: DVec3| sin(3.0 * w.x + 1.0) * (1.0 + w.z * w.z);
        let direction = DVec3::new(0.5, 0.4, 0.6).normalize();
        let (mut sharp, mut plain, n) = (0.0, 0.0, 40);
        for i in 0..n * n {
            let place = [f64::from(i / n) + 0.5, f64::from(i % n) + 0.5].map(|x| x / f64::from(n));
            let mesh = Mesh::new(spacing, place);
            let values: Vec<f64> = mesh.directions().map(wave).collect();
            let sharpened = mesh.sharpened();
            for (node, share) in mesh.shares(direction) {
                plain += share * values[node];
                let around = sharpened[node].iter();
                assert!((around.clone().map(|it| it.1).sum::<f64>() - 1.0).abs() < 1e-12);
                sharp += share * around.map(|&(node, share)| share * values[node]).sum::<f64>();
            }
        }
        let off = |sum: f64| (sum / f64::from(n * n) - wave(direction)).abs();
        assert!(off(sharp) < 0.2 * off(plain), "{} {}", off(sharp), off(plain));
    }

    /// Integrals of shares against a sum over many directions.
    #[test]
    fn solid_angles_are_integrals_of_shares() {
        let mesh = Mesh::new(Spacing { usual: 0.5, at_horizon: 0.2 }, [0.4, 0.7]);
        let mut sums = vec![0.0; mesh.len()];
        let n = 400_000;
        for i in 0..n {
            let z = -0.4 + 1.4 * (f64::from(i) + 0.5) / f64::from(n);
            let azimuth = TAU * (0.618_033_988_749_895 * f64::from(i)).fract();
            let aside = (1.0 - z * z).sqrt();
            let direction = DVec3::new(aside * cos(azimuth), aside * sin(azimuth), z);
            // Below the lowest ring its nodes go on.
            if asin(z) >= mesh.rings[0].altitude {
                for (node, share) in mesh.shares(direction) {
                    sums[node] += share * TAU * 1.4 / f64::from(n);
                }
            }
        }
        for (found, expected) in sums.iter().zip(mesh.solid_angles_sr()) {
            assert!((found / expected - 1.0).abs() < 0.01, "{found} {expected}");
        }
    }
}
