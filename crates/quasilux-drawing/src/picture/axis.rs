//! The edges of a grid as axes in metres.

use crate::ticks::{Tick, Ticks};
use glam::DVec3;

/// Ticks along one edge of a grid.
#[derive(Debug, PartialEq)]
pub(crate) struct Axis {
    /// What the numbers mean.
    pub(crate) title: String,
    /// Its numbers; shares are of the edge from its beginning.
    pub(crate) ticks: Vec<Tick>,
}

/// What is shown of the line along an edge of a grid.
pub(crate) struct Edge<'a> {
    /// The grid's corner in m.
    pub(crate) origin: DVec3,
    /// Unit vector along the edge.
    pub(crate) direction: DVec3,
    /// Where the shown part begins and ends, from the corner, in m.
    pub(crate) shown_m: [f64; 2],
    /// What the edge is called.
    pub(crate) name: &'a str,
}

impl Axis {
    /// World coordinates where the edge runs along one of their axes, else lengths from the grid's
    /// corner, named as the edge; at most `most` ticks.
    pub(crate) fn along_edge(edge: &Edge<'_>, most: usize) -> Self {
        let world = (0..3).find(|&a| edge.direction[a].abs() > 1.0 - 1e-9);
        let (title, start_m, end_m) = match world {
            Some(a) => {
                let at = |length_m: f64| edge.origin[a] + edge.direction[a].signum() * length_m;
                let [start_m, end_m] = edge.shown_m.map(at);
                (["x", "y", "z"][a], start_m, end_m)
            }
            None => (edge.name, edge.shown_m[0], edge.shown_m[1]),
        };
        let ticks = Ticks::within(start_m.min(end_m), start_m.max(end_m), most, 0.0);
        let place = |value: f64| ((value - start_m) / (end_m - start_m)).clamp(0.0, 1.0);
        Self { title: format!("{title} (m)"), ticks: ticks.marks(place) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tick(share: f64, label: &str) -> Tick {
        Tick { share, label: Some(label.to_owned()) }
    }

    #[test]
    fn world_coordinates_where_there_are_some() {
        let along = |origin, direction, length_m| Edge {
            origin,
            direction,
            shown_m: [0.0, length_m],
            name: "u",
        };
        let axis = Axis::along_edge(&along(DVec3::new(0.5, 0.0, 0.0), DVec3::X, 4.0), 5);
        assert_eq!(axis.title, "x (m)");
        let expected = [(0.125, "1"), (0.375, "2"), (0.625, "3"), (0.875, "4")];
        assert_eq!(axis.ticks, expected.map(|(share, text)| tick(share, text)));
        let backward = Axis::along_edge(&along(DVec3::Y * 4.0, DVec3::NEG_Y, 4.0), 3);
        assert_eq!(backward.title, "y (m)");
        assert_eq!(backward.ticks[0], tick(1.0, "0"));
    }

    #[test]
    fn lengths_from_the_corner_otherwise() {
        let direction = DVec3::new(0.6, 0.8, 0.0);
        let edge = Edge { origin: DVec3::ONE, direction, shown_m: [0.0, 5.0], name: "u" };
        let axis = Axis::along_edge(&edge, 6);
        assert_eq!(axis.title, "u (m)");
        assert_eq!(axis.ticks.first(), Some(&tick(0.0, "0")));
        assert_eq!(axis.ticks.last(), Some(&tick(1.0, "5")));
    }
}
