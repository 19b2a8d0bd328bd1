//! Triangles cut into smaller ones of the same shape, by barycentric weights.

/// Where a place lies in the cell of a cut triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct InCell {
    /// Number of the cell among those of its triangle.
    pub(super) number: usize,
    /// Barycentric weights within the cell.
    pub(super) weights: [f64; 3],
    /// By how much the triangle's second and third weight grow with those of the cell; negative
    /// where the cell is turned by half a turn.
    pub(super) step: f64,
}

/// The place with these weights in a triangle cut into `parts^2` cells. Rows run along the second
/// corner's weight; in a row, cells that stand and cells that hang take turns.
pub(super) fn cut([_, b, c]: [f64; 3], parts: u32) -> InCell {
    let scale = f64::from(parts);
    let row = ((b * scale) as u32).min(parts - 1);
    let column = ((c * scale) as u32).min(parts - 1 - row);
    let (b, c) = (b * scale - f64::from(row), c * scale - f64::from(column));
    let hangs = b + c > 1.0 && row + column + 1 < parts;
    let number = (row * (2 * parts - row) + 2 * column + u32::from(hangs)) as usize;
    if hangs {
        InCell { number, weights: inside([b + c - 1.0, 1.0 - b, 1.0 - c]), step: -1.0 / scale }
    } else {
        InCell { number, weights: inside([1.0 - b - c, b, c]), step: 1.0 / scale }
    }
}

/// The same for a triangle split at the middles of its edges: three cells at its corners, and one
/// that is turned.
pub(super) fn split(weights: [f64; 3]) -> InCell {
    match weights.iter().position(|&weight| weight > 0.5) {
        Some(corner) => {
            let mut weights = weights.map(|weight| 2.0 * weight);
            weights[corner] -= 1.0;
            InCell { number: corner, weights: inside(weights), step: 0.5 }
        }
        None => InCell { number: 3, weights: inside(weights.map(|w| 1.0 - 2.0 * w)), step: -0.5 },
    }
}

/// Rounding leaves weights a little outside of their cell.
fn inside(weights: [f64; 3]) -> [f64; 3] {
    let weights = weights.map(|weight| weight.max(0.0));
    let sum: f64 = weights.iter().sum();
    weights.map(|weight| weight / sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Weights in the triangle of the centre of each cell, by the corners of all cells.
    fn centres(parts: u32) -> Vec<[f64; 3]> {
        let n = f64::from(parts);
        let mut centres = Vec::new();
        for row in 0..parts {
            for column in 0..parts - row {
                let mut add = |d: f64| {
                    let (b, c) = ((f64::from(row) + d) / n, (f64::from(column) + d) / n);
                    centres.push([1.0 - b - c, b, c]);
                };
                add(1.0 / 3.0);
                if row + column + 1 < parts {
                    add(2.0 / 3.0);
                }
            }
        }
        centres
    }

    /// Every cell's centre belongs to it alone: numbers come once each, in order.
    #[test]
    fn cells_are_numbered_once_each() {
        for parts in [1, 2, 3, 7, 64] {
            let cells = centres(parts).into_iter().map(|centre| cut(centre, parts));
            for (number, cell) in cells.enumerate() {
                assert_eq!(number, cell.number, "{parts} parts");
                assert!(cell.weights.iter().all(|w| (w - 1.0 / 3.0).abs() < 1e-12), "{cell:?}");
            }
        }
        let mut children: Vec<usize> = centres(2).into_iter().map(|c| split(c).number).collect();
        children.sort_unstable();
        assert_eq!(children, [0, 1, 2, 3]);
    }

    #[test]
    fn borders_stay_inside() {
        for weights in [[1., 0., 0.], [0., 1., 0.], [0., 0., 1.], [0., 0.5, 0.5], [0., 0.4, 0.6]] {
            for cell in [cut(weights, 5), split(weights)] {
                assert!(cell.number < 25 && cell.weights.iter().all(|w| (0.0..=1.0).contains(w)));
            }
        }
    }

    /// The weights in the triangle move by `step` times those in the cell.
    #[test]
    fn steps_lead_back() {
        for parts in [1, 3, 8] {
            for centre in centres(3 * parts) {
                for cell in [cut(centre, parts), split(centre)] {
                    let shift = 1e-3;
                    let moved = [0, 1, 2].map(|i| {
                        let along = [-2.0, 1.0, 1.0][i];
                        centre[i] + shift * cell.step * along
                    });
                    let other = if cell.step.abs() == 0.5 && parts != 2 {
                        split(moved)
                    } else {
                        cut(moved, parts)
                    };
                    assert_eq!(other.number, cell.number);
                    for i in 1..3 {
                        assert!((other.weights[i] - cell.weights[i] - shift).abs() < 1e-12);
                    }
                }
            }
        }
    }
}
