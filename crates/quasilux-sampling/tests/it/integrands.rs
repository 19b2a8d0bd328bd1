//! Integrands: their integrals against quadrature and against randomised points.

use quasilux_sampling::quality::{Integrand, Roughness};
use quasilux_sampling::{PointSet, Randomization, Sequence, stream_key};

use crate::support::{SampleMean, assert_mean, sample_mean};

/// Eight-point Gauss-Legendre nodes and weights on [-1, 1] (Abramowitz and Stegun, table 25.4).
const GAUSS: [[f64; 2]; 4] = [
    [0.183_434_642_495_649_8, 0.362_683_783_378_362],
    [0.525_532_409_916_329, 0.313_706_645_877_887_3],
    [0.796_666_477_413_626_7, 0.222_381_034_453_374_47],
    [0.960_289_856_497_536_2, 0.101_228_536_290_376_26],
];

/// The integral over [0, 1]^8 of a function of the sum of the coordinates, as one over the density
/// of the sum, convolved seven times with that of one coordinate on a grid of step 1/`STEPS`.
fn of_sum(function: impl Fn(f64) -> f64) -> f64 {
    const STEPS: usize = 400;
    let mut density = vec![1.0; STEPS];
    for _ in 1..8 {
        let mut sums = vec![0.0; density.len() + 1];
        for (i, d) in density.iter().enumerate() {
            sums[i + 1] = sums[i] + d;
        }
        let window =
            |i: usize| sums[(i + 1).min(density.len())] - sums[(i + 1).saturating_sub(STEPS)];
        density = (0..density.len() + STEPS - 1).map(|i| window(i) / STEPS as f64).collect();
    }
    // The sum of eight middles of steps is a whole number of steps and four; where the function
    // jumps there, the mean of both sides is taken.
    let value = |(i, d): (usize, &f64)| {
        let sum = (i as f64 + 4.0) / STEPS as f64;
        d * 0.5 * (function(sum - 1e-9) + function(sum + 1e-9))
    };
    density.iter().enumerate().map(value).sum::<f64>() / STEPS as f64
}

/// Composite Gauss quadrature in two dimensions, its pieces ending at the kinks.
fn by_quadrature(integrand: Integrand) -> f64 {
    let ends = |kink: f64| {
        let pieces = move |from: f64, to: f64| {
            (0..4).map(move |i| [i, i + 1].map(|k| from + (to - from) * f64::from(k) / 4.0))
        };
        pieces(0.0, kink).chain(pieces(kink, 1.0))
    };
    let nodes = |kink: f64| -> Vec<[f64; 2]> {
        ends(kink)
            .flat_map(|[a, b]| {
                let signed = GAUSS.into_iter().flat_map(|[x, w]| [[x, w], [-x, w]]);
                signed.map(move |[x, w]| [0.5 * (a + b + x * (b - a)), 0.5 * w * (b - a)])
            })
            .collect()
    };
    let (first, second) = (nodes(0.37), nodes(0.58));
    let value = |[x, v]: &[f64; 2], [y, w]: &[f64; 2]| v * w * integrand.value(&[*x, *y]);
    first.iter().map(|a| second.iter().map(|b| value(a, b)).sum::<f64>()).sum()
}

fn assert_close(integrand: Integrand, reference: f64, relative: f64) {
    let error = (integrand.integral() / reference - 1.0).abs();
    assert!(error < relative, "{}: {error:e} from {reference}", integrand.name());
}

#[test]
fn integrals_equal_quadrature() {
    assert_close(Integrand::Gaussian, by_quadrature(Integrand::Gaussian), 1e-12);
    assert_close(Integrand::Ridge, by_quadrature(Integrand::Ridge), 1e-12);
    let in_eight = |integrand: Integrand| of_sum(|sum| integrand.value(&[sum / 8.0; 8]));
    assert_close(Integrand::Oscillatory, in_eight(Integrand::Oscillatory), 1e-5);
    assert_close(Integrand::Hinge, in_eight(Integrand::Hinge), 1e-5);
    assert_close(Integrand::HalfSpace, in_eight(Integrand::HalfSpace), 1e-4);
}

/// Each factor of a product has mean 1: found by changing one coordinate alone, on 2^12 middles.
#[test]
fn factors_of_products_have_mean_one() {
    for (integrand, tolerance) in
        [(Integrand::Exponential, 1e-7), (Integrand::GFunction, 1e-3), (Integrand::Steps, 1e-3)]
    {
        let at_start = |j: usize, u: f64| {
            let mut point = [0.25; 32];
            point[j] = u;
            integrand.value(&point)
        };
        let product: f64 = (0..32)
            .map(|j| {
                let middles = (0..1 << 12).map(|i| (f64::from(i) + 0.5) / 4096.0);
                let mean = middles.map(|u| at_start(j, u)).sum::<f64>() / 4096.0;
                mean / integrand.value(&[0.25; 32])
            })
            .product();
        let integral = product * integrand.value(&[0.25; 32]);
        assert!((integral - 1.0).abs() < tolerance, "{}: {integral}", integrand.name());
    }
}

/// z-test over 64 seeds, 2^12 points each: finds an integral that is off by five standard errors,
/// for the worst of them (half-space) 1.7 %.
#[test]
fn integrals_equal_means_over_scrambled_points() {
    for integrand in Integrand::ALL {
        let means: Vec<f64> = (0..64)
            .map(|seed| {
                let key = stream_key(seed, 0, 9);
                let points = PointSet::new(Sequence::Sobol, Randomization::Owen, key);
                let mut u = [0.0; Integrand::MAX_DIMENSIONS];
                let value = |index| {
                    for (j, u) in u.iter_mut().enumerate().take(integrand.dimensions()) {
                        *u = points.coordinate(index, j as u32);
                    }
                    integrand.value(&u)
                };
                (0..1 << 12).map(value).sum::<f64>() / 4096.0
            })
            .collect();
        let SampleMean { mean, standard_error: error } = sample_mean(&means);
        println!("{}: {mean} +- {error:e}", integrand.name());
        assert!(error < 5e-3 * integrand.integral());
        assert_mean(mean, integrand.integral(), error, integrand.name());
    }
}

#[test]
fn the_suite_is_a_grid_of_roughness_and_dimension() {
    let roughness = [Roughness::Smooth, Roughness::Kink, Roughness::Jump];
    for (i, integrand) in Integrand::ALL.into_iter().enumerate() {
        assert_eq!(integrand.roughness(), roughness[i / 3]);
        assert_eq!(integrand.dimensions(), [2, 8, 32][i % 3]);
    }
}
