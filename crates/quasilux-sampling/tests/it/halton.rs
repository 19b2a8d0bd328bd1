//! Halton's sequence, Hammersley's points and their randomisations, against scipy and by their
//! defining properties.

use quasilux_sampling::{PointSet, Randomization, Sequence, radical_inverse, stream_key};

use crate::support::{assert_uniform, cell};

const GOLDEN: &str = include_str!("golden/halton_scipy.txt");

fn halton(randomization: Randomization, seed: u64) -> PointSet {
    PointSet::new(Sequence::Halton, randomization, stream_key(seed, 0, 0))
}

#[test]
fn equals_scipy() {
    let mut points = 0;
    for line in GOLDEN.lines().filter(|line| !line.starts_with('#')) {
        let (head, numbers) = line.split_once(": ").expect("a colon");
        let index: u64 = head["point ".len()..].parse().expect("a number");
        for (dimension, field) in (0..).zip(numbers.split(' ')) {
            let ours = halton(Randomization::None, 0).coordinate(index, dimension);
            let theirs: f64 = field.parse().expect("a number");
            assert!((ours - theirs).abs() <= 1e-15, "point {index}, dimension {dimension}");
        }
        points += 1;
    }
    assert_eq!(points, 22);
}

/// Aligned blocks of b^k put one point into each of b^k parts, also far out, and the blocks of the
/// product of two bases one into each box: digit randomisations keep the digits' evenness.
#[test]
fn digit_randomisations_keep_the_nets() {
    for randomization in [Randomization::None, Randomization::DigitalShift, Randomization::Owen] {
        let points = halton(randomization, 3);
        for (dimension, base, digits) in
            [(0, 2_u64, 10), (1, 3, 6), (2, 5, 4), (9, 29, 2), (30, 127, 1)]
        {
            let count = base.pow(digits);
            for offset in [0, 7 * count, (1 << 40) / count * count] {
                let mut seen = vec![false; count as usize];
                for index in offset..offset + count {
                    // Quotients like 2 / 3 may be rounded down.
                    let u = points.coordinate(index, dimension) + 1e-15;
                    seen[cell(u.min(1.0 - 1e-16), count as usize)] = true;
                }
                assert!(seen.iter().all(|seen| *seen), "base {base}, {randomization:?}");
            }
        }
        let mut boxes = [false; 72];
        for index in 0..72 {
            let [x, y] = [0, 1].map(|d| (points.coordinate(index, d) + 1e-15).min(1.0 - 1e-16));
            boxes[9 * cell(x, 8) + cell(y, 9)] = true;
        }
        assert!(boxes.iter().all(|seen| *seen), "8 x 9 boxes, {randomization:?}");
    }
}

/// Two points of one dimension under nested permutations: where their digits first differ the
/// images are any two different digits with equal probability, and what follows is independent.
/// 2^16 keys, 6 x 9 x 9 cells in base 3: finds frequencies that are off by 10 % in half of them.
#[test]
fn pairs_under_nested_permutations_are_jointly_uniform() {
    for (index, other) in [(0, 1), (1, 2), (5, 5 + 9), (5, 5 + 2 * 27), (80, 80 + (1 << 4) * 81)] {
        let shared = {
            let (mut i, mut j, mut digits) = (index, other, 0);
            while i % 3 == j % 3 {
                (i, j, digits) = (i / 3, j / 3, digits + 1);
            }
            3_u64.pow(digits)
        };
        let mut counts = vec![0; 9 * 81];
        for seed in 0..1 << 16 {
            let points = halton(Randomization::Owen, seed);
            let digits = |index| (points.coordinate(index, 1) * (27 * shared) as f64) as usize;
            let (here, there) = (digits(index), digits(other));
            assert_eq!(here / 27, there / 27, "digits before the difference");
            let (here, there) = (here % 27, there % 27);
            counts[81 * (3 * (here / 9) + there / 9) + 9 * (here % 9) + there % 9] += 1;
        }
        let (equal, different): (Vec<_>, Vec<_>) =
            (0..9 * 81).partition(|place: &usize| [0, 4, 8].contains(&(place / 81)));
        assert!(equal.iter().all(|place| counts[*place] == 0));
        let counts: Vec<u64> = different.iter().map(|place| counts[*place]).collect();
        assert_uniform(&counts, &format!("digits of {index} and {other}"));
    }
}

