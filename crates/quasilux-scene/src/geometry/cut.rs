//! Polygons without others that lie in their plane: walls without windows, faces with holes.
//!
//! Everything is cut into triangles first. A convex piece without a triangle is what of it lies
//! beyond the first edge, what of the rest lies beyond the second one, and beyond the third: the
//! difference needs no sweep and no search, and each step is the cut of a convex polygon by a
//! line. Corners keep their bits: where lines meet within the tolerance of a corner, it is that
//! corner, so that a window has the corners of the hole that it fills.

use super::polygon::Cutter;
use glam::DVec3;

/// Share of the size of a polygon within which points are on a line, and are one point.
const TOLERANCE: f64 = 1e-9;
/// Most pairs of a piece and a triangle that is cut out of it, in a file: some seconds.
const MAX_PAIRS: u64 = 100_000_000;

/// Cuts holes into the polygons of a file.
pub(super) struct HoleCutter {
    polygons: Cutter,
    pairs_left: u64,
}

/// Rest of a polygon, counter-clockwise seen as the polygon is.
#[derive(Debug, Default)]
pub(super) struct Left {
    pub(super) triangles: Vec<[DVec3; 3]>,
    /// The area in the square of the unit, and what it is if all that is cut out lies inside, and
    /// nothing twice.
    pub(super) area: f64,
    pub(super) expected_area: f64,
    outline_area: f64,
}

impl Left {
    /// Whether what was cut out lay inside and apart.
    pub(super) fn is_as_expected(&self) -> bool {
        (self.area - self.expected_area).abs() <= 1e-6 * self.outline_area
    }
}

/// A convex polygon.
type Piece = Vec<DVec3>;

/// The plane that stands on an edge of what is cut out; its normal points inward.
struct Edge {
    from: DVec3,
    to: DVec3,
    inward: DVec3,
}

/// The two sides of a piece.
struct Halves {
    outside: Piece,
    inside: Piece,
}

impl HoleCutter {
    pub(super) fn new() -> Self {
        Self { polygons: Cutter::default(), pairs_left: MAX_PAIRS }
    }

    /// A polygon without others; the reason where that takes too long.
    pub(super) fn cut(&mut self, outline: &[DVec3], others: &[Vec<DVec3>]) -> Result<Left, String> {
        let normal = area_vector(outline);
        let Some(up) = normal.try_normalize() else {
            return Ok(Left::default());
        };
        let mut pieces = self.triangles(outline, up)?;
        let tolerance = TOLERANCE * size(outline);
        let outline_area = 0.5 * normal.length();
        let mut expected_area = outline_area;
        for other in others {
            expected_area -= 0.5 * area_vector(other).length();
            for triangle in self.triangles(other, up)? {
                pieces = self.without(pieces, &triangle, up, tolerance)?;
            }
        }
        let triangles: Vec<[DVec3; 3]> = pieces.iter().flat_map(|piece| fan(piece)).collect();
        let area = triangles.iter().map(|&[a, b, c]| 0.5 * (b - a).cross(c - a).length()).sum();
        Ok(Left { triangles, area, expected_area, outline_area })
    }

    /// The triangles of a polygon, counter-clockwise seen from above.
    fn triangles(&mut self, corners: &[DVec3], up: DVec3) -> Result<Vec<Piece>, String> {
        if corners.len() < 3 {
            return Ok(Vec::new());
        }
        let triangles = self.polygons.triangulate(corners).map_err(|error| error.to_string())?;
        let turned = triangles.into_iter().map(|triangle| {
            let [a, b, c] = triangle.map(|corner| corners[corner]);
            if (b - a).cross(c - a).dot(up) < 0.0 { vec![a, c, b] } else { vec![a, b, c] }
        });
        Ok(turned.collect())
    }

