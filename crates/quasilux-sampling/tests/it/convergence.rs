//! What the points are for: unbiased means, and errors that fall faster than N^-1/2.

use quasilux_sampling::{PointSet, Randomization, Sequence, stream_key};
use quasilux_stats::{least_squares_slope, student_t_test};

use crate::support::SIGNIFICANCE;

/// Smooth in four dimensions, with integral 1.
fn integrand(x: [f64; 4]) -> f64 {
    let normalisation = 1.0 - libm::exp(-1.0);
    x.into_iter().map(|x| libm::exp(-x) / normalisation).product()
}

/// The mean over `count` points, block by block.
fn mean(points: &PointSet, count: u64) -> f64 {
    let size = count.min(4096) as usize;
    let mut columns = vec![0.0; 4 * size];
    let mut sum = 0.0;
    for first_index in (0..count).step_by(size) {
        points.fill_dimensions(0, first_index, columns.chunks_mut(size));
        sum += (0..size)
            .map(|place| integrand([0, 1, 2, 3].map(|d| columns[d * size + place])))
            .sum::<f64>();
    }
    sum / count as f64
}

/// The root mean square error of 2^m points.
struct ErrorAt {
    m: u32,
    error: f64,
}

/// Slope of the error over the number of points, in logarithms.
fn slope(errors: impl Iterator<Item = ErrorAt>) -> f64 {
    let points: Vec<[f64; 2]> =
        errors.map(|ErrorAt { m, error }| [f64::from(m), libm::log2(error)]).collect();
    least_squares_slope(&points)
}

/// Slope of the root mean square error over N = 2^m points, m = 6, 8, .. `last`, of `replicates`
/// replicates.
fn replicate_slope(
    sequence: Sequence,
    randomization: Randomization,
    last: usize,
    replicates: u32,
) -> f64 {
    slope((6..=last as u32).step_by(2).map(|m| {
        let squares = (0..replicates).map(|replicate| {
            let points = PointSet::new(sequence, randomization, stream_key(5, replicate, 0));
            let error = mean(&points, 1 << m) - 1.0;
            error * error
        });
        ErrorAt { m, error: (squares.sum::<f64>() / f64::from(replicates)).sqrt() }
    }))
}

/// Up to 2^20 points, far past where libraries of 16-bit indices fold. The standard error of a
/// slope is about 0.02: eight errors, each known to 18 % from 16 replicates.
#[test]
fn scrambled_errors_fall_faster_than_theory_must_have_it() {
    let owen = replicate_slope(Sequence::Sobol, Randomization::Owen, 20, 16);
    let base4 = replicate_slope(Sequence::Faure4, Randomization::Owen, 20, 16);
    println!("slopes to 2^20: Sobol' {owen:.3}, base 4 {base4:.3}");
    assert!(owen < -1.2, "Owen scrambling: N^{owen}");
    assert!(base4 < -1.2, "Owen scrambling in base 4: N^{base4}");
}

/// Halton's blocks are no powers of two, so it gains less: see the numbers printed.
#[test]
fn other_randomisations_keep_the_order_of_the_sequence() {
    let sobol_shift = replicate_slope(Sequence::Sobol, Randomization::DigitalShift, 18, 16);
    let sobol_rotation =
        replicate_slope(Sequence::Sobol, Randomization::CranleyPattersonRotation, 18, 16);
    let halton_owen = replicate_slope(Sequence::Halton, Randomization::Owen, 16, 16);
    let halton_shift = replicate_slope(Sequence::Halton, Randomization::DigitalShift, 16, 16);
    println!(
        "slopes: Sobol' shift {sobol_shift:.3}, rotation {sobol_rotation:.3}, Halton Owen \
         {halton_owen:.3}, shift {halton_shift:.3}"
    );
    for slope in [sobol_shift, sobol_rotation, halton_owen, halton_shift] {
        assert!(slope < -0.8, "N^{slope}");
    }
}

/// 1024 replicates: each of six errors is known to 2.2 %, the slope to 0.004.
#[test]
fn pseudo_random_errors_fall_like_the_root() {
    let random = slope((4..=14).step_by(2).map(|m| {
        let squares = (0..1024).map(|replicate| {
            let key = stream_key(5, replicate, 0);
            let points = PointSet::new(Sequence::Independent, Randomization::None, key);
            let error = mean(&points, 1 << m) - 1.0;
            error * error
        });
        ErrorAt { m, error: (squares.sum::<f64>() / 1024.0).sqrt() }
    }));
    println!("slope of pseudo-random: {random:.3}");
    assert!((random + 0.5).abs() < 0.05, "pseudo-random: N^{random}");
}

/// Without randomisation there is one error for each N, from 2^4 to 2^20.
#[test]
fn plain_sequences_fall_nearly_like_the_inverse() {
    for sequence in [Sequence::Sobol, Sequence::Halton, Sequence::Faure4] {
        let points = PointSet::new(sequence, Randomization::None, 0);
        let plain =
            slope((4..=20).map(|m| ErrorAt { m, error: (mean(&points, 1 << m) - 1.0).abs() }));
        println!("slope of plain {}: {plain:.3}", sequence.name());
        assert!(plain < -0.9, "{}: N^{plain}", sequence.name());
    }
}

/// Student's test over 1000 seeds, N = 256, at a significance of 1e-6: finds a bias of 5 standard
/// errors, which under Owen scrambling of Sobol' is 0.02 % of the integral.
#[test]
fn randomised_means_are_unbiased() {
    let mut kinds = vec![(Sequence::Independent, Randomization::None)];
    for sequence in Sequence::all_for(256).into_iter().filter(|it| it.name() != "random") {
        for randomization in [
            Randomization::CranleyPattersonRotation,
            Randomization::DigitalShift,
            Randomization::Owen,
        ] {
            kinds.push((sequence, randomization));
        }
    }
    for (sequence, randomization) in kinds {
        let means: Vec<f64> = (0..1000)
            .map(|seed| mean(&PointSet::new(sequence, randomization, stream_key(seed, 1, 2)), 256))
            .collect();
        let p_value = student_t_test(&means, 1.0);
        assert!(p_value > SIGNIFICANCE, "{sequence:?} {randomization:?}: p-value {p_value:e}");
    }
}
