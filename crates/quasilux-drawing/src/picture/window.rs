//! How much of what stands around a grid its picture shows.

use super::cells::GridPicture;
use super::plan::clipped;
use crate::drawing::Frame;
use glam::{DVec2, DVec3};

/// A picture shows the whole section of a room that is at most this many times as long as the
/// longer edge of the grid.
const MAX_WHOLE: f64 = 3.0;
/// Room around a grid that its picture may take for what stands there in a longer one, in its
/// longer edge.
const AROUND: f64 = 0.3;
/// Clear space outside of the walls, in the longer edge of the picture.
const BEYOND: f64 = 0.015;

/// The part of a grid's plane that its picture shows, from the grid's corner along its edges, in m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Window {
    pub(super) low_m: DVec2,
    pub(super) high_m: DVec2,
}

impl Window {
    /// The grid, and the room around it, or of a large one the walls that are near.
    pub(super) fn new(grid: &GridPicture<'_>) -> Self {
        let [u_m, v_m] = grid.edges_m();
        let own = Self { low_m: DVec2::ZERO, high_m: DVec2::new(u_m, v_m) };
        let reach_m = AROUND * own.high_m.max_element();
        let around = Frame {
            corner_px: (own.low_m - reach_m).to_array(),
            size_px: (own.high_m + 2.0 * reach_m).to_array(),
        };
        let [u, v] = grid.directions();
        let origin = DVec3::from(grid.origin_m);
        let place = |p: DVec3| DVec2::new((p - origin).dot(u), (p - origin).dot(v));
        let cut = || grid.surroundings.surfaces.cut(grid.plane()).map(|ends| ends.map(place));
        let with = |window: Self, p: DVec2| Self {
            low_m: window.low_m.min(p),
            high_m: window.high_m.max(p),
        };
        let mut all = cut().flatten().fold(own, with);
        if all.size_m().max_element() > MAX_WHOLE * own.high_m.max_element() {
            all = cut().filter_map(|ends| clipped(ends, around)).flatten().fold(own, with);
        }
        if all == own {
            return own;
        }
        let beyond_m = BEYOND * all.size_m().max_element();
        Self { low_m: all.low_m - beyond_m, high_m: all.high_m + beyond_m }
    }

    pub(super) fn size_m(&self) -> DVec2 {
        self.high_m - self.low_m
    }
}

#[cfg(test)]
mod tests {
    use super::super::plan::fixtures::room;
    use super::*;
    use crate::example::Grid;
    use crate::picture::Surroundings;

    /// A grid half a metre from walls of 6 m x 4 m, and the same in a hall.
    #[test]
    fn the_window_holds_near_walls() {
        let (near, grid) = (room(), Grid::new([5.0, 3.0], [5, 3], 0.0, |_, _| 1.0));
        let surroundings = Surroundings { surfaces: near.surfaces(), ..Surroundings::default() };
        let picture = GridPicture { surroundings, ..grid.picture("workplane") };
        let window = Window::new(&picture);
        let beyond = DVec2::splat(0.015 * 6.0);
        assert!(window.low_m.distance(DVec2::splat(-0.5) - beyond) < 1e-9, "{window:?}");
        assert!(window.high_m.distance(DVec2::new(5.5, 3.5) + beyond) < 1e-9, "{window:?}");
        let alone = Window::new(&grid.picture("workplane"));
        assert_eq!(alone, Window { low_m: DVec2::ZERO, high_m: DVec2::new(5.0, 3.0) });
        let hall = super::super::plan::fixtures::Shell::default()
            .with_box(DVec3::splat(-30.0), DVec3::splat(30.0));
        let surroundings = Surroundings { surfaces: hall.surfaces(), ..Surroundings::default() };
        let picture = GridPicture { surroundings, ..grid.picture("workplane") };
        assert_eq!(Window::new(&picture), alone);
    }

    /// A room of 6 m is shown whole around a grid of 2.1 m, and in part around one of 1.9 m; both
    /// lie 1 m from its nearest walls.
    #[test]
    fn a_room_of_up_to_three_times_the_grid_is_shown_whole() {
        let shell = room();
        let surroundings = Surroundings { surfaces: shell.surfaces(), ..Surroundings::default() };
        let window = |edge_m: f64| {
            let grid = Grid::new([edge_m, 1.0], [5, 3], 0.0, |_, _| 1.0);
            let origin_m = [1.0, 2.0, 1.0];
            Window::new(&GridPicture { surroundings, origin_m, ..grid.picture("task") })
        };
        let size_m = window(2.1).size_m();
        assert!(size_m.distance(DVec2::new(6.18, 4.18)) < 1e-9, "{size_m}");
        assert_eq!(window(1.9), Window { low_m: DVec2::ZERO, high_m: DVec2::new(1.9, 1.0) });
    }
}