    /// Pieces without a triangle.
    fn without(
        &mut self,
        pieces: Vec<Piece>,
        triangle: &[DVec3],
        up: DVec3,
        tolerance: f64,
    ) -> Result<Vec<Piece>, String> {
        let pairs = pieces.len() as u64;
        let too_many = "cutting apertures and holes out takes too many steps; expected fewer";
        self.pairs_left = self.pairs_left.checked_sub(pairs).ok_or(too_many)?;
        let mut edges = Vec::new();
        for (number, &from) in triangle.iter().enumerate() {
            let to = triangle[(number + 1) % 3];
            // A triangle without area takes nothing away.
            let Some(inward) = up.cross(to - from).try_normalize() else { return Ok(pieces) };
            edges.push(Edge { from, to, inward });
        }
        let mut left = Vec::new();
        for piece in pieces {
            let mut rest = piece.clone();
            let mut outside = Vec::new();
            for edge in &edges {
                let halves = halves(&rest, edge, tolerance);
                rest = halves.inside;
                outside.push(halves.outside);
                if rest.is_empty() {
                    break;
                }
            }
            if rest.is_empty() {
                left.push(piece);
            } else {
                left.extend(outside.into_iter().filter(|piece| !piece.is_empty()));
            }
        }
        Ok(left)
    }
}

/// Cuts a piece by a line; a half that is nowhere further from the line than the tolerance is
/// empty.
fn halves(piece: &[DVec3], edge: &Edge, tolerance: f64) -> Halves {
    let distances: Vec<f64> = piece.iter().map(|&p| (p - edge.from).dot(edge.inward)).collect();
    let is_inside = distances.iter().any(|&distance| distance > tolerance);
    let is_outside = distances.iter().any(|&distance| distance < -tolerance);
    match (is_inside, is_outside) {
        (true, false) => return Halves { outside: Vec::new(), inside: piece.to_vec() },
        (false, _) => return Halves { outside: piece.to_vec(), inside: Vec::new() },
        (true, true) => {}
    }
    let (mut outside, mut inside) = (Vec::new(), Vec::new());
    for (number, (&p, &distance)) in piece.iter().zip(&distances).enumerate() {
        let next = (number + 1) % piece.len();
        if distance >= -tolerance {
            inside.push(p);
        }
        if distance <= tolerance {
            outside.push(p);
        }
        let (q, other) = (piece[next], distances[next]);
        let crosses = distance.min(other) < -tolerance && distance.max(other) > tolerance;
        if crosses {
            let meeting = p + (q - p) * (distance / (distance - other));
            let corners = [edge.from, edge.to];
            let near = |corner: &DVec3| (*corner - meeting).length() <= 2.0 * tolerance;
            let meeting = corners.into_iter().find(near).unwrap_or(meeting);
            inside.push(meeting);
            outside.push(meeting);
        }
    }
    Halves { outside, inside }
}

/// Twice the area vector of a polygon (Newell's method).
fn area_vector(corners: &[DVec3]) -> DVec3 {
    let Some(&origin) = corners.first() else { return DVec3::ZERO };
    corners.windows(2).map(|pair| (pair[0] - origin).cross(pair[1] - origin)).sum()
}

/// The largest distance of a corner from the first one.
fn size(corners: &[DVec3]) -> f64 {
    let origin = corners[0];
    corners.iter().map(|&corner| (corner - origin).length()).fold(0.0, f64::max)
}

