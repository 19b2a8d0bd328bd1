//! Subdivision of a triangle into similar triangles, in barycentric coordinates: `n^2` equal cells
//! along a grid parallel to its edges, or four between its corners and the middles of its edges.

/// A triangle similar to another one, turned by half a turn or not, in that one's barycentric
/// coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SubTriangle {
    /// Second and third weight of its first corner.
    origin: [f64; 2],
    /// Distance of the other corners from the first, each along one weight; negative where it is
    /// turned.
    step: f64,
}

impl SubTriangle {
    /// The triangle itself.
    pub(crate) const WHOLE: Self = Self { origin: [0.0; 2], step: 1.0 };

    /// Barycentric coordinates in the large triangle of the point with these in the small one.
    pub(crate) fn point(self, [_, b, c]: [f64; 3]) -> [f64; 3] {
        let [b, c] = [self.origin[0] + self.step * b, self.origin[1] + self.step * c];
        [(1.0 - b - c).max(0.0), b, c]
    }

    /// The cells at its three corners, then the turned one between the middles of its edges.
    pub(crate) fn quarters(self) -> [Self; 4] {
        let ([b, c], step) = (self.origin, 0.5 * self.step);
        let upright = |b: f64, c: f64| Self { origin: [b, c], step };
        let turned = Self { origin: [b + step, c + step], step: -step };
        [upright(b, c), upright(b + step, c), upright(b, c + step), turned]
    }

    /// Values at the corners of the four [`Self::quarters`], from those at the corners of the
    /// triangle and at the middles of the edges opposite to them.
    pub(crate) fn quarter_corners<T: Copy>(corners: [T; 3], middles: [T; 3]) -> [[T; 3]; 4] {
        let ([a, b, c], [bc, ca, ab]) = (corners, middles);
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [bc, ca, ab]]
    }

    /// Its share of the large triangle's area.
    pub(crate) fn area_share(self) -> f64 {
        self.step * self.step
    }
}

/// A point in one cell of a subdivided triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct InCell {
    /// Number of the cell in its triangle.
    pub(crate) number: usize,
    /// Barycentric coordinates in the cell.
    pub(crate) weights: [f64; 3],
    /// Derivative of the triangle's second and third weight by those of the cell; negative where
    /// the cell is turned by half a turn.
    pub(crate) step: f64,
}

/// Finds a point in a triangle cut into `parts^2` cells. Rows run along the second corner's weight;
/// in a row, upright and turned cells alternate.
pub(crate) fn locate_in_grid([_, b, c]: [f64; 3], parts: u32) -> InCell {
    let scale = f64::from(parts);
    let row = ((b * scale) as u32).min(parts - 1);
    let column = ((c * scale) as u32).min(parts - 1 - row);
    let (b, c) = (b * scale - f64::from(row), c * scale - f64::from(column));
    let is_turned = b + c > 1.0 && row + column + 1 < parts;
    let number = (row * (2 * parts - row) + 2 * column + u32::from(is_turned)) as usize;
    if is_turned {
        InCell { number, weights: inside([b + c - 1.0, 1.0 - b, 1.0 - c]), step: -1.0 / scale }
    } else {
        InCell { number, weights: inside([1.0 - b - c, b, c]), step: 1.0 / scale }
    }
}

/// Finds a point in one of the four [`SubTriangle::quarters`].
pub(crate) fn locate_in_quarters(weights: [f64; 3]) -> InCell {
    match weights.iter().position(|&weight| weight > 0.5) {
        Some(corner) => {
            let mut weights = weights.map(|weight| 2.0 * weight);
            weights[corner] -= 1.0;
            InCell { number: corner, weights: inside(weights), step: 0.5 }
        }
        None => InCell { number: 3, weights: inside(weights.map(|w| 1.0 - 2.0 * w)), step: -0.5 },
    }
}

/// Barycentric coordinates of the centroids of `parts^2` cells, in the order of
/// [`locate_in_grid`].
pub(crate) fn grid_centroids(parts: u32) -> impl Iterator<Item = [f64; 3]> {
    let n = f64::from(parts);
    let columns = move |row: u32| (0..parts - row).map(move |column| (row, column));
    (0..parts).flat_map(columns).flat_map(move |(row, column)| {
        let has_turned = row + column + 1 < parts;
        let thirds = [Some(1.0 / 3.0), has_turned.then_some(2.0 / 3.0)];
        thirds.into_iter().flatten().map(move |d| {
            let (b, c) = ((f64::from(row) + d) / n, (f64::from(column) + d) / n);
            [1.0 - b - c, b, c]
        })
    })
}

