//! The (0, 4)-sequence in base 4.

use quasilux_sampling::{PointSet, Randomization, Sequence, stream_key};

use crate::support::{assert_pairs_are_shuffled, cell};

/// One point in each elementary box of 4^-a x 4^-b x 4^-c x 4^-d of each aligned block of 4^m, for
/// all a + b + c + d = m <= 5, near and far; and one in each of 2^m parts of each axis.
#[test]
fn four_dimensions_are_exact_nets() {
    for randomization in [Randomization::None, Randomization::DigitalShift, Randomization::Owen] {
        let points = PointSet::new(Sequence::Faure4, randomization, stream_key(2, 0, 0));
        for (m, block) in [(1_u32, 0), (2, 3), (3, 0), (4, 1 << 30), (5, 0), (5, 77)] {
            let count = 1_u64 << (2 * m);
            for dimensions in [[0, 1, 2, 3], [8, 9, 10, 11]] {
                let block: Vec<[f64; 4]> = (block * count..(block + 1) * count)
                    .map(|index| dimensions.map(|d| points.coordinate(index, d)))
                    .collect();
                for shape in shapes(m) {
                    let mut seen = vec![false; count as usize];
                    for point in &block {
                        let place = point.iter().zip(shape).fold(0, |place, (x, digits)| {
                            (place << (2 * digits)) + cell(*x, 1 << (2 * digits))
                        });
                        assert!(!seen[place], "two points in a box of {shape:?}");
                        seen[place] = true;
                    }
                }
            }
        }
    }
}

/// The definition without matrices: the base-4 digits of the index are the coefficients of a
/// polynomial f over the field, those of coordinate x the coefficients of f(z + x), by repeated
/// division by z + x (Horner); the digit a + b w stands for a / 2 + b / 4.
#[test]
fn equals_the_taylor_shift_of_the_index() {
    const PRODUCTS: [[u64; 4]; 4] = [[0, 0, 0, 0], [0, 1, 2, 3], [0, 2, 3, 1], [0, 3, 1, 2]];
    let slow_coordinate = |index: u64, x: usize| {
        let mut digits: Vec<u64> = (0..20).map(|place| (index >> (2 * place)) & 3).collect();
        for divided in 0..digits.len() {
            for place in (divided..digits.len() - 1).rev() {
                digits[place] ^= PRODUCTS[x][digits[place + 1] as usize];
            }
        }
        let value = |digit: &u64| (2 * (digit & 1) + (digit >> 1)) as f64;
        digits.iter().rev().fold(0.0, |sum, digit| (sum + value(digit)) / 4.0)
    };
    let points = PointSet::new(Sequence::Faure4, Randomization::None, 0);
    for step in 0..4000 {
        let index = (stream_key(step, 0, 0) >> 24) >> (step % 40);
        for x in 0..4 {
            let (fast, slow) = (points.coordinate(index, x), slow_coordinate(index, x as usize));
            assert_eq!(fast, slow, "point {index}, coordinate {x}");
        }
    }
}

fn shapes(m: u32) -> Vec<[u32; 4]> {
    let digits = |code: u32| [code % 8, code / 8 % 8, code / 64 % 8, code / 512];
    (0..4096).map(digits).filter(|shape| shape.iter().sum::<u32>() == m).collect()
}

/// Dimensions of different blocks of four are shuffled apart.
#[test]
fn blocks_of_four_are_independent() {
    let pairs = [[0, 4], [3, 7], [0, 5], [4, 8], [1, 4001]];
    assert_pairs_are_shuffled(Sequence::Faure4, &pairs);
}
