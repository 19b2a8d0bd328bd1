//! Pearson's chi-square test (Pearson 1900).

use crate::special::gamma_q;

/// A count beside the count that the distribution predicts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellCount {
    /// How many samples fell into the cell.
    pub observed: u64,
    /// How many were expected.
    pub expected: f64,
}

/// Cells with fewer expected samples are pooled: the statistic is chi-square only for large counts.
const MIN_EXPECTED: f64 = 5.0;

/// The probability that counts as far from the expected ones arise by chance.
///
/// The expected counts add up to the number of samples. Cells with less than five expected samples
/// are pooled; what was observed where (almost) nothing is expected, gives 0.
///
/// # Panics
/// With fewer than two cells after pooling.
pub fn chi_square_test(cells: &[CellCount]) -> f64 {
    let mut pool = CellCount { observed: 0, expected: 0.0 };
    let mut statistic = 0.0;
    let mut terms = 0usize;
    let term = |cell: &CellCount| {
        let difference = cell.observed as f64 - cell.expected;
        difference * difference / cell.expected
    };
    for cell in cells {
        if cell.expected < MIN_EXPECTED {
            if cell.observed > 0 && cell.expected <= 0.0 {
                return 0.0;
            }
            pool.observed += cell.observed;
            pool.expected += cell.expected;
        } else {
            statistic += term(cell);
            terms += 1;
        }
    }
    if pool.expected > 0.0 {
        // A pool below one sample would weigh a single one too much.
        pool.expected = pool.expected.max(1.0);
        statistic += term(&pool);
        terms += 1;
    }
    assert!(terms > 1, "a chi-square test needs two cells with samples");
    gamma_q(0.5 * (terms - 1) as f64, 0.5 * statistic)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn probabilities_are_those_of_the_tables() {
        // With one degree of freedom: erfc(sqrt(statistic / 2)).
        let cells = [
            CellCount { observed: 60, expected: 50.0 },
            CellCount { observed: 40, expected: 50.0 },
        ];
        assert!((chi_square_test(&cells) - libm::erfc(2.0_f64.sqrt())).abs() < 1e-12);
        // Quantiles at 0.05 with three and with one degree of freedom.
        assert!((gamma_q(1.5, 7.814_727_903_251_178 / 2.0) - 0.05).abs() < 1e-12);
        assert!((gamma_q(0.5, 3.841_458_820_694_124 / 2.0) - 0.05).abs() < 1e-12);
    }

    #[test]
    fn a_sample_in_an_impossible_cell_is_rejected() {
        let cells = [(10, 10.0), (9, 10.0), (1, 0.0)]
            .map(|(observed, expected)| CellCount { observed, expected });
        assert_eq!(chi_square_test(&cells), 0.0);
    }

    #[test]
    fn small_cells_are_pooled() {
        let small = std::iter::repeat_n(CellCount { observed: 0, expected: 0.1 }, 100);
        let large = [
            CellCount { observed: 105, expected: 100.0 },
            CellCount { observed: 95, expected: 90.0 },
        ];
        let cells: Vec<CellCount> = small.chain(large).collect();
        let statistic = 10.0 + 25.0 / 100.0 + 25.0 / 90.0;
        assert!((chi_square_test(&cells) - libm::exp(-0.5 * statistic)).abs() < 1e-12);
    }
}
