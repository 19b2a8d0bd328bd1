//! The corners of a polygon in square cells of its plane, to find those in a triangle.

use glam::{DVec2, DVec3};

/// Most cells along an edge.
const MAX_CELLS: usize = 1 << 10;

/// A box is wider than its triangle by this share of the polygon's size: it has to hold every
/// corner that rounding may put into the triangle.
const SLACK: f64 = 1e-9;

/// Corners by place; cells keep room for those that they have lost.
pub(super) struct CornerGrid {
    /// Directions of the edges, square to the normal.
    axes: [DVec3; 2],
    low: DVec2,
    size: DVec2,
    cells: usize,
    /// Where each cell begins in `corners`, and how many it has left.
    start: Vec<usize>,
    len: Vec<usize>,
    corners: Vec<usize>,
    /// The cell of each corner.
    cell_of: Vec<usize>,
}

impl CornerGrid {
    /// About one corner a cell.
    pub(super) fn new(corners: &[DVec3], normal: DVec3) -> Self {
        let across = normal.try_normalize().unwrap_or(DVec3::Z).any_orthonormal_vector();
        let along = normal.cross(across).try_normalize().unwrap_or(DVec3::Y);
        let axes = [across, along];
        let places: Vec<DVec2> = corners.iter().map(|&corner| flat(axes, corner)).collect();
        let first = places.first().copied().unwrap_or_default();
        let low = places.iter().fold(first, |low, &place| low.min(place));
        let high = places.iter().fold(first, |high, &place| high.max(place));
        let cells = corners.len().isqrt().clamp(1, MAX_CELLS);
        let mut grid = Self {
            axes,
            low,
            size: high - low,
            cells,
            start: vec![0; cells * cells],
            len: vec![0; cells * cells],
            corners: vec![0; corners.len()],
            cell_of: Vec::new(),
        };
        grid.cell_of = places.iter().map(|&place| grid.cell(place)).collect();
        grid.cell_of.iter().for_each(|&cell| grid.len[cell] += 1);
        for cell in 1..grid.start.len() {
            grid.start[cell] = grid.start[cell - 1] + grid.len[cell - 1];
        }
        grid.len.fill(0);
        for (corner, &cell) in grid.cell_of.iter().enumerate() {
            grid.corners[grid.start[cell] + grid.len[cell]] = corner;
            grid.len[cell] += 1;
        }
        grid
    }

    /// Takes a corner out.
    pub(super) fn remove(&mut self, corner: usize) {
        let cell = self.cell_of[corner];
        let held = &mut self.corners[self.start[cell]..][..self.len[cell]];
        if let Some(at) = held.iter().position(|&other| other == corner) {
            held.swap(at, held.len() - 1);
            self.len[cell] -= 1;
        }
    }

    /// Whether `is_inside` holds for a corner in the cells around a triangle. Counts cells and
    /// corners down from `tests_left`; `None` where that is used up.
    pub(super) fn any_near(
        &self,
        triangle: [DVec3; 3],
        is_inside: impl Fn(usize) -> bool,
        tests_left: &mut u64,
    ) -> Option<bool> {
        let [a, b, c] = triangle.map(|corner| flat(self.axes, corner));
        let slack = DVec2::splat(SLACK * self.size.max_element());
        let [low, high] = [a.min(b).min(c) - slack, a.max(b).max(c) + slack];
        let [from, to] = [low, high].map(|place| self.cell(place));
        let columns = from % self.cells..=to % self.cells;
        for row in from / self.cells..=to / self.cells {
            for column in columns.clone() {
                let cell = row * self.cells + column;
                let held = &self.corners[self.start[cell]..][..self.len[cell]];
                *tests_left = tests_left.checked_sub(1 + held.len() as u64)?;
                if held.iter().any(|&corner| is_inside(corner)) {
                    return Some(true);
                }
            }
        }
        Some(false)
    }

    /// The cell of a place; those outside belong to the nearest. What is not a number is 0.
    fn cell(&self, place: DVec2) -> usize {
        let at = (place - self.low) / self.size * self.cells as f64;
        let [column, row] = at.to_array().map(|at| (at as usize).min(self.cells - 1));
        row * self.cells + column
    }
}

/// A place in the plane.
fn flat([across, along]: [DVec3; 2], place: DVec3) -> DVec2 {
    DVec2::new(place.dot(across), place.dot(along))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_removed_is_not_found() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::ONE, DVec3::Y, DVec3::splat(0.4)];
        let mut grid = CornerGrid::new(&corners, DVec3::Z);
        let triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let tests = &mut 1000;
        assert_eq!(grid.any_near(triangle, |corner| corner == 4, tests), Some(true));
        grid.remove(4);
        assert_eq!(grid.any_near(triangle, |corner| corner == 4, tests), Some(false));
        assert_eq!(grid.any_near(triangle, |corner| corner == 0, tests), Some(true));
        assert_eq!(grid.any_near(triangle, |_| false, &mut 1), None);
    }

    /// Places that are no numbers have a cell too.
    #[test]
    fn numbers_beyond_all_others_are_held() {
        let huge = DVec3::splat(f64::MAX);
        let mut grid = CornerGrid::new(&[huge, -huge, DVec3::ZERO], DVec3::ONE * f64::MAX);
        grid.remove(0);
        assert_eq!(grid.any_near([huge, -huge, DVec3::ZERO], |_| true, &mut 1000), Some(true));
    }
}
