//! A non-negative function on the sphere: bilinear on a grid of spherical angles.
//!
//! In the frame of the table theta is measured from +z and phi from +x towards +y. Inside a cell
//! the value is bilinear in (theta, phi), both in radians; outside the polar range of the grid, and
//! outside the azimuths of a sector, it is zero. The integral over solid angle and the inverse
//! transform are exact: see [`SphericalTable::sample`].

mod angle_lookup;
mod axis;
mod band;
mod grid;
mod linear;
mod measured_grid;
#[cfg(test)]
mod per_cell;
mod sample;

use angle_lookup::AngleLookup;
use axis::{Axis, CellPosition};
use band::Band;
use glam::DVec3;
pub use grid::{Grid, Symmetry, TableError};
pub use sample::DirectionSample;
use std::f64::consts::TAU;

/// A bilinear function on a spherical grid, with its exact integral and inverse transform.
///
/// Symmetries are unfolded on construction: the stored grid closes around the azimuth, or is a
/// sector.
#[derive(Clone, Debug)]
pub struct SphericalTable {
    symmetry: Symmetry,
    theta: Axis,
    /// Offsets from `phi_start_rad`, from 0 to a full turn or to the end of a sector.
    phi: Axis,
    phi_start_rad: f64,
    theta_lookup: AngleLookup,
    phi_lookup: AngleLookup,
    /// Cosine and sine of `phi_start_rad`.
    phi_start: [f64; 2],
    /// Row by row, one row for each polar angle.
    values: Vec<f64>,
    /// The integral of each row over the azimuth, up to each node.
    row_integrals: Vec<f64>,
    bands: Vec<Band>,
    /// The integral over solid angle of all bands before each one, and of all of them.
    integral_before: Vec<f64>,
}

/// The greatest value of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Maximum {
    /// The value.
    pub value: f64,
    /// Where it is.
    pub angles: Angles,
}

/// Spherical angles of a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Angles {
    /// From the pole +z, in [0, pi].
    pub theta_rad: f64,
    /// From +x towards +y, in (-pi, pi].
    pub phi_rad: f64,
}

impl Angles {
    /// The angles of a direction of any length; accurate at both poles.
    pub fn from_direction(direction: DVec3) -> Self {
        let horizontal = (direction.x * direction.x + direction.y * direction.y).sqrt();
        Self {
            theta_rad: libm::atan2(horizontal, direction.z),
            phi_rad: libm::atan2(direction.y, direction.x),
        }
    }

    /// The unit direction.
    pub fn direction(self) -> DVec3 {
        let (sin_theta, cos_theta) = libm::sincos(self.theta_rad);
        let (sin_phi, cos_phi) = libm::sincos(self.phi_rad);
        DVec3::new(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta)
    }
}

impl SphericalTable {
    /// A table from a grid as measured: see [`Symmetry`] for what the azimuths mean.
    ///
    /// # Errors
    /// [`TableError`] for a grid with fewer than two polar angles, angles that do not ascend,
    /// azimuths that do not fit the symmetry, or values that are not finite.
    pub fn new(grid: Grid) -> Result<Self, TableError> {
        let symmetry = grid.symmetry;
        let full = grid.without_symmetry()?;
        let (theta, phi) = (Axis::new(full.theta_rad), Axis::new(full.phi_rad));
        let columns = phi.nodes().len();

        let mut row_integrals = Vec::with_capacity(full.values.len());
        for row in full.values.chunks_exact(columns) {
            let mut sum = 0.0;
            row_integrals.push(sum);
            for (pair, nodes) in row.windows(2).zip(phi.nodes().windows(2)) {
                sum += 0.5 * (pair[0] + pair[1]) * (nodes[1] - nodes[0]);
                row_integrals.push(sum);
            }
        }

        let row_total = |row: usize| row_integrals[row * columns + columns - 1];
        let bands: Vec<Band> = theta
            .nodes()
            .windows(2)
            .enumerate()
            .map(|(row, ends)| Band::new(ends[0], ends[1], row_total(row), row_total(row + 1)))
            .collect();
        let mut integral_before = vec![0.0];
        for band in &bands {
            integral_before.push(integral_before[integral_before.len() - 1] + band.integral());
        }

        Ok(Self {
            symmetry,
            theta_lookup: AngleLookup::new(&theta),
            phi_lookup: AngleLookup::new(&phi),
            phi_start: [libm::cos(full.phi_start_rad), libm::sin(full.phi_start_rad)],
            theta,
            phi,
            phi_start_rad: full.phi_start_rad,
            values: full.values,
            row_integrals,
            bands,
            integral_before,
        })
    }

