//! Where in a sensor's cell a photon is joined.
//!
//! A cell's mean counts all of its places alike, but a photon that lands close to its plane, at height h,
//! matters to few of them, with `1 / d^2`. Half of such photons are joined to a place that is drawn by the
//! cosine distribution of the plane as seen from there, of density `h^2 / (pi d^4)`, the others to an even
//! one, and the balance heuristic weighs both (Veach and Guibas 1995).

use crate::targets::Target;
use glam::DVec3;
use std::f64::consts::{FRAC_1_PI, TAU};

/// Photons are joined by their own view of a cell up to so many of its edges beside it.
const BESIDE: f64 = 1.0;

/// A place to join a photon to.
pub(super) struct Place {
    pub(super) position: DVec3,
    pub(super) normal: DVec3,
    /// What it counts for the target: the even density over that of the place.
    pub(super) weight: f64,
}

impl Place {
    /// The place of a target for a photon that landed at `from`; `None` where what was drawn lies outside.
    pub(super) fn of(target: &Target, from: DVec3, u: [f64; 2]) -> Option<Self> {
        let (grid, cell) = match target {
            Target::Point { position, normal } => {
                return Some(Self { position: *position, normal: *normal, weight: 1.0 });
            }
            Target::Cell { grid, cell } => (grid, *cell),
        };
        let [du, dv] = grid.cell_edges();
        let (across, corner) = (du.cross(dv), grid.point_in_cell(cell, [0.0; 2]));
        let area_m2 = across.length();
        let n = across / area_m2;
        // In edges of the cell.
        let in_edges =
            |way: DVec3| [n.dot(way.cross(dv)), n.dot(du.cross(way))].map(|x| x / area_m2);
        let way = from - corner;
        let height_m = n.dot(way);
        let square_m2 = height_m * height_m;
        let is_beside = |x: f64| (-BESIDE..1.0 + BESIDE).contains(&x);
        let is_near =
            square_m2 > 0.0 && square_m2 < area_m2 && in_edges(way).into_iter().all(is_beside);
        let place = |position, weight| Self { position, normal: grid.normal, weight };
        if !is_near {
            return Some(place(grid.point_in_cell(cell, u), 1.0));
        }
        let foot = from - n * height_m;
        let position = if u[0] < 0.5 {
            grid.point_in_cell(cell, [2.0 * u[0], u[1]])
        } else {
            let rest = 2.0 * u[0] - 1.0;
            let radius_m = height_m.abs() * (rest / (1.0 - rest)).sqrt();
            let (sin, cos) = libm::sincos(TAU * u[1]);
            let along = du.normalize();
            let position = foot + (along * cos + n.cross(along) * sin) * radius_m;
            let is_inside = |x: f64| (0.0..1.0).contains(&x);
            if !in_edges(position - corner).into_iter().all(is_inside) {
                return None;
            }
            position
        };
        let d2 = square_m2 + (position - foot).length_squared();
        let by_view = area_m2 * square_m2 * FRAC_1_PI / (d2 * d2);
        Some(place(position, 2.0 / (1.0 + by_view)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasilux_sampling::{PointSet, Randomization, SampleCursor, Sequence};
    use quasilux_scene::{Grid, Quantity};

    /// The mean over a cell of what a photon gives, by both ways to draw a place and by a fine even grid.
    /// Differences of 1 % would be found, near and far.
    #[test]
    fn every_place_counts_what_it_should() {
        let grid = Grid {
            origin: DVec3::new(1.0, 2.0, 0.5),
            u: DVec3::new(2.0, 0.0, 0.4),
            v: DVec3::Y * 1.5,
            counts: [2, 1],
            normal: DVec3::Z,
            quantity: Quantity::Mean,
        };
        let target = Target::Cell { grid, cell: 1 };
        let points = PointSet::new(Sequence::Sobol, Randomization::Owen, 7);
        for from in [[2.5, 2.5, 1.0], [3.0, 2.1, 0.95], [2.2, 1.2, 0.9], [9.0, 2.0, 3.0]] {
            let from = DVec3::from_array(from);
            let given = |position: DVec3| {
                let way = from - position;
                way.z.max(0.0) / (way.length_squared() * way.length_squared())
            };
            let count = 1_u64 << 14;
            let drawn = (0..count).filter_map(|index| {
                let place = Place::of(&target, from, SampleCursor::new(&points, index).next_2d())?;
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
