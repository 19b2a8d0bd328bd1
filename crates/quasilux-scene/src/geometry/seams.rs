//! Polygons of Radiance: holes are parts of the outline, which goes to each of them and back along
//! a seam.
//!
//! Ear clipping cuts most of them as they are. Where its triangles have another area than the
//! outline, seams are taken out: an edge that is there in both directions parts an outline into
//! two, of which the smaller one is a hole of the other.

use super::cut::HoleCutter;
use super::polygon::Cutter;
use glam::DVec3;

/// Triangles of a polygon.
pub(super) struct Cut {
    pub(super) triangles: Vec<[DVec3; 3]>,
    pub(super) has_no_area: bool,
    /// Whether the triangles have the area of the outline.
    pub(super) is_simple: bool,
}

/// Cuts the polygons of a scene.
pub(super) struct SeamCutter {
    polygons: Cutter,
    holes: HoleCutter,
    steps_left: u64,
}

/// Share of the area that triangles may be off.
const SAME: f64 = 1e-6;
/// Most pairs of edges that are compared for the seams of all outlines.
const MAX_STEPS: u64 = 500_000_000;

impl SeamCutter {
    pub(super) fn new() -> Self {
        Self { polygons: Cutter::default(), holes: HoleCutter::new(), steps_left: MAX_STEPS }
    }

    /// Triangles of an outline, counter-clockwise seen as it is.
    pub(super) fn triangles(&mut self, corners: &[DVec3]) -> Result<Cut, String> {
        let corners = without_repeats(corners);
        let area = area_vector(&corners);
        let size = corners.iter().map(|it| (*it - corners[0]).length()).fold(0.0, f64::max);
        if corners.len() < 3 || area.length() <= 1e-12 * size * size {
            return Ok(Cut { triangles: Vec::new(), has_no_area: true, is_simple: true });
        }
        let cut = self.polygons.triangulate(&corners).map_err(|error| error.to_string())?;
        let triangles = cut.into_iter().map(|it| it.map(|index| corners[index])).collect();
        let plain = Cut { triangles, has_no_area: false, is_simple: true };
        if is_same(&plain.triangles, area) {
            return Ok(plain);
        }
        let mut loops = loops(&corners, &mut self.steps_left)?;
        loops.retain(|corners| corners.len() > 2);
        let largest = |a: &Vec<DVec3>, b: &Vec<DVec3>| {
            area_vector(a).length().total_cmp(&area_vector(b).length())
        };
        let Some(outer) = loops.iter().enumerate().max_by(|a, b| largest(a.1, b.1)) else {
            return Ok(Cut { is_simple: false, ..plain });
        };
        let outer = outer.0;
        let outline = loops.swap_remove(outer);
        let left = self.holes.cut(&outline, &loops)?;
        let is_simple = is_same(&left.triangles, area);
        Ok(Cut { triangles: left.triangles, has_no_area: false, is_simple })
    }
}

/// Whether triangles that all face as the outline have its area.
fn is_same(triangles: &[[DVec3; 3]], area: DVec3) -> bool {
    let doubled = |&[a, b, c]: &[DVec3; 3]| (b - a).cross(c - a).length();
    let sum: f64 = triangles.iter().map(doubled).sum();
    (sum - area.length()).abs() <= SAME * area.length()
}

fn area_vector(corners: &[DVec3]) -> DVec3 {
    let Some(&origin) = corners.first() else { return DVec3::ZERO };
    corners.windows(2).map(|pair| (pair[0] - origin).cross(pair[1] - origin)).sum()
}

/// Corners of which none equals the one before it.
fn without_repeats(corners: &[DVec3]) -> Vec<DVec3> {
    let mut kept: Vec<DVec3> = Vec::with_capacity(corners.len());
    for &corner in corners {
        if kept.last() != Some(&corner) {
            kept.push(corner);
        }
    }
    while kept.len() > 1 && kept.first() == kept.last() {
        kept.pop();
    }
    kept
}

