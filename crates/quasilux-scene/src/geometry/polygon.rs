//! Polygons to triangles: a fan where convex, ear clipping where not.
//!
//! The plane of a polygon is that of its area vector (Newell's method: Sutherland, Sproull and
//! Schumacker 1974). Ear clipping: Meisters 1975, "Polygons have ears": a simple polygon of more
//! than three corners has a corner whose triangle lies inside and can be cut off. Cutting it off
//! makes ears of no other corners than its neighbours (Eberly 1998, "Triangulation by ear
//! clipping"), so that each step tests two corners, against those near them.

use super::corner_grid::CornerGrid;
use glam::DVec3;
use std::collections::BTreeSet;

/// Most tests of all faces of a file together: some seconds. A face of 1000 corners takes some ten
/// thousand of them where its triangles are small, half a million where all reach across it.
const MAX_TESTS: u64 = 400_000_000;

/// Faces that are not convex take too many tests.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "up to this face, of {0} corners, cutting faces that are not convex into triangles takes more \
     than {MAX_TESTS} steps; expected faces of fewer corners"
)]
pub(super) struct TooIntricate(usize);

/// Cuts the polygons of a file.
pub(super) struct Cutter {
    tests_left: u64,
}

impl Default for Cutter {
    fn default() -> Self {
        Self { tests_left: MAX_TESTS }
    }
}

impl Cutter {
    /// The triangles of a polygon as indices of its corners, in its own sense of rotation: always
    /// two fewer than corners, some of them degenerate where corners are.
    pub(super) fn triangulate(
        &mut self,
        corners: &[DVec3],
    ) -> Result<Vec<[usize; 3]>, TooIntricate> {
        let normal = area_vector(corners);
        if is_convex(corners, normal) {
            let all: Vec<usize> = (0..corners.len()).collect();
            return Ok(fan(&all));
        }
        let polygon = Remainder::new(corners, normal);
        polygon.clip_ears(&mut self.tests_left).ok_or(TooIntricate(corners.len()))
    }
}

/// Twice the area vector of the polygon.
fn area_vector(corners: &[DVec3]) -> DVec3 {
    let Some(&origin) = corners.first() else {
        return DVec3::ZERO;
    };
    corners.windows(2).map(|pair| (pair[0] - origin).cross(pair[1] - origin)).sum()
}

/// Whether no corner turns against `normal`, and the outline goes round once.
fn is_convex(corners: &[DVec3], normal: DVec3) -> bool {
    let n = corners.len();
    let no_turn_back =
        (0..n).all(|i| turn(corners[i], corners[(i + 1) % n], corners[(i + 2) % n], normal) >= 0.0);
    no_turn_back
        && (1..n.max(2) - 1).all(|i| turn(corners[0], corners[i], corners[i + 1], normal) >= 0.0)
}

/// Twice the signed area of triangle abc seen along `-normal`, times the length of `normal`.
fn turn(a: DVec3, b: DVec3, c: DVec3, normal: DVec3) -> f64 {
    (b - a).cross(c - a).dot(normal)
}

fn fan(corners: &[usize]) -> Vec<[usize; 3]> {
    corners.windows(2).skip(1).map(|pair| [corners[0], pair[0], pair[1]]).collect()
}

/// Part of a polygon that is left.
struct Remainder<'a> {
    corners: &'a [DVec3],
    normal: DVec3,
    /// The corners before and after each that is left.
    before: Vec<usize>,
    after: Vec<usize>,
    /// Corners that are left, by place.
    grid: CornerGrid,
}

impl<'a> Remainder<'a> {
    fn new(corners: &'a [DVec3], normal: DVec3) -> Self {
        let n = corners.len();
        Self {
            corners,
            normal,
            before: (0..n).map(|i| (i + n - 1) % n).collect(),
            after: (0..n).map(|i| (i + 1) % n).collect(),
            grid: CornerGrid::new(corners, normal),
        }
    }

