//! Owen scrambling: all nested flips, equally often and independently.
//!
//! The first dimension is the radical inverse in base 2, so index `digits.reverse_bits()` has the
//! coordinate 0.digits, and the scramble is seen by itself.

use quasilux_sampling::{PointSet, Randomization, Sequence, stream_key};

use crate::support::{SIGNIFICANCE, SampleMean, assert_mean, assert_uniform, sample_mean, sobol};

fn owen(key: u64) -> PointSet {
    PointSet::new(Sequence::Sobol, Randomization::Owen, key)
}

/// The scrambled form of the 53-bit binary fraction `digits`, the first digit in bit 52.
fn scrambled(points: &PointSet, digits: u64) -> u64 {
    (points.coordinate((digits << 11).reverse_bits(), 0) * (1_u64 << 53) as f64) as u64
}

/// Four levels of the tree of flips are 1 + 2 + 4 + 8 random bits. All 2^15 states must be equally
/// frequent over the keys; 2^20 of them find frequencies that are off by 10 % in half of the
/// states.
#[test]
fn all_trees_of_flips_are_equally_likely() {
    let mut counts = vec![0; 1 << 15];
    for key in 0..1 << 20 {
        let points = owen(key);
        let mut state = 0;
        for level in 0..4 {
            for parent in 0..1_u64 << level {
                let digits = parent << (53 - level);
                let flip = (scrambled(&points, digits) >> (52 - level)) & 1;
                state = 2 * state + flip as usize;
            }
        }
        counts[state] += 1;
    }
    assert_uniform(&counts, "trees of flips");
}

/// Two points whose digits first differ at `place`: the five digits after it are uniform in both
/// scrambled points, and jointly so. 2^16 keys a place find joint frequencies that are off by 8 %
/// in half of the 1024 cells.
#[test]
fn pairs_of_points_are_jointly_uniform() {
    for place in 0..48_u64 {
        for base in [0, 0x000c_aba5_1234_5678] {
            let mut counts = vec![0; 1 << 10];
            for key in 0..1 << 16 {
                let points = owen(stream_key(key, 7, base));
                let after = |digits| (scrambled(&points, digits) >> (47 - place) & 31) as usize;
                counts[32 * after(base) + after(base ^ (1 << (52 - place)))] += 1;
            }
            assert_uniform(&counts, &format!("pairs that part at digit {place}"));
        }
    }
}

/// A digit's flip must change in half of all keys when any one digit before it changes, and never
/// when a later digit does. 53 x 52 / 2 pairs, 4096 keys each: the family rejects a pair whose
/// frequency is off by 0.05.
#[test]
fn each_flip_depends_on_all_digits_before_it() {
    const KEYS: u64 = 4096;
    let bound = f64::sqrt(2.0 * libm::log(1378.0 / SIGNIFICANCE)) * 0.5 * (KEYS as f64).sqrt();
    for base in [0, 0x0015_5555_5555_5555] {
        for changed in 0..53 {
            let mut changes = [0_u64; 53];
            for key in 0..KEYS {
                let points = owen(stream_key(key, changed, base));
                let other = base ^ (1 << changed);
                let flips = scrambled(&points, base) ^ base ^ scrambled(&points, other) ^ other;
                assert_eq!(flips >> changed, 0, "a flip depends on digits after it");
                for (bit, changes) in changes.iter_mut().enumerate() {
                    *changes += (flips >> bit) & 1;
                }
            }
            for (bit, changes) in changes.iter().enumerate().take(changed as usize) {
                let excess = (*changes as f64 - 0.5 * KEYS as f64).abs();
                assert!(excess < bound, "bit {bit} on bit {changed}: {changes} of {KEYS}");
            }
        }
    }
}

/// Pairs of dimensions, and pairs of neighbouring keys without hashing, flip independently: 8
/// digits of one point in two scrambles are uniform over 2^8 differences.
#[test]
fn dimensions_and_keys_scramble_independently() {
    let first_digits =
        |points: &PointSet, dimension| (points.coordinate(0, dimension) * 256.0) as usize;
    for other in [1, 2, 3, 64, 1023] {
        let (mut by_dimension, mut by_key) = ([0; 256], [0; 256]);
        for key in 0..1 << 16 {
            let digits = first_digits(&owen(key), 0);
            by_dimension[digits ^ first_digits(&owen(key), other)] += 1;
            by_key[digits ^ first_digits(&owen(key ^ u64::from(other)), 0)] += 1;
        }
        // Each unordered pair of keys is met twice.
        let by_key = by_key.map(|count| count / 2);
        assert_uniform(&by_dimension, "differences of dimensions");
        assert_uniform(&by_key, "differences of keys");
    }
}

/// The mean of x over N scrambled points has the variance N^-3 / 12: in each of the N parts one
/// point, uniform and independent. 40 000 keys: the standard error of the variance is 0.7 %, an
/// error of 3.5 % is found.
#[test]
fn variance_is_that_of_independent_strata() {
    for count in [1_u64, 16, 64] {
        let squares: Vec<f64> = (0..40_000)
            .map(|seed| {
                let points = sobol(Randomization::Owen, seed);
                let sum: f64 = (0..count).map(|index| points.coordinate(index, 2) - 0.5).sum();
                12.0 * sum * sum * count as f64
            })
            .collect();
        let SampleMean { mean, standard_error: error } = sample_mean(&squares);
        assert_mean(mean, 1.0, error, "relative variance of the mean");
    }
}

/// The slow twin: exact nested scrambling, each flip a hash of all digits before it, 20 levels
/// deep. The mean squared error of an integral over 64 points in four dimensions must be the same;
/// 20 000 keys find a difference of 10 %.
#[test]
fn errors_are_those_of_exact_nested_scrambling() {
    let plain = sobol(Randomization::None, 0);
    let squared_error = |coordinate: &dyn Fn(u64, u32) -> f64| {
        let value =
            |index| (0..4).map(|d| coordinate(index, d)).map(|x| 3.0 * x * x).product::<f64>();
        let error = (0..64).map(value).sum::<f64>() / 64.0 - 1.0;
        error * error
    };
    let errors = |exact: bool| -> Vec<f64> {
        (0..20_000)
            .map(|seed| {
                let hashed = sobol(Randomization::Owen, seed);
                squared_error(&|index, d| {
                    if exact {
                        exactly_scrambled(plain.coordinate(index, d), seed, d)
                    } else {
                        hashed.coordinate(index, d)
                    }
                })
            })
            .collect()
    };
    let SampleMean { mean: exact, standard_error: exact_error } = sample_mean(&errors(true));
    let SampleMean { mean: hashed, standard_error: hashed_error } = sample_mean(&errors(false));
    println!("mean squared errors: exact {exact:e}, hashed {hashed:e}");
    let error = (exact_error * exact_error + hashed_error * hashed_error).sqrt();
    assert!(error < 0.02 * exact);
    assert_mean(hashed, exact, error, "mean squared error");
}

fn exactly_scrambled(x: f64, seed: u64, dimension: u32) -> f64 {
    const LEVELS: u32 = 20;
    let digits = (x * f64::from(1 << LEVELS)) as u32;
    let mut flipped = digits;
    for level in 0..LEVELS {
        let node = 1 << level | digits >> (LEVELS - level);
        let flip = (stream_key(seed, node, u64::from(dimension)) >> 63) as u32;
        flipped ^= flip << (LEVELS - 1 - level);
    }
    (f64::from(flipped) + 0.5) / f64::from(1 << LEVELS)
}
