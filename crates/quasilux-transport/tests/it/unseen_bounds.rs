//! Bounds on light that no sample met, beside each other: of an average and of its points, of rooms
//! painted grey and green, between one mirror and two.

use crate::images::add_panel;
use crate::scenes::{diffuse, level_grid, mirror, point_light, points, room};
use glam::DVec3;
use quasilux_scene::bsdf::Diffuse;
use quasilux_scene::{Bsdf, Rgb, Scene};
use quasilux_transport::{EstimatorKind, SensorEstimates, Settings, simulate};

const SIZE: DVec3 = DVec3::new(4.0, 3.0, 2.5);

fn first_sensor(scene: &Scene, rel_tol: f64, samples: u64) -> SensorEstimates {
    let settings = Settings {
        estimator: EstimatorKind::Bidirectional,
        rel_tol,
        max_samples: Some(samples),
        ..Settings::default()
    };
    simulate(scene, &settings, &mut ()).sensors.remove(0)
}

/// Light at one of m targets is an m-th of it in the average, which may miss no less than that.
fn assert_average_has_room(sensor: &SensorEstimates) {
    let unseen = sensor.unseen.as_ref().unwrap();
    let most_lx = unseen.point_lx.iter().copied().fold(0.0, f64::max);
    let least_lx = most_lx / unseen.point_lx.len() as f64;
    assert!(unseen.average_lx >= 0.999 * least_lx, "{unseen:?}");
}

/// Cells get light straight from a lamp, also where surfaces send nothing on.
#[test]
fn averages_of_cells_may_miss_what_a_lamp_gives_to_one() {
    for reflectance in [0.0, 0.001, 0.5] {
        let mut scene = room(SIZE, diffuse(reflectance));
        scene.lights.push(point_light(DVec3::new(1.0, 1.0, 1.1), 1000.0));
        scene.sensors.push(level_grid(DVec3::new(0.0, 0.0, 1.0), [4.0, 3.0], [4, 3]));
        assert_average_has_room(&first_sensor(&scene, 0.01, 1 << 11));
    }
}

/// A point near a lamp that nothing shades is done long before one in a niche.
#[test]
fn averages_know_that_some_points_had_few_samples() {
    let mut scene = room(SIZE, diffuse(0.5));
    add_panel(&mut scene, DVec3::new(3.5, 0.0, 0.0), DVec3::Y * 3.0, DVec3::Z, diffuse(0.5));
    scene.lights.push(point_light(DVec3::new(1.0, 1.0, 2.3), 500.0));
    let niche = (DVec3::new(3.6, 2.9, 0.05), DVec3::NEG_X);
    scene.sensors.push(points("points", &[(DVec3::new(1.0, 1.0, 1.0), DVec3::Z), niche]));
    let sensor = first_sensor(&scene, 0.02, 1 << 11);
    assert!(sensor.samples[0] < sensor.samples[1], "{:?}", sensor.samples);
    assert_average_has_room(&sensor);
}

/// Paths survive by the channel that is left strongest: green paint keeps them as long as white.
#[test]
fn paint_of_one_colour_keeps_paths_as_long_as_white() {
    let bound_lx = |reflectance: Rgb| {
        let mut scene = room(SIZE, Bsdf::Diffuse(Diffuse { reflectance }));
        scene.lights.push(point_light(DVec3::new(1.0, 1.0, 1.1), 1000.0));
        scene.sensors.push(points("point", &[(DVec3::new(2.0, 2.0, 1.0), DVec3::Z)]));
        first_sensor(&scene, 0.0, 1 << 5).unseen.unwrap().point_lx[0]
    };
    let [white, green] = [Rgb::grey(0.95), Rgb([0.0, 0.95, 0.0])].map(bound_lx);
    assert!(green > 0.5 * white, "{green} lx, {white} lx");
}

/// Between two mirrors a photon crosses a cell at every round, before one of them but once.
#[test]
fn photons_come_again_between_two_mirrors() {
    let bound_lx = |opposite: Bsdf| {
        let mut scene = room(SIZE, diffuse(0.0));
        let [x, y] = [DVec3::X * 3.8, DVec3::Y * 2.8];
        add_panel(&mut scene, DVec3::new(0.1, 0.1, 0.2), x, y, mirror(0.99));
        add_panel(&mut scene, DVec3::new(0.1, 0.1, 2.3), y, x, opposite);
        scene.lights.push(point_light(DVec3::new(1.0, 1.0, 2.2), 1000.0));
        scene.sensors.push(level_grid(DVec3::new(1.0, 1.0, 1.0), [0.1, 0.1], [1, 1]));
        first_sensor(&scene, 0.0, 1 << 5).unseen.unwrap().point_lx[0]
    };
    let [one, two] = [diffuse(0.0), mirror(0.99)].map(bound_lx);
    let rounds = 1.0 / (1.0 - 0.99 * 0.99);
    assert!((two / one / rounds - 1.0).abs() < 1e-6, "{one} lx, {two} lx");
}
