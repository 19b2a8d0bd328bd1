//! Receiver elements, sensor points and grid cells as photons see them, and sampling of a point in
//! a cell.
//!
//! A cell's mean counts all of its places alike, but a photon that lands close to its plane, at
//! height h, matters to few of them, with `1 / d^2`. Half of such photons are connected to a place
//! that is drawn by the cosine distribution of the plane as seen from there, of density `h^2 / (pi
//! d^4)`, the others to an even one, and the balance heuristic weighs both (Veach and Guibas 1995).

use crate::spectrum::Spectrum;
use crate::stats::targets::Target;
use crate::world::{Interaction, World};
use glam::DVec3;
use quasilux_scene::Grid;
use std::f64::consts::{FRAC_1_PI, TAU};

/// Photons sample a cell by their own view up to this number of its edges beside it.
const BESIDE: f64 = 1.0;
/// Nearer to the centre than this number of radii a contribution has no bound: only closer photons
/// sample a cell by their own view.
const CLOSE: f64 = 4.0;

/// A target, as photons see it.
pub(in crate::estimator) struct ReceiverElement {
    centre: DVec3,
    normal: DVec3,
    /// No place that photons are connected to is further from the centre.
    radius_m: f64,
    /// `None` where it is a point.
    cell: Option<Cell>,
}

/// A cell of a grid.
struct Cell {
    corner: DVec3,
    edges: [DVec3; 2],
    /// Reciprocal edges: scalar products with them are 0 to 1 across the cell.
    dual: [DVec3; 2],
    area_m2: f64,
    /// Normal to the edges, on either side.
    n: DVec3,
}

/// A place to connect a photon to.
pub(super) struct ConnectionPoint {
    pub(super) position: DVec3,
    pub(super) normal: DVec3,
    /// What it counts for the target: the even density over that of the place.
    pub(super) weight: f64,
}

impl ReceiverElement {
    pub(in crate::estimator) fn new<S: Spectrum>(world: &World<S>, target: &Target) -> Self {
        // Rays leave a hair in front of a sensor.
        let hairs_m = 2.0 * world.hair_m();
        match target {
            Target::Point { position, normal } => {
                Self { centre: *position, normal: *normal, radius_m: hairs_m, cell: None }
            }
            Target::Cell { grid, cell } => Self::for_cell(grid, *cell, hairs_m),
        }
    }

    fn for_cell(grid: &Grid, cell: usize, hairs_m: f64) -> Self {
        let [du, dv] = grid.cell_edges();
        let across = du.cross(dv);
        let area_m2 = across.length();
        let n = across / area_m2;
        let dual = [dv.cross(n) / area_m2, n.cross(du) / area_m2];
        let corner = grid.point_in_cell(cell, [0.0; 2]);
        Self {
            centre: grid.point_in_cell(cell, [0.5; 2]),
            normal: grid.normal,
            radius_m: 0.5 * (du + dv).length().max((du - dv).length()) + hairs_m,
            cell: Some(Cell { corner, edges: [du, dv], dual, area_m2, n }),
        }
    }

    pub(super) fn is_point(&self) -> bool {
        self.cell.is_none()
    }

    /// The place for a photon that landed at `from`; `None` where what was drawn lies outside.
    pub(super) fn place(&self, from: DVec3, u: [f64; 2]) -> Option<ConnectionPoint> {
        match &self.cell {
            None => {
                Some(ConnectionPoint { position: self.centre, normal: self.normal, weight: 1.0 })
            }
            Some(cell) => cell.place(self.normal, from, u),
        }
    }

    /// The most lux for each lm/sr that it can get from a landing there; infinite close by.
    pub(super) fn max_lx_sr_lm(&self, at: &Interaction) -> f64 {
        let way = at.position - self.centre;
        let distance_m = way.length();
        if distance_m < CLOSE * self.radius_m {
            return f64::INFINITY;
        }
        let height_m = (self.normal.dot(way) + self.radius_m).max(0.0);
        let height_there_m = at.n.dot(way).abs() + self.radius_m;
        let min_m = distance_m - self.radius_m;
        let square_m2 = min_m * min_m;
        height_m * height_there_m / (square_m2 * square_m2)
    }
}

