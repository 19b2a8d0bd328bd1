//! Coherent groups: a partition of the indices whose members lie close together.

use quasilux_sampling::{
    CoherentGroups, PointSet, Randomization, Sequence, SharedDigits, stream_key,
};

const SEQUENCES: [Sequence; 3] = [Sequence::Sobol, Sequence::Halton, Sequence::Faure4];
const RANDOMIZATIONS: [Randomization; 4] = [
    Randomization::None,
    Randomization::CranleyPattersonRotation,
    Randomization::DigitalShift,
    Randomization::Owen,
];

/// The inequality |Phi_b(i) - Phi_b(i + n b^k)| < b^-k and its like for matrices, measured; and
/// each index once, whether or not the count is a multiple of the number of groups. Of Hammersley's
/// points the dimensions with digits, which begin at 1.
#[test]
fn groups_are_a_partition_within_the_bound() {
    let hammersley = Sequence::Hammersley { points: 4096 };
    for (sequence, first) in
        SEQUENCES.map(|sequence| (sequence, 0)).into_iter().chain([(hammersley, 1)])
    {
        for randomization in RANDOMIZATIONS {
            let points = PointSet::new(sequence, randomization, stream_key(1, 0, 0));
            for (count, digits) in
                [(4096, [3, 2, 2]), (5000, [2, 3, 1]), (1, [1, 1, 1]), (0, [2, 0, 0])]
            {
                let shared: Vec<SharedDigits> = (first..)
                    .zip(digits)
                    .map(|(dimension, digits)| SharedDigits { dimension, digits })
                    .collect();
                let groups = CoherentGroups::new(&points, count, &shared).expect("groups");
                for number in 0..groups.len() {
                    for (spread, bound) in
                        groups.spreads(&points, number).iter().zip(groups.bounds())
                    {
                        assert!(*spread < bound, "{points:?}, group {number}: {spread} of {bound}");
                    }
                }
                let mut indices: Vec<u64> = groups.indices().collect();
                indices.sort_unstable();
                assert_eq!(indices, (0..count).collect::<Vec<_>>(), "{points:?}");
            }
        }
    }
}

/// Rotation carries groups over the end of the axis: there the smallest and the largest coordinate
/// lie at either end, and the arc between them is short.
#[test]
fn spreads_under_rotation_wrap_around() {
    for sequence in SEQUENCES {
        let points =
            PointSet::new(sequence, Randomization::CranleyPattersonRotation, stream_key(1, 0, 0));
        let shared = [SharedDigits { dimension: 1, digits: 2 }];
        let groups = CoherentGroups::new(&points, 1 << 12, &shared).expect("groups");
        let wide = |number: &u64| {
            let coordinates: Vec<f64> =
                groups.group(*number).map(|index| points.coordinate(index, 1)).collect();
            coordinates.iter().any(|u| *u < 0.1) && coordinates.iter().any(|u| *u > 0.9)
        };
        let wide: Vec<u64> = (0..groups.len()).filter(wide).collect();
        assert_eq!(wide.len(), 1, "{sequence:?}");
        let (spread, bound) = (groups.spreads(&points, wide[0])[0], groups.bounds()[0]);
        assert!(spread < bound && spread > 0.9 * bound, "{sequence:?}: {spread} of {bound}");
    }
}

/// 2^63 indices are the most: one more and none are given, rather than a part of them.
#[test]
fn more_indices_than_2_to_the_63_have_no_groups() {
    for sequence in SEQUENCES {
        let points = PointSet::new(sequence, Randomization::None, 0);
        let shared = [SharedDigits { dimension: 0, digits: 1 }];
        let groups = |count| CoherentGroups::new(&points, count, &shared);
        assert_eq!(groups(1 << 63).expect("groups").group(1).take(3).count(), 3);
        assert!(groups((1 << 63) + 1).is_none() && groups(u64::MAX).is_none());
        assert!(CoherentGroups::with_size(&points, u64::MAX, &[0], 32).is_none());
    }
}

/// The bound is sharp to a factor of two: nothing closer could be promised.
#[test]
fn the_bound_is_nearly_reached() {
    for sequence in SEQUENCES {
        let points = PointSet::new(sequence, Randomization::None, 0);
        let shared = [0, 1].map(|dimension| SharedDigits { dimension, digits: 2 });
        let groups = CoherentGroups::new(&points, 1 << 14, &shared).expect("groups");
        let mut largest = [0.0_f64; 2];
        for number in 0..groups.len() {
            for (largest, spread) in largest.iter_mut().zip(groups.spreads(&points, number)) {
                *largest = largest.max(spread);
            }
        }
        println!("{}: spreads {largest:?} within {:?}", sequence.name(), groups.bounds());
        assert!(largest.iter().zip(groups.bounds()).all(|(largest, bound)| *largest > 0.5 * bound));
    }
}

/// Groups that follow each other make up a group of a coarser partition: in base 2 for all that are
/// a power of two larger, in Halton's bases for those that the divisions pass through.
#[test]
fn neighbouring_groups_are_close() {
    for sequence in SEQUENCES {
        let points = PointSet::new(sequence, Randomization::Owen, stream_key(1, 0, 0));
        let of_size =
            |size| CoherentGroups::with_size(&points, 1 << 14, &[0, 1], size).expect("groups");
        let fine = of_size(16);
        for size in [64, 300, 4096] {
            let coarse = of_size(size);
            let each = fine.len() / coarse.len();
            assert!(each > 1 && fine.len() % coarse.len() == 0, "{sequence:?}, {size}");
            for number in 0..coarse.len() {
                let parts = number * each..(number + 1) * each;
                let mut together: Vec<u64> = parts.flat_map(|part| fine.group(part)).collect();
                let mut whole: Vec<u64> = coarse.group(number).collect();
                together.sort_unstable();
                whole.sort_unstable();
                assert_eq!(together, whole, "{sequence:?}, {size}, group {number}");
            }
        }
    }
}

/// Groups of a wanted size are at most the largest base larger, and narrower than chance.
#[test]
fn groups_have_the_size_that_was_asked_for() {
    for sequence in SEQUENCES {
        let points = PointSet::new(sequence, Randomization::Owen, stream_key(1, 0, 0));
        for size in [1, 16, 100, 1 << 14, 1 << 20] {
            let groups =
                CoherentGroups::with_size(&points, 1 << 14, &[0, 1, 2], size).expect("groups");
            let members = (1 << 14) / groups.len();
            assert!(members >= size.min(1 << 14), "{sequence:?}, {size}: {members}");
            assert!(members <= 10 * size, "{sequence:?}, {size}: {members}");
            assert_eq!(groups.indices().count(), 1 << 14);
        }
    }
}

#[test]
fn what_has_no_digits_has_no_groups() {
    let groups = |sequence, dimension, digits| {
        let points = PointSet::new(sequence, Randomization::None, 0);
        CoherentGroups::new(&points, 100, &[SharedDigits { dimension, digits }])
    };
    assert!(groups(Sequence::Independent, 0, 1).is_none());
    assert!(groups(Sequence::Hammersley { points: 100 }, 0, 1).is_none());
    assert!(groups(Sequence::Hammersley { points: 100 }, 1, 1).is_some());
    assert!(groups(Sequence::Halton, 1, 64).is_none());
    assert!(groups(Sequence::Sobol, 1024, 1).is_none());
    let far = groups(Sequence::Sobol, 0, u32::MAX).expect("groups");
    assert_eq!(far.group(u64::MAX).count(), 0);
}
