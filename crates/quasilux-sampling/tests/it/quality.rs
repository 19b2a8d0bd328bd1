//! Quality measures: against scipy, brute force and closed forms.

use quasilux_sampling::quality::{
    Exchange, L2Measure, PairMeasure, PointsView, cell_counts, change_by_exchange,
    discrepancy_terms, l2_discrepancy, squared_l2_discrepancy, star_discrepancy, worst_pairs,
};
use quasilux_sampling::{PointSet, Randomization, Sequence};

use crate::support::{random, sobol};

const GOLDEN: &str = include_str!("golden/discrepancy_scipy.txt");

fn first(points: &PointSet, count: u64, dimensions: u32) -> Vec<f64> {
    let point = |index| (0..dimensions).map(move |j| points.coordinate(index, j));
    (0..count).flat_map(point).collect()
}

fn view(coordinates: &[f64], dimensions: usize) -> PointsView<'_> {
    PointsView::new(coordinates, dimensions).expect("points of the unit cube")
}

#[test]
fn views_are_whole_points_of_the_unit_cube() {
    assert!(PointsView::new(&[], 1).is_none());
    assert!(PointsView::new(&[0.5], 0).is_none());
    assert!(PointsView::new(&[0.5, 0.5, 0.5], 2).is_none());
    for bad in [-1e-300, 1.0 + f64::EPSILON, f64::NAN, f64::INFINITY] {
        assert!(PointsView::new(&[0.5, bad], 2).is_none(), "{bad}");
    }
    let points = view(&[0.0, 0.1, 0.2, 1.0], 2);
    assert_eq!((points.count(), points.dimensions()), (2, 2));
    assert!(points.column(1).eq([0.1, 1.0]));
}

#[test]
#[should_panic(expected = "0 cells a side")]
fn pairs_need_cells() {
    let _ = worst_pairs(view(&[0.5, 0.5], 2), PairMeasure::EmptyCells(0));
}

const MEASURES: [L2Measure; 4] =
    [L2Measure::Star, L2Measure::Centred, L2Measure::WrapAround, L2Measure::Mixture];

#[test]
fn terms_of_ranges_add_up() {
    let coordinates = first(&random(12), 50, 3);
    let points = view(&coordinates, 3);
    for measure in MEASURES {
        let whole = discrepancy_terms(points, measure, 0..50);
        let parts =
            [0..7, 7..7, 7..31, 31..50].map(|range| discrepancy_terms(points, measure, range));
        let sum = |of: fn(&quasilux_sampling::quality::DiscrepancyTerms) -> f64| -> f64 {
            parts.iter().map(of).sum()
        };
        assert!((sum(|terms| terms.single) / whole.single - 1.0).abs() < 1e-14);
        assert!((sum(|terms| terms.pairs) / whole.pairs - 1.0).abs() < 1e-14);
        assert_eq!(whole.squared_discrepancy(50), squared_l2_discrepancy(points, measure));
    }
}

/// Against the discrepancies before and after; with itself a point exchanges nothing, and
/// coordinates may be at the ends, where factors of the kernels vanish.
#[test]
fn exchanges_change_the_discrepancy() {
    let mut coordinates = first(&random(13), 20, 4);
    coordinates[..8].copy_from_slice(&[0.0, 1.0, 0.5, 0.25, 1.0, 0.0, 1.0, 0.5]);
    for measure in MEASURES {
        let before = squared_l2_discrepancy(view(&coordinates, 4), measure);
        for step in 0..80 {
            let exchange = Exchange { points: [step % 20, step * 7 % 20], dimension: step % 4 };
            let change = change_by_exchange(view(&coordinates, 4), measure, exchange);
            let mut after = coordinates.clone();
            let [a, b] = exchange.points.map(|point| 4 * point + exchange.dimension);
            after.swap(a, b);
            let difference = squared_l2_discrepancy(view(&after, 4), measure) - before;
            assert!((change - difference).abs() < 1e-14, "{measure:?}, {exchange:?}");
        }
    }
}

