//! The edges of surfaces that a drawing shows: borders, creases, lines where one material ends and
//! another one begins, and contours where a surface turns away from the viewer. Edges between
//! triangles of one smooth face of one material are left out.
//!
//! Corners at one place are one corner, whatever their indices. Of each triangle at an edge only
//! the direction w counts in which it leaves the edge, a unit vector square to it, so that the
//! order of corners does not matter: where each triangle at the edge has another one of its
//! material that leaves about the opposite way, the surface goes on. Seen along d, it turns there
//! if both leave to the same side of the edge's line on the sheet.

use super::model::Surfaces;
use glam::DVec3;
use std::collections::HashMap;

/// Surfaces that bend by less than this angle go on: its cosine (20 degrees).
const COS_SMOOTH: f64 = 0.94;

/// An edge that is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Edge {
    pub(crate) ends_m: [DVec3; 2],
    /// Where a single triangle has it, the direction in which that leaves.
    pub(crate) border: Option<DVec3>,
    /// Bit k is set where it is seen along direction k.
    shown: u8,
}

impl Edge {
    /// Whether it is seen along direction number `view`.
    pub(crate) fn is_seen(&self, view: usize) -> bool {
        self.shown & (1 << view) != 0
    }
}

/// An edge of one triangle.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Side {
    /// Corners, the lower number first.
    ends: [u32; 2],
    /// The third corner.
    opposite: u32,
    material: u32,
}

/// The edges that are seen along at most eight unit directions, in a fixed order. Edges shorter
/// than `least_m` are left out.
pub(crate) fn edges(surfaces: Surfaces<'_>, directions: &[DVec3], least_m: f64) -> Vec<Edge> {
    let corner_of = welded(surfaces.positions_m);
    let place = |corner: u32| surfaces.positions_m[corner as usize];
    let mut sides: Vec<Side> = Vec::new();
    for (index, triangle) in surfaces.triangles.iter().enumerate() {
        let Some([a, b, c]) = surfaces.triangle(index) else {
            continue;
        };
        if (b - a).cross(c - a) == DVec3::ZERO {
            continue;
        }
        let material = surfaces.material(index);
        let corners = triangle.map(|corner| corner_of[corner as usize]);
        for k in 0..3 {
            let [a, b, opposite] = [k, (k + 1) % 3, (k + 2) % 3].map(|k| corners[k]);
            if place(a).distance_squared(place(b)) >= least_m * least_m {
                sides.push(Side { ends: [a.min(b), a.max(b)], opposite, material });
            }
        }
    }
    sides.sort_unstable();
    let groups = sides.chunk_by(|a, b| a.ends == b.ends);
    groups.filter_map(|group| edge(group, &place, directions)).collect()
}

/// The first of the corners at the same place as each.
fn welded(positions_m: &[DVec3]) -> Vec<u32> {
    let mut first: HashMap<[u64; 3], u32> = HashMap::with_capacity(positions_m.len());
    // Adding zero makes one of both zeros.
    let key = |p: &DVec3| (*p + 0.0).to_array().map(f64::to_bits);
    let numbered = positions_m.iter().zip(0..);
    numbered.map(|(position, number)| *first.entry(key(position)).or_insert(number)).collect()
}

