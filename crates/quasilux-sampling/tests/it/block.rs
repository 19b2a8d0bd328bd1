//! Blocks: bit for bit what random access gives.

use quasilux_sampling::{PointSet, Randomization, Sequence, stream_key};

/// Random first indices up to 2^40 and at the end of all indices, lengths that end within aligned
/// blocks, dimensions before and after padding begins.
#[test]
fn blocks_equal_random_access() {
    let mut lengths = [0, 1, 7, 31, 32, 33, 255, 256, 257, 1000].into_iter().cycle();
    for sequence in Sequence::all_for(12_345) {
        for randomization in Randomization::ALL {
            let points = PointSet::new(sequence, randomization, stream_key(3, 0, 0));
            for dimension in [0, 1, 3, 4, 100, 1023, 1024, 5000, u32::MAX] {
                for step in 0..10 {
                    let random = stream_key(7, step, u64::from(dimension));
                    let first = if step == 0 { u64::MAX - 300 } else { random >> (24 + step) };
                    let mut block = vec![-1.0; lengths.next().expect("a cycle")];
                    points.fill(dimension, first, &mut block);
                    for (offset, coordinate) in (0..).zip(&block) {
                        let index = first.wrapping_add(offset);
                        let single = points.coordinate(index, dimension);
                        assert_eq!(*coordinate, single, "{points:?}: {index}, {dimension}");
                    }
                }
            }
        }
    }
}

/// Indices in any order and of any size, as many as end within blocks; room without an index stays
/// as it is.
#[test]
fn lists_equal_random_access() {
    for sequence in Sequence::all_for(12_345) {
        for randomization in Randomization::ALL {
            let points = PointSet::new(sequence, randomization, stream_key(3, 0, 0));
            for dimension in [0, 1, 4, 1023, 1024, u32::MAX] {
                for count in [0, 1, 33, 256, 600] {
                    let index = |step| stream_key(9, step, 0) >> (step % 64);
                    let indices: Vec<u64> = (0..count).map(index).collect();
                    let mut list = vec![-1.0; indices.len() + 2];
                    points.fill_at(dimension, &indices, &mut list);
                    for (index, coordinate) in indices.iter().zip(&list) {
                        let single = points.coordinate(*index, dimension);
                        assert_eq!(*coordinate, single, "{points:?}: {index}, {dimension}");
                    }
                    assert_eq!(list[indices.len()..], [-1.0; 2]);
                }
            }
        }
    }
}

#[test]
fn columns_are_dimensions() {
    let points = PointSet::new(Sequence::Sobol, Randomization::Owen, stream_key(3, 0, 0));
    let mut columns = vec![0.0; 5 * 300];
    points.fill_dimensions(1022, 99, columns.chunks_mut(300));
    for (place, coordinate) in columns.iter().enumerate() {
        let (dimension, index) = (1022 + place as u32 / 300, 99 + place as u64 % 300);
        assert_eq!(*coordinate, points.coordinate(index, dimension));
    }
    // The last dimension is the last.
    points.fill_dimensions(u32::MAX, 0, columns.chunks_mut(300));
    assert_eq!(columns[300], points.coordinate(99, 1023));
}
