//! The sampler: which coordinates, and how many.

use quasilux_sampling::{DimensionHistogram, Discrete, Randomization, Sampler};

use crate::support::sobol;

#[test]
fn hands_out_coordinates_in_order() {
    let points = sobol(Randomization::Owen, 1);
    let mut sampler = Sampler::new(&points, 77);
    let coordinates = [sampler.next_1d(), sampler.next_2d()[0], sampler.clone().next_1d()];
    assert_eq!(coordinates, [0, 1, 3].map(|dimension| points.coordinate(77, dimension)));
    assert_eq!((sampler.used(), sampler.dimension()), (3, 3));
}

#[test]
fn skips_forward_only_and_counts_what_it_gives() {
    let points = sobol(Randomization::Owen, 1);
    let mut sampler = Sampler::new(&points, 5);
    sampler.skip_to(4);
    assert_eq!((sampler.used(), sampler.dimension()), (0, 4));
    assert_eq!(sampler.next_1d(), points.coordinate(5, 4));
    sampler.skip_to(2);
    assert_eq!(sampler.next_1d(), points.coordinate(5, 5));
    assert_eq!((sampler.used(), sampler.dimension()), (2, 6));
}

/// Choices of one coordinate are the digits of its superposition; a fresh one begins after eight
/// bits, whatever was chosen.
#[test]
fn choices_share_a_coordinate_up_to_its_useful_bits() {
    let points = sobol(Randomization::Owen, 2);
    for index in 0..100 {
        let mut sampler = Sampler::new(&points, index);
        let mut digits = 0;
        for _ in 0..8 {
            digits = 2 * digits + u64::from(!sampler.choose_bool(0.5));
        }
        assert_eq!(sampler.used(), 1);
        assert_eq!(digits, (points.coordinate(index, 0) * 256.0) as u64);
        assert_eq!(sampler.choose_bool(0.5), points.coordinate(index, 1) < 0.5);
        assert_eq!(sampler.next_1d(), points.coordinate(index, 2));
        sampler.close();
        assert!(sampler.choose_bool(1.0) && !sampler.choose_bool(0.0));
        assert_eq!(sampler.used(), 3);
    }
}

/// A choice among 1024 has its coordinate for itself; certain choices cost nothing; a choice
/// without a choice consumes nothing.
#[test]
fn choices_are_charged_by_their_distribution() {
    let points = sobol(Randomization::Owen, 2);
    let mut sampler = Sampler::new(&points, 3);
    assert_eq!(sampler.sample_weights([0.0].into_iter()), None);
    assert_eq!((sampler.used(), sampler.dimension()), (0, 0));
    for _ in 0..100 {
        assert!(sampler.choose_bool(1.0));
    }
    assert_eq!(sampler.used(), 0);
    let luminaires = Discrete::new(&[1.0; 1024]).expect("weights");
    let luminaire = sampler.sample_discrete(&luminaires).index;
    assert_eq!(luminaire, (points.coordinate(3, 0) * 1024.0) as usize);
    assert_eq!(sampler.used(), 1);
    let second = sampler.sample_weights([1.0, 1.0].into_iter()).expect("weights").index;
    assert_eq!(second, (points.coordinate(3, 1) * 2.0) as usize);
    assert_eq!(sampler.used(), 2);
}

/// Small choices before a large one leave it a coordinate that can tell all its entries apart, even
/// of few points that are not randomised.
#[test]
fn a_large_choice_reaches_all_its_entries() {
    let points = sobol(Randomization::None, 0);
    let luminaires = Discrete::new(&[1.0; 1024]).expect("weights");
    let mut reached = vec![false; 1024];
    for index in 0..4096 {
        let mut sampler = Sampler::new(&points, index);
        for _ in 0..7 {
            sampler.choose_bool(0.5);
        }
        reached[sampler.sample_discrete(&luminaires).index] = true;
        let direction = sampler.remapped_1d();
        assert_eq!(direction, points.coordinate(index, 2), "ten bits are too many to share");
    }
    assert!(reached.iter().all(|reached| *reached));
}

