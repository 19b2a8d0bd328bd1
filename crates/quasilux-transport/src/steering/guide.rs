//! Guided directions: where photons that leave a cell should go.
//!
//! From a lit wall to the far end of a corridor lead few directions, and whole photons that take them
//! carry far more than the end is due. A photon's direction is made from a point of the unit square; a
//! histogram over the square, learnt from the survey's rays and what they were worth where they landed,
//! makes such points more frequent, and weights as much less (importance sampling of the directions, as
//! in J. Vorba et al., "On-line learning of parametric mixture models for light transport simulation",
//! ACM Trans. Graph. 33(4), 2014, with piecewise constant densities).

use crate::state::Writer;

/// Bins along each edge of the square.
const EDGE: usize = 32;
/// What few rays say of near places is told to blocks of this many bins along each edge.
const BLOCK: usize = 4;
/// Share of the points that are left even, so that no weight grows more than its inverse.
const EVEN: f64 = 0.3;

/// A density over the unit square, constant in each of 32 x 32 bins.
#[derive(Clone, Debug)]
pub(crate) struct Guide {
    /// Cumulative shares of the rows.
    rows: [f32; EDGE + 1],
    /// Cumulative shares of the bins in each row.
    columns: Vec<[f32; EDGE + 1]>,
}

/// A point of the square, drawn by a guide.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Guided {
    pub(crate) u: [f64; 2],
    /// With respect to the area of the square.
    pub(crate) density: f64,
}

/// What rays through each bin of the square were worth, in all.
#[derive(Clone, Debug)]
pub(crate) struct Worths(Vec<[f64; EDGE]>);

impl Default for Worths {
    fn default() -> Self {
        Self(vec![[0.0; EDGE]; EDGE])
    }
}

impl Worths {
    /// Counts a ray through a point of the square toward a far place: it stands for few directions.
    pub(crate) fn add_far(&mut self, u: [f64; 2], worth: f64) {
        let [row, column] = u.map(bin);
        self.0[row][column] += worth;
    }

    /// Counts a ray through a point of the square toward a near place.
    pub(crate) fn add_near(&mut self, u: [f64; 2], worth: f64) {
        let [row, column] = u.map(|u| bin(u) / BLOCK * BLOCK);
        for row in &mut self.0[row..row + BLOCK] {
            row[column..column + BLOCK].iter_mut().for_each(|bin| {
                *bin += worth / (BLOCK * BLOCK) as f64;
            });
        }
    }

    /// Counts what others counted.
    pub(crate) fn merge(&mut self, other: &Self) {
        for (own, other) in self.0.iter_mut().flatten().zip(other.0.iter().flatten()) {
            *own += other;
        }
    }
}

impl Guide {
    /// Puts it among the decisions.
    pub(crate) fn put(&self, out: &mut Writer) {
        let shares = self.rows.iter().chain(self.columns.iter().flatten());
        shares.for_each(|share| out.f32(*share));
    }

    /// In proportion to the worths, but for an even share.
    pub(crate) fn new(worths: &Worths) -> Self {
        let total: f64 = worths.0.iter().flatten().sum();
        let even = if total > 0.0 { EVEN } else { 1.0 };
        let scale = if total > 0.0 { (1.0 - even) / total } else { 0.0 };
        let bin = |worth: f64| worth * scale + even / (EDGE * EDGE) as f64;
        let rows = std::array::from_fn(|row| worths.0[row].iter().map(|worth| bin(*worth)).sum());
        let columns = worths.0.iter().map(|row| cumulative(row.map(bin))).collect();
        Self { rows: cumulative(rows), columns }
    }

    /// The point that an even point of the square becomes.
    pub(crate) fn sample(&self, u: [f64; 2]) -> Guided {
        let (row, first, density) = invert(&self.rows, u[0]);
        let (_, second, in_row) = invert(&self.columns[row], u[1]);
        Guided { u: [first, second], density: density * in_row }
    }

    /// Density with respect to the area of the square.
    pub(crate) fn density(&self, u: [f64; 2]) -> f64 {
        let [row, column] = u.map(bin);
        slope(&self.rows, row) * slope(&self.columns[row], column)
    }
}

fn bin(u: f64) -> usize {
    ((u * EDGE as f64) as usize).min(EDGE - 1)
}

/// Shares of a whole, summed up from zero to one.
fn cumulative(weights: [f64; EDGE]) -> [f32; EDGE + 1] {
    let total: f64 = weights.iter().sum();
    let mut shares = [0.0; EDGE + 1];
    let mut sum = 0.0;
    for (share, weight) in shares[1..].iter_mut().zip(weights) {
        sum += weight;
        *share = (sum / total) as f32;
    }
    shares[EDGE] = 1.0;
    shares
}

/// Bin, place and density where a piecewise linear cumulative density reaches `u`.
fn invert(shares: &[f32; EDGE + 1], u: f64) -> (usize, f64, f64) {
    let bin = shares[1..EDGE].partition_point(|share| f64::from(*share) <= u);
    let density = slope(shares, bin);
    let within = (u - f64::from(shares[bin])) / density;
    (bin, (bin as f64 / EDGE as f64 + within).clamp(0.0, 1.0 - f64::EPSILON / 2.0), density)
}

fn slope(shares: &[f32; EDGE + 1], bin: usize) -> f64 {
    (f64::from(shares[bin + 1]) - f64::from(shares[bin])) * EDGE as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn guide() -> Guide {
        let mut worths = Worths::default();
        worths.add_near([0.3, 0.9], 5.0);
        worths.add_far([0.31, 0.1], 0.2);
        worths.add_far([0.99, 0.99], 1e-3);
        Guide::new(&worths)
    }

    /// The density is the inverse of the Jacobian determinant, by differences inside a bin.
    #[test]
    fn the_density_is_that_of_the_samples() {
        let (guide, step) = (guide(), 1e-7);
        for i in 0..40 {
            for j in 0..40 {
                let u = [(f64::from(i) + 0.37) / 40.0, (f64::from(j) + 0.61) / 40.0];
                let at = guide.sample(u);
                let next = guide.sample([u[0] + step, u[1] + step]);
                if at.u.map(bin) != next.u.map(bin) {
                    continue;
                }
                let jacobian = (next.u[0] - at.u[0]) * (next.u[1] - at.u[1]) / (step * step);
                assert!((jacobian * at.density - 1.0).abs() < 1e-4, "{u:?}");
                assert!((guide.density(at.u) / at.density - 1.0).abs() < 1e-12, "{u:?}");
                assert!(at.density >= 0.99 * EVEN);
            }
        }
    }

    #[test]
    fn nothing_learnt_leaves_points_where_they_are() {
        let guide = Guide::new(&Worths::default());
        for u in [[0.0, 0.0], [0.3, 0.8], [0.999_999, 0.5]] {
            let guided = guide.sample(u);
            assert!((guided.density - 1.0).abs() < 1e-6);
            assert!((0..2).all(|d| (guided.u[d] - u[d]).abs() < 1e-6));
        }
    }
}
