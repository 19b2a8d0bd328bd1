//! Contour lines of a field known at the nodes of a rectangular lattice: marching squares, on a
//! finer lattice with smooth values between the known ones.
//!
//! A line crosses a lattice edge where the linear interpolation along the edge equals the level.
//! Where a square's corners are above and below in turn (a saddle), the mean of the four, which is
//! the bilinear value at the centre, decides which corners are joined (Nielson and Hamann 1991,
//! "The asymptotic decider", compare the value at the saddle point itself. Deviation: the centre is
//! enough for lines that are drawn at the resolution of the lattice).

use glam::DVec2;
use std::collections::BTreeMap;

/// A field on a rectangular lattice; nodes with a value that is not a number are holes.
#[derive(Clone, Debug)]
pub(crate) struct Field {
    /// Ascending coordinates of the columns.
    x: Vec<f64>,
    /// Ascending coordinates of the rows.
    y: Vec<f64>,
    /// Values at the nodes, x fastest.
    values: Vec<f64>,
}

/// A contour line; the last point of a closed one equals its first.
pub(crate) type Line = Vec<DVec2>;

/// A lattice edge: its lower left node, and whether it goes up.
type Edge = (usize, bool);

impl Field {
    /// A field with values in the cells of a grid, x fastest, one unit a cell. The nodes are the
    /// cell centres, and on the border what the two nearest centres extrapolate to.
    pub(crate) fn of_cells([columns, rows]: [usize; 2], values: &[f64]) -> Self {
        let nodes = |n: usize| -> Vec<f64> {
            let centres = (0..n).map(|i| i as f64 + 0.5);
            std::iter::once(0.0).chain(centres).chain([n as f64]).collect()
        };
        // The field is separable: rows first, then columns of the widened rows.
        let wide: Vec<f64> =
            values.chunks(columns).flat_map(|row| extended(row.iter().copied())).collect();
        let columns_with_border: Vec<Vec<f64>> = (0..columns + 2)
            .map(|i| extended(wide.iter().skip(i).step_by(columns + 2).copied()))
            .collect();
        let values = (0..rows + 2).flat_map(|j| columns_with_border.iter().map(move |c| c[j]));
        Self { x: nodes(columns), y: nodes(rows), values: values.collect() }
    }

    /// A field on a lattice with every square cut into `pieces` times `pieces`: through the same
    /// values at the nodes, and smooth along rows and columns.
    pub(crate) fn refined(&self, pieces: usize) -> Self {
        let columns = self.x.len();
        let rows: Vec<Vec<f64>> =
            self.values.chunks(columns).map(|row| finer(&self.x, row, pieces)).collect();
        let (x, y) = (finer(&self.x, &self.x, pieces), finer(&self.y, &self.y, pieces));
        let column = |i: usize| {
            let values: Vec<f64> = rows.iter().map(|row| row[i]).collect();
            finer(&self.y, &values, pieces)
        };
        let of_columns: Vec<Vec<f64>> = (0..x.len()).map(column).collect();
        let values = (0..y.len()).flat_map(|j| of_columns.iter().map(move |it| it[j]));
        Self { values: values.collect(), x, y }
    }

    /// The lines on which the field has a level, in a fixed order.
    pub(crate) fn contours(&self, level: f64) -> Vec<Line> {
        let mut neighbours: BTreeMap<Edge, Vec<Edge>> = BTreeMap::new();
        for j in 0..self.y.len() - 1 {
            for i in 0..self.x.len() - 1 {
                for [a, b] in self.crossings(i, j, level) {
                    neighbours.entry(a).or_default().push(b);
                    neighbours.entry(b).or_default().push(a);
                }
            }
        }
        let mut lines = Vec::new();
        // Open lines first, from their ends: what is left then is closed.
        let ends: Vec<Edge> =
            neighbours.iter().filter(|(_, n)| n.len() == 1).map(|(edge, _)| *edge).collect();
        for end in ends {
            lines.extend(self.follow(&mut neighbours, end, level));
        }
        while let Some((&start, _)) = neighbours.first_key_value() {
            lines.extend(self.follow(&mut neighbours, start, level));
        }
        lines
    }

    /// The pairs of edges of one square that are joined by the contour.
    fn crossings(&self, i: usize, j: usize, level: f64) -> Vec<[Edge; 2]> {
        let columns = self.x.len();
        let node = j * columns + i;
        let corners = [node, node + 1, node + columns + 1, node + columns];
        let values = corners.map(|n| self.values[n]);
        if values.iter().any(|v| v.is_nan()) {
            return Vec::new();
        }
        // Edge k joins corners k and k + 1, counter-clockwise from the lower one.
        let edges: [Edge; 4] =
            [(node, false), (node + 1, true), (node + columns, false), (node, true)];
        let above = values.map(|v| v >= level);
        let crossed: Vec<usize> = (0..4).filter(|&k| above[k] != above[(k + 1) % 4]).collect();
        match crossed.as_slice() {
            [] => Vec::new(),
            &[a, b] => vec![[edges[a], edges[b]]],
            _ => {
                let centre_above = values.iter().sum::<f64>() / 4.0 >= level;
                // Lines cut off the two corners that differ from the centre: corner k lies
                // between the edges k - 1 and k.
                let first = usize::from(above[0] == centre_above);
                vec![[edges[(first + 3) % 4], edges[first]], [edges[first + 1], edges[first + 2]]]
            }
        }
    }

