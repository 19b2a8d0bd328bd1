//! Polygons to triangles: a fan where convex, ear clipping where not.
//!
//! The plane of a polygon is that of its area vector (Newell's method: Sutherland, Sproull and
//! Schumacker 1974). Ear clipping: Meisters 1975, "Polygons have ears": a simple polygon of more
//! than three corners has a corner whose triangle lies inside and can be cut off.

use glam::DVec3;

/// Most corners of a polygon that is not convex: clipping costs up to their cube.
const MAX_CONCAVE_CORNERS: usize = 1000;

/// A polygon that is not convex has too many corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a face that is not convex has {0} corners; expected at most {MAX_CONCAVE_CORNERS}")]
pub(super) struct TooManyCorners(usize);

/// The triangles of a polygon as indices of its corners, in its own sense of rotation: always two
/// fewer than corners, some of them degenerate where corners are.
pub(super) fn triangulate(corners: &[DVec3]) -> Result<Vec<[usize; 3]>, TooManyCorners> {
    let normal = area_vector(corners);
    let all: Vec<usize> = (0..corners.len()).collect();
    if is_convex(corners, normal) {
        return Ok(fan(&all));
    }
    if corners.len() > MAX_CONCAVE_CORNERS {
        return Err(TooManyCorners(corners.len()));
    }
    Ok(clip_ears(corners, normal, all))
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

fn clip_ears(corners: &[DVec3], normal: DVec3, mut left: Vec<usize>) -> Vec<[usize; 3]> {
    let mut triangles = Vec::with_capacity(left.len().saturating_sub(2));
    while left.len() > 3 {
        let n = left.len();
        let neighbours = |i: usize| [left[(i + n - 1) % n], left[i], left[(i + 1) % n]];
        // A polygon that crosses itself may have no ear: its remainder becomes a fan.
        let Some(ear) = (0..n).find(|&i| is_ear(corners, normal, &left, neighbours(i))) else {
            break;
        };
        triangles.push(neighbours(ear));
        left.remove(ear);
    }
    triangles.extend(fan(&left));
    triangles
}

/// Whether abc turns left and no other corner that is left lies in it.
fn is_ear(corners: &[DVec3], normal: DVec3, left: &[usize], [a, b, c]: [usize; 3]) -> bool {
    let [pa, pb, pc] = [a, b, c].map(|i| corners[i]);
    turn(pa, pb, pc, normal) > 0.0
        && left.iter().all(|&i| {
            let p = corners[i];
            [pa, pb, pc].contains(&p)
                || turn(pa, pb, p, normal) < 0.0
                || turn(pb, pc, p, normal) < 0.0
                || turn(pc, pa, p, normal) < 0.0
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(points: &[[f64; 2]]) -> Vec<DVec3> {
        // A tilted plane: x and y are kept, z follows.
        points.iter().map(|&[x, y]| DVec3::new(x, y, 0.5 * x - 0.25 * y)).collect()
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
}
