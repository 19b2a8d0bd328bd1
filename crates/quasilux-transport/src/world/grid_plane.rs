//! Grid sensors as virtual planes: the cell that a free flight passes through.

use crate::spectrum::Spectrum;
use crate::world::World;
use crate::world::flight::Flight;
use glam::DVec3;
use quasilux_scene::sensor::Grid;

/// Sines of the angle between a grid's normal and that of its plane below this are rounding.
const TILTED: f64 = 1e-9;

/// A virtual plane with the cells of a grid: it disturbs nothing.
pub(crate) struct GridPlane {
    grid: Grid,
    /// A point of the plane, a hair in front of the grid.
    origin: DVec3,
    /// The plane's unit normal, on the side that flights come from.
    normal: DVec3,
    /// Reciprocal edges: scalar products with them are 0 to 1 across the grid.
    dual: [DVec3; 2],
}

impl GridPlane {
    pub(crate) fn new<S: Spectrum>(world: &World<S>, grid: &Grid) -> Self {
        let plane = grid.u.cross(grid.v);
        let normal = plane.normalize() * grid.normal.dot(plane).signum();
        let dual = |edge: DVec3, other: DVec3| {
            let across = other.cross(normal);
            across / edge.dot(across)
        };
        Self {
            grid: *grid,
            origin: world.ray_origin_of_sensor(grid.origin, normal).position(),
            normal,
            dual: [dual(grid.u, grid.v), dual(grid.v, grid.u)],
        }
    }

    /// The plane as flights from behind see it, where some of these come to the front of the grid's
    /// own normal. A surface in the grid's plane ends them before.
    pub(crate) fn behind(&self) -> Option<Self> {
        let Self { grid, origin, normal, dual } = *self;
        let is_tilted = grid.normal.cross(normal).length() > TILTED;
        is_tilted.then_some(Self { grid, origin, normal: -normal, dual })
    }

    /// The area of a cell in m^2.
    pub(crate) fn cell_area_m2(&self) -> f64 {
        self.grid.u.cross(self.grid.v).length() / self.grid.cells() as f64
    }

    /// How much a flight through the plane counts for the grid's own normal, which may be tilted:
    /// the ratio of the cosines.
    pub(crate) fn tilt_factor(&self, direction: DVec3) -> f64 {
        (self.grid.normal.dot(direction) / self.normal.dot(direction)).max(0.0)
    }

    /// Where the line of a flight crosses it, in m from the start.
    pub(crate) fn distance_m(&self, flight: &Flight) -> f64 {
        self.normal.dot(self.origin - flight.from) / self.normal.dot(flight.direction)
    }

    /// The cell that a flight passes through from the front, if any.
    pub(crate) fn cell(&self, flight: &Flight) -> Option<usize> {
        let &Flight { from, direction, length_m } = flight;
        let approach = self.normal.dot(direction);
        let height = self.normal.dot(self.origin - from);
        // Neither from behind nor away: most flights end here, before the division.
        if !(approach < 0.0 && height < 0.0) {
            return None;
        }
        let t = height / approach;
        if !(t > 0.0 && t < length_m) {
            return None;
        }
        let place = from + direction * t - self.origin;
        let [columns, rows] = self.grid.counts;
        let column = part(self.dual[0].dot(place), columns)?;
        let row = part(self.dual[1].dot(place), rows)?;
        Some(row * columns as usize + column)
    }
}

/// Which of `count` equal parts of [0, 1) holds `share`, if any.
fn part(share: f64, count: u32) -> Option<usize> {
    let inside = (0.0..1.0).contains(&share);
    inside.then(|| ((share * f64::from(count)) as u32).min(count - 1) as usize)
}
