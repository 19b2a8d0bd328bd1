//! Luminous surfaces in pieces: triangles that share corners belong together, so that one panel of
//! several is seen to be turned over.

use super::forest::first_of_each;
use super::model::Surfaces;
use glam::DVec3;
use std::collections::BTreeMap;

/// Surfaces of more triangles are one piece.
const MAX_TRIANGLES: usize = 20_000;

/// Triangles that belong together.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Piece {
    /// The centre of its area in m.
    pub(crate) middle_m: DVec3,
    /// The mean of its unit normals over its area: shorter than 1 where it is not flat.
    pub(crate) mean_normal: DVec3,
}

/// The pieces of a surface, in the order of their first triangles.
pub(crate) fn pieces(surfaces: Surfaces<'_>, triangles: &[u32]) -> Vec<Piece> {
    let corners = triangles.iter().filter_map(|&t| surfaces.triangle(t as usize));
    let corners: Vec<[DVec3; 3]> = corners.collect();
    let mut groups: BTreeMap<usize, Sum> = BTreeMap::new();
    let firsts = match corners.len() > MAX_TRIANGLES {
        true => vec![0; corners.len()],
        false => first_of_each(&corners),
    };
    for (corners, first) in corners.iter().zip(firsts) {
        groups.entry(first).or_default().add(*corners);
    }
    groups.into_values().filter_map(Sum::piece).collect()
}

/// Twice the areas of triangles, summed in three ways.
#[derive(Default)]
struct Sum {
    area: f64,
    directed: DVec3,
    moment: DVec3,
}

impl Sum {
    fn add(&mut self, [a, b, c]: [DVec3; 3]) {
        let across = (b - a).cross(c - a);
        self.area += across.length();
        self.directed += across;
        self.moment += (a + b + c) * (across.length() / 3.0);
    }

    fn piece(self) -> Option<Piece> {
        (self.area > 0.0).then(|| Piece {
            middle_m: self.moment / self.area,
            mean_normal: self.directed / self.area,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::Shell;
    use super::*;

    #[test]
    fn each_panel_is_a_piece_with_its_own_direction() {
        let panel = |x: f64| {
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[s, t]| DVec3::new(x + s, t, 2.9))
        };
        let positions_m: Vec<DVec3> = [0.0, 3.0, 6.0].into_iter().flat_map(panel).collect();
        let up = |first: u32| [[0, 1, 2], [0, 2, 3]].map(|t| t.map(|k| first + k));
        let down = |first: u32| [[2, 1, 0], [3, 2, 0]].map(|t| t.map(|k| first + k));
        let triangles = [down(0), up(4), down(8)].concat();
        let shell = Shell { positions_m, triangles, ..Shell::default() };
        let found = pieces(shell.surfaces(), &[0, 1, 2, 3, 4, 5, 99]);
        let heights: Vec<f64> = found.iter().map(|piece| piece.mean_normal.z).collect();
        assert_eq!(heights, [-1.0, 1.0, -1.0]);
        assert!((found[1].middle_m - DVec3::new(3.5, 0.5, 2.9)).length() < 1e-12);
        assert!(pieces(shell.surfaces(), &[]).is_empty());
    }
}
