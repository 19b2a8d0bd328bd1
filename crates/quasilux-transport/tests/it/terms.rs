//! The terms of the Neumann series one by one: their sum, their closed form, and who agrees.

use crate::agreement::coloured_room_with_mirror;
use crate::scenes::{all_walls_emit, diffuse, level_grid, point_light, points, room};
use glam::DVec3;
use quasilux_scene::Scene;
use quasilux_transport::{Estimates, EstimatorKind, Reconstruction, Settings, check, simulate};
use std::f64::consts::PI;

/// Terms that are told apart in a furnace, where later ones are small.
const FURNACE_TERMS: u32 = 4;
/// Terms that are told apart elsewhere: a map has three layers of its own, and one for the rest.
const LISTED: u32 = 5;

fn run(scene: &Scene, settings: &Settings) -> Estimates {
    assert_eq!(check(scene, settings), Ok(()));
    let estimates = simulate(scene, settings, &mut ());
    assert!(estimates.tolerance_reached && estimates.invalid_contributions == 0);
    estimates
}

/// In a furnace of reflectance r, term k is pi L r^k everywhere, and past n terms pi L r^n / (1 -
/// r) is left. 80 intervals of 95 %, three times as wide (6.8 standard errors, 15 degrees of
/// freedom): right programs fail once in some 10^3 seeds. A term that were counted one too early or
/// late would be off by half, more than the 45 % that are allowed at most.
#[test]
fn terms_of_a_furnace_are_powers() {
    let mut scene = room(DVec3::new(4.0, 3.0, 2.5), diffuse(0.5));
    all_walls_emit(&mut scene, 100.0);
    for estimator in EstimatorKind::ALL {
        scene.sensors = match estimator {
            EstimatorKind::Photon => vec![level_grid(DVec3::ONE, [2.0, 1.0], [1, 1])],
            _ => vec![points(
                "probes",
                &[
                    (DVec3::new(2.0, 1.5, 1.2), DVec3::Z),
                    (DVec3::new(0.3, 0.2, 2.3), DVec3::new(0.6, 0.0, -0.8)),
                    (DVec3::new(3.99, 1.0, 0.01), DVec3::NEG_Z),
                    (DVec3::new(1.0, 0.0, 1.0), DVec3::Y),
                    (DVec3::new(1.0, 0.5, 1.0), DVec3::NEG_X),
                ],
            )],
        };
        // Light is even here: large elements have no bias, and photons enough.
        let settings = Settings {
            estimator,
            list_terms: FURNACE_TERMS,
            rel_tol: 0.01,
            map_element_m: Some(10.0),
            map_adaptive: false,
            map_reconstruction: Reconstruction::Constant,
            ..Settings::default()
        };
        let estimates = run(&scene, &settings);
        assert_eq!(estimates.sensors[0].terms.len(), FURNACE_TERMS as usize + 1);
        for term in 0..=FURNACE_TERMS {
            let power = PI * 100.0 / f64::from(1 << term);
            let wanted = if term == FURNACE_TERMS { 2.0 * power } else { power };
            for interval in estimates.term_intervals(0, term as usize) {
                let found = format!("{estimator:?}, term {term}: {interval:?}, wanted {wanted}");
                let half_width = interval.half_width.expect("light was found");
                assert!(half_width < 0.15 * wanted, "{found}");
                assert!((interval.value - wanted).abs() <= 3.0 * half_width, "{found}");
            }
        }
    }
}

/// Means over the four cells of the floor: each pair of intervals of each term, of paths and of
/// another estimator with another seed, must overlap when both are half as wide again, as in
/// [`crate::agreement`]. Each term is four fifths of the one before at most, and known to a
/// seventh. A point light adds what paths get of its image in the mirror, or, where images are not
/// followed, of photons.
#[test]
fn estimators_agree_term_by_term() {
    let panel = coloured_room_with_mirror();
    let mut point = panel.clone();
    point.lights.push(point_light(DVec3::new(2.5, 1.2, 1.5), 400.0));
    for (scene, image_depth) in [(&panel, 2), (&point, 8), (&point, 0)] {
        let listed = |estimator, seed| {
            let (list_terms, image_depth) = (LISTED, Some(image_depth));
            let settings = Settings {
                estimator,
                list_terms,
                image_depth,
                seed,
                rel_tol: 0.0045,
                ..Settings::default()
            };
            run(scene, &settings)
        };
        let paths = listed(EstimatorKind::Path, 1);
        for way in
            [EstimatorKind::Photon, EstimatorKind::Bidirectional, EstimatorKind::BidirectionalMap]
        {
            let others = listed(way, 2);
            for term in 0..=LISTED as usize {
                let terms = [&others, &paths].map(|estimates| estimates.term_intervals(0, term));
                let [x, y] = terms;
                for (x, y) in x.into_iter().zip(y) {
                    let [a, b] = [x, y].map(|value| value.half_width.expect("light was found"));
                    let found =
                        format!("{way:?}, depth {image_depth}, term {term}: {x:?} against {y:?}");

                    assert!(a.max(b) < 0.15 * y.value, "{found}");
                    assert!((x.value - y.value).abs() <= 1.5 * (a + b), "{found}");
                }
            }
        }
        let averages: Vec<f64> =
            (0..LISTED as usize).map(|term| paths.term_average(0, term).value).collect();
        assert!(averages.windows(2).all(|pair| pair[1] < 0.8 * pair[0]), "{averages:?}");
    }
}

/// Terms add up to the whole in each replicate but for rounding, and listing them changes no bit of
/// it.
#[test]
fn terms_add_up_and_disturb_nothing() {
    let scene = coloured_room_with_mirror();
    for estimator in EstimatorKind::ALL {
        for max_bounces in [None, Some(1), Some(3), Some(17)] {
            let limited = |list_terms| Settings {
                estimator,
                max_bounces,
                list_terms,
                max_samples: Some(16),
                rel_tol: 0.0,
                ..Settings::default()
            };
            let [plain, listed] = [0, LISTED]
                .map(|terms| simulate(&scene, &limited(terms), &mut ()).sensors[0].clone());
            assert_eq!(plain.replicate_lx, listed.replicate_lx);
            assert_eq!(plain.direct_lx, listed.direct_lx);
            assert!(plain.terms.is_empty());
            for (r, row) in listed.replicate_lx.iter().enumerate() {
                for (point, whole) in row.iter().enumerate() {
                    let sum: f64 = listed.terms.iter().map(|t| t.replicate_lx[r][point]).sum();
                    assert!((sum - whole).abs() <= 1e-13 * whole, "{sum} of {whole}");
                }
            }
        }
    }
}

/// Light that `max_bounces` cuts is known to be nothing; light that was not found is not.
#[test]
fn what_is_cut_is_known_to_be_nothing() {
    let scene = coloured_room_with_mirror();
    let settings = Settings {
        list_terms: 3,
        max_bounces: Some(1),
        max_samples: Some(64),
        ..Settings::default()
    };
    let estimates = simulate(&scene, &settings, &mut ());
    for (term, is_cut) in [(0, false), (1, false), (2, true), (3, true)] {
        for interval in estimates.term_intervals(0, term) {
            assert_eq!(interval.half_width == Some(0.0), is_cut, "term {term}: {interval:?}");
            assert_eq!(interval.value == 0.0, is_cut, "term {term}: {interval:?}");
        }
    }
}
