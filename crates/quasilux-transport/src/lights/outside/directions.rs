//! Directions drawn by a table over the sphere.
//!
//! Cells are even in height and azimuth, so all have one solid angle; the horizon is an edge of
//! cells, for there the sky jumps to the ground. A cell is chosen by the mean of a function over
//! it, a direction evenly in it. What is drawn is to be weighed by the very function over the
//! density, so the table costs no more than noise where the function changes within a cell.

use glam::DVec3;
use quasilux_sampling::Discrete;
use std::f64::consts::{PI, TAU};

/// Cells in height over the whole sphere, an even number, and around.
const ROWS: usize = 96;
const COLUMNS: usize = 96;
/// Places along each axis of a cell at which the function is asked.
const LOOKS: usize = 2;
/// The part of the mean over all cells that each has beside its own: views may miss something.
const EVERYWHERE: f64 = 0.01;

/// The solid angle of a cell in sr.
const CELL_SR: f64 = 4.0 * PI / (ROWS * COLUMNS) as f64;

/// A density over directions.
pub(super) struct DirectionTable {
    rows: Discrete,
    /// Of each row.
    columns: Vec<Discrete>,
    /// The integral of the function over the sphere.
    integral: f64,
}

/// A row or column, and how far in it.
#[derive(Clone, Copy, Debug)]
struct PlaceInCells {
    cell: usize,
    #[cfg_attr(not(test), expect(dead_code, reason = "what inverts a sample needs it"))]
    within: f64,
}

/// A direction with its density.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DrawnDirection {
    /// Unit vector.
    pub(crate) direction: DVec3,
    /// In sr^-1.
    pub(crate) pdf_sr: f64,
}

impl DirectionTable {
    /// The density about in proportion to a function that is nowhere negative; `None` where it is
    /// found to be 0.
    pub(super) fn new(function: impl Fn(DVec3) -> f64) -> Option<Self> {
        let look = |number: usize| (number as f64 + 0.5) / LOOKS as f64;
        let mean = |row: usize, column: usize| {
            let views = (0..LOOKS * LOOKS).map(|number| {
                let (down, along) = (look(number / LOOKS), look(number % LOOKS));
                function(direction_in(row as f64 + down, column as f64 + along))
            });
            views.sum::<f64>() / (LOOKS * LOOKS) as f64
        };
        let cells: Vec<f64> =
            (0..ROWS * COLUMNS).map(|cell| mean(cell / COLUMNS, cell % COLUMNS)).collect();
        let sum: f64 = cells.iter().sum();
        let each = EVERYWHERE * sum / cells.len() as f64;
        let raised: Vec<f64> = cells.iter().map(|cell| cell + each).collect();
        let rows: Vec<f64> = raised.chunks(COLUMNS).map(|row| row.iter().sum()).collect();
        let columns = raised.chunks(COLUMNS).map(Discrete::new).collect::<Option<_>>()?;
        Some(Self { rows: Discrete::new(&rows)?, columns, integral: sum * CELL_SR })
    }

    /// The integral of the function over the sphere, as the table has it.
    pub(super) fn integral(&self) -> f64 {
        self.integral
    }

    /// A direction by two coordinates.
    pub(super) fn sample_direction(&self, u: [f64; 2]) -> DrawnDirection {
        let row = self.rows.sample(u[0]);
        let column = self.columns[row.index].sample(u[1]);
        let direction = direction_in(
            row.index as f64 + row.u_remapped,
            column.index as f64 + column.u_remapped,
        );
        DrawnDirection { direction, pdf_sr: row.pdf * column.pdf / CELL_SR }
    }

    /// Density in sr^-1 of [`Self::sample_direction`].
    pub(super) fn pdf_direction_sr(&self, direction: DVec3) -> f64 {
        let [row, column] = place_of(direction).map(|place| place.cell);
        self.rows.pdf(row) * self.columns[row].pdf(column) / CELL_SR
    }

    /// The directions in the middle of all cells.
    pub(super) fn middles() -> impl Iterator<Item = DVec3> {
        (0..ROWS * COLUMNS)
            .map(|cell| direction_in((cell / COLUMNS) as f64 + 0.5, (cell % COLUMNS) as f64 + 0.5))
    }
}

/// Where in the grid of cells a direction is.
fn place_of(direction: DVec3) -> [PlaceInCells; 2] {
    let row = (direction.z + 1.0) / 2.0 * ROWS as f64;
    let turn = libm::atan2(direction.y, direction.x) / TAU;
    let column = (turn - turn.floor()) * COLUMNS as f64;
    [(row, ROWS), (column, COLUMNS)].map(|(place, count)| {
        let cell = (place as usize).min(count - 1);
        PlaceInCells { cell, within: place - cell as f64 }
    })
}