/// Clamps weights that rounding left a little outside of their cell.
fn inside(weights: [f64; 3]) -> [f64; 3] {
    let weights = weights.map(|weight| weight.max(0.0));
    let sum: f64 = weights.iter().sum();
    weights.map(|weight| weight / sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every cell's centre belongs to it alone: numbers come once each, in order.
    #[test]
    fn cells_are_numbered_once_each() {
        for parts in [1, 2, 3, 7, 64] {
            let cells = grid_centroids(parts).map(|centre| locate_in_grid(centre, parts));
            for (number, cell) in cells.enumerate() {
                assert_eq!(number, cell.number, "{parts} parts");
                assert!(cell.weights.iter().all(|w| (w - 1.0 / 3.0).abs() < 1e-12), "{cell:?}");
            }
        }
        let mut children: Vec<usize> =
            grid_centroids(2).map(|c| locate_in_quarters(c).number).collect();
        children.sort_unstable();
        assert_eq!(children, [0, 1, 2, 3]);
    }

    #[test]
    fn borders_stay_inside() {
        for weights in [[1., 0., 0.], [0., 1., 0.], [0., 0., 1.], [0., 0.5, 0.5], [0., 0.4, 0.6]] {
            for cell in [locate_in_grid(weights, 5), locate_in_quarters(weights)] {
                assert!(cell.number < 25 && cell.weights.iter().all(|w| (0.0..=1.0).contains(w)));
            }
        }
    }

    /// The weights in the triangle move by `step` times those in the cell.
    #[test]
    fn steps_lead_back() {
        for parts in [1, 3, 8] {
            for centre in grid_centroids(3 * parts) {
                for cell in [locate_in_grid(centre, parts), locate_in_quarters(centre)] {
                    let shift = 1e-3;
                    let moved = [0, 1, 2].map(|i| {
                        let along = [-2.0, 1.0, 1.0][i];
                        centre[i] + shift * cell.step * along
                    });
                    let other = if cell.step.abs() == 0.5 && parts != 2 {
                        locate_in_quarters(moved)
                    } else {
                        locate_in_grid(moved, parts)
                    };
                    assert_eq!(other.number, cell.number);
                    for i in 1..3 {
                        assert!((other.weights[i] - cell.weights[i] - shift).abs() < 1e-12);
                    }
                }
            }
        }
    }

    const CORNERS: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    /// The corners of quarters are those that [`SubTriangle::quarter_corners`] hands on, exactly,
    /// four levels deep.
    #[test]
    fn quarters_have_the_corners_they_are_given() {
        let mut cells = vec![(SubTriangle::WHOLE, CORNERS)];
        for _ in 0..4 {
            cells = cells
                .into_iter()
                .flat_map(|(cell, corners)| {
                    let middle = |i: usize, j: usize| {
                        std::array::from_fn(|k| 0.5 * (corners[i][k] + corners[j][k]))
                    };
                    let middles = [middle(1, 2), middle(2, 0), middle(0, 1)];
                    cell.quarters().into_iter().zip(SubTriangle::quarter_corners(corners, middles))
                })
                .collect();
        }
        assert!(cells.iter().all(|(cell, corners)| CORNERS.map(|c| cell.point(c)) == *corners));
        let area: f64 = cells.iter().map(|(cell, _)| cell.area_share()).sum();
        assert_eq!(area, 1.0);
    }

    /// Points are found in the quarter that they were placed in.
    #[test]
    fn quarters_are_found_by_their_points() {
        for (number, quarter) in SubTriangle::WHOLE.quarters().into_iter().enumerate() {
            for weights in grid_centroids(4) {
                let found = locate_in_quarters(quarter.point(weights));
                assert_eq!((found.number, found.step), (number, quarter.step));
                assert!((0..3).all(|i| (found.weights[i] - weights[i]).abs() < 1e-12));
            }
        }
    }

    #[test]
    fn centroids_are_those_of_equal_parts() {
        for parts in [1, 2, 5, 16] {
            let all: Vec<[f64; 3]> = grid_centroids(parts).collect();
            assert_eq!(all.len(), (parts * parts) as usize);
            for corner in 0..3 {
                let mean =
                    all.iter().map(|weights| weights[corner]).sum::<f64>() / all.len() as f64;
                assert!((mean - 1.0 / 3.0).abs() < 1e-12, "{parts}: {mean}");
            }
        }
    }
}