/// A leading choice among 1024 goes on, renormalised, to what hangs on it; what follows has another
/// coordinate.
#[test]
fn a_leading_choice_goes_on_whatever_its_bits() {
    let points = sobol(Randomization::Owen, 2);
    let luminaires = Discrete::new(&[1.0; 1024]).expect("weights");
    for index in 0..100 {
        let mut sampler = Sampler::new(&points, index);
        let scaled = points.coordinate(index, 0) * 1024.0;
        assert_eq!(sampler.choose_leading(&luminaires).index, scaled as usize);
        assert!((sampler.remapped_1d() - scaled.fract()).abs() < 1e-12);
        assert_eq!(sampler.used(), 1);
        sampler.choose_leading(&luminaires);
        assert_eq!(sampler.choose_bool(0.5), points.coordinate(index, 2) < 0.5);
        assert_eq!(sampler.used(), 3);
    }
}

/// Whatever comes out of the choices, the next decision has the same coordinate.
#[test]
fn outcomes_do_not_move_later_decisions() {
    let points = sobol(Randomization::Owen, 3);
    let skewed = Discrete::new(&[0.001, 0.999]).expect("weights");
    for index in 0..2000 {
        let mut sampler = Sampler::new(&points, index);
        sampler.choose_bool(0.01);
        sampler.sample_discrete(&skewed);
        for _ in 0..3 {
            sampler.choose_bool(0.5);
        }
        assert_eq!((sampler.used(), sampler.dimension()), (1, 1));
    }
}

#[test]
fn histograms_of_parts_merge_to_that_of_the_whole() {
    let used = [3, 0, 7, 7, 5000, 2, 1024];
    let record = |parts: &[u32]| {
        let mut histogram = DimensionHistogram::new();
        parts.iter().for_each(|used| histogram.record(*used));
        histogram
    };
    let whole = record(&used);
    for split in 0..=used.len() {
        let mut merged = record(&used[split..]);
        merged.merge(&record(&used[..split]));
        assert_eq!(merged, whole);
    }
    assert_eq!(
        (whole.samples(), whole.largest(), whole.count(7), whole.count(4000)),
        (7, 5000, 2, 2)
    );
    assert_eq!(whole.mean(), 6043.0 / 7.0);
    assert_eq!(DimensionHistogram::new().mean(), 0.0);
}

/// The children that one way leads to are points of one net; another way's are others.
#[test]
fn children_of_one_way_are_as_even_as_their_sequence() {
    let points = sobol(Randomization::Owen, 1);
    let child = |index: u64, dimension: u32, number: u32| {
        let mut parent = Sampler::new(&points, index);
        parent.skip_to(dimension);
        parent.child(number)
    };
    let ways = [(3, 1), (3, 2), (4, 1)];
    let firsts = ways.map(|(dimension, number)| {
        let coordinate = |index| child(index, dimension, number).next_1d();
        (0..256).map(coordinate).collect::<Vec<f64>>()
    });
    for coordinates in &firsts {
        let mut bins: Vec<u32> = coordinates.iter().map(|u| (u * 256.0) as u32).collect();
        bins.sort_unstable();
        assert!(bins.into_iter().eq(0..256));
    }
    assert!(firsts[0] != firsts[1] && firsts[0] != firsts[2] && firsts[1] != firsts[2]);
    let mut grandchild = child(9, 3, 1).child(1);
    assert!(grandchild.is_branch() && grandchild.next_1d() != child(9, 3, 1).next_1d());
}

/// Where their ancestors began says nothing of the coordinates of children: those whose ancestors
/// began in one eighth of the line are spread over all of it, as evenly as points of a net in two
/// dimensions are.
#[test]
fn children_do_not_repeat_their_ancestors() {
    for seed in 1..=20 {
        let points = sobol(Randomization::Owen, seed);
        let mut bins = [0; 8];
        for index in 0..512 {
            let mut parent = Sampler::new(&points, index);
            if parent.next_1d() < 0.125 {
                bins[(parent.child(1).next_1d() * 8.0) as usize] += 1;
            }
        }
        assert_eq!(bins, [8; 8], "seed {seed}");
    }
}

#[test]
fn children_are_randomised_where_their_sequence_is_not() {
    let points = sobol(Randomization::None, 1);
    let [mut one, mut two] = [1, 2].map(|number| Sampler::new(&points, 5).child(number));
    let plain = points.coordinate(5, 0);
    let (a, b) = (one.next_1d(), two.next_1d());
    assert!(a != plain && b != plain && a != b);
    one.supply(1, [0.5; 2]);
    assert_ne!(one.next_1d(), 0.5, "coordinates of the points are not those of a branch");
}