    /// Always the first ear in the order of corners; `None` where the tests are used up.
    fn clip_ears(mut self, tests_left: &mut u64) -> Option<Vec<[usize; 3]>> {
        let n = self.corners.len();
        let mut triangles = Vec::with_capacity(n.saturating_sub(2));
        let mut is_left = vec![true; n];
        let mut ears = BTreeSet::new();
        while triangles.len() + 3 < n {
            if ears.is_empty() {
                for i in (0..n).filter(|&i| is_left[i]) {
                    if self.is_ear(i, tests_left)? {
                        ears.insert(i);
                    }
                }
            }
            // A polygon that crosses itself may have no ear: its remainder becomes a fan.
            let Some(ear) = ears.pop_first() else { break };
            let [before, after] = [self.before[ear], self.after[ear]];
            triangles.push([before, ear, after]);
            is_left[ear] = false;
            self.grid.remove(ear);
            (self.after[before], self.before[after]) = (after, before);
            for i in [before, after] {
                if self.is_ear(i, tests_left)? {
                    ears.insert(i);
                } else {
                    ears.remove(&i);
                }
            }
        }
        let left: Vec<usize> = (0..n).filter(|&i| is_left[i]).collect();
        triangles.extend(fan(&left));
        Some(triangles)
    }

    /// Whether the outline turns left at a corner and no other corner that is left lies in its
    /// triangle; `None` where the tests are used up.
    fn is_ear(&self, corner: usize, tests_left: &mut u64) -> Option<bool> {
        let triangle = [self.before[corner], corner, self.after[corner]].map(|i| self.corners[i]);
        let [a, b, c] = triangle;
        if turn(a, b, c, self.normal) <= 0.0 {
            return Some(false);
        }
        let is_inside = |i: usize| {
            let p = self.corners[i];
            !(triangle.contains(&p)
                || turn(a, b, p, self.normal) < 0.0
                || turn(b, c, p, self.normal) < 0.0
                || turn(c, a, p, self.normal) < 0.0)
        };
        self.grid.any_near(triangle, is_inside, tests_left).map(|any| !any)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(points: &[[f64; 2]]) -> Vec<DVec3> {
        // A tilted plane: x and y are kept, z follows.
        points.iter().map(|&[x, y]| DVec3::new(x, y, 0.5 * x - 0.25 * y)).collect()
    }

    fn triangulate(corners: &[DVec3]) -> Result<Vec<[usize; 3]>, TooIntricate> {
        Cutter::default().triangulate(corners)
    }

    /// Sum of the areas, and whether all triangles turn like the polygon.
    fn areas(corners: &[DVec3]) -> (f64, bool) {
        let normal = area_vector(corners);
        let triangles = triangulate(corners).unwrap();
        assert_eq!(triangles.len(), corners.len() - 2);
        let vectors: Vec<DVec3> = triangles
            .iter()
            .map(|&[a, b, c]| (corners[b] - corners[a]).cross(corners[c] - corners[a]) / 2.0)
            .collect();
        let alike = vectors.iter().all(|v| v.dot(normal) >= 0.0);
        (vectors.iter().map(|v| v.length()).sum(), alike)
    }

    #[test]
    fn an_l_keeps_its_area_from_every_first_corner() {
        let l = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
        let slant = DVec3::new(-0.5, 0.25, 1.0).length();
        for first in 0..l.len() {
            let mut turned = l;
            turned.rotate_left(first);
            for reversed in [false, true] {
                if reversed {
                    turned.reverse();
                }
                let (area, alike) = areas(&polygon(&turned));
                assert!((area - 3.0 * slant).abs() < 1e-12, "{area}");
                assert!(alike, "a triangle is turned over");
            }
        }
    }

    #[test]
    fn a_star_keeps_its_area() {
        // Corners alternate between radius 2 and 1/2: ten triangles of area r R sin(36 deg) / 2.
        let corner = |i: usize| {
            let (sin, cos) = libm::sincos(std::f64::consts::PI * i as f64 / 5.0);
            let radius = if i.is_multiple_of(2) { 2.0 } else { 0.5 };
            DVec3::new(radius * cos, radius * sin, 0.0)
        };
        let star: Vec<DVec3> = (0..10).map(corner).collect();
        let expected = 5.0 * libm::sin(std::f64::consts::PI / 5.0);
        let (area, alike) = areas(&star);
        assert!((area - expected).abs() < 1e-12 && alike, "{area} is not {expected}");
    }

    #[test]
    fn degenerate_outlines_are_still_cut() {
        for points in [&[[0.0, 0.0]; 5][..], &[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 0.0]]] {
            assert_eq!(triangulate(&polygon(points)).unwrap().len(), points.len() - 2);
        }
        let bow_tie = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
        assert_eq!(triangulate(&polygon(&bow_tie)).unwrap().len(), 2);
        assert!(triangulate(&[]).unwrap().is_empty());
    }
    /// A wall of a thousand corners in six turns, the inner side nearer to the middle by half of
    /// what a turn gains.
    fn spiral() -> Vec<DVec3> {
        let corner = |i: usize, inward: f64| {
            let along = i as f64 / 500.0;
            let (sin, cos) = libm::sincos(12.0 * std::f64::consts::PI * along);
            let radius = 0.2 + 0.9 * along - inward;
            DVec3::new(radius * cos, radius * sin, 0.0)
        };
        let outer = (0..500).map(|i| corner(i, 0.0));
        outer.chain((0..500).rev().map(|i| corner(i, 0.07))).collect()
    }