impl Cell {
    /// A place, and what it counts.
    fn place(&self, normal: DVec3, from: DVec3, u: [f64; 2]) -> Option<ConnectionPoint> {
        let Self { corner, edges: [du, dv], dual, area_m2, n } = self;
        let evenly = |[u, v]: [f64; 2]| *corner + *du * u + *dv * v;
        let in_edges = |way: DVec3| dual.map(|dual| way.dot(dual));
        let way = from - *corner;
        let height_m = n.dot(way);
        let square_m2 = height_m * height_m;
        let is_beside = |x: f64| (-BESIDE..1.0 + BESIDE).contains(&x);
        let is_near =
            square_m2 > 0.0 && square_m2 < *area_m2 && in_edges(way).into_iter().all(is_beside);
        if !is_near {
            return Some(ConnectionPoint { position: evenly(u), normal, weight: 1.0 });
        }
        let foot = from - *n * height_m;
        let position = if u[0] < 0.5 {
            evenly([2.0 * u[0], u[1]])
        } else {
            let rest = 2.0 * u[0] - 1.0;
            let radius_m = height_m.abs() * (rest / (1.0 - rest)).sqrt();
            let (sin, cos) = libm::sincos(TAU * u[1]);
            let along = du.normalize();
            let position = foot + (along * cos + n.cross(along) * sin) * radius_m;
            let is_inside = |x: f64| (0.0..1.0).contains(&x);
            if !in_edges(position - *corner).into_iter().all(is_inside) {
                return None;
            }
            position
        };
        let d2 = square_m2 + (position - foot).length_squared();
        let by_view = area_m2 * square_m2 * FRAC_1_PI / (d2 * d2);
        Some(ConnectionPoint { position, normal, weight: 2.0 / (1.0 + by_view) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasilux_sampling::{PointSet, Randomization, Sampler, Sequence};
    use quasilux_scene::Quantity;

    /// The mean over a cell of what a photon gives, by both ways to draw a place and by a fine even
    /// grid. Differences of 1 % would be found, near and far.
    #[test]
    fn every_place_counts_what_it_should() {
        let grid = Grid {
            origin: DVec3::new(1.0, 2.0, 0.5),
            u: DVec3::new(2.0, 0.0, 0.4),
            v: DVec3::Y * 1.5,
            counts: [2, 1],
            normal: DVec3::Z,
            quantity: Quantity::Mean,
            target_lx: None,
        };
        let element = ReceiverElement::for_cell(&grid, 1, 0.0);
        let points = PointSet::new(Sequence::Sobol, Randomization::Owen, 7);
        for from in [[2.5, 2.5, 1.0], [3.0, 2.1, 0.95], [2.2, 1.2, 0.9], [9.0, 2.0, 3.0]] {
            let from = DVec3::from_array(from);
            let given = |position: DVec3| {
                let way = from - position;
                way.z.max(0.0) / (way.length_squared() * way.length_squared())
            };
            let count = 1_u64 << 14;
            let drawn = (0..count).filter_map(|index| {
                let place = element.place(from, Sampler::new(&points, index).next_2d())?;
                Some(place.weight * given(place.position))
            });
            let found = drawn.sum::<f64>() / count as f64;
            let side = 1000;
            let middle = |i: u32| (f64::from(i) + 0.5) / f64::from(side);
            let even = (0..side).flat_map(|i| (0..side).map(move |j| [middle(i), middle(j)]));
            let wanted =
                even.map(|u| given(grid.point_in_cell(1, u))).sum::<f64>() / f64::from(side * side);
            assert!((found / wanted - 1.0).abs() < 0.01, "{from}: {found}, wanted {wanted}");
        }
    }
}
