//! The lines in which a plane cuts triangles.
//!
//! A corner in the plane counts as below it, so that a face in the plane is not cut, neighbours
//! agree on their common edge, and the outline of a solid is closed.

use super::model::Surfaces;
use glam::DVec3;

/// The points p with `normal` . p = `offset_m`; what lies toward `normal` is above.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plane {
    pub(crate) normal: DVec3,
    pub(crate) offset_m: f64,
}

impl Plane {
    fn height(&self, point_m: DVec3) -> f64 {
        self.normal.dot(point_m) - self.offset_m
    }

    /// Whether a point is not above the plane, within a hair of `hair_m`.
    pub(crate) fn has_below(&self, point_m: DVec3, hair_m: f64) -> bool {
        self.height(point_m) <= hair_m
    }

    /// What of a triangle is not above the plane, in triangles.
    pub(crate) fn triangles_below(&self, corners: [DVec3; 3]) -> Vec<[DVec3; 3]> {
        let side = |k: usize| [corners[k], corners[(k + 1) % 3]];
        // Where sides cross the plane both neighbours have the crossing: once is enough.
        let ends = (0..3).filter_map(|k| self.part_below(side(k))).flatten();
        let mut ring: Vec<DVec3> = ends.collect();
        ring.dedup();
        if ring.len() > 1 && ring.first() == ring.last() {
            ring.pop();
        }
        (2..ring.len()).map(|k| [ring[0], ring[k - 1], ring[k]]).collect()
    }

    /// What of a segment is not above the plane.
    pub(crate) fn part_below(&self, [a, b]: [DVec3; 2]) -> Option<[DVec3; 2]> {
        match [a, b].map(|end| self.height(end) > 0.0) {
            [true, true] => None,
            [false, false] => Some([a, b]),
            [false, true] => Some([a, self.crossing(a, b)]),
            [true, false] => Some([self.crossing(b, a), b]),
        }
    }

    /// Where the plane cuts a triangle.
    pub(crate) fn cut(&self, corners: [DVec3; 3]) -> Option<[DVec3; 2]> {
        let above = corners.map(|corner| self.height(corner) > 0.0);
        // The corner that lies alone on its side.
        let alone =
            (0..3).find(|&k| above[k] != above[(k + 1) % 3] && above[k] != above[(k + 2) % 3])?;
        let ends = [1, 2].map(|step| corners[(alone + step) % 3]);
        Some(ends.map(|end| self.between(corners[alone], end)))
    }

    /// The crossing between two corners, computed from the lower one, so that both triangles of an
    /// edge have the same.
    fn between(&self, a: DVec3, b: DVec3) -> DVec3 {
        if self.height(a) > 0.0 { self.crossing(b, a) } else { self.crossing(a, b) }
    }

    fn crossing(&self, below: DVec3, above: DVec3) -> DVec3 {
        let [low, high] = [below, above].map(|end| self.height(end));
        below.lerp(above, (low / (low - high)).clamp(0.0, 1.0))
    }
}

