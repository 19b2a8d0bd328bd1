//! One axis of a grid: ascending nodes, and the cell that holds a coordinate.

/// Strictly ascending nodes, at least two.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Axis {
    nodes: Vec<f64>,
    /// Cells per radian of an evenly spaced axis.
    cells_per_rad: Option<f64>,
}

/// A cell of an axis, and a place in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CellPosition {
    /// The cell between nodes `cell` and `cell + 1`.
    pub(super) cell: usize,
    /// 0 at the first node of the cell, 1 at the second.
    pub(super) fraction: f64,
}

impl Axis {
    pub(super) fn new(nodes: Vec<f64>) -> Self {
        let cells = (nodes.len() - 1) as f64;
        let (first, last) = (nodes[0], nodes[nodes.len() - 1]);
        let step = (last - first) / cells;
        let even = nodes
            .iter()
            .enumerate()
            .all(|(index, &node)| (node - (first + step * index as f64)).abs() < 1e-6 * step);
        Self { nodes, cells_per_rad: even.then_some(step.recip()) }
    }

    pub(super) fn nodes(&self) -> &[f64] {
        &self.nodes
    }

    pub(super) fn first(&self) -> f64 {
        self.nodes[0]
    }

    pub(super) fn last(&self) -> f64 {
        self.nodes[self.nodes.len() - 1]
    }

    /// The place of `x`, clamped to the axis.
    pub(super) fn place(&self, x: f64) -> CellPosition {
        let x = x.clamp(self.first(), self.last());
        let last_cell = self.nodes.len() - 2;
        let cell = match self.cells_per_rad {
            // The guess can be one cell off by rounding only.
            Some(cells_per_rad) => {
                let guess = (((x - self.first()) * cells_per_rad) as usize).min(last_cell);
                if x < self.nodes[guess] {
                    guess - 1
                } else if guess < last_cell && x >= self.nodes[guess + 1] {
                    guess + 1
                } else {
                    guess
                }
            }
            None => (self.nodes.partition_point(|&node| node <= x) - 1).min(last_cell),
        };
        let (start, end) = (self.nodes[cell], self.nodes[cell + 1]);
        CellPosition { cell, fraction: (x - start) / (end - start) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn even_and_uneven_axes_agree_on_the_cell() {
        let nodes: Vec<f64> = (0..=1800).map(|i| f64::from(i) / 1800.0 * 3.1).collect();
        let even = Axis::new(nodes.clone());
        assert!(even.cells_per_rad.is_some());
        let uneven = Axis { nodes: nodes.clone(), cells_per_rad: None };
        for &node in &nodes {
            for x in [node.next_down(), node, node.next_up()] {
                assert_eq!(even.place(x), uneven.place(x), "at {x}");
            }
        }
    }

    #[test]
    fn outside_is_clamped() {
        let axis = Axis::new(vec![0.0, 1.0, 3.0]);
        assert_eq!(axis.place(-1.0), CellPosition { cell: 0, fraction: 0.0 });
        assert_eq!(axis.place(9.0), CellPosition { cell: 1, fraction: 1.0 });
        assert_eq!(axis.place(2.0), CellPosition { cell: 1, fraction: 0.5 });
    }
}
