//! Values of a grid without what may be noise: a smooth field within their intervals.
//!
//! The field s has the least sum of `pull (s - value)^2` over cells and of squares of second
//! differences along rows and columns, so that slopes and bends remain and ripples go, and in each
//! cell |s - value| is at most the half-width. Cells are set one after another to the value that is
//! best for their neighbours (projected Gauss-Seidel; the sum is convex, so that every step lowers
//! it). The pull is the least of a few for which the field is as far from the values as they are
//! from the truth, a standard error in the root mean square (Morozov's discrepancy principle).

use super::cells::Cell;

/// The pulls that are tried, in turn.
const PULLS: [f64; 8] = [10.0, 3.0, 1.0, 0.3, 0.1, 0.03, 0.01, 0.0];
/// Rounds over all cells for each; fewer where there are very many.
const ROUNDS: usize = 60;
const MAX_STEPS: usize = 4_000_000;
/// Standard errors in the half of an interval.
const ERRORS: f64 = 2.0;

/// The values, cells without one are not a number.
pub(super) fn steady([columns, rows]: [usize; 2], cells: &[Cell]) -> Vec<f64> {
    let half_width = |cell: &Cell| cell.half_width.filter(|w| w.is_finite() && *w > 0.0);
    let grid = NoisyGrid {
        columns,
        rows,
        values: cells.iter().map(|cell| cell.value.unwrap_or(f64::NAN)).collect(),
        reaches: cells.iter().map(|cell| half_width(cell).unwrap_or(0.0)).collect(),
    };
    let mut best = grid.values.clone();
    for pull in PULLS {
        let mut field = best.clone();
        grid.smooth(&mut field, pull);
        if grid.discrepancy(&field) > 1.0 {
            break;
        }
        best = field;
    }
    best
}

/// What is known of a grid.
struct NoisyGrid {
    columns: usize,
    rows: usize,
    values: Vec<f64>,
    /// Half-widths, zero where there are none.
    reaches: Vec<f64>,
}

impl NoisyGrid {
    /// The mean square of what a field differs from the values, in standard errors.
    fn discrepancy(&self, field: &[f64]) -> f64 {
        let known = field.iter().zip(&self.values).zip(&self.reaches);
        let squares = known
            .filter(|((s, _), reach)| **reach > 0.0 && s.is_finite())
            .map(|((s, value), reach)| square(ERRORS * (s - value) / reach));
        let (mut sum, mut count) = (0.0, 0.0);
        for square in squares {
            sum += square;
            count += 1.0;
        }
        if count > 0.0 { sum / count } else { f64::INFINITY }
    }

    /// Makes a field smooth.
    fn smooth(&self, field: &mut [f64], pull: f64) {
        for _ in 0..ROUNDS.min(MAX_STEPS / field.len().max(1)) {
            for cell in 0..field.len() {
                let (value, reach) = (self.values[cell], self.reaches[cell]);
                if value.is_finite() && reach > 0.0 {
                    let wanted = self.wanted(field, cell, pull);
                    field[cell] = wanted.clamp(value - reach, value + reach);
                }
            }
        }
    }

    /// The best value of a cell for its neighbours as they are.
    fn wanted(&self, field: &[f64], cell: usize, pull: f64) -> f64 {
        let [at, row] = [cell % self.columns, cell / self.columns];
        let across = Neighbours { at, count: self.columns, step: 1 };
        let along = Neighbours { at: row, count: self.rows, step: self.columns };
        let (mut sum, mut weight) = (pull * self.values[cell], pull);
        for wish in across.wishes(cell, field).chain(along.wishes(cell, field)) {
            sum += wish.weight * wish.value;
            weight += wish.weight;
        }
        if weight > 0.0 { sum / weight } else { self.values[cell] }
    }
}

fn square(x: f64) -> f64 {
    x * x
}

