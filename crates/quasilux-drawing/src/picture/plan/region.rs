//! The outlines of what triangles cover on the sheet.
//!
//! All triangles are turned to one sense of rotation; sides that two of them pass in opposite
//! senses cancel, and the rest are closed outlines with the same winding numbers.

use glam::DVec2;

/// At most this many sides are drawn.
const MOST: usize = 4000;
/// Points of the finest lattice in a pixel.
const FINEST: f64 = 4.0;

type Corner = [i32; 2];

/// A side that is passed from its first corner to its second one.
type Side = [Corner; 2];

/// Closed outlines, without their last points; triangles that cover no area have none. Where there
/// are too many sides, corners move to a coarser lattice.
pub(crate) fn outlines(triangles: impl Iterator<Item = [DVec2; 3]>) -> Vec<Vec<DVec2>> {
    let lattice = |p: DVec2| (p * FINEST).round().to_array().map(|x| x as i32);
    let mut triangles: Vec<[Corner; 3]> = triangles.map(|corners| corners.map(lattice)).collect();
    let mut unit = 1.0 / FINEST;
    let mut sides = border(&triangles);
    while sides.len() > MOST {
        let coarser = |corner: Corner| corner.map(|x| x.div_euclid(2));
        triangles.iter_mut().for_each(|corners| *corners = corners.map(coarser));
        unit *= 2.0;
        sides = border(&triangles);
    }
    let place = |corner: Corner| DVec2::from(corner.map(f64::from)) * unit;
    rings(sides).into_iter().map(|ring| ring.into_iter().map(place).collect()).collect()
}

/// The sides that do not cancel, sorted.
fn border(triangles: &[[Corner; 3]]) -> Vec<Side> {
    let turned = triangles.iter().filter_map(|&[a, b, c]| {
        let edge = |to: Corner| [0, 1].map(|axis| i64::from(to[axis]) - i64::from(a[axis]));
        let [u, v] = [edge(b), edge(c)];
        match u[0].wrapping_mul(v[1]).wrapping_sub(u[1].wrapping_mul(v[0])) {
            0 => None,
            area if area > 0 => Some([a, b, c]),
            _ => Some([a, c, b]),
        }
    });
    let mut sides: Vec<Side> = turned.flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
    let forward = |side: &Side| side[0] < side[1];
    let line = |side: &Side| if forward(side) { *side } else { [side[1], side[0]] };
    sides.sort_unstable_by_key(|side| line(side));
    let mut left = Vec::new();
    for group in sides.chunk_by(|a, b| line(a) == line(b)) {
        let ahead = group.iter().filter(|side| forward(side)).count();
        let back = group.len() - ahead;
        let [a, b] = line(&group[0]);
        let side = if ahead > back { [a, b] } else { [b, a] };
        left.extend(std::iter::repeat_n(side, ahead.abs_diff(back)));
    }
    left.sort_unstable();
    left
}

/// Joins sorted sides to closed outlines: at each corner as many arrive as leave.
fn rings(sides: Vec<Side>) -> Vec<Vec<Corner>> {
    let mut is_used = vec![false; sides.len()];
    // Sides behind the first one of a corner that may be unused.
    let mut next_of: Vec<usize> = vec![0; sides.len()];
    let mut found = Vec::new();
    for start in 0..sides.len() {
        if is_used[start] {
            continue;
        }
        let (mut here, mut ring) = (start, Vec::new());
        loop {
            is_used[here] = true;
            ring.push(sides[here][0]);
            let corner = sides[here][1];
            let first = sides.partition_point(|side| side[0] < corner);
            let Some(step) = next_of.get(first).copied() else {
                break;
            };
            let unused = (first + step..sides.len())
                .take_while(|&k| sides[k][0] == corner)
                .find(|&k| !is_used[k]);
            let Some(next) = unused else {
                break;
            };
            next_of[first] = next - first;
            here = next;
        }
        found.push(ring);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Twice the area inside outlines.
    fn double_area(rings: &[Vec<DVec2>]) -> f64 {
        let sides = rings.iter().flat_map(|ring| {
            (0..ring.len()).map(move |k| ring[k].perp_dot(ring[(k + 1) % ring.len()]))
        });
        sides.sum()
    }

    #[test]
    fn triangles_side_by_side_have_one_outline() {
        let [a, b, c, d] = [[0.0, 0.0], [8.0, 0.0], [8.0, 6.0], [0.0, 6.0]].map(DVec2::from);
        // The second one runs the other way round.
        let found = outlines([[a, b, c], [a, d, c]].into_iter());
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].len(), 4);
        assert_eq!(double_area(&found), 2.0 * 48.0);
        assert!(outlines([[a, b, b], [a, a, a]].into_iter()).is_empty());
    }

    #[test]
    fn many_triangles_keep_their_area_and_few_sides() {
        let corner = |x: u32, y: u32| DVec2::new(f64::from(x), f64::from(y)) * 0.7;
        let cells = (0..300_u32).flat_map(|x| (0..200_u32).map(move |y| [x, y]));
        // A chessboard: each field keeps its border until the lattice is coarse.
        let triangles = cells.filter(|[x, y]| (x + y) % 2 == 0).flat_map(|[x, y]| {
            let [a, b, c, d] =
                [corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1)];
            [[a, b, c], [a, c, d]]
        });
        let found = outlines(triangles);
        assert!(found.iter().map(Vec::len).sum::<usize>() <= MOST);
        assert!(double_area(&found) > 0.0);
    }
}
