//! The (0, 4)-sequence in base 4.

use quasilux_sampling::{PointSet, Randomization, Sequence, stream_key};

use crate::support::cell;

/// One point in each elementary box of 4^-a x 4^-b x 4^-c x 4^-d of each aligned block of 4^m, for
/// all a + b + c + d = m <= 5, near and far; and one in each of 2^m parts of each axis.
#[test]
fn four_dimensions_are_exact_nets() {
    for randomization in [Randomization::None, Randomization::Shift, Randomization::Owen] {
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

fn shapes(m: u32) -> Vec<[u32; 4]> {
    let digits = |code: u32| [code % 8, code / 8 % 8, code / 64 % 8, code / 512];
    (0..4096).map(digits).filter(|shape| shape.iter().sum::<u32>() == m).collect()
}

/// Dimensions of different blocks of four are shuffled apart: in 16 x 16 cells a diagonal would
/// leave 240 empty, independent pairs put 64 +- 8 in each.
#[test]
fn blocks_of_four_are_independent() {
    for randomization in [Randomization::None, Randomization::Rotation, Randomization::Owen] {
        let points = PointSet::new(Sequence::Faure4, randomization, stream_key(2, 0, 0));
        for (first, second) in [(0, 4), (3, 7), (0, 5), (4, 8), (1, 4001)] {
            let mut counts = [0_u64; 256];
            for index in 0..1 << 14 {
                let x = cell(points.coordinate(index, first), 16);
                counts[16 * x + cell(points.coordinate(index, second), 16)] += 1;
            }
            assert!(counts.iter().all(|count| (17..128).contains(count)), "{first}, {second}");
        }
    }
}
