//! Columns at equal cost, as in the paper's table 5, and whether one beats another.
//!
//! Columns that read maps of the same elements have the same bias, for each randomisation leaves every point uniform. Of
//! two such columns the one errs less that spreads less about its mean, and that is told apart from chance even where
//! both come near their floor. Other columns are compared by their errors.

use super::curve::{Currency, Curve, root_mean_square};
use quasilux_transport::interval::t_quantile_for;

/// A column of table 5, or our own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Column {
    Pseudo,
    Quasi,
    Pseudo2,
    Quasi2,
    Own,
}

/// The columns at costs that double.
pub(super) struct Table {
    pub(super) currency: Currency,
    pub(super) rows: Vec<Row>,
}

/// The columns at one cost.
pub(super) struct Row {
    pub(super) cost: f64,
    /// Of each column, the errors of all replicates; `None` where it has not begun or has ended.
    errors: [Option<Vec<f64>>; 5],
    /// The same of their distances from the mean of all replicates.
    spreads: [Option<Vec<f64>>; 5],
}

/// One column against another.
pub(super) struct Duel {
    pub(super) worse: Column,
    pub(super) better: Column,
    /// Whether spreads are compared.
    pub(super) has_same_floor: bool,
    /// At each cost.
    pub(super) rounds: Vec<Round>,
    /// What they exceed by chance at any of the costs in one case of a hundred, were the columns alike.
    pub(super) critical: f64,
}

pub(super) struct Round {
    pub(super) cost: f64,
    /// Of the errors' root mean squares.
    pub(super) ratio: f64,
    /// Of those of what is compared: spreads or errors.
    pub(super) compared: f64,
    /// By how many standard errors their mean logarithms are apart (B. L. Welch, Biometrika 34, 1947).
    pub(super) t: f64,
}

/// The probability that any round of a duel seems won by chance.
pub(super) const SIGNIFICANCE: f64 = 0.01;
/// The table begins where the error of pseudo-random photons is this: the paper's begins at 46 %.
const FIRST_ERROR: f64 = 0.46;

impl Column {
    pub(super) const ALL: [Self; 5] =
        [Self::Pseudo, Self::Quasi, Self::Pseudo2, Self::Quasi2, Self::Own];
    /// Those that the paper has.
    pub(super) const OF_PAPER: [Self; 4] = [Self::Pseudo, Self::Quasi, Self::Pseudo2, Self::Quasi2];

    /// Whether both read the same map in the same way.
    fn has_floor_of(self, other: Self) -> bool {
        let is_of_paths = |column| matches!(column, Self::Pseudo2 | Self::Quasi2);
        let is_of_paper = |column| column != Self::Own;
        is_of_paper(self) && is_of_paper(other) && is_of_paths(self) == is_of_paths(other)
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Pseudo => "pseudo",
            Self::Quasi => "quasi",
            Self::Pseudo2 => "pseudo2",
            Self::Quasi2 => "quasi2",
            Self::Own => "own",
        }
    }
}

impl Table {
    /// The curves in the order of [`Column::ALL`].
    pub(super) fn of(curves: &[Curve; 5], currency: Currency) -> Self {
        let of_paper = Column::OF_PAPER.map(|column| curves[column as usize].by_cost(currency));
        let first = of_paper.iter().map(|curve| curve[0][0]).fold(0.0, f64::max);
        let last = of_paper.iter().map(|curve| curve[curve.len() - 1][0]);
        let last = last.fold(f64::INFINITY, f64::min);
        let [pseudo, ..] = of_paper;
        let begins = pseudo.iter().find(|[_, error]| *error <= FIRST_ERROR);
        let begins = begins.map_or(first, |[cost, _]| cost.max(first));
        let costs = std::iter::successors(Some(begins), |cost| Some(2.0 * cost));
        let row = |cost: f64| Row {
            cost,
            errors: Column::ALL
                .map(|column| curves[column as usize].at(cost, currency, |look| &look.errors)),
            spreads: Column::ALL
                .map(|column| curves[column as usize].at(cost, currency, |look| &look.spreads)),
        };
        Self { currency, rows: costs.take_while(|cost| *cost <= last).map(row).collect() }
    }

    /// Whether the second beats the first, as far as both go.
    pub(super) fn duel(&self, worse: Column, better: Column) -> Duel {
        let has_same_floor = worse.has_floor_of(better);
        let both = |row: &Row| -> Option<Round> {
            let of = |rows: &[Option<Vec<f64>>; 5], column: Column| rows[column as usize].clone();
            let [a, b] = [of(&row.errors, worse)?, of(&row.errors, better)?];
            let ratio = root_mean_square(&a) / root_mean_square(&b);
            let compared = if has_same_floor { &row.spreads } else { &row.errors };
            let [a, b] = [of(compared, worse)?, of(compared, better)?];
            let compared = root_mean_square(&a) / root_mean_square(&b);
            Some(Round { cost: row.cost, ratio, compared, t: welch(&a, &b) })
        };
        let rounds: Vec<Round> = self.rows.iter().filter_map(both).collect();
        let replicates = self.rows.iter().flat_map(|row| row.errors.iter().flatten()).map(Vec::len);
        let miss = 2.0 * SIGNIFICANCE / rounds.len().max(1) as f64;
        let critical = t_quantile_for(replicates.min().unwrap_or(0), miss);
        Duel { worse, better, has_same_floor, rounds, critical: critical.unwrap_or(f64::INFINITY) }
    }
}

impl Row {
    /// Root mean square over the replicates.
    pub(super) fn rms(&self, column: Column) -> Option<f64> {
        self.errors[column as usize].as_deref().map(root_mean_square)
    }
}

impl Duel {
    /// Rounds that are won beyond chance.
    pub(super) fn won(&self) -> usize {
        self.rounds.iter().filter(|round| round.t > self.critical).count()
    }

    pub(super) fn is_won_throughout(&self) -> bool {
        !self.rounds.is_empty() && self.won() == self.rounds.len()
    }

    /// Smallest and largest of the ratios.
    pub(super) fn range(&self, of: fn(&Round) -> f64) -> [f64; 2] {
        let ratios = || self.rounds.iter().map(of);
        [ratios().fold(f64::INFINITY, f64::min), ratios().fold(0.0, f64::max)]
    }

    /// The smallest t.
    pub(super) fn least_t(&self) -> f64 {
        self.rounds.iter().map(|round| round.t).fold(f64::INFINITY, f64::min)
    }
}

/// By how many standard errors the mean logarithm of the first is above that of the second.
fn welch(a: &[f64], b: &[f64]) -> f64 {
    let moments = |values: &[f64]| {
        let n = values.len() as f64;
        let mean = values.iter().map(|x| libm::log(*x)).sum::<f64>() / n;
        let squares: f64 =
            values.iter().map(|x| (libm::log(*x) - mean) * (libm::log(*x) - mean)).sum();
        [mean, squares / (n * (n - 1.0))]
    };
    let [[mean_a, square_a], [mean_b, square_b]] = [moments(a), moments(b)];
    (mean_a - mean_b) / (square_a + square_b).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Logarithms 0, 1, 2 and 3, 4, 5: means 1 and 4, each with a variance of 1 / 3.
    #[test]
    fn welch_is_right_for_a_small_example() {
        let [a, b] = [[0.0, 1.0, 2.0], [3.0, 4.0, 5.0]].map(|logs| logs.map(libm::exp));
        assert!((welch(&a, &b) + 3.0 / (2.0_f64 / 3.0).sqrt()).abs() < 1e-12);
    }
}
