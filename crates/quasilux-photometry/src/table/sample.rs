//! The inverse transform of a spherical table, in its continuous form.
//!
//! Voloboy, Dmitriev and Kopylov (2003) choose a cell by its flux and invert inside it.
//! Deviation: theta comes from the marginal of the *whole band* and phi from the piecewise linear
//! conditional at that theta. The density is the same, and the map from the unit square to
//! directions is continuous, where the per-cell form jumps at each azimuth of the grid.

use super::band::inside;
use super::linear::{linear_fraction, linear_quantile};
use super::{Angles, CellPosition, SphericalTable, lerp};
use glam::DVec3;
use std::f64::consts::TAU;

/// A direction drawn from a distribution over solid angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionSample {
    /// Unit direction.
    pub direction: DVec3,
    /// Density with respect to solid angle, in sr^-1. Positive.
    pub pdf_sr: f64,
}

impl SphericalTable {
    /// Solid angle, sr^-1: a direction with density `value / integral`, or `None` where the
    /// integral is zero.
    ///
    /// `u` is in [0, 1]^2: `u[0]` picks the polar angle, `u[1]` the azimuth at that polar angle. No
    /// rejection; continuous in `u` wherever the table is positive.
    pub fn sample(&self, u: [f64; 2]) -> Option<DirectionSample> {
        let direction = self.sample_direction(u)?;
        Some(DirectionSample { direction, pdf_sr: self.pdf(direction) })
    }

    /// The direction of [`Self::sample`] alone: nobody looks up its density.
    pub fn sample_direction(&self, u: [f64; 2]) -> Option<DVec3> {
        if self.integral() <= 0.0 {
            return None;
        }
        let theta_rad = self.sample_theta(u[0]);
        let row = self.theta.place(theta_rad);
        let phi_rad = self.phi_start_rad + self.sample_phi_offset(row, u[1]);
        Some(Angles { theta_rad, phi_rad }.direction())
    }

    /// Solid angle, sr^-1: the density of [`Self::sample`]; zero where the integral is zero.
    pub fn pdf(&self, direction: DVec3) -> f64 {
        let integral = self.integral();
        if integral > 0.0 { self.value(direction) / integral } else { 0.0 }
    }

    /// The coordinates that [`Self::sample`] turns into `direction`.
    ///
    /// A direction outside the polar range, or outside the sector, is first moved to its border.
    pub fn invert(&self, direction: DVec3) -> [f64; 2] {
        let angles = Angles::from_direction(direction);
        let theta_rad = angles.theta_rad.clamp(self.theta.first(), self.theta.last());
        let row = self.theta.place(theta_rad);
        let below = self.integral_below(theta_rad);
        let u0 = if self.integral() > 0.0 { below / self.integral() } else { 0.0 };
        [u0.min(1.0), self.invert_phi_offset(row, self.phi_offset(angles.phi_rad))]
    }

    fn sample_theta(&self, u: f64) -> f64 {
        let target = u * self.integral();
        let cell = step(self.bands.len(), target, |band| self.integral_before[band]);
        let band = &self.bands[cell];
        let renormalised = (target - self.integral_before[cell]) / band.integral();
        band.theta_at(renormalised.clamp(0.0, 1.0))
    }

    fn sample_phi_offset(&self, row: CellPosition, u: f64) -> f64 {
        let cells = self.phi.nodes().len() - 1;
        let below = |node| self.row_integral(row, node);
        if below(cells) <= 0.0 {
            return inside(u * self.phi.last(), 0.0, self.phi.last());
        }
        let target = u * below(cells);
        let cell = step(cells, target, below);
        let (start, end) = (self.phi.nodes()[cell], self.phi.nodes()[cell + 1]);
        let renormalised = (target - below(cell)) / (below(cell + 1) - below(cell));
        let (at_start, at_end) = self.cell_edges(row, cell);
        let t = linear_quantile(at_start, at_end, renormalised.clamp(0.0, 1.0));
        inside(lerp(start, end, t), start, end)
    }

    fn invert_phi_offset(&self, row: CellPosition, offset: f64) -> f64 {
        let last = self.phi.last();
        // Beyond a sector, the border that is nearer around the azimuth.
        let offset = match offset - last {
            beyond if beyond <= 0.0 => offset,
            beyond if beyond < TAU - offset => last,
            _ => 0.0,
        };
        let total = self.row_integral(row, self.phi.nodes().len() - 1);
        if total <= 0.0 {
            return offset / last;
        }
        let CellPosition { cell, fraction } = self.phi.place(offset);
        let (at_start, at_end) = self.cell_edges(row, cell);
        let (below, above) = (self.row_integral(row, cell), self.row_integral(row, cell + 1));
        let inside_cell = (above - below) * linear_fraction(at_start, at_end, fraction);
        ((below + inside_cell) / total).min(1.0)
    }

    /// Integral over the azimuth up to a node, at a place between two parallels.
    fn row_integral(&self, row: CellPosition, node: usize) -> f64 {
        let columns = self.phi.nodes().len();
        let above = row.cell * columns + node;
        lerp(self.row_integrals[above], self.row_integrals[above + columns], row.fraction)
    }
}

/// The step of a non-decreasing sum of `count` steps that crosses `target`: never one of height
/// zero.
///
/// `before(i)` is the sum before step i; `before(count)` is the positive total.
fn step(count: usize, target: f64, before: impl Fn(usize) -> f64) -> usize {
    // Rounding may lift the target to the total: then the last step that rises is meant.
    let first_beyond = |reached: &dyn Fn(f64) -> bool| {
        let (mut low, mut high) = (0, count);
        while low < high {
            let middle = low.midpoint(high);
            if reached(before(middle + 1)) {
                high = middle;
            } else {
                low = middle + 1;
            }
        }
        low
    };
    let beyond = first_beyond(&|sum| sum > target);
    if beyond < count { beyond } else { first_beyond(&|sum| sum >= before(count)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_of_height_zero_is_never_taken() {
        let sums = [0.0, 0.0, 1.0, 1.0, 3.0, 3.0];
        let taken: Vec<usize> =
            [0.0, 0.5, 1.0, 2.9, 3.0, 4.0].map(|target| step(5, target, |i| sums[i])).to_vec();
        assert_eq!(taken, [1, 1, 3, 3, 3, 3]);
    }
}
