//! The Sobol' sequence: equal to scipy's, a net before and after randomisation, defined everywhere.

use quasilux_sampling::{Randomization, Sequence};

use crate::support::{assert_pairs_are_shuffled, cell, sobol};

const GOLDEN: &str = include_str!("golden/sobol_scipy.txt");
const RANDOMIZATIONS: [Randomization; 4] = [
    Randomization::None,
    Randomization::CranleyPattersonRotation,
    Randomization::DigitalShift,
    Randomization::Owen,
];
const NET_KEEPING: [Randomization; 3] =
    [Randomization::None, Randomization::DigitalShift, Randomization::Owen];

/// Coordinate of point i of scipy, which walks in Gray-code order, in units of 1/4096.
fn scipy_order(i: u64, dimension: u32) -> u64 {
    let scaled = sobol(Randomization::None, 0).coordinate(i ^ (i >> 1), dimension) * 4096.0;
    assert_eq!(scaled, scaled.floor());
    scaled as u64
}

#[test]
fn equals_scipy_for_4096_points_in_50_dimensions() {
    let (mut points, mut hashes) = (0, 0);
    for line in GOLDEN.lines().filter(|line| !line.starts_with('#')) {
        let (head, numbers) = line.split_once(": ").expect("a colon");
        let (kind, number) = head.split_once(' ').expect("a kind and a number");
        let number: u32 = number.parse().expect("a number");
        let numbers: Vec<u64> =
            numbers.split(' ').map(|field| field.parse().expect("an integer")).collect();
        if kind == "point" {
            let ours: Vec<u64> = (0..50).map(|d| scipy_order(u64::from(number), d)).collect();
            assert_eq!(ours, numbers, "point {number}");
            points += 1;
        } else {
            let fnv = |hash: u64, word: u64| (hash ^ word).wrapping_mul(1_099_511_628_211);
            let hash =
                (0..4096).map(|i| scipy_order(i, number)).fold(14_695_981_039_346_656_037, fnv);
            assert_eq!(hash, numbers[0], "dimension {number}");
            hashes += 1;
        }
    }
    assert_eq!((points, hashes), (38, 50));
}

/// Digits that were made elsewhere, here read off unrandomised coordinates, are randomised as those
/// of the sequence; `common` is added without carry.
#[test]
fn foreign_digits_are_randomised_like_own_ones() {
    let plain = sobol(Randomization::None, 0);
    for randomization in RANDOMIZATIONS {
        let points = sobol(randomization, 21);
        for dimension in [0, 1, 700] {
            let digits: Vec<u64> = (100..400)
                .map(|index| (plain.coordinate(index, dimension) * 512.0) as u64)
                .map(|word| (word << 55).reverse_bits())
                .collect();
            for common in [0, 0x5a] {
                let shifted: Vec<u64> = digits.iter().map(|digits| digits ^ common).collect();
                let mut coordinates = [2.0; 301];
                points.randomize_digits(dimension, &shifted, common, &mut coordinates);
                let expected = (100..400).map(|index| points.coordinate(index, dimension));
                assert!(coordinates[..300].iter().copied().eq(expected), "{randomization:?}");
                assert_eq!(coordinates[300], 2.0);
            }
        }
    }
}

/// Rows of any width and number equal single coordinates; more digits than places are left alone.
#[test]
fn foreign_digits_are_randomised_in_rows() {
    let plain = sobol(Randomization::None, 0);
    let digits_of = |index, dimension| {
        let word = (plain.coordinate(index, dimension) * 4096.0) as u64;
        (word << 52).reverse_bits()
    };
    for randomization in RANDOMIZATIONS {
        let points = sobol(randomization, 22);
        for width in [1, 2, 3, 5, 8, 12, 40, 67] {
            let randomizer = points.row_randomizer(9, width);
            let dimensions = 9..9 + width as u32;
            for count in [0, 1, 2, 7, 8, 60, 131] {
                let common: Vec<u64> = dimensions.clone().map(|d| digits_of(512, d)).collect();
                let point = |index| dimensions.clone().map(move |d| digits_of(index, d));
                let digits: Vec<u64> = (0..count + 3).flat_map(point).collect();
                let mut coordinates = vec![2.0; count as usize * width];
                randomizer.randomize(&digits, &common, &mut coordinates);
                let row = |index| {
                    let points = &points;
                    dimensions.clone().map(move |d| points.coordinate(512 + index, d))
                };
                let expected = (0..count).flat_map(row);
                assert!(coordinates.iter().copied().eq(expected), "{randomization:?}, {width}");
            }
        }
        points.row_randomizer(0, 0).randomize(&[1], &[], &mut [2.0]);
    }
}