fn edge(sides: &[Side], place: &impl Fn(u32) -> DVec3, directions: &[DVec3]) -> Option<Edge> {
    let ends_m = sides.first()?.ends.map(place);
    let along = (ends_m[1] - ends_m[0]).normalize_or_zero();
    let leaving = |side: &Side| {
        let across = place(side.opposite) - ends_m[0];
        (across - along * along.dot(across)).normalize_or_zero()
    };
    // Where very many meet, the first ones decide.
    let sides = &sides[..sides.len().min(16)];
    let leaving: Vec<DVec3> = sides.iter().map(leaving).collect();
    let pairs = || sides.iter().zip(&leaving);
    let goes_on = |(side, w): (&Side, &DVec3)| {
        let is_next = |(other, v): (&Side, &DVec3)| {
            other.material == side.material && w.dot(*v) < -COS_SMOOTH
        };
        pairs().any(is_next)
    };
    let shown = if pairs().all(goes_on) {
        let turns = |direction: &DVec3| {
            let aside = along.cross(*direction);
            let sides = || leaving.iter().map(|w| w.dot(aside));
            let least = sides().fold(f64::INFINITY, f64::min);
            let most = sides().fold(f64::NEG_INFINITY, f64::max);
            least * most > 1e-9
        };
        directions.iter().rev().fold(0, |shown, d| shown << 1 | u8::from(turns(d)))
    } else {
        u8::MAX
    };
    let border = if let [only] = leaving.as_slice() { Some(*only) } else { None };
    (shown != 0).then_some(Edge { ends_m, border, shown })
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::{Shell, room};
    use super::*;

    const VIEWS: [DVec3; 3] = [DVec3::Z, DVec3::NEG_Y, DVec3::X];

    #[test]
    fn a_box_has_twelve_edges() {
        let one = Shell::default().with_box(DVec3::ZERO, DVec3::ONE);
        let found = edges(one.surfaces(), &VIEWS, 0.0);
        assert_eq!(found.len(), 12);
        for edge in &found {
            assert!((edge.ends_m[0].distance(edge.ends_m[1]) - 1.0).abs() < 1e-12);
            assert!((0..3).all(|view| edge.is_seen(view)));
        }
        assert_eq!(edges(room().surfaces(), &VIEWS, 0.0).len(), 24);
        assert!(edges(one.surfaces(), &VIEWS, 1.1).is_empty());
    }

    /// A sheet of two triangles, a sheet with two faces, and two sheets side by side.
    #[test]
    fn sheets_have_their_border() {
        let corner = |x: f64, y: f64| DVec3::new(x, y, 0.0);
        let positions_m = [corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)];
        let one = [[0, 1, 2], [0, 2, 3]];
        let two = [[0, 1, 2], [0, 2, 3], [0, 2, 1], [0, 3, 2]];
        for triangles in [&one[..], &two[..]] {
            let positions_m = &positions_m;
            let surfaces = Surfaces { positions_m, triangles, ..Surfaces::default() };
            let found = edges(surfaces, &VIEWS, 0.0);
            assert_eq!(found.len(), 4, "{triangles:?}");
            assert!(found.iter().all(|edge| edge.ends_m[0].distance(edge.ends_m[1]) < 1.1));
        }
    }

    /// A wall of 3 x 3 squares with shared corners, the middle one of glass: the outline of the
    /// wall and of the glass.
    #[test]
    fn materials_in_one_plane_have_an_edge_between_them() {
        let positions_m: Vec<DVec3> =
            (0..16).map(|k| DVec3::new(f64::from(k % 4), 0.0, f64::from(k / 4))).collect();
        let square = |k: u32| {
            let a = k % 3 + 4 * (k / 3);
            [[a, a + 1, a + 5], [a, a + 5, a + 4]]
        };
        let triangles: Vec<[u32; 3]> = (0..9).flat_map(square).collect();
        let material_of: Vec<u32> = (0..18).map(|k| u32::from(k / 2 == 4)).collect();
        let wall = Surfaces {
            positions_m: &positions_m,
            triangles: &triangles,
            material_of: &material_of,
            ..Surfaces::default()
        };
        let length = |surfaces: Surfaces<'_>| -> f64 {
            let found = edges(surfaces, &VIEWS, 0.0);
            found.iter().map(|edge| edge.ends_m[0].distance(edge.ends_m[1])).sum()
        };
        assert!((length(wall) - 16.0).abs() < 1e-12);
        assert!((length(Surfaces { material_of: &[], ..wall }) - 12.0).abs() < 1e-12);
    }

    /// From each side a ball of many faces shows about a circle.
    #[test]
    fn a_ball_shows_its_contour() {
        let ball = Shell::default().with_ball(DVec3::ONE, 0.5, 40);
        let found = edges(ball.surfaces(), &VIEWS, 0.0);
        for (view, direction) in VIEWS.iter().enumerate() {
            let mut length = 0.0;
            for edge in found.iter().filter(|edge| edge.is_seen(view)) {
                let flat =
                    edge.ends_m.map(|p| p - DVec3::ONE - *direction * (p - 1.0).dot(*direction));
                length += flat[0].distance(flat[1]);
                assert!(flat.iter().all(|p| (p.length() - 0.5).abs() < 0.05), "{edge:?}");
            }
            assert!((length / std::f64::consts::PI - 1.0).abs() < 0.1, "{length} in {view}");
        }
    }
}
