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

impl Axis {
    /// World coordinates where the edge runs along one of their axes, else lengths from the grid's
    /// corner, named as the edge; at most `most` ticks.
    pub(crate) fn along_edge(origin: DVec3, edge: DVec3, edge_name: &str, most: usize) -> Self {
        let length_m = edge.length();
        let world = (0..3).find(|&a| edge[a].abs() > length_m * (1.0 - 1e-9));
        let (title, start_m, end_m) = match world {
            Some(a) => (["x", "y", "z"][a], origin[a], origin[a] + edge[a]),
            None => (edge_name, 0.0, length_m),
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
        let axis = Axis::along_edge(DVec3::new(0.5, 0.0, 0.0), DVec3::X * 4.0, "u", 5);
        assert_eq!(axis.title, "x (m)");
        let expected = [(0.125, "1"), (0.375, "2"), (0.625, "3"), (0.875, "4")];
        assert_eq!(axis.ticks, expected.map(|(share, text)| tick(share, text)));
        let backward = Axis::along_edge(DVec3::Y * 4.0, DVec3::Y * -4.0, "v", 3);
        assert_eq!(backward.title, "y (m)");
        assert_eq!(backward.ticks[0], tick(1.0, "0"));
    }

    #[test]
    fn lengths_from_the_corner_otherwise() {
        let axis = Axis::along_edge(DVec3::ONE, DVec3::new(3.0, 4.0, 0.0), "u", 6);
        assert_eq!(axis.title, "u (m)");
        assert_eq!(axis.ticks.first(), Some(&tick(0.0, "0")));
        assert_eq!(axis.ticks.last(), Some(&tick(1.0, "5")));
    }
}
