//! Statistical helpers and short names.

use quasilux_sampling::{PointSet, Randomization, Sequence, stream_key};
use quasilux_stats::{CellCount, chi_square_test, normal_cdf};

pub(crate) const SIGNIFICANCE: f64 = 1e-6;

/// A pseudo-random point set.
pub(crate) fn random(seed: u64) -> PointSet {
    PointSet::new(Sequence::Independent, Randomization::None, stream_key(seed, 0, 0))
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

/// The chi-square of the first 2^14 points of a pair of dimensions in 16 x 16 cells.
///
/// Where the indices of the one are a nested shuffle of those of the other it is distributed like
/// 16 chi2_1 + 8 chi2_4 + 4 chi2_16 + 2 chi2_64, whose mean is 240 and variance 2048: the counts of
/// 2^a by 2^b cells, a + b <= 8, are tied by the nets on both axes. A diagonal has 245 760.
pub(crate) fn pair_chi_square(points: &PointSet, [first, second]: [u32; 2]) -> f64 {
    let [mut x, mut y] = [(); 2].map(|()| vec![0.0; 1 << 14]);
    points.fill(first, 0, &mut x);
    points.fill(second, 0, &mut y);
    let mut counts = [0_u64; 256];
    for (x, y) in x.iter().zip(&y) {
        counts[16 * cell(*x, 16) + cell(*y, 16)] += 1;
    }
    counts.iter().map(|count| (*count as f64 - 64.0) * (*count as f64 - 64.0) / 64.0).sum()
}

/// That pairs of dimensions are shuffled against each other. The mean of 64 keys, seeds 0 to 63,
/// has a standard error of 5.7: at [`SIGNIFICANCE`] it finds an excess of 28, which cells have
/// whose densities are off by 4 % (root mean square). Where nothing is random there is one value,
/// and above 790 with a probability below 1e-6 (Chernoff's bound): densities off by 18 %.
pub(crate) fn assert_pairs_are_shuffled(sequence: Sequence, pairs: &[[u32; 2]]) {
    for randomization in Randomization::ALL {
        let name = randomization.name();
        for pair in pairs {
            let chi_square = |seed| {
                let points = PointSet::new(sequence, randomization, stream_key(seed, 0, 0));
                pair_chi_square(&points, *pair)
            };
            if randomization == Randomization::None {
                let chi_square = chi_square(0);
                assert!(chi_square < 790.0, "dimensions {pair:?}: {chi_square} instead of 240");
            } else {
                let mean = (0..64).map(chi_square).sum::<f64>() / 64.0;
                let standard_error = (2048.0_f64 / 64.0).sqrt();
                assert_mean(mean, 240.0, standard_error, &format!("{name}, dimensions {pair:?}"));
            }
        }
    }
}

/// Two-sided z-test of a mean, given its standard error.
pub(crate) fn assert_mean(mean: f64, expected: f64, standard_error: f64, what: &str) {
    let p_value = 2.0 * normal_cdf(-((mean - expected) / standard_error).abs());
    assert!(
        p_value > SIGNIFICANCE,
        "{what}: {mean} instead of {expected} +- {standard_error:e}, p-value {p_value:e}"
    );
}

/// A mean, and its standard error from the spread of the values.
pub(crate) struct SampleMean {
    pub(crate) mean: f64,
    pub(crate) standard_error: f64,
}

pub(crate) fn sample_mean(values: &[f64]) -> SampleMean {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|x| (x - mean) * (x - mean)).sum();
    SampleMean { mean, standard_error: (squares / (n - 1.0) / n).sqrt() }
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
