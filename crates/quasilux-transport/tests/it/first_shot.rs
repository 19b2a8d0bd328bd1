//! Photons that leave lit places against photons that leave the lights, and against paths.
//!
//! With and without first shot a map has the same elements, hence the same bias: both must agree
//! within their errors. Welch's test at each of nine points of three rooms, the family of 27 at 0.1
//! % in all, 16 replicates each of 2^8 photons and paths, seeds 1 and 2. Standard errors are up to
//! 0.3 %, so that a difference of 2 % is found nearly always. Paths know nothing of maps: intervals
//! may be half as wide again, and for the map's bias there is 1 % more.

use crate::agreement::coloured_room_with_mirror;
use crate::scenes::{diffuse, point_light, points, room};
use crate::spotlight::spotlight;
use glam::DVec3;
use quasilux_scene::Scene;
use quasilux_stats::{sidak, student_t_cdf};
use quasilux_transport::{CheckError, Estimates, EstimatorKind, Settings, Switch};
use quasilux_transport::{check, simulate};

/// Two narrow beams; a bare lamp 20 cm from a wall; a point light beside an area light, with a
/// mirror.
fn rooms() -> [(&'static str, Scene); 3] {
    let size = DVec3::new(4.0, 3.0, 2.5);
    let mut beams = room(size, diffuse(0.4));
    beams.lights = [(1.4, 1.4), (3.0, 2.0)].map(|(x, y)| spotlight(DVec3::new(x, y, 2.4))).to_vec();
    let mut near_wall = room(size, diffuse(0.4));
    near_wall.lights = vec![point_light(DVec3::new(0.2, 1.1, 1.3), 100.0)];
    let mut mixed = coloured_room_with_mirror();
    mixed.lights.push(point_light(DVec3::new(1.2, 1.1, 1.7), 300.0));
    let places = [0.6, 2.0, 3.3].map(|x| [0.5, 1.5, 2.4].map(|y| DVec3::new(x, y, 0.6)));
    let places: Vec<(DVec3, DVec3)> =
        places.as_flattened().iter().map(|&position| (position, DVec3::Z)).collect();
    [("beams", beams), ("near a wall", near_wall), ("mixed", mixed)].map(|(name, mut scene)| {
        scene.sensors = vec![points("plane", &places)];
        (name, scene)
    })
}

fn run(scene: &Scene, settings: Settings) -> Estimates {
    let estimates = simulate(scene, &settings, &mut ());
    assert_eq!(estimates.invalid_contributions, 0);
    estimates
}

fn map(first_shot: Switch, seed: u64) -> Settings {
    Settings {
        estimator: EstimatorKind::BidirectionalMap,
        first_shot,
        seed,
        rel_tol: 0.0,
        max_samples: Some(1 << 8),
        ..Settings::default()
    }
}

/// The chance of means as far apart as those of the columns `point`.
fn p_of_difference(a: &Estimates, b: &Estimates, point: usize) -> f64 {
    let moments = |estimates: &Estimates| {
        let rows = &estimates.sensors[0].replicate_lx;
        let n = rows.len() as f64;
        let mean = rows.iter().map(|row| row[point]).sum::<f64>() / n;
        let squares: f64 = rows.iter().map(|row| (row[point] - mean) * (row[point] - mean)).sum();
        [mean, squares / (n * (n - 1.0))]
    };
    let ([a, a_squared], [b, b_squared]) = (moments(a), moments(b));
    2.0 * student_t_cdf(-((a - b) / (a_squared + b_squared).sqrt()).abs(), 15.0)
}

#[test]
fn maps_agree_with_and_without_first_shot_and_with_paths() {
    let significance = sidak(0.001, 27);
    for (name, scene) in rooms() {
        let on = run(&scene, map(Switch::On, 1));
        let off = run(&scene, map(Switch::Off, 2));
        let paths = Settings { rel_tol: 0.0, max_samples: Some(1 << 10), ..Settings::default() };
        let paths = run(&scene, paths).point_intervals(0);
        for (point, (x, path)) in on.point_intervals(0).iter().zip(&paths).enumerate() {
            let p = p_of_difference(&on, &off, point);
            let other = off.point_intervals(0)[point];
            assert!(p > significance, "{name}, point {point}: {x:?} and {other:?}, p = {p}");
            let widths = x.half_width.unwrap() + path.half_width.unwrap();
            let allowed = 1.5 * widths + 0.01 * path.value;
            let found = format!("{name}, point {point}: {x:?}, by paths {path:?}");
            assert!((x.value - path.value).abs() < allowed, "{found}");
        }
    }
}

/// Photons that are guided as well give the same light.
#[test]
fn first_shot_goes_with_guided_photons() {
    let significance = sidak(0.001, 27);
    for (name, scene) in rooms() {
        let off = run(&scene, map(Switch::Off, 2));
        let guided = Settings { importance: Switch::On, ..map(Switch::On, 1) };
        let guided = run(&scene, guided);
        for point in 0..9 {
            let p = p_of_difference(&guided, &off, point);
            assert!(p > significance, "{name}, point {point}: p = {p}");
        }
    }
}

/// The balance of the flux is that of all light, and no share is lost in closed rooms.
#[test]
fn the_balance_of_the_flux_is_whole() {
    for (name, scene) in rooms() {
        {
            let settings =
                Settings { map_adaptive: false, max_samples: Some(16), ..map(Switch::On, 1) };
            let flux = run(&scene, settings).flux;
            let sum_lm = flux.absorbed_lm + flux.lost_lm + flux.cut_lm;
            assert!((flux.emitted_lm / scene.flux_lm() - 1.0).abs() < 1e-12, "{name}");
            assert!((sum_lm / flux.emitted_lm - 1.0).abs() < 1e-6, "{name}: {flux:?}");
            assert!(flux.absorbed_lm > 0.9 * flux.emitted_lm, "{name}: {flux:?}");
        }
    }
}

/// After n bounces light is cut, wherever the first of them is computed.
#[test]
fn bounces_are_counted_from_the_lights() {
    let [_, (name, scene), _] = rooms();
    let mut compared = 0;
    for max_bounces in [Some(0), Some(1), Some(2), Some(3)] {
        let with =
            |first_shot, seed| run(&scene, Settings { max_bounces, ..map(first_shot, seed) });
        let (on, off) = (with(Switch::On, 1), with(Switch::Off, 2));
        for point in 0..9 {
            let [x, y] = [&on, &off].map(|estimates| estimates.point_intervals(0)[point]);
            // What few paths found has no interval.
            let Some((a, b)) = x.half_width.zip(y.half_width) else { continue };
            let allowed = 1.5 * (a + b);
            compared += 1;
            let found = format!("{name}, {max_bounces:?}, point {point}: {x:?} and {y:?}");
            assert!((x.value - y.value).abs() <= allowed + 1e-9 * x.value, "{found}");
        }
    }
    assert!(compared > 24, "{compared} of 36 points have intervals");
}

#[test]
fn estimators_without_maps_refuse_it() {
    let [(_, scene), ..] = rooms();
    for estimator in [EstimatorKind::Auto, EstimatorKind::Path, EstimatorKind::Photon] {
        let settings = Settings { estimator, ..map(Switch::On, 1) };
        let estimator = estimator.name();
        assert_eq!(check(&scene, &settings), Err(CheckError::FirstShotWithoutMap { estimator }));
    }
}

/// A switch that is on is heeded or refused.
#[test]
fn what_is_switched_on_is_not_passed_over() {
    let [(_, scene), ..] = rooms();
    let guided =
        Settings { importance: Switch::On, first_shot: Switch::Auto, ..map(Switch::On, 1) };
    for estimator in [EstimatorKind::Auto, EstimatorKind::Path] {
        let refused = check(&scene, &Settings { estimator, ..guided.clone() });
        assert!(matches!(refused, Err(CheckError::NothingToGuide { .. })), "{refused:?}");
    }
    let of_map = Settings { estimator: EstimatorKind::BidirectionalMap, ..guided.clone() };
    assert_eq!(check(&scene, &of_map), Ok(()));
    let of_photons = Settings { estimator: EstimatorKind::Photon, ..guided };
    assert_eq!(check(&scene, &of_photons), Ok(()));
    // Photons leave lit places, or not: other numbers.
    let few =
        |first_shot| run(&scene, Settings { max_samples: Some(64), ..map(first_shot, 1) }).sensors;
    assert!(few(Switch::On) != few(Switch::Off));
}
