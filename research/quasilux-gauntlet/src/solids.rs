//! Closed bodies.

use crate::room::{Room, Surface};
use crate::shell::Block;
use glam::DVec3;

/// Corners of an octahedron and its faces, counter-clockwise from outside.
const CORNERS: [DVec3; 6] =
    [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
const FACES: [[usize; 3]; 8] =
    [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
/// Faces of a box, counter-clockwise from outside: bits say where a corner is along x, y and z.
const BOX: [[usize; 4]; 6] =
    [[0, 2, 3, 1], [4, 5, 7, 6], [0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3]];
/// Halvings of the edges of balls: 8 times 4^3 facets.
const HALVINGS: u32 = 3;

impl Room {
    /// Adds a ball of flat facets, its fronts outward.
    pub(crate) fn add_ball(&mut self, middle: DVec3, radius_m: f64, surface: Surface) {
        let mut faces: Vec<[DVec3; 3]> = FACES.map(|face| face.map(|k| CORNERS[k])).to_vec();
        for _ in 0..HALVINGS {
            faces = faces.into_iter().flat_map(quarters).collect();
        }
        for face in faces {
            let corners = face.map(|corner| middle + corner * radius_m);
            self.add_polygon(corners.to_vec(), surface);
        }
    }

    /// Adds a box, its fronts outward and its corners shared to the last bit, as glass must have
    /// them.
    pub(crate) fn add_body(&mut self, block: Block, surface: Surface) {
        let ends = [block.low, block.high];
        for face in BOX {
            let corner = |bits: usize| {
                DVec3::new(ends[bits & 1].x, ends[bits >> 1 & 1].y, ends[bits >> 2 & 1].z)
            };
            self.add_polygon(face.map(corner).to_vec(), surface);
        }
    }
}

/// Four facets of one, on the unit sphere; both neighbours of an edge halve it alike.
fn quarters([a, b, c]: [DVec3; 3]) -> [[DVec3; 3]; 4] {
    let middle = |a: DVec3, b: DVec3| (a + b).normalize();
    let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By the divergence theorem.
    fn volume(room: &Room) -> f64 {
        let triangles = room.faces.iter().flat_map(|face| face.triangles());
        triangles.map(|[a, b, c]| a.cross(b).dot(c)).sum::<f64>() / 6.0
    }

    /// The volume is that of a ball, less what its facets cut off.
    #[test]
    fn balls_are_closed_and_face_outward() {
        let mut room = Room::empty();
        room.add_ball(DVec3::new(1.0, 2.0, 3.0), 0.5, Surface::Glass(1.5));
        let ball = 4.0 / 3.0 * std::f64::consts::PI * 0.125;
        let share = volume(&room) / ball;
        assert!((0.96..1.0).contains(&share), "{share}");
    }

    #[test]
    fn boxes_are_closed_and_face_outward() {
        let mut room = Room::empty();
        room.add_body(Block::new([0.1, 0.2, 0.3], [1.1, 2.2, 3.3]), Surface::Glass(1.5));
        assert!((volume(&room) - 6.0).abs() < 1e-12);
    }
}
