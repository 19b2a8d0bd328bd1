//! What the points are for: unbiased means, and errors that fall faster than N^-1/2.

use quasilux_sampling::{PointSet, Randomization, Sequence, stream_key};

use crate::support::{assert_mean, mean_and_error};

/// Smooth in four dimensions, with integral 1.
fn integrand(x: [f64; 4]) -> f64 {
    let normalisation = 1.0 - libm::exp(-1.0);
    x.into_iter().map(|x| libm::exp(-x) / normalisation).product()
}

fn mean(points: &PointSet, count: u64) -> f64 {
    let value = |index| integrand(std::array::from_fn(|d| points.coordinate(index, d as u32)));
    (0..count).map(value).sum::<f64>() / count as f64
}

/// Slope of log2(root mean square error) over m for N = 2^m points, m = 6, 8, .., 18, from 32
/// replicates.
fn error_slope(sequence: Sequence, randomization: Randomization) -> f64 {
    let errors: Vec<(f64, f64)> = (6..=18)
        .step_by(2)
        .map(|m| {
            let squares = (0..32).map(|replicate| {
                let points = PointSet::new(sequence, randomization, stream_key(5, replicate, 0));
                let error = mean(&points, 1 << m) - 1.0;
                error * error
            });
            (f64::from(m), 0.5 * libm::log2(squares.sum::<f64>() / 32.0))
        })
        .collect();
    let n = errors.len() as f64;
    let (sum_x, sum_y) = errors.iter().fold((0.0, 0.0), |(x, y), e| (x + e.0, y + e.1));
    let (mean_x, mean_y) = (sum_x / n, sum_y / n);
    let covariance: f64 = errors.iter().map(|e| (e.0 - mean_x) * (e.1 - mean_y)).sum();
    covariance / errors.iter().map(|e| (e.0 - mean_x) * (e.0 - mean_x)).sum::<f64>()
}

/// The standard error of a slope is about 0.015: seven errors, each known to 13 %.
#[test]
fn errors_fall_as_theory_has_it() {
    let owen = error_slope(Sequence::Sobol, Randomization::Owen);
    let shift = error_slope(Sequence::Sobol, Randomization::Shift);
    let random = error_slope(Sequence::Random, Randomization::None);
    println!("slopes: Owen {owen:.3}, digital shift {shift:.3}, pseudo-random {random:.3}");
    assert!(owen < -1.2, "Owen scrambling: N^{owen}");
    assert!(shift < -0.8, "digital shift: N^{shift}");
    assert!((random + 0.5).abs() < 0.08, "pseudo-random: N^{random}");
}

/// z-test over 1000 seeds (as good as t with 999 degrees of freedom), N = 256: finds a bias of 5
/// standard errors, which under Owen scrambling is 0.02 % of the integral.
#[test]
fn randomised_means_are_unbiased() {
    let kinds = [
        (Sequence::Sobol, Randomization::Shift),
        (Sequence::Sobol, Randomization::Owen),
        (Sequence::Random, Randomization::None),
    ];
    for (sequence, randomization) in kinds {
        let means: Vec<f64> = (0..1000)
            .map(|seed| mean(&PointSet::new(sequence, randomization, stream_key(seed, 1, 2)), 256))
            .collect();
        let (mean, error) = mean_and_error(&means);
        println!("{} {}: mean {mean} +- {error:e}", sequence.name(), randomization.name());
        assert_mean(mean, 1.0, error, "mean over seeds");
    }
}