    /// Takes a line out of the graph, beginning at `start`.
    fn follow(
        &self,
        neighbours: &mut BTreeMap<Edge, Vec<Edge>>,
        start: Edge,
        level: f64,
    ) -> Option<Line> {
        let mut here = start;
        let mut line = vec![self.crossing(start, level)];
        while let Some(next) = neighbours.get_mut(&here).and_then(Vec::pop) {
            if let Some(back) = neighbours.get_mut(&next)
                && let Some(at) = back.iter().position(|edge| *edge == here)
            {
                back.swap_remove(at);
            }
            if neighbours[&here].is_empty() {
                neighbours.remove(&here);
            }
            line.push(self.crossing(next, level));
            here = next;
        }
        neighbours.remove(&here);
        (line.len() > 1).then_some(line)
    }

    /// Where the field has the level on an edge that it crosses.
    fn crossing(&self, (node, goes_up): Edge, level: f64) -> DVec2 {
        let columns = self.x.len();
        let other = node + if goes_up { columns } else { 1 };
        let place = |n: usize| DVec2::new(self.x[n % columns], self.y[n / columns]);
        let (a, b) = (self.values[node], self.values[other]);
        place(node).lerp(place(other), (level - a) / (b - a))
    }
}

/// Values at the nodes and between them, each interval in this many pieces: cubic, with the slopes
/// at the nodes of H. Akima (Journal of the ACM 17, 1970), who weights those on both sides by how
/// much the others bend, so that a step does not swing. Next to a hole the slope is that of the
/// interval.
fn finer(nodes: &[f64], values: &[f64], pieces: usize) -> Vec<f64> {
    let last = nodes.len() - 1;
    let length = |i: usize| nodes[i + 1] - nodes[i];
    let rises: Vec<f64> = (0..last).map(|i| (values[i + 1] - values[i]) / length(i)).collect();
    // Of node `at` for the interval `i` beside it.
    let slope = |at: usize, i: usize| {
        if at == 0 || at == last {
            return rises[i];
        }
        let [before, behind] = [rises[at - 1], rises[at]];
        let bends_before = if at > 1 { (before - rises[at - 2]).abs() } else { 0.0 };
        let bends_behind = if at + 1 < last { (rises[at + 1] - behind).abs() } else { 0.0 };
        let sum = bends_before + bends_behind;
        let slope = if sum > 0.0 {
            (bends_behind * before + bends_before * behind) / sum
        } else {
            0.5 * (before + behind)
        };
        if slope.is_nan() { rises[i] } else { slope }
    };
    let between = |i: usize, k: usize| {
        let t = k as f64 / pieces as f64;
        let rise = values[i + 1] - values[i];
        let [from, to] = [slope(i, i), slope(i + 1, i)].map(|slope| slope * length(i));
        // The straight line, and what the slopes at both ends differ from it.
        let bend = (from - rise) * (1.0 - t) - (to - rise) * t;
        values[i] + rise * t + bend * t * (1.0 - t)
    };
    let inner = |i: usize| {
        let between = &between;
        std::iter::once(values[i]).chain((1..pieces).map(move |k| between(i, k)))
    };
    (0..last).flat_map(inner).chain([values[last]]).collect()
}

