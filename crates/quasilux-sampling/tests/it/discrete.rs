//! Discrete choices: right frequencies, uniform rests, monotone, total.

use quasilux_sampling::{Discrete, choose_bool, choose_weights};

use crate::support::{assert_distributed, cell, random};

const WEIGHTS: [f64; 8] = [0.0, 1.0, 2.0, 0.0, 0.5, 3.0, 1.5, 0.0];

/// Entry and rest together, in 8 parts of the rest: 40 cells, 2^20 draws find 2 % in half of them.
#[test]
fn rests_are_uniform_and_independent_of_the_choice() {
    let points = random(1);
    let distribution = Discrete::new(&WEIGHTS).unwrap();
    let (mut by_table, mut by_scan, mut by_bool) = ([0; 64], [0; 64], [0; 16]);
    for index in 0..1 << 20 {
        let u = points.coordinate(index, 0);
        let choice = distribution.sample(u);
        by_table[8 * choice.index + cell(choice.u_remapped, 8)] += 1;
        let choice = choose_weights(u, WEIGHTS.into_iter()).unwrap();
        by_scan[8 * choice.index + cell(choice.u_remapped, 8)] += 1;
        let choice = choose_bool(u, 0.3);
        by_bool[8 * usize::from(choice.value) + cell(choice.u_remapped, 8)] += 1;
    }
    let positive = |counts: [u64; 64]| -> Vec<u64> {
        (0..64).filter(|i| WEIGHTS[i / 8] > 0.0).map(|i| counts[i]).collect()
    };
    let probabilities: Vec<f64> =
        (0..64).map(|i| WEIGHTS[i / 8] / 64.0).filter(|p| *p > 0.0).collect();
    for counts in [by_table, by_scan] {
        assert!((0..64).all(|i| WEIGHTS[i / 8] > 0.0 || counts[i] == 0));
        assert_distributed(&positive(counts), &probabilities, "entry and rest");
    }
    let of_bool: Vec<f64> = (0..16).map(|i| if i < 8 { 0.7 / 8.0 } else { 0.3 / 8.0 }).collect();
    assert_distributed(&by_bool, &of_bool, "truth and rest");
}

#[test]
fn probabilities_are_those_of_the_weights() {
    let distribution = Discrete::new(&WEIGHTS).unwrap();
    assert_eq!((distribution.total(), distribution.len()), (8.0, 8));
    for (index, weight) in WEIGHTS.iter().enumerate() {
        assert_eq!(distribution.pdf(index), weight / 8.0);
    }
    for step in 0..4096 {
        let u = f64::from(step) / 4096.0;
        let choice = distribution.sample(u);
        assert_eq!(choose_weights(u, WEIGHTS.into_iter()), Some(choice));
        assert_eq!(distribution.invert(choice.index, choice.u_remapped), u);
    }
}

/// A million entries over 30 decades: the guided search equals the definition, at random and on the
/// borders between entries.
#[test]
fn guided_search_equals_the_definition() {
    let points = random(2);
    let weight = |index| {
        let x = points.coordinate(index, 0);
        if x < 0.2 { 0.0 } else { libm::exp(70.0 * (x - 1.0)) }
    };
    let weights: Vec<f64> = (0..1_000_000).map(weight).collect();
    let distribution = Discrete::new(&weights).unwrap();
    let borders: Vec<f64> = (0..weights.len()).map(|i| distribution.invert(i, 1.0)).collect();
    let at_random = (0..100_000).map(|index| points.coordinate(index, 1));
    let on_borders = (0..100_000).flat_map(|index| {
        let border = borders[cell(points.coordinate(index, 2), borders.len())];
        [border.next_down(), border, border.next_up()]
    });
    for u in at_random.chain(on_borders).filter(|u| (0.0..1.0).contains(u)) {
        let choice = distribution.sample(u);
        assert!(weights[choice.index] > 0.0 && choice.pdf > 0.0);
        let definition = borders.partition_point(|border| *border <= u);
        assert!(
            choice.index.abs_diff(definition) <= 1 || borders[choice.index] == borders[definition]
        );
        assert!((0.0..1.0).contains(&choice.u_remapped));
    }
}

#[test]
fn choice_is_monotone() {
    let points = random(3);
    let weights: Vec<f64> = (0..1000).map(|index| points.coordinate(index, 0)).collect();
    let distribution = Discrete::new(&weights).unwrap();
    let mut last = (0, 0.0);
    for step in 0..1 << 16 {
        let choice = distribution.sample(f64::from(step) / 65_536.0);
        let here = (choice.index, choice.u_remapped);
        assert!(here > last || step == 0, "{here:?} after {last:?}");
        last = here;
    }
}

#[test]
fn what_is_no_distribution_is_refused() {
    let refused: [&[f64]; 7] = [
        &[],
        &[0.0, 0.0],
        &[1.0, -0.5],
        &[1.0, f64::NAN],
        &[1.0, f64::INFINITY],
        &[f64::MAX, f64::MAX],
        &[f64::NEG_INFINITY],
    ];
    for weights in refused {
        assert!(Discrete::new(weights).is_none(), "{weights:?}");
        assert!(choose_weights(0.5, weights.iter().copied()).is_none(), "{weights:?}");
    }
}

#[test]
fn extremes_are_chosen_without_panic() {
    let tiny = f64::from_bits(1);
    for weights in [&[tiny][..], &[tiny, 0.0, tiny], &[0.0, f64::MAX, 0.0], &[1e-300, 1.0, 1e-300]]
    {
        let distribution = Discrete::new(weights).unwrap();
        for u in [0.0, tiny, 0.5, 1.0 - f64::EPSILON / 2.0, 1.0, 2.0, -1.0, f64::INFINITY] {
            let scan = choose_weights(u, weights.iter().copied()).unwrap();
            for choice in [distribution.sample(u), scan] {
                assert!(weights[choice.index] > 0.0, "u = {u}, {weights:?}");
                assert!((0.0..1.0).contains(&choice.u_remapped));
            }
        }
        let _ = (distribution.sample(f64::NAN), choose_weights(f64::NAN, weights.iter().copied()));
    }
}

#[test]
fn choose_bool_is_total() {
    let below_one = 1.0 - f64::EPSILON / 2.0;
    for u in [0.0, 1e-300, 0.5, below_one] {
        for never in [0.0, -1.0, f64::NAN, f64::NEG_INFINITY] {
            assert_eq!((choose_bool(u, never).value, choose_bool(u, never).u_remapped), (false, u));
        }
        for always in [1.0, 2.0, f64::INFINITY] {
            assert_eq!(
                (choose_bool(u, always).value, choose_bool(u, always).u_remapped),
                (true, u)
            );
        }
        for p_true in [1e-300, 0.5, below_one] {
            assert!((0.0..1.0).contains(&choose_bool(u, p_true).u_remapped));
        }
    }
}
