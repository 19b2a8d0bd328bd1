//! Points varied in some dimensions: the others keep their bits, one by one and in lists.

use quasilux_sampling::{PointSet, Randomization, Sampler, Sequence};

/// Past the last dimension of each sequence's own, too.
const DIMENSIONS: [u32; 8] = [0, 1, 2, 3, 4, 5, 1023, 1024];

fn sets() -> impl Iterator<Item = [PointSet; 2]> {
    let sequences = [
        Sequence::Sobol,
        Sequence::Halton,
        Sequence::Hammersley { points: 100 },
        Sequence::Faure4,
        Sequence::Independent,
    ];
    let randomizations = [
        Randomization::Owen,
        Randomization::DigitalShift,
        Randomization::CranleyPattersonRotation,
        Randomization::None,
    ];
    sequences.into_iter().flat_map(move |sequence| {
        randomizations
            .map(|randomization| [3, 4].map(|key| PointSet::new(sequence, randomization, key)))
    })
}

#[test]
fn exchanged_dimensions_come_from_the_other_set() {
    for [points, others] in sets() {
        let mixed = points.exchanged(2..5, 4);
        for (index, dimension) in (0..40).flat_map(|i| DIMENSIONS.map(|d| (i * 7, d))) {
            let from = if (2..5).contains(&dimension) { others } else { points };
            let wanted = from.coordinate(index, dimension);
            assert_eq!(mixed.coordinate(index, dimension), wanted, "{points:?} {dimension}");
        }
    }
}

#[test]
fn exchanging_all_and_nothing() {
    for [points, others] in sets() {
        let (all, nothing) = (points.exchanged(0..u32::MAX, 4), points.exchanged(3..3, 4));
        for dimension in DIMENSIONS {
            assert_eq!(all.coordinate(9, dimension), others.coordinate(9, dimension));
            assert_eq!(nothing.coordinate(9, dimension), points.coordinate(9, dimension));
        }
    }
}

#[test]
fn moved_coordinates_stay_inside_and_the_others_in_place() {
    for [points, _] in sets() {
        let moved = points.moved(1..4, 0.125);
        for (index, dimension) in (0..40).flat_map(|i| DIMENSIONS.map(|d| (i, d))) {
            let [before, after] = [points, moved].map(|points| points.coordinate(index, dimension));
            let step = if (1..4).contains(&dimension) { 0.125 } else { 0.0 };
            let moved = (after - before).abs();
            assert!((moved - step).abs() < 1e-15, "{points:?} {dimension}: {moved}");
            assert!((0.0..1.0).contains(&after));
        }
    }
}

#[test]
fn lists_and_cursors_give_the_same_bits() {
    for [points, _] in sets() {
        for varied in [points.exchanged(1..3, 4), points.moved(1..3, 0.25)] {
            let mut list = [0.0; 64];
            for dimension in 0..4 {
                varied.fill(dimension, 5, &mut list);
                let wanted: Vec<f64> = (5..69).map(|i| varied.coordinate(i, dimension)).collect();
                assert_eq!(list[..], wanted);
                varied.fill_at(dimension, &[9, 6], &mut list[..2]);
                assert_eq!(list[..2], [9, 6].map(|i| varied.coordinate(i, dimension)));
            }
            let mut sampler = Sampler::new(&varied, 11);
            let handed_out = [(); 4].map(|()| sampler.next_1d());
            assert_eq!(handed_out, [0, 1, 2, 3].map(|d| varied.coordinate(11, d)));
        }
    }
}

/// What a split sample's children draw is their own: no dimension of theirs is varied.
#[test]
fn children_are_those_of_the_original() {
    for [points, _] in sets() {
        let varied = points.exchanged(0..3, 4);
        let [child, original] = [&varied, &points].map(|points| Sampler::new(points, 5).child(1));
        let [drawn, wanted] =
            [child, original].map(|mut sampler| [(); 4].map(|()| sampler.next_1d()));
        assert_eq!(drawn, wanted, "{points:?}");
    }
}
