//! What `bidirectional` makes of a scene by itself, and what it must not.

use crate::images::add_panel;
use crate::scenes::{diffuse, diffuse_cube, point_light, points, room, wall_grid};
use glam::DVec3;
use quasilux_scene::Scene;
use quasilux_transport::{
    Decisions, Estimates, EstimatorKind, Settings, Switch, ToleranceOn, simulate,
};

fn run(scene: &Scene, rel_tol: f64, connections: Switch) -> Estimates {
    let settings = Settings {
        estimator: EstimatorKind::Selected,
        rel_tol,
        connections,
        max_samples: Some(128),
        ..Settings::default()
    };
    simulate(scene, &settings, &mut ())
}

fn decided(scene: &Scene, rel_tol: f64) -> (Option<u64>, bool) {
    let Decisions { connected_photons, map_elements, .. } =
        run(scene, rel_tol, Switch::Auto).decisions;
    (connected_photons, map_elements.is_some())
}

/// Loose tolerances are reached before a map has paid for its photons or the scene is surveyed;
/// close ones are not.
#[test]
fn what_is_wanted_decides() {
    let scene = diffuse_cube(&[(0.0, 0.0), (0.5, 0.0), (0.5, 0.5)]);
    let loose = run(&scene, 0.1, Switch::Auto);
    assert_eq!(loose.decisions.connected_photons, None);
    // The paths of the shortest run, and not many photons.
    assert!(loose.rays < 200_000, "{}", loose.rays);
    assert_eq!(decided(&scene, 0.005), (None, true));
    let (light_vertices, on_map) = decided(&scene, 0.0002);
    assert!(light_vertices.is_some() && !on_map);
}

/// A bright lamp behind a screen in a box with a slit of 2 cm, and a dim one that all paths find at
/// once. Their small spread says that a short run will do; a few photons show that most of the
/// light comes through the slit, and so photons are connected.
#[test]
fn light_that_is_found_at_once_hides_no_other() {
    let mut scene = room(DVec3::new(4.0, 4.0, 3.0), diffuse(0.7));
    let (x, y, z) = (DVec3::X * 0.5, DVec3::Y * 0.5, DVec3::Z * 0.5);
    let corner = DVec3::new(1.8, 1.8, 1.5);
    let walls = [(corner, y, z), (corner + x, y, z), (corner, x, z), (corner + y, x, z)];
    let others =
        [(corner, x, y), (corner + z, x, 0.96 * y), (corner + 0.6 * y + 0.2 * z, x, 0.8 * z)];
    for (from, u, v) in walls.into_iter().chain(others) {
        add_panel(&mut scene, from, u, v, diffuse(0.9));
    }
    scene.lights.push(point_light(DVec3::new(0.5, 0.5, 2.5), 1.0));
    let places = [1.0, 3.0].map(|x| (DVec3::new(x, 1.0, 0.8), DVec3::Z));
    scene.sensors.push(points("places", &places));
    assert_eq!(decided(&scene, 0.05).0, None);
    scene.lights.push(point_light(corner + 0.5 * (x + z) + 0.2 * y, 3000.0));
    assert!(decided(&scene, 0.05).0.is_some());
}

/// Of many targets some are looked at closely. One that is not stands in the dark, on a floor whose
/// elements reach from the light to it: nothing is known there, its paths go alone, and the run
/// gives it up.
#[test]
fn a_dark_place_among_many_is_given_up() {
    let mut scene = room(DVec3::new(6.0, 3.0, 2.5), diffuse(0.5));
    let wall = DVec3::new(4.0, 0.0, 0.0);
    add_panel(&mut scene, wall, DVec3::Y * 3.0, DVec3::Z * 2.5, diffuse(0.5));
    scene.lights.push(point_light(DVec3::new(1.0, 1.0, 2.0), 300.0));
    let lit = |i: u32| (DVec3::new(0.03 * f64::from(i), 1.5, 0.5), DVec3::Z);
    let mut places: Vec<_> = (1..100).map(lit).collect();
    places[51].0.x = 5.0;
    scene.sensors.push(points("places", &places));
    let settings = Settings {
        estimator: EstimatorKind::Selected,
        connections: Switch::Off,
        rel_tol: 0.05,
        ..Settings::default()
    };
    let estimates = simulate(&scene, &settings, &mut ());
    assert_eq!(estimates.unresolved_points, 1);
    let [dark, beside] = [51, 52].map(|place| estimates.point_intervals(0)[place]);
    assert!(dark.value == 0.0 && beside.value > 0.0, "{dark:?} {beside:?}");
}

/// An average of many points is known after the shortest run, whatever each of them is; so nothing
/// is spent on a survey.
#[test]
fn averages_ask_for_less() {
    let mut scene = diffuse_cube(&[]);
    scene.sensors = vec![wall_grid([12, 12])];
    let run = |tolerance_on| {
        let settings = Settings {
            estimator: EstimatorKind::Selected,
            rel_tol: 0.003,
            tolerance_on,
            max_samples: Some(16),
            ..Settings::default()
        };
        simulate(&scene, &settings, &mut ()).rays
    };
    let [points, average] = [ToleranceOn::Points, ToleranceOn::Summary].map(run);
    assert!(average < points / 2, "{average} {points}");
}

/// One sensor in a sealed box that no light reaches, among others outside: its paths end like those
/// of others.
#[test]
fn a_dark_box_costs_nothing() {
    let mut scene = room(DVec3::new(4.0, 3.0, 2.5), diffuse(0.85));
    let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
    let corner = DVec3::new(3.0, 2.0, 0.5);
    for axes in [(y, z, x), (x, z, y), (x, y, z)] {
        for from in [corner, corner + axes.2 * 0.6] {
            add_panel(&mut scene, from, axes.0 * 0.6, axes.1 * 0.6, diffuse(0.95));
        }
    }
    scene.lights.push(point_light(DVec3::new(1.0, 1.0, 2.0), 300.0));
    let outside = [0.5, 1.0, 1.5, 2.0].map(|x| (DVec3::new(x, 1.5, 0.5), z));
    scene.sensors.push(points("outside", &outside));
    let without = run(&scene, 0.01, Switch::Off);
    scene.sensors.push(points("inside", &[(corner + DVec3::splat(0.3), z)]));
    let with = run(&scene, 0.01, Switch::Off);
    assert!(!with.biased, "{:?}", with.warnings);
    assert_eq!(with.sensors[1].replicate_lx[0][0], 0.0);
    // Sampled to the limit without ever being done, at plain prices: 20 surfaces at this
    // reflectance.
    assert!(with.rays < without.rays + 128 * 16 * 150, "{} {}", with.rays, without.rays);
}
