//! Statistical helpers and short names.

use quasilux_sampling::{PointSet, Randomization, Sequence, stream_key};
use quasilux_stats::{CellCount, chi_square_test, normal_cdf};

pub(crate) const SIGNIFICANCE: f64 = 1e-6;

/// A pseudo-random point set.
pub(crate) fn random(seed: u64) -> PointSet {
    PointSet::new(Sequence::Random, Randomization::None, stream_key(seed, 0, 0))
}

/// A Sobol' point set.
pub(crate) fn sobol(randomization: Randomization, seed: u64) -> PointSet {
    PointSet::new(Sequence::Sobol, randomization, stream_key(seed, 0, 0))
}

/// The cell of u among `cells` equal ones.
pub(crate) fn cell(u: f64, cells: usize) -> usize {
    assert!((0.0..1.0).contains(&u), "{u} is not in [0, 1)");
    (u * cells as f64) as usize
}

/// Pearson's test of counts against equal probabilities.
pub(crate) fn assert_uniform(counts: &[u64], what: &str) {
    let probabilities = vec![1.0 / counts.len() as f64; counts.len()];
    assert_distributed(counts, &probabilities, what);
}

/// Pearson's test of counts against given probabilities.
pub(crate) fn assert_distributed(counts: &[u64], probabilities: &[f64], what: &str) {
    let p_value = chi_square_p_value(counts, probabilities);
    assert!(p_value > SIGNIFICANCE, "{what}: chi-square p-value {p_value:e}");
}

/// The probability of a statistic at least as large.
pub(crate) fn chi_square_p_value(counts: &[u64], probabilities: &[f64]) -> f64 {
    let total = counts.iter().sum::<u64>() as f64;
    let cell = |(observed, probability): (&u64, &f64)| CellCount {
        observed: *observed,
        expected: total * probability,
    };
    let cells: Vec<CellCount> = counts.iter().zip(probabilities).map(cell).collect();
    assert!(cells.iter().all(|cell| cell.expected >= 5.0), "too few samples for so many cells");
    chi_square_test(&cells)
}

/// Two-sided z-test of a mean, given its standard error.
pub(crate) fn assert_mean(mean: f64, expected: f64, standard_error: f64, what: &str) {
    let p_value = 2.0 * normal_cdf(-((mean - expected) / standard_error).abs());
    assert!(
        p_value > SIGNIFICANCE,
        "{what}: {mean} instead of {expected} +- {standard_error:e}, p-value {p_value:e}"
    );
}

/// Mean and its standard error.
pub(crate) fn mean_and_error(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|x| (x - mean) * (x - mean)).sum();
    (mean, (squares / (n - 1.0) / n).sqrt())
}

/// The chi-square test must reject a density that is 2 % too high in one half and 2 % too low in
/// the other.
#[test]
fn chi_square_rejects_two_percent() {
    let wrong: Vec<f64> = (0..64).map(|i| if i < 32 { 1.02 / 64.0 } else { 0.98 / 64.0 }).collect();
    let points = random(1);
    let mut counts = [0; 64];
    for index in 0..1 << 18 {
        counts[cell(points.coordinate(index, 0), 64)] += 1;
    }
    assert_uniform(&counts, "right density");
    assert!(chi_square_p_value(&counts, &wrong) < SIGNIFICANCE);
}
