//! The same seed gives the same points on every machine: a table of their bits.
//!
//! The test prints the table where it differs; a change of it changes every result.

use quasilux_sampling::{PointSet, Randomization, Sequence, stream_key};

const GOLDEN: &str = include_str!("golden/randomised_points.txt");
const INDICES: [u64; 3] = [1, 12_345, (1 << 40) + 7];
/// The first ones, bases and copies far out, and what comes past the last base.
const DIMENSIONS: [u32; 5] = [0, 1, 3, 1000, 5000];

/// One line for each sequence, randomisation and index: the bits of its coordinates.
fn table() -> Vec<String> {
    let mut lines = Vec::new();
    for sequence in Sequence::all_for(20_000) {
        let name = sequence.name();
        for randomization in Randomization::ALL {
            let randomization_name = randomization.name();
            let points = PointSet::new(sequence, randomization, stream_key(2026, 3, 1));
            for index in INDICES {
                let bits =
                    DIMENSIONS.map(|d| format!("{:016x}", points.coordinate(index, d).to_bits()));
                lines.push(format!("{name} {randomization_name} {index}: {}", bits.join(" ")));
            }
        }
    }
    lines
}

#[test]
fn are_those_of_the_table() {
    let golden: Vec<&str> = GOLDEN.lines().filter(|line| !line.starts_with('#')).collect();
    let table = table();
    assert!(table == golden, "the points have changed; they are now\n{}", table.join("\n"));
}
