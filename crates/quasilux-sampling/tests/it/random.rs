//! The counter-based generator: uniform, and without memory along indices, dimensions and keys.

use quasilux_sampling::{PointSet, Randomization, Sequence, stream_key};

use crate::support::{assert_mean, assert_uniform, cell, random};

const COUNT: u64 = 1 << 20;

/// 1024 cells, 2^20 points: detects densities that are off by 2 % in half of the cells.
#[test]
fn coordinates_are_uniform() {
    for dimension in [0, 1, 5, 1000, u32::MAX] {
        let points = random(1);
        let mut counts = vec![0; 1024];
        for index in 0..COUNT {
            counts[cell(points.coordinate(index, dimension), 1024)] += 1;
        }
        assert_uniform(&counts, &format!("dimension {dimension}"));
    }
}

/// Pairs of neighbours along each axis fill 64 x 64 cells and have no correlation; 2^20 pairs find
/// one of 0.005.
#[test]
fn neighbours_are_independent() {
    let here = random(2);
    let key = stream_key(2, 0, 0);
    let next_key = PointSet::new(Sequence::Independent, Randomization::None, key + 1);
    type Neighbour<'a> = (&'a str, &'a dyn Fn(u64) -> f64);
    let neighbours: [Neighbour<'_>; 6] = [
        ("next index", &|index| here.coordinate(index + 1, 3)),
        ("index + 2^32", &|index| here.coordinate(index + (1 << 32), 3)),
        ("next dimension", &|index| here.coordinate(index, 4)),
        ("dimension + 2^16", &|index| here.coordinate(index, 3 + (1 << 16))),
        ("next key", &|index| next_key.coordinate(index, 3)),
        ("next index and dimension", &|index| here.coordinate(index + 1, 4)),
    ];
    for (name, neighbour) in neighbours {
        let mut counts = vec![0; 64 * 64];
        let mut products = 0.0;
        for index in 0..COUNT {
            let (x, y) = (here.coordinate(index, 3), neighbour(index));
            counts[64 * cell(x, 64) + cell(y, 64)] += 1;
            products += (x - 0.5) * (y - 0.5);
        }
        assert_uniform(&counts, name);
        let correlation = 12.0 * products / COUNT as f64;
        assert_mean(correlation, 0.0, 1.0 / (COUNT as f64).sqrt(), name);
    }
}

/// Points along the dimensions at a fixed index, as one path sees them.
#[test]
fn dimensions_of_one_point_are_uniform() {
    let points = random(3);
    for index in [0, 1, u64::MAX] {
        let mut counts = vec![0; 256 * 16];
        for dimension in 0..COUNT as u32 {
            let u = points.coordinate(index, dimension);
            counts[16 * cell(u, 256) + cell((u * 256.0).fract(), 16)] += 1;
        }
        assert_uniform(&counts, &format!("dimensions of point {index}"));
    }
}

/// Keys of a 64 x 64 x 64 cube of small numbers are distinct and their bits are even.
#[test]
fn stream_keys_are_spread() {
    let mut keys = Vec::new();
    for seed in 0..64 {
        for replicate in 0..64 {
            keys.extend((0..64).map(|stream| stream_key(seed, replicate, stream)));
        }
    }
    let mut low = vec![0; 1 << 12];
    let mut high = vec![0; 1 << 12];
    let mut differences = vec![0; 1 << 12];
    for pair in keys.chunks(2) {
        low[(pair[0] & 0xfff) as usize] += 1;
        high[(pair[0] >> 52) as usize] += 1;
        differences[((pair[0] ^ pair[1]) >> 30 & 0xfff) as usize] += 1;
    }
    assert_uniform(&low, "low bits");
    assert_uniform(&high, "high bits");
    assert_uniform(&differences, "differences of neighbours");
    keys.sort_unstable();
    keys.dedup();
    assert_eq!(keys.len(), 64 * 64 * 64);
}