/// A convex polygon as triangles.
fn fan(piece: &[DVec3]) -> impl Iterator<Item = [DVec3; 3]> + '_ {
    (2..piece.len()).map(|last| [piece[0], piece[last - 1], piece[last]])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A rectangle in a tilted plane, whose slant keeps areas by a known factor.
    fn rectangle([x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) -> Vec<DVec3> {
        [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(place).to_vec()
    }

    fn place([x, y]: [f64; 2]) -> DVec3 {
        DVec3::new(3.0 + x, y, 0.5 * x - 0.25 * y)
    }

    fn slant() -> f64 {
        DVec3::new(-0.5, 0.25, 1.0).length()
    }

    fn cut(outline: &[DVec3], others: &[Vec<DVec3>]) -> Left {
        HoleCutter::new().cut(outline, others).unwrap()
    }

    fn expect_area(outline: &[DVec3], others: &[Vec<DVec3>], area: f64) {
        let left = cut(outline, others);
        assert!((left.area - area * slant()).abs() < 1e-9, "{} is not {area}", left.area / slant());
        let up = area_vector(outline);
        assert!(left.triangles.iter().all(|&[a, b, c]| (b - a).cross(c - a).dot(up) >= 0.0));
    }

    #[test]
    fn windows_inside_at_edges_and_over_all_are_cut_out() {
        let wall = rectangle([0.0, 0.0], [4.0, 3.0]);
        let window = rectangle([1.0, 1.0], [2.0, 2.0]);
        expect_area(&wall, &[], 12.0);
        expect_area(&wall, std::slice::from_ref(&window), 11.0);
        let door = rectangle([0.5, 0.0], [1.5, 2.0]);
        expect_area(&wall, std::slice::from_ref(&door), 10.0);
        expect_area(&wall, &[rectangle([0.0, 0.0], [4.0, 1.0])], 8.0);
        // Two that share an edge, then the same again, then all of it, either way round.
        let beside = rectangle([2.0, 1.0], [3.0, 2.0]);
        expect_area(&wall, &[window.clone(), beside.clone()], 10.0);
        assert!(cut(&wall, &[window.clone(), beside.clone()]).is_as_expected());
        expect_area(&wall, &[window.clone(), window.clone()], 11.0);
        assert!(!cut(&wall, &[window.clone(), window.clone()]).is_as_expected());
        expect_area(&wall, std::slice::from_ref(&wall), 0.0);
        let reversed: Vec<DVec3> = wall.iter().rev().copied().collect();
        expect_area(&wall, std::slice::from_ref(&reversed), 0.0);
        expect_area(&reversed, &[window], 11.0);
        expect_area(&wall, &[rectangle([3.0, 2.0], [5.0, 4.0])], 11.0);
        expect_area(&wall, &[rectangle([5.0, 2.0], [6.0, 4.0])], 12.0);
    }

    /// Rests of nothing but rounding are no gap.
    #[test]
    fn glass_that_covers_its_face_is_as_expected() {
        let wall = rectangle([0.1, 0.0], [4.7, 3.3]);
        let glass = rectangle([0.1, 0.0], [4.7, 3.3 - 1e-8]);
        assert!(
            cut(&wall, &[glass.clone(), rectangle([4.7, 0.0], [4.7 + 1e-8, 3.0])]).is_as_expected()
        );
        assert!(!cut(&wall, &[glass, rectangle([4.7, 0.0], [4.8, 3.0])]).is_as_expected());
    }

    #[test]
    fn concave_outlines_and_holes_keep_their_area() {
        let l = [[0.0, 0.0], [4.0, 0.0], [4.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];
        let l = l.map(place).to_vec();
        expect_area(&l, &[], 6.0);
        expect_area(&rectangle([-1.0, -1.0], [5.0, 4.0]), std::slice::from_ref(&l), 24.0);
        // Of the rectangle, 2 x 0.5 lies in the foot of the L.
        expect_area(&l, &[rectangle([2.0, 0.5], [6.0, 2.0])], 5.0);
    }

    /// The corners of the hole are those of the window, bit by bit.
    #[test]
    fn corners_of_windows_keep_their_bits() {
        let wall = rectangle([0.0, 0.1], [4.7, 3.3]);
        let window = [[1.1, 0.9], [2.3, 1.3], [2.2, 2.7]].map(place).to_vec();
        let left = cut(&wall, std::slice::from_ref(&window));
        for corner in wall.iter().chain(&window) {
            assert!(left.triangles.iter().flatten().any(|it| it == corner), "{corner}");
        }
        let near = |p: &DVec3| window.iter().any(|w| w != p && (*w - *p).length() < 1e-6);
        assert!(!left.triangles.iter().flatten().any(near));
    }

    #[test]
    fn what_has_no_area_is_left_out() {
        assert!(cut(&[DVec3::ZERO; 4], &[]).triangles.is_empty());
        assert!(cut(&[], &[]).triangles.is_empty());
        let wall = rectangle([0.0, 0.0], [4.0, 3.0]);
        expect_area(&wall, &[vec![], vec![DVec3::ONE], vec![wall[0]; 5]], 12.0);
    }

    #[test]
    fn steps_are_bounded() {
        let wall = rectangle([0.0, 0.0], [4.0, 3.0]);
        let window = rectangle([1.0, 1.0], [2.0, 2.0]);
        let mut cutter = HoleCutter { polygons: Cutter::default(), pairs_left: 10 };
        let error = cutter.cut(&wall, &vec![window; 5]).unwrap_err();
        assert!(error.contains("too many steps"), "{error}");
    }
}
