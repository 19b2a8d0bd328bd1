//! The grid as it was measured, from the table that closes around the azimuth.

use super::{Grid, SphericalTable, Symmetry};

impl SphericalTable {
    /// The grid as measured: the azimuths that the symmetry leaves, with their values.
    ///
    /// Values are those of the grid that the table was made of, bit for bit; an azimuth may differ
    /// from it by the rounding of one subtraction and one addition.
    pub fn grid(&self) -> Grid {
        let closed = self.phi.nodes().len();
        let columns = match self.symmetry {
            Symmetry::Rotational => 1,
            Symmetry::Quadrant => (closed - 1) / 4 + 1,
            Symmetry::Bilateral => (closed - 1) / 2 + 1,
            Symmetry::Open => closed - 1,
            Symmetry::None | Symmetry::Sector => closed,
        };
        self.columns(columns, self.symmetry)
    }

    /// The unfolded grid: a whole turn with its closing azimuth, whatever the symmetry; a sector as
    /// it is.
    pub fn unfolded_grid(&self) -> Grid {
        let unfolded = match self.symmetry {
            Symmetry::Sector => Symmetry::Sector,
            _ => Symmetry::None,
        };
        self.columns(self.phi.nodes().len(), unfolded)
    }

    fn columns(&self, columns: usize, symmetry: Symmetry) -> Grid {
        let rows = self.values.chunks_exact(self.phi.nodes().len());
        Grid {
            theta_rad: self.theta.nodes().to_vec(),
            phi_rad: self.phi.nodes()[..columns]
                .iter()
                .map(|offset| self.phi_start_rad + offset)
                .collect(),
            symmetry,
            values: rows.flat_map(|row| row[..columns].iter().copied()).collect(),
        }
    }
}
