//! The slow twin: the per-cell form of the paper, cells in one list, formulas as printed.
//!
//! Voloboy, Dmitriev and Kopylov (2003): with corners A1, A2 at theta1 and B1, B2 at theta2, `SA =
//! A1 + A2`, `SB = B1 + B2`, flux up to t: `dphi / (2 dtheta) [(SB - SA)(sin t - t cos t - sin t1 +
//! t1 cos t1) + (t2 SA - t1 SB)(cos t1 - cos t)]`.

use super::SphericalTable;

/// A cell of the grid with its corner values.
struct Cell {
    theta: [f64; 2],
    phi: [f64; 2],
    sums: [f64; 2],
}

impl Cell {
    fn new(table: &SphericalTable, row: usize, column: usize) -> Self {
        let columns = table.phi.nodes().len();
        let value = |row: usize, column: usize| table.values[row * columns + column];
        let sum = |row| value(row, column) + value(row, column + 1);
        Self {
            theta: [table.theta.nodes()[row], table.theta.nodes()[row + 1]],
            phi: [table.phi.nodes()[column], table.phi.nodes()[column + 1]],
            sums: [sum(row), sum(row + 1)],
        }
    }

    fn flux_below(&self, t: f64) -> f64 {
        let ([t1, t2], [sa, sb]) = (self.theta, self.sums);
        let primitive = |t: f64| libm::sin(t) - t * libm::cos(t);
        let bracket = (sb - sa) * (primitive(t) - primitive(t1))
            + (t2 * sa - t1 * sb) * (libm::cos(t1) - libm::cos(t));
        (self.phi[1] - self.phi[0]) / (2.0 * (t2 - t1)) * bracket
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Angles, Grid, Symmetry};

    /// The grid closed around the azimuth, and as a sector.
    fn coarse_tables() -> [SphericalTable; 2] {
        [Symmetry::Open, Symmetry::Sector].map(coarse_table)
    }

    fn coarse_table(symmetry: Symmetry) -> SphericalTable {
        SphericalTable::new(Grid {
            theta_rad: vec![0.0, 0.4, 1.1, 1.9, 3.0],
            phi_rad: vec![0.0, 1.0, 2.5, 4.0],
            symmetry,
            values: vec![
                3.0, 3.0, 3.0, 3.0, 5.0, 0.0, 2.0, 8.0, 1.0, 4.0, 0.0, 0.0, 0.5, 7.0, 0.0, 0.0,
                2.0, 2.0, 1.0, 3.0,
            ],
        })
        .unwrap()
    }

    /// The cells of a band.
    fn cells(table: &SphericalTable, row: usize) -> impl Iterator<Item = Cell> {
        (0..table.phi.nodes().len() - 1).map(move |column| Cell::new(table, row, column))
    }

    #[test]
    fn fluxes_of_the_cells_add_up_to_the_integral() {
        for table in coarse_tables() {
            let all = (0..4).flat_map(|row| cells(&table, row));
            let flux: f64 = all.map(|cell| cell.flux_below(cell.theta[1])).sum();
            assert!((flux - table.integral()).abs() < 1e-12 * flux, "{flux} {}", table.integral());
        }
    }

    #[test]
    fn flux_below_a_parallel_is_that_of_the_per_cell_form() {
        for table in coarse_tables() {
            for i in 1..100 {
                let theta_rad = 3.0 * f64::from(i) / 100.0;
                let row = table.theta.place(theta_rad).cell;
                let whole = (0..row).flat_map(|row| cells(&table, row));
                let flux: f64 = whole
                    .map(|cell| cell.flux_below(cell.theta[1]))
                    .chain(cells(&table, row).map(|cell| cell.flux_below(theta_rad)))
                    .sum();
                let u = table.invert(Angles { theta_rad, phi_rad: 0.3 }.direction());
                assert!((u[0] - flux / table.integral()).abs() < 1e-12, "at {theta_rad}");
            }
        }
    }
}