#[test]
fn mean_square_discrepancies_equal_scipy() {
    let mut tables = 0;
    for line in GOLDEN.lines().filter(|line| !line.starts_with('#')) {
        let fields: Vec<f64> = line.split(' ').map(|field| field.parse().unwrap()).collect();
        let (n, d) = (fields[0] as u64, fields[1] as u64);
        let coordinate = |i, j| (i * i * (7 * j + 3) + i * (29 * j + 11) + 5 * j * j) % 1009;
        let coordinates: Vec<f64> = (0..n)
            .flat_map(|i| (0..d).map(move |j| (coordinate(i, j) as f64 + 0.5) / 1009.0))
            .collect();
        let points = view(&coordinates, d as usize);
        let ours = [
            squared_l2_discrepancy(points, L2Measure::Centred),
            squared_l2_discrepancy(points, L2Measure::WrapAround),
            squared_l2_discrepancy(points, L2Measure::Mixture),
            l2_discrepancy(points, L2Measure::Star),
        ];
        for (ours, scipys) in ours.iter().zip(&fields[2..]) {
            assert!((ours / scipys - 1.0).abs() < 1e-10, "{n} {d}: {ours} {scipys}");
        }
        tables += 1;
    }
    assert_eq!(tables, 11);
}

/// Every box whose edges are coordinates of points or 1, with the points on its faces and without.
fn star_by_brute_force(points: PointsView<'_>) -> f64 {
    let edges: Vec<Vec<f64>> =
        (0..points.dimensions()).map(|j| points.column(j).chain([1.0]).collect()).collect();
    let boxes: usize = edges.iter().map(Vec::len).product();
    let mut largest = 0.0_f64;
    for mut number in 0..boxes {
        let mut corner = Vec::new();
        for edges in &edges {
            corner.push(edges[number % edges.len()]);
            number /= edges.len();
        }
        let share = |holds: fn(&f64, &f64) -> bool| {
            let inside = |point: &&[f64]| point.iter().zip(&corner).all(|(x, edge)| holds(x, edge));
            points.points().filter(inside).count() as f64 / points.count() as f64
        };
        let volume: f64 = corner.iter().product();
        largest = largest.max(volume - share(f64::lt)).max(share(f64::le) - volume);
    }
    largest
}

#[test]
fn star_discrepancy_equals_brute_force() {
    for (dimensions, count) in [(1, 40), (2, 1), (2, 40), (3, 12), (4, 7), (5, 4)] {
        for seed in 0..4 {
            let mut coordinates = first(&random(seed), count, dimensions);
            if seed > 1 {
                // Equal coordinates, and some at the far faces.
                for u in &mut coordinates {
                    *u = (*u * 5.0).round() / 5.0;
                }
            }
            let points = view(&coordinates, dimensions as usize);
            let ours = star_discrepancy(points).expect("few points");
            let difference = (ours - star_by_brute_force(points)).abs();
            assert!(difference < 1e-14, "{count} points in {dimensions}: {difference}");
        }
    }
}

/// H. Niederreiter, "Random number generation and quasi-Monte Carlo methods" (1992), theorem 2.6:
/// 1/2N + max |x_i - (2i - 1)/2N| in one dimension; N copies of one point at the centre of the
/// square: the box that ends there holds all of them, and 1/4 of the volume.
#[test]
fn star_discrepancy_of_known_sets() {
    for n in [1_u32, 2, 3, 10, 1000] {
        let width = 1.0 / f64::from(n);
        let middles: Vec<f64> = (0..n).map(|i| (f64::from(i) + 0.5) * width).collect();
        let starts: Vec<f64> = (0..n).map(|i| f64::from(i) * width).collect();
        assert!((star_discrepancy(view(&middles, 1)).unwrap() - 0.5 * width).abs() < 1e-14);
        assert!((star_discrepancy(view(&starts, 1)).unwrap() - width).abs() < 1e-14);
    }
    assert_eq!(star_discrepancy(view(&[0.5; 8], 2)), Some(0.75));
    assert_eq!(star_discrepancy(view(&[0.0; 8], 4)), Some(1.0));
    assert_eq!(star_discrepancy(view(&[1.0; 8], 4)), Some(1.0));
}

#[test]
fn star_discrepancy_knows_its_limits() {
    for (dimensions, most) in [(2, 32_767), (3, 1023), (4, 180), (5, 63)] {
        let too_many = vec![0.5; (most + 1) * dimensions];
        assert_eq!(star_discrepancy(view(&too_many, dimensions)), None);
    }
    assert_eq!(star_discrepancy(view(&[0.5; 8], 8)), Some(1.0 - 1.0 / 256.0));
    assert_eq!(star_discrepancy(view(&vec![0.5; 2000], 1000)), None);
    assert!(star_discrepancy(view(&vec![0.5; 100_000], 1)).is_some());
}