/// The loops of an outline without its seams.
fn loops(corners: &[DVec3], steps_left: &mut u64) -> Result<Vec<Vec<DVec3>>, String> {
    let size = corners.iter().map(|it| (*it - corners[0]).length()).fold(0.0, f64::max);
    let near = |a: DVec3, b: DVec3| (a - b).length() <= 1e-7 * size;
    let mut done = Vec::new();
    let mut open = vec![corners.to_vec()];
    while let Some(corners) = open.pop() {
        let n = corners.len();
        let mut steps = 0;
        let seam = (0..n).find_map(|i| {
            steps += (n - i) as u64;
            if steps > *steps_left {
                return Some([0, 0]);
            }
            let (from, to) = (corners[i], corners[(i + 1) % n]);
            let back = |&j: &usize| near(corners[j], to) && near(corners[(j + 1) % n], from);
            (i + 1..n).find(back).map(|j| [i, j])
        });
        *steps_left = steps_left.checked_sub(steps).ok_or_else(|| {
            format!(
                "up to here polygons that are not simple have more than {MAX_STEPS} pairs of \
                 edges; expected fewer corners"
            )
        })?;
        let Some([i, j]) = seam else {
            done.push(corners);
            continue;
        };
        // From the end of the seam to where it goes back, and the rest.
        let inner: Vec<DVec3> = corners[i + 1..j].to_vec();
        let rest: Vec<DVec3> = corners[j + 1..].iter().chain(&corners[..i]).copied().collect();
        open.extend([without_repeats(&inner), without_repeats(&rest)]);
    }
    Ok(done)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place([x, y]: [f64; 2]) -> DVec3 {
        DVec3::new(x, y, 0.5 * x - 0.25 * y)
    }

    fn expect(corners: &[[f64; 2]], area: f64) {
        let corners: Vec<DVec3> = corners.iter().copied().map(place).collect();
        let slant = DVec3::new(-0.5, 0.25, 1.0).length();
        let cut = SeamCutter::new().triangles(&corners).unwrap();
        let doubled = |&[a, b, c]: &[DVec3; 3]| (b - a).cross(c - a).length();
        let found = 0.5 * cut.triangles.iter().map(doubled).sum::<f64>() / slant;
        assert!((found - area).abs() < 1e-9 && cut.is_simple, "{found} is not {area}");
        let up = DVec3::new(-0.5, 0.25, 1.0);
        assert!(cut.triangles.iter().all(|&[a, b, c]| (b - a).cross(c - a).dot(up) >= 0.0));
    }

    /// By the areas of rectangles and triangles.
    #[test]
    fn holes_by_seams_keep_their_area() {
        let hole = [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0], [0.0, 0.0]];
        let window = [[1.0, 1.0], [1.0, 2.0], [2.0, 2.0], [2.0, 1.0], [1.0, 1.0]];
        expect(&[&hole[..], &window].concat(), 11.0);
        // A second hole by a seam from the first one, and one at its own corner of the outline.
        let second = [[2.0, 1.0], [2.5, 1.0], [2.5, 1.5], [3.5, 1.5], [3.5, 0.5], [2.5, 0.5]];
        let back = [[2.5, 1.0], [2.0, 1.0], [1.0, 1.0]];
        let first = [[1.0, 1.0], [1.0, 2.0], [2.0, 2.0]];
        expect(&[&hole[..], &first, &second, &back].concat(), 10.0);
        let third = [[4.0, 3.0], [3.5, 2.75], [3.5, 2.5], [3.0, 2.5], [3.5, 2.75]];
        let outline = [&hole[..3], &third, &hole[2..], &window].concat();
        expect(&outline, 11.0 - 0.0625);
        // The hole first.
        let turned = [&window[..], &[[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0], [0.0, 0.0]]];
        expect(&turned.concat(), 11.0);
        expect(&[[0.0, 0.0], [0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0], [0.0, 0.0]], 2.0);
    }

    /// Outlines that cross themselves are searched for seams, and that has an end.
    #[test]
    fn outlines_of_many_corners_end() {
        let point = |at: usize| DVec3::new((at % 2) as f64, (at / 2) as f64, 0.0);
        let corners: Vec<DVec3> = (0..100_000).map(point).collect();
        let mut left = 1_000_000;
        let error = loops(&corners, &mut left).unwrap_err();
        assert!(error.contains("pairs of edges"), "{error}");
    }

    #[test]
    fn what_has_no_area_is_said() {
        for corners in [&[[0.0, 0.0]; 4][..], &[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]] {
            let corners: Vec<DVec3> = corners.iter().copied().map(place).collect();
            assert!(SeamCutter::new().triangles(&corners).unwrap().has_no_area);
        }
    }
}