/// The direction at a place in the grid of cells, counted from straight down.
fn direction_in(row: f64, column: f64) -> DVec3 {
    let z = 2.0 * row / ROWS as f64 - 1.0;
    let (sin, cos) = libm::sincos(TAU * column / COLUMNS as f64);
    let level = ((1.0 - z) * (1.0 + z)).max(0.0).sqrt();
    DVec3::new(level * cos, level * sin, z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasilux_sampling::radical_inverse;
    use quasilux_stats::{CellCount, chi_square_test, sphere_jacobian};

    impl DirectionTable {
        /// The coordinates that a direction is drawn with.
        fn invert_direction(&self, direction: DVec3) -> [f64; 2] {
            let [row, column] = place_of(direction);
            [
                self.rows.invert(row.cell, row.within),
                self.columns[row.cell].invert(column.cell, column.within),
            ]
        }
    }

    /// A bright spot over a dim sky, and a ground.
    fn function(direction: DVec3) -> f64 {
        let spot = DVec3::new(0.48, 0.6, 0.64);
        if direction.z < 0.0 {
            return 0.3;
        }
        1.0 + 30.0 * libm::exp(20.0 * (spot.dot(direction) - 1.0))
    }

    fn coordinates(index: u64) -> [f64; 2] {
        [2, 3].map(|base| radical_inverse(base, index + 1))
    }

    /// `pdf * |det J| = 1` and both ways between coordinates and directions, at 500 places; an
    /// error of 1e-5 is found.
    #[test]
    fn density_is_one_over_the_jacobian() {
        let table = DirectionTable::new(function).unwrap();
        for index in 0..500 {
            let u = coordinates(index);
            let DrawnDirection { direction, pdf_sr } = table.sample_direction(u);
            assert!((table.pdf_direction_sr(direction) / pdf_sr - 1.0).abs() < 1e-9);
            let back = table.invert_direction(direction);
            assert!((back[0] - u[0]).abs() + (back[1] - u[1]).abs() < 1e-9, "{u:?}, not {back:?}");
            let step = 1e-7;
            let sample = |u| table.sample_direction(u).direction.to_array();
            let one_cell =
                |u: [f64; 2]| place_of(table.sample_direction(u).direction).map(|at| at.cell);
            let corners = [[step, step], [-step, -step], [step, -step], [-step, step]];
            let moved = corners.map(|by| [u[0] + by[0], u[1] + by[1]]);
            if moved.iter().all(|other| one_cell(*other) == one_cell(u)) {
                let product = pdf_sr * sphere_jacobian(sample, u, step);
                assert!((product - 1.0).abs() < 1e-5, "{u:?}: {product}");
            }
        }
    }

    /// 2^20 pseudo-random directions in 12 by 12 boxes against the integral of the density, at a
    /// significance of 1e-4; a density that is 2 % wrong in half of them is rejected.
    #[test]
    fn directions_follow_the_density() {
        const BOXES: usize = 12;
        const SAMPLES: usize = 1 << 20;
        let table = DirectionTable::new(function).unwrap();
        let mut state = 1_u64;
        let mut number = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_889);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut observed = vec![0_u64; BOXES * BOXES];
        for _ in 0..SAMPLES {
            let u = [number(), number()];
            let [row, column] = place_of(table.sample_direction(u).direction).map(|at| at.cell);
            observed[row * BOXES / ROWS * BOXES + column * BOXES / COLUMNS] += 1;
        }
        let mut expected = vec![0.0; BOXES * BOXES];
        for cell in 0..ROWS * COLUMNS {
            let (row, column) = (cell / COLUMNS, cell % COLUMNS);
            let middle = direction_in(row as f64 + 0.5, column as f64 + 0.5);
            expected[row * BOXES / ROWS * BOXES + column * BOXES / COLUMNS] +=
                table.pdf_direction_sr(middle) * CELL_SR * SAMPLES as f64;
        }
        let test = |wrong: f64| {
            let counts = observed.iter().zip(&expected).enumerate();
            let cells = counts.map(|(number, (observed, expected))| {
                let factor = if number % 2 == 0 { 1.0 + wrong } else { 1.0 - wrong };
                CellCount { observed: *observed, expected: expected * factor }
            });
            chi_square_test(&cells.collect::<Vec<CellCount>>())
        };
        assert!(test(0.0) > 1e-4, "{}", test(0.0));
        assert!(test(0.02) < 1e-4, "{}", test(0.02));
    }

    /// The integral of the function, against that of its closed form: a tenth of a percent off is
    /// found. Where nothing shines there is nothing to draw.
    #[test]
    fn the_integral_is_that_of_the_function() {
        let flat =
            DirectionTable::new(|direction| if direction.z < 0.0 { 0.0 } else { direction.z });
        assert!((flat.unwrap().integral() / PI - 1.0).abs() < 1e-3);
        assert!(DirectionTable::new(|_| 0.0).is_none());
    }
}