/// Each coordinate of a randomised point is uniform: 2^14 seeds in 64 cells find densities that are
/// off by 10 % in half of them.
#[test]
fn each_coordinate_is_uniform_over_the_seeds() {
    let sets = [
        (Sequence::Halton, [0, 1, 5, 200, 5000]),
        (Sequence::Hammersley { points: 100 }, [0, 1, 2, 3, 5000]),
        (Sequence::Faure4, [0, 1, 2, 3, 5000]),
        (Sequence::Sobol, [0, 1, 2, 3, 5000]),
    ];
    for (sequence, dimensions) in sets {
        for randomization in [
            Randomization::CranleyPattersonRotation,
            Randomization::DigitalShift,
            Randomization::Owen,
        ] {
            for dimension in dimensions {
                let mut counts = [0; 64];
                for seed in 0..1 << 14 {
                    let points = PointSet::new(sequence, randomization, stream_key(seed, 0, 0));
                    counts[cell(points.coordinate(17, dimension), 64)] += 1;
                }
                assert_uniform(&counts, &format!("{points:?}", points = (sequence, randomization)));
            }
        }
    }
}

#[test]
fn hammersley_is_equal_steps_before_halton() {
    let sequence = Sequence::Hammersley { points: 100 };
    let points = PointSet::new(sequence, Randomization::None, 0);
    for index in 0..100 {
        let place = index as f64 / 100.0;
        let expected = [place, radical_inverse(2, index), radical_inverse(3, index)];
        assert_eq!([0, 1, 2].map(|d| points.coordinate(index, d)), expected);
    }
    assert_eq!(points.coordinate(130, 0), 0.3);
    for randomization in
        [Randomization::CranleyPattersonRotation, Randomization::DigitalShift, Randomization::Owen]
    {
        let points = PointSet::new(sequence, randomization, stream_key(5, 0, 0));
        let mut axis: Vec<f64> = (0..100).map(|index| points.coordinate(index, 0)).collect();
        axis.sort_unstable_by(f64::total_cmp);
        for (place, x) in axis.iter().enumerate() {
            assert_eq!(cell(*x, 100), place, "{randomization:?}: one point in each step");
        }
    }
}

/// Rotation adds one number modulo 1 to all points of a dimension.
#[test]
fn rotation_is_a_rotation() {
    for sequence in Sequence::all_for(1000).into_iter().filter(|it| it.name() != "random") {
        let plain = PointSet::new(sequence, Randomization::None, 0);
        let rotated =
            PointSet::new(sequence, Randomization::CranleyPattersonRotation, stream_key(9, 0, 0));
        let mut steps = Vec::new();
        for dimension in 0..4 {
            let step = |index| {
                let step =
                    rotated.coordinate(index, dimension) - plain.coordinate(index, dimension);
                if step < 0.0 { step + 1.0 } else { step }
            };
            assert!((0..1000).all(|index| (step(index) - step(0)).abs() < 1e-15), "{sequence:?}");
            steps.push(step(0));
        }
        assert!(steps[0] != steps[1] && steps[2] != steps[3], "each dimension has its own");
    }
}

/// The bases end at 8161; what follows is pseudo-random, also in pairs with what precedes.
#[test]
fn past_the_last_base_points_are_pseudo_random() {
    for randomization in [Randomization::None, Randomization::Owen] {
        let points = halton(randomization, 8);
        for (first, second) in [(0, 1024), (1024, 1025), (1, 2048)] {
            let mut counts = [0; 256];
            for index in 0..1 << 14 {
                let x = cell(points.coordinate(index, first), 16);
                counts[16 * x + cell(points.coordinate(index, second), 16)] += 1;
            }
            assert_uniform(&counts, &format!("dimensions {first}, {second}"));
        }
    }
}
