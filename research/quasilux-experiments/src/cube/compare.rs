//! Columns at equal cost, as in the paper's table 5, and whether one beats another.
//!
//! Columns that read maps of the same elements have the same bias, for each randomisation leaves
//! every point uniform. Of two such columns the one errs less that spreads less about its mean, and
//! that is told apart from chance even where both come near their floor. Other columns are compared
//! by their errors.

use super::curve::{Currency, Curve, Look, root_mean_square};
use crate::contrast::Contrast;

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
}

pub(super) struct Round {
    pub(super) cost: f64,
    /// Of the errors' root mean squares.
    pub(super) ratio: f64,
    /// Of those of what is compared: spreads or errors.
    pub(super) compared: Contrast,
}

/// Costs begin where the error of pseudo-random photons is this, as in the paper, or where the last
/// column begins: below, there are no errors to compare.
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
    pub(super) fn new(curves: &[Curve; 5], currency: Currency) -> Self {
        let of_paper = Column::OF_PAPER.map(|column| curves[column as usize].by_cost(currency));
        let first = of_paper.iter().map(|curve| curve[0][0]).fold(0.0, f64::max);
        let last = of_paper.iter().map(|curve| curve[curve.len() - 1][0]);
        let last = last.fold(f64::INFINITY, f64::min);
        let [pseudo, ..] = of_paper;
        let begins = pseudo.iter().find(|[_, error]| *error <= FIRST_ERROR);
        let begins = begins.map_or(first, |[cost, _]| cost.max(first));
        let costs = std::iter::successors(Some(begins), |cost| Some(2.0 * cost));
        let rows = costs.take_while(|cost| *cost <= last);
        Self { currency, rows: rows.map(|cost| Row::at(curves, cost, currency)).collect() }
    }

    /// Whether the second beats the first, as far as both go.
    pub(super) fn duel(&self, worse: Column, better: Column) -> Duel {
        let has_same_floor = worse.has_floor_of(better);
        let both = |row: &Row| -> Option<Round> {
            let of = |rows: &[Option<Vec<f64>>; 5], column: Column| rows[column as usize].clone();
            let [a, b] = [of(&row.errors, worse)?, of(&row.errors, better)?];
            let ratio = root_mean_square(&a) / root_mean_square(&b);
            let compared = if has_same_floor { &row.spreads } else { &row.errors };
            let squares = |column| Some(of(compared, column)?.iter().map(|x| x * x).collect());
            let [a, b]: [Vec<f64>; 2] = [squares(worse)?, squares(better)?];
            Some(Round { cost: row.cost, ratio, compared: Contrast::gain(&a, &b) })
        };
        Duel { worse, better, has_same_floor, rounds: self.rows.iter().filter_map(both).collect() }
    }

    /// Beside a row of the paper's table 5: the columns at the cost at which pseudo errs as much as
    /// there, `None` where it never does.
    pub(super) fn at_error_of_pseudo(curves: &[Curve; 5], error: f64) -> Option<Row> {
        let pseudo = curves[Column::Pseudo as usize].by_cost(Currency::Seconds);
        let pair = pseudo.windows(2).find(|pair| pair[0][1] >= error && error > pair[1][1])?;
        let logs = [0, 1].map(|k| pair[k].map(libm::log));
        let share = (libm::log(error) - logs[0][1]) / (logs[1][1] - logs[0][1]);
        let cost = libm::exp(logs[0][0] + share * (logs[1][0] - logs[0][0]));
        Some(Row::at(curves, cost, Currency::Seconds))
    }
}

impl Row {
    fn at(curves: &[Curve; 5], cost: f64, currency: Currency) -> Self {
        let of = |of_look: fn(&Look) -> &[f64]| {
            Column::ALL.map(|column| curves[column as usize].at(cost, currency, of_look))
        };
        Self { cost, errors: of(|look| &look.errors), spreads: of(|look| &look.spreads) }
    }

    /// Root mean square over the replicates.
    pub(super) fn rms(&self, column: Column) -> Option<f64> {
        self.errors[column as usize].as_deref().map(root_mean_square)
    }
}

impl Duel {
    /// Rounds that are won beyond chance, at a significance for each.
    pub(super) fn won(&self, significance: f64) -> usize {
        let is_won = |round: &&Round| round.compared.is_above(1.0, significance);
        self.rounds.iter().filter(is_won).count()
    }
}