/// A cell in its row or column.
#[derive(Clone, Copy)]
struct Neighbours {
    /// Its place there, of this many.
    at: usize,
    count: usize,
    /// From one to the next in the field.
    step: usize,
}

/// What a second difference wants a cell to be, so that it vanishes.
struct Wish {
    value: f64,
    /// The square of the cell's factor in it.
    weight: f64,
}

impl Neighbours {
    /// What the second differences want that the cell is in.
    fn wishes(self, cell: usize, field: &[f64]) -> impl Iterator<Item = Wish> + '_ {
        let Self { at, count, step } = self;
        let before = |k: usize| (at >= k).then(|| field[cell - k * step]);
        let behind = |k: usize| (at + k < count).then(|| field[cell + k * step]);
        let middle =
            before(1).zip(behind(1)).map(|(a, b)| Wish { value: 0.5 * (a + b), weight: 4.0 });
        let outer = |near: Option<f64>, far: Option<f64>| {
            near.zip(far).map(|(near, far)| Wish { value: 2.0 * near - far, weight: 1.0 })
        };
        let all = [middle, outer(before(1), before(2)), outer(behind(1), behind(2))];
        all.into_iter().flatten().filter(|wish| wish.value.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example::{Grid, batwing};

    /// Numbers of variance 1 without order.
    fn noise(cell: usize) -> f64 {
        let mut bits = (cell as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        bits = (bits ^ bits >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let share = ((bits ^ bits >> 31) >> 11) as f64 / (1_u64 << 53) as f64;
        (2.0 * share - 1.0) * 3.0_f64.sqrt()
    }

    fn roughness(field: &[f64], columns: usize) -> f64 {
        let rows = field.chunks(columns).flat_map(|row| row.windows(3));
        rows.map(|w| square(w[0] - 2.0 * w[1] + w[2])).sum()
    }

    /// Noise goes, and the field is nearer to the truth than the values.
    #[test]
    fn ripples_within_the_intervals_go() {
        let truth = Grid::new([5.0, 4.0], [20, 16], 0.05, batwing);
        let mut noisy = truth.cells.clone();
        for (k, cell) in noisy.iter_mut().enumerate() {
            cell.value = cell.value.zip(cell.half_width).map(|(x, w)| x + 0.5 * w * noise(k));
        }
        let values = |cells: &[Cell]| cells.iter().filter_map(|c| c.value).collect::<Vec<f64>>();
        let (true_values, measured) = (values(&truth.cells), values(&noisy));
        let field = steady([20, 16], &noisy);
        let off = |field: &[f64]| -> f64 {
            field.iter().zip(&true_values).map(|(a, b)| square(a - b)).sum()
        };
        assert!(off(&field) < 0.7 * off(&measured), "{} of {}", off(&field), off(&measured));
        assert!(roughness(&field, 20) < 0.2 * roughness(&measured, 20));
        for ((value, cell), measured) in field.iter().zip(&noisy).zip(&measured) {
            assert!((value - measured).abs() <= cell.half_width.unwrap_or(0.0) + 1e-9);
        }
    }

    #[test]
    fn what_is_known_stays() {
        let exact = Grid::new([5.0, 4.0], [20, 16], 0.0, batwing);
        let values: Vec<f64> = exact.cells.iter().filter_map(|cell| cell.value).collect();
        assert_eq!(steady([20, 16], &exact.cells), values);
        let ramp = Grid::new([5.0, 4.0], [20, 16], 0.1, |x, y| 300.0 + 90.0 * x - 40.0 * y);
        for (value, cell) in steady([20, 16], &ramp.cells).iter().zip(&ramp.cells) {
            assert!((value - cell.value.unwrap_or(0.0)).abs() < 1e-9);
        }
        let mut holes = ramp.cells;
        holes[37].value = None;
        let field = steady([20, 16], &holes);
        assert!(field[37].is_nan() && field.iter().filter(|x| x.is_nan()).count() == 1);
        assert_eq!(steady([1, 1], &holes[..1]).len(), 1);
    }
}