/// Values at cell centres with one more at either end, half a cell further on the straight line
/// through the two nearest ones; a hole or the lack of a second value leaves the nearest one.
fn extended(centres: impl Iterator<Item = f64>) -> Vec<f64> {
    let centres: Vec<f64> = centres.collect();
    let beyond = |nearest: f64, next: Option<&f64>| {
        let value = next.map_or(nearest, |next| nearest + 0.5 * (nearest - next));
        if value.is_nan() { nearest } else { value }
    };
    let n = centres.len();
    let before = beyond(centres[0], centres.get(1));
    let after = beyond(centres[n - 1], n.checked_sub(2).map(|i| &centres[i]));
    std::iter::once(before).chain(centres).chain([after]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn field(counts: [usize; 2], lx: impl Fn(f64, f64) -> f64) -> Field {
        let values: Vec<f64> = (0..counts[0] * counts[1])
            .map(|c| lx((c % counts[0]) as f64 + 0.5, (c / counts[0]) as f64 + 0.5))
            .collect();
        Field::of_cells(counts, &values)
    }

    #[test]
    fn a_ramp_has_straight_lines_at_exact_places() {
        for pieces in [1, 3] {
            let ramp = field([10, 7], |x, _| 100.0 * x).refined(pieces);
            for level in [10.0, 100.0, 250.0, 333.0, 850.0, 990.0] {
                let lines = ramp.contours(level);
                assert_eq!(lines.len(), 1, "one line at {level}");
                assert!(lines[0].iter().all(|p| (p.x - level / 100.0).abs() < 1e-12));
                let (first, last) = (lines[0][0].y, lines[0][lines[0].len() - 1].y);
                assert!(first.min(last) == 0.0 && (first.max(last) - 7.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn a_cone_has_circles() {
        let centre = DVec2::new(20.0, 15.0);
        let cone = field([40, 30], |x, y| DVec2::new(x, y).distance(centre));
        for radius in [3.0, 7.7, 12.0] {
            for pieces in [1, 4] {
                let lines = cone.refined(pieces).contours(radius);
                assert_eq!(lines.len(), 1);
                assert_eq!(lines[0][0], lines[0][lines[0].len() - 1], "closed");
                // The bilinear interpolant of the distance is off by less than 1/8 of the second
                // derivatives 1/r along each axis.
                let tolerance = 0.25 / radius;
                assert!(lines[0].iter().all(|p| (p.distance(centre) - radius).abs() < tolerance));
                let length: f64 = lines[0].windows(2).map(|w| w[0].distance(w[1])).sum();
                assert!((length / (2.0 * std::f64::consts::PI * radius) - 1.0).abs() < 0.02);
            }
        }
    }

    /// At a row of known values lines have no kinks: a line turns there by no more than elsewhere.
    #[test]
    fn lines_bend_smoothly() {
        let dome = |x: f64, y: f64| 500.0 / (1.0 + 0.08 * (x - 4.0) * (x - 4.0) + 0.05 * y * y);
        let turns = |field: &Field| {
            let turn = |w: &[DVec2]| (w[1] - w[0]).angle_to(w[2] - w[1]).abs();
            let lines = field.contours(250.0);
            // Lines of even steps: short ones between two edges of the lattice turn by chance.
            let spaced = lines.into_iter().map(|line| {
                let mut kept = vec![line[0]];
                for point in line {
                    if point.distance(kept[kept.len() - 1]) > 0.3 {
                        kept.push(point);
                    }
                }
                kept
            });
            spaced
                .flat_map(|line| line.windows(3).map(turn).collect::<Vec<_>>())
                .fold(0.0, f64::max)
        };
        let coarse = field([8, 6], dome);
        let (kinked, smooth) = (turns(&coarse), turns(&coarse.refined(12)));
        assert!(smooth < 0.25 && kinked > 1.5 * smooth, "{kinked} and {smooth}");
    }

    /// A step does not swing, and holes stay holes.
    #[test]
    fn finer_values_neither_swing_nor_fill_holes() {
        let nodes: Vec<f64> = (0..8).map(f64::from).collect();
        let step = [1.0, 1.0, 1.0, 1.0, 30.0, 30.0, 30.0, 30.0];
        for value in finer(&nodes, &step, 7) {
            assert!((1.0 - 1e-9..30.0 + 1e-9).contains(&value), "{value}");
        }
        let mut hole = step;
        hole[1] = f64::NAN;
        let values = finer(&nodes, &hole, 2);
        assert_eq!(values.iter().filter(|value| value.is_nan()).count(), 3);
    }

    #[test]
    fn the_centre_decides_a_saddle() {
        for (corner, joins_lower_left_with_itself) in [(10.0, false), (4.0, true)] {
            let lattice = Field {
                x: vec![0.0, 1.0],
                y: vec![0.0, 1.0],
                values: vec![corner, 0.0, 0.0, corner],
            };
            let level = 0.25 * (10.0 + 4.0);
            let lines = lattice.contours(level);
            assert_eq!(lines.len(), 2);
            let cuts_corner = |line: &Line| {
                line.iter().all(|p| p.x + p.y < 1.0) || line.iter().all(|p| p.x + p.y > 1.0)
            };
            assert_eq!(lines.iter().all(cuts_corner), joins_lower_left_with_itself);
        }
    }

    #[test]
    fn lines_neither_branch_nor_break() {
        // A pattern that is above and below in turn has saddles everywhere.
        let board = field([9, 9], |x, y| f64::from((x as i32 * 7 + y as i32 * 5) % 4));
        for level in [0.5, 1.0, 1.5, 2.0, 3.0] {
            for line in board.contours(level) {
                let on_border = |p: DVec2| [p.x, p.y].iter().any(|c| *c == 0.0 || *c == 9.0);
                let (first, last) = (line[0], line[line.len() - 1]);
                assert!(first == last || (on_border(first) && on_border(last)));
                assert!(line.windows(2).all(|w| w[0].distance(w[1]) <= 2.0_f64.sqrt() + 1e-12));
            }
        }
    }

    #[test]
    fn nothing_to_draw() {
        assert!(field([1, 1], |_, _| 5.0).contours(5.0).is_empty());
        assert!(field([8, 8], |_, _| 5.0).refined(4).contours(5.0).is_empty());
        assert!(field([5, 1], |_, _| f64::NAN).contours(1.0).is_empty());
        assert_eq!(field([1, 6], |_, y| y).contours(3.2).len(), 1);
    }
}