/// Each elementary interval of 2^-a by 2^-(m-a) holds one point of each aligned block of 2^m: (0,
/// m, 2)-nets.
#[test]
fn first_two_dimensions_are_exact_nets() {
    for randomization in NET_KEEPING {
        let points = sobol(randomization, 11);
        for m in 0..=16_u32 {
            for block in [0, 5] {
                let offset = block << m;
                let block: Vec<[f64; 2]> = (offset..offset + (1 << m))
                    .map(|index| [points.coordinate(index, 0), points.coordinate(index, 1)])
                    .collect();
                for a in 0..=m {
                    assert_one_in_each(&block, 1 << a, 1 << (m - a));
                }
            }
        }
    }
}

fn assert_one_in_each(block: &[[f64; 2]], columns: usize, rows: usize) {
    let mut seen = vec![false; columns * rows];
    for [x, y] in block {
        let place = &mut seen[cell(*x, columns) * rows + cell(*y, rows)];
        assert!(!*place, "two points in one of {columns} x {rows} intervals");
        *place = true;
    }
}

/// Past 2^40 points, in all dimensions and past the last: aligned blocks of 2^10 put one point in
/// each of 2^10 parts.
#[test]
fn every_dimension_is_stratified_far_out() {
    for randomization in NET_KEEPING {
        let points = sobol(randomization, 3);
        for dimension in (0..3000).chain([u32::MAX]) {
            let offset = (1 << 40) + (u64::from(dimension) << 10);
            let mut seen = [false; 1024];
            for index in offset..offset + 1024 {
                seen[cell(points.coordinate(index, dimension), 1024)] = true;
            }
            assert!(seen.iter().all(|seen| *seen), "dimension {dimension}, {randomization:?}");
        }
    }
}

/// Dimension j and its copies j + 1024 k share digits; shuffled and scrambled, their pairs must
/// fill the square.
#[test]
fn padding_is_independent() {
    let pairs = [[0, 1024], [1, 1025], [7, 2055], [1030, 2054], [0, 1025], [1024, 3072]];
    assert_pairs_are_shuffled(Sequence::Sobol, &pairs);
}

#[test]
fn extreme_arguments_have_coordinates() {
    for sequence in [0, 1, 1000, u64::MAX].into_iter().flat_map(Sequence::all_for) {
        for randomization in RANDOMIZATIONS {
            let points = quasilux_sampling::PointSet::new(sequence, randomization, u64::MAX);
            for index in [0, 1, 1 << 52, 1 << 63, u64::MAX] {
                for dimension in [0, 1023, 1024, 1 << 31, u32::MAX] {
                    cell(points.coordinate(index, dimension), 1);
                }
            }
        }
    }
    assert!((0..1024).all(|d| sobol(Randomization::None, 9).coordinate(0, d) == 0.0));
}

/// Every name is read back as what it names, and nothing close to a name is.
#[test]
fn names_are_read_back() {
    for sequence in Sequence::all_for(7) {
        let name = sequence.name();
        assert_eq!(sequence.to_string().parse(), Ok(sequence));
        assert_eq!(sequence.to_string().split(':').next(), Some(name));
    }
    for randomization in Randomization::ALL {
        assert_eq!(randomization.to_string().parse(), Ok(randomization));
    }
    assert_eq!(Randomization::ALL, RANDOMIZATIONS);
    for wrong in ["", "Sobol", "sobol ", "hammersley", "hammersley:", "hammersley:-1"] {
        assert!(wrong.parse::<Sequence>().is_err(), "{wrong}");
        assert!(wrong.parse::<Randomization>().is_err(), "{wrong}");
    }
}