    /// The value towards a unit direction; the azimuth of the poles is 0.
    ///
    /// The same as [`Self::value_at`] of [`Angles::from_direction`] but for the rounding of the
    /// angles, which is no larger here, and sooner found.
    pub fn value(&self, direction: DVec3) -> f64 {
        let DVec3 { x, y, z } = direction;
        let horizontal = (x * x + y * y).sqrt();
        let Some(row) = self.theta_lookup.place(z, horizontal, 1.0) else { return 0.0 };
        let (x, y, horizontal) =
            if horizontal > 0.0 { (x, y, horizontal) } else { (1.0, 0.0, 1.0) };
        let [cos, sin] = self.phi_start;
        let column = self.phi_lookup.place(cos * x + sin * y, cos * y - sin * x, horizontal);
        column.map_or(0.0, |column| self.value_in(row, column))
    }

    /// The value at spherical angles; the azimuth may be any number of turns off.
    pub fn value_at(&self, angles: Angles) -> f64 {
        if !(self.theta.first()..=self.theta.last()).contains(&angles.theta_rad) {
            return 0.0;
        }
        let offset = self.phi_offset(angles.phi_rad);
        if offset > self.phi.last() {
            return 0.0;
        }
        self.value_in(self.theta.place(angles.theta_rad), self.phi.place(offset))
    }

    /// Integral of the value over solid angle.
    pub fn integral(&self) -> f64 {
        self.integral_before[self.bands.len()]
    }

    /// Integral of the value over the solid angle between the pole +z and the parallel `theta_rad`.
    pub fn integral_below(&self, theta_rad: f64) -> f64 {
        let theta_rad = theta_rad.clamp(self.theta.first(), self.theta.last());
        let cell = self.theta.place(theta_rad).cell;
        let band = &self.bands[cell];
        self.integral_before[cell]
            + band.integral() * band.fraction_below(theta_rad).clamp(0.0, 1.0)
    }

    /// The greatest value: a bilinear function has it at a node. Of several the first in the order
    /// of the polar angle, then of the azimuth from the first plane on.
    pub fn maximum(&self) -> Maximum {
        let columns = self.phi.nodes().len();
        let mut max_index = 0;
        for (index, value) in self.values.iter().enumerate() {
            if *value > self.values[max_index] {
                max_index = index;
            }
        }
        let theta_rad = self.theta.nodes()[max_index / columns];
        let phi_rad = self.phi_start_rad + self.phi.nodes()[max_index % columns];
        Maximum { value: self.values[max_index], angles: Angles { theta_rad, phi_rad } }
    }

    /// The symmetry that the table was measured with.
    pub fn symmetry(&self) -> Symmetry {
        self.symmetry
    }

    /// The polar angles of the grid, ascending.
    pub fn theta_rad(&self) -> &[f64] {
        self.theta.nodes()
    }

    /// The azimuths of the unfolded grid, ascending over one full turn or over the sector.
    pub fn phi_rad(&self) -> impl Iterator<Item = f64> {
        self.phi.nodes().iter().map(|offset| self.phi_start_rad + offset)
    }

    fn value_in(&self, row: CellPosition, column: CellPosition) -> f64 {
        let (at_start, at_end) = self.cell_edges(row, column.cell);
        lerp(at_start, at_end, column.fraction)
    }

    /// The values at both azimuths of a cell, at a place between two parallels.
    fn cell_edges(&self, row: CellPosition, column: usize) -> (f64, f64) {
        let columns = self.phi.nodes().len();
        let above = row.cell * columns + column;
        let below = above + columns;
        (
            lerp(self.values[above], self.values[below], row.fraction),
            lerp(self.values[above + 1], self.values[below + 1], row.fraction),
        )
    }

    /// The azimuth as an offset from the first node, in [0, one turn].
    fn phi_offset(&self, phi_rad: f64) -> f64 {
        let offset = phi_rad - self.phi_start_rad;
        if (0.0..=TAU).contains(&offset) {
            offset
        } else {
            (offset - (offset / TAU).floor() * TAU).clamp(0.0, TAU)
        }
    }
}

/// Exact at both ends, and monotone in `a` and `b`.
fn lerp(a: f64, b: f64, t: f64) -> f64 {
    (1.0 - t) * a + t * b
}
