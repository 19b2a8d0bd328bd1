//! Whether a union of boxes covers a triangle, by clipping.
//!
//! Box after box is taken away from what is left of the triangle, each of which leaves at most six
//! convex pieces of a convex piece, one beyond each of its planes.

use glam::DVec3;

/// A box; empty where its low is above its high.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Solid {
    pub(crate) low: DVec3,
    pub(crate) high: DVec3,
}

/// A convex polygon; a point and a line are two.
type Polygon = Vec<DVec3>;

/// Whether every point of the triangle is in one of the boxes, which must overlap by more than the
/// rounding of a cut.
pub(crate) fn is_covered(triangle: [DVec3; 3], boxes: &[Solid]) -> bool {
    let mut pieces = vec![triangle.to_vec()];
    for solid in boxes {
        pieces = pieces.into_iter().flat_map(|piece| solid.taken_from(piece)).collect();
    }
    pieces.is_empty()
}

impl Solid {
    /// The pieces of a polygon outside of this box.
    fn taken_from(&self, piece: Polygon) -> Vec<Polygon> {
        let mut outside = Vec::new();
        let mut rest = piece.clone();
        for axis in 0..3 {
            for (sign, plane) in [(1.0, self.low[axis]), (-1.0, -self.high[axis])] {
                let beyond = |p: &DVec3| plane - sign * p[axis];
                if rest.iter().any(|p| beyond(p) > 0.0) {
                    outside.push(half(&rest, beyond));
                    rest = half(&rest, |p| -beyond(p));
                }
                if rest.is_empty() {
                    // Nothing in common: cutting would be in vain.
                    return vec![piece];
                }
            }
        }
        outside
    }
}

/// The part of a polygon where a linear function is not negative.
fn half(polygon: &[DVec3], f: impl Fn(&DVec3) -> f64) -> Polygon {
    let mut part = Vec::with_capacity(polygon.len() + 1);
    for (i, p) in polygon.iter().enumerate() {
        let q = &polygon[(i + 1) % polygon.len()];
        let (at_p, at_q) = (f(p), f(q));
        if at_p >= 0.0 {
            part.push(*p);
        }
        if (at_p > 0.0 && at_q < 0.0) || (at_p < 0.0 && at_q > 0.0) {
            part.push(*p + (*q - *p) * (at_p / (at_p - at_q)));
        }
    }
    part
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: [DVec3; 3] = [DVec3::ZERO, DVec3::X, DVec3::Y];

    fn solid(low: [f64; 2], high: [f64; 2]) -> Solid {
        let at = |p: [f64; 2], z| DVec3::new(p[0], p[1], z);
        Solid { low: at(low, -0.1), high: at(high, 0.1) }
    }

    #[test]
    fn one_box_or_many_may_do() {
        assert!(is_covered(TRIANGLE, &[solid([0.0, 0.0], [1.0, 1.0])]));
        let quarters = [
            solid([0.0, 0.0], [0.5, 0.5]),
            solid([0.5, 0.0], [1.0, 0.5]),
            solid([0.0, 0.5], [0.5, 1.0]),
        ];
        assert!(is_covered(TRIANGLE, &quarters));
        for missing in 0..3 {
            let others = [quarters[(missing + 1) % 3], quarters[(missing + 2) % 3]];
            assert!(!is_covered(TRIANGLE, &others), "without {missing}");
        }
    }

    /// All corners, all middles of edges and the centre are covered, and still there is a hole.
    #[test]
    fn small_holes_are_found() {
        let frame = [
            solid([0.0, 0.0], [0.21, 1.0]),
            solid([0.2, 0.0], [1.0, 0.3]),
            solid([0.19, 0.301], [0.9, 0.9]),
        ];
        assert!(!is_covered(TRIANGLE, &frame));
        let mended = [frame[0], frame[1], solid([0.19, 0.29], [0.9, 0.9])];
        assert!(is_covered(TRIANGLE, &mended));
    }

    #[test]
    fn points_and_lines_count() {
        let point = [DVec3::new(0.5, 0.5, 0.0); 3];
        assert!(is_covered(point, &[solid([0.5, 0.5], [0.5, 0.5])]));
        assert!(!is_covered(point, &[solid([0.0, 0.0], [0.4, 1.0])]));
        let line = [DVec3::ZERO, DVec3::X, 0.5 * DVec3::X];
        assert!(!is_covered(line, &[solid([0.0, 0.0], [0.9, 0.0])]));
        assert!(!is_covered(line, &[]));
    }
}