impl<'a> Surfaces<'a> {
    /// The triangles whose corners are there and finite.
    pub(crate) fn corners(self) -> impl Iterator<Item = [DVec3; 3]> + 'a {
        (0..self.triangles.len()).filter_map(move |index| self.triangle(index))
    }

    /// The corners of a triangle, if they are there and finite.
    pub(crate) fn triangle(self, index: usize) -> Option<[DVec3; 3]> {
        let [a, b, c] = self
            .triangles
            .get(index)?
            .map(|v| self.positions_m.get(v as usize).copied().filter(|p| p.is_finite()));
        Some([a?, b?, c?])
    }

    /// The number of the material of a triangle.
    pub(crate) fn material(self, index: usize) -> u32 {
        self.material_of.get(index).copied().unwrap_or(0)
    }

    /// Triangles that light goes through.
    pub(crate) fn panes(self) -> impl Iterator<Item = [DVec3; 3]> + 'a {
        let lets_through = move |index: &usize| {
            let material = self.material(*index) as usize;
            self.lets_through.get(material).copied().unwrap_or(false)
        };
        let all = 0..self.triangles.len();
        all.filter(lets_through).filter_map(move |index| self.triangle(index))
    }

    /// The lines in which a plane cuts the triangles.
    pub(crate) fn cut(self, plane: Plane) -> impl Iterator<Item = [DVec3; 2]> + 'a {
        self.corners().filter_map(move |corners| plane.cut(corners))
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::{Shell, room};
    use super::*;

    /// Bounds and total length of the cut at a height.
    fn cut_at(shell: &Shell, offset_m: f64) -> Vec<[DVec3; 2]> {
        shell.surfaces().cut(Plane { normal: DVec3::Z, offset_m }).collect()
    }

    #[test]
    fn the_cut_of_a_box_is_its_rectangle() {
        let lines = cut_at(&room(), 1.1);
        let length: f64 = lines.iter().map(|[a, b]| a.distance(*b)).sum();
        assert!((length - 20.0).abs() < 1e-12, "{length}");
        for point in lines.iter().flatten() {
            let on_wall = [point.x, 6.0 - point.x, point.y, 4.0 - point.y];
            assert!(on_wall.iter().any(|distance| distance.abs() < 1e-12), "{point}");
            assert!((point.z - 1.1).abs() < 1e-12);
        }
        let with_table: f64 = cut_at(&room(), 0.4).iter().map(|[a, b]| a.distance(*b)).sum();
        assert!((with_table - 25.0).abs() < 1e-12, "{with_table}");
    }

    /// The table's top lies in the plane: it is below, and only the walls are cut.
    #[test]
    fn a_face_in_the_plane_is_not_cut() {
        assert_eq!(cut_at(&room(), 0.7).len(), cut_at(&room(), 1.1).len());
        assert!(cut_at(&room(), 3.0).is_empty());
        assert_eq!(cut_at(&room(), 0.0).len(), cut_at(&room(), 0.4).len());
    }

    #[test]
    fn what_is_above_is_cut_off() {
        let plane = Plane { normal: DVec3::Z, offset_m: 1.0 };
        let up = [DVec3::ZERO, DVec3::Z * 4.0];
        assert_eq!(plane.part_below(up), Some([DVec3::ZERO, DVec3::Z]));
        assert_eq!(plane.part_below([up[1], up[0]]), Some([DVec3::Z, DVec3::ZERO]));
        assert_eq!(plane.part_below([DVec3::Z * 2.0, up[1]]), None);
    }

    #[test]
    fn triangles_are_cut_off_at_the_plane() {
        let plane = Plane { normal: DVec3::Z, offset_m: 1.0 };
        let corner = |x: f64, z: f64| DVec3::new(x, 0.0, z);
        let area_below = |corners: [DVec3; 3]| -> f64 {
            let pieces = plane.triangles_below(corners);
            let area = |[a, b, c]: [DVec3; 3]| 0.5 * (b - a).cross(c - a).length();
            assert!(pieces.iter().flatten().all(|p| p.z <= 1.0));
            pieces.into_iter().map(area).sum()
        };
        let tip_up = [corner(0.0, 0.0), corner(2.0, 0.0), corner(1.0, 2.0)];
        assert!((area_below(tip_up) - 1.5).abs() < 1e-12);
        let tip_down = tip_up.map(|p| corner(p.x, 2.0 - p.z));
        assert!((area_below(tip_down) - 0.5).abs() < 1e-12);
        assert!((area_below(tip_up.map(|p| p * 0.5)) - 0.5).abs() < 1e-12);
        assert_eq!(area_below(tip_up.map(|p| p + DVec3::Z * 1.5)), 0.0);
    }

    #[test]
    fn triangles_with_wrong_corners_are_left_out() {
        let positions_m = [DVec3::ZERO, DVec3::NAN, DVec3::Z, DVec3::ONE];
        let triangles = [[0, 1, 2], [0, 2, 9], [0, 2, 3]];
        let surfaces =
            Surfaces { positions_m: &positions_m, triangles: &triangles, ..Surfaces::default() };
        assert_eq!(surfaces.corners().count(), 1);
    }
}