    /// Few tests a corner: tested against all others, a file of two thousand had no end.
    #[test]
    fn a_spiral_is_cut_with_few_tests() {
        let spiral = spiral();
        let (area, alike) = areas(&spiral);
        let expected = 0.5 * area_vector(&spiral).length();
        assert!((area - expected).abs() < 1e-9 && alike, "{area} is not {expected}");
        let mut cutter = Cutter::default();
        cutter.triangulate(&spiral).unwrap();
        let tests = MAX_TESTS - cutter.tests_left;
        assert!(tests < 100_000, "{tests} tests");
    }

    #[test]
    fn tests_are_bounded() {
        let mut cutter = Cutter { tests_left: 1000 };
        assert_eq!(cutter.triangulate(&spiral()), Err(TooIntricate(1000)));
        let square = polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        assert_eq!(cutter.triangulate(&square).unwrap().len(), 2);
    }

    /// Triangles by the definition, all corners against all others.
    fn slow_twin(corners: &[DVec3]) -> Vec<[usize; 3]> {
        let normal = area_vector(corners);
        let mut left: Vec<usize> = (0..corners.len()).collect();
        let mut triangles = Vec::new();
        while left.len() > 3 {
            let n = left.len();
            let neighbours = |i: usize| [left[(i + n - 1) % n], left[i], left[(i + 1) % n]];
            let is_ear = |[a, b, c]: [usize; 3]| {
                let [pa, pb, pc] = [a, b, c].map(|i| corners[i]);
                turn(pa, pb, pc, normal) > 0.0
                    && left.iter().map(|&i| corners[i]).all(|p| {
                        [pa, pb, pc].contains(&p)
                            || turn(pa, pb, p, normal) < 0.0
                            || turn(pb, pc, p, normal) < 0.0
                            || turn(pc, pa, p, normal) < 0.0
                    })
            };
            let Some(ear) = (0..n).find(|&i| is_ear(neighbours(i))) else { break };
            triangles.push(neighbours(ear));
            left.remove(ear);
        }
        triangles.extend(fan(&left));
        triangles
    }

    fn clipped(corners: &[DVec3]) -> Vec<[usize; 3]> {
        Remainder::new(corners, area_vector(corners)).clip_ears(&mut 1_000_000).unwrap()
    }

    #[test]
    fn the_slow_twin_cuts_alike() {
        let star = |n: usize, sharp: f64| -> Vec<DVec3> {
            let corner = |i: usize| {
                let (sin, cos) = libm::sincos(2.0 * std::f64::consts::PI * i as f64 / n as f64);
                let radius = 1.0 + sharp * libm::cos(1.7 * (i * i) as f64);
                DVec3::new(radius * cos, radius * sin, 0.1 * cos)
            };
            (0..n).map(corner).collect()
        };
        for n in [5, 12, 41, 100] {
            for sharp in [0.2, 0.9] {
                let star = star(n, sharp);
                assert_eq!(clipped(&star), slow_twin(&star), "{n} {sharp}");
            }
        }
        assert_eq!(clipped(&spiral()), slow_twin(&spiral()));
    }
}