/// Mean over random points of the squared discrepancy: (K(x, x) - its mean) / N. For the star and
/// two dimensions that is (1/4 - 1/9) / N; of 400 seeds the mean is known to 4 %.
#[test]
fn random_points_have_the_discrepancy_of_theory() {
    let squares = (0..400)
        .map(|seed| squared_l2_discrepancy(view(&first(&random(seed), 64, 2), 2), L2Measure::Star));
    let mean = squares.sum::<f64>() / 400.0;
    assert!((mean * 64.0 / (1.0 / 4.0 - 1.0 / 9.0) - 1.0).abs() < 0.2, "{mean}");
}

/// Reflections and shifts leave alone what they should, and change what they should.
#[test]
fn symmetries_are_as_stated() {
    let coordinates = first(&random(1), 32, 3);
    let reflected: Vec<f64> = coordinates.iter().map(|u| 1.0 - u).collect();
    let shifted: Vec<f64> = coordinates.iter().map(|u| (u + 0.3) % 1.0).collect();
    let change = |other: &[f64], measure| {
        let [a, b] = [&coordinates, other].map(|set| l2_discrepancy(view(set, 3), measure));
        (a / b - 1.0).abs()
    };
    assert!(change(&reflected, L2Measure::Centred) < 1e-12);
    assert!(change(&reflected, L2Measure::Mixture) < 1e-12);
    assert!(change(&reflected, L2Measure::WrapAround) < 1e-12);
    assert!(change(&shifted, L2Measure::WrapAround) < 1e-12);
    assert!(change(&reflected, L2Measure::Star) > 1e-3);
    assert!(change(&shifted, L2Measure::Centred) > 1e-3);
}

/// Figure 6 of the paper: 64 points of Sobol', one in each of 8 x 8 cells. Of random points, figure
/// 5, a third of the cells stays empty.
#[test]
fn figure_six_has_one_point_in_each_cell() {
    for randomization in [Randomization::None, Randomization::DigitalShift, Randomization::Owen] {
        let coordinates = first(&sobol(randomization, 1), 64, 2);
        let cells = cell_counts(view(&coordinates, 2), [0, 1], 8);
        assert_eq!((cells.least(), cells.most(), cells.empty()), (1, 1, 0), "{randomization:?}");
    }
    let coordinates = first(&random(1), 64, 2);
    let cells = cell_counts(view(&coordinates, 2), [0, 1], 8);
    assert!((cells.empty_if_random() - 64.0 * 0.364_987).abs() < 1e-3);
    assert!((12..36).contains(&cells.empty()), "{} empty cells", cells.empty());
    assert_eq!(cell_counts(view(&[1.0, 0.0], 2), [0, 1], 3).counts, [0, 0, 1, 0, 0, 0, 0, 0, 0]);
}

/// A diagonal pair is planted among good ones; each measure must find it.
#[test]
fn worst_pair_is_found() {
    let mut coordinates = first(&sobol(Randomization::Owen, 2), 256, 6);
    for point in coordinates.chunks_mut(6) {
        point[4] = point[1];
    }
    let points = view(&coordinates, 6);
    for measure in [
        PairMeasure::Star,
        PairMeasure::L2(L2Measure::Centred),
        PairMeasure::L2(L2Measure::WrapAround),
        PairMeasure::L2(L2Measure::Mixture),
        PairMeasure::L2(L2Measure::Star),
        PairMeasure::EmptyCells(16),
    ] {
        let pairs = worst_pairs(points, measure);
        assert_eq!(pairs.len(), 15);
        assert_eq!(pairs[0].dimensions, [1, 4], "{measure:?}");
        assert!(pairs[0].value > 1.5 * pairs[1].value, "{measure:?}: {pairs:?}");
        assert!(pairs.windows(2).all(|pair| pair[0].value >= pair[1].value));
    }
    let sequence = Sequence::Sobol;
    let one = first(&PointSet::new(sequence, Randomization::None, 0), 4, 1);
    assert!(worst_pairs(view(&one, 1), PairMeasure::Star).is_empty());
}
