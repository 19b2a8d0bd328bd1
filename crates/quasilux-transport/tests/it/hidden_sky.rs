//! Rooms whose windows see surfaces before they see the sky: eye paths that are led to openings,
//! and places that ask the open sky, against an integral that shares no code with them and against
//! plain paths, which know of neither.

use crate::images::add_panel;
use crate::outside::{ETA, Numbers, Room, even, outside, room_with_window};
use crate::scenes::{diffuse, point_light, points};
use glam::DVec3;
use quasilux_scene::bsdf::Pane;
use quasilux_scene::{Bsdf, Environment, Opening, Scene, Sun};
use quasilux_sky::SkyPoint;
use quasilux_transport::{Estimates, EstimatorKind, Settings, Switch, simulate};
use std::f64::consts::{PI, TAU};

/// A parallelogram.
#[derive(Clone, Copy)]
struct Panel {
    corner: DVec3,
    u: DVec3,
    v: DVec3,
}

/// Without a tolerance.
fn settings() -> Settings {
    Settings { rel_tol: 0.0, ..Settings::default() }
}

fn run(scene: &Scene, settings: &Settings) -> Estimates {
    let estimates = simulate(scene, settings, &mut ());
    assert!(estimates.invalid_contributions == 0 && !estimates.biased);
    estimates
}

/// How far a ray goes to the inside of a parallelogram.
fn distance_m(panel: &Panel, from: DVec3, direction: DVec3) -> Option<f64> {
    let n = panel.u.cross(panel.v);
    let along_m = n.dot(panel.corner - from) / n.dot(direction);
    let at = from + direction * along_m - panel.corner;
    let is_within = |edge: DVec3| (0.0..1.0).contains(&(at.dot(edge) / edge.length_squared()));
    (along_m > 1e-9 && is_within(panel.u) && is_within(panel.v)).then_some(along_m)
}

/// Whether a ray meets a box.
fn meets_box(low: DVec3, high: DVec3, from: DVec3, direction: DVec3) -> bool {
    let (a, b) = ((low - from) / direction, (high - from) / direction);
    let (near, far) = (a.min(b).max_element(), a.max(b).min_element());
    near < far && far > 0.0
}

/// The part of an even sky, its zenith straight up, that lights a place on the side `n`, where a
/// box stands in the way of some: illuminance over luminance.
fn open_sky_sr(place: DVec3, n: DVec3, [low, high]: [DVec3; 2]) -> f64 {
    const ROWS: usize = 48;
    let mut sum = 0.0;
    for row in 0..ROWS {
        for column in 0..4 * ROWS {
            let z = (row as f64 + 0.5) / ROWS as f64;
            let (sin, cos) = libm::sincos(TAU * (column as f64 + 0.5) / (4 * ROWS) as f64);
            let level = (1.0 - z * z).sqrt();
            let direction = DVec3::new(level * cos, level * sin, z);
            if !meets_box(low, high, place, direction) {
                sum += n.dot(direction).max(0.0);
            }
        }
    }
    sum * TAU / (4 * ROWS * ROWS) as f64
}

/// Illuminance in lx of a point in a black room through its window, from a wall before that, lit by
/// an even sky of 1 cd/m2 over a black ground, and from the sky beside that wall.
fn through_window(
    window: &Opening,
    wall: &Panel,
    reflectance: f64,
    box_of_room: [DVec3; 2],
    [position, n]: [DVec3; 2],
) -> f64 {
    const N: usize = 48;
    let across = window.u.cross(window.v);
    let mut sum = 0.0;
    for cell in 0..N * N {
        let part = |k: usize| (k as f64 + 0.5) / N as f64;
        let place = window.origin + window.u * part(cell % N) + window.v * part(cell / N);
        let way = place - position;
        let direction = way.normalize();
        let cd_m2 = match distance_m(wall, position, direction) {
            Some(along_m) => {
                let met = position + direction * along_m;
                reflectance / PI * open_sky_sr(met, DVec3::Y, box_of_room)
            }
            None => f64::from(u8::from(direction.z > 0.0)),
        };
        let seen = across.dot(direction).abs() / way.length_squared();
        sum += cd_m2 * n.dot(direction).max(0.0) * seen;
    }
    sum / (N * N) as f64
}

fn size_of(scene: &Scene) -> DVec3 {
    scene.mesh.positions.iter().fold(DVec3::ZERO, |size, at| size.max(*at))
}

/// Black rooms at random before a wall: the mean of three points is right within 1.5 %; without the
/// light by the wall it is 4 to 60 times that off.
#[test]
fn a_wall_before_a_window_gives_what_the_sky_gives_it() {
    let mut numbers = Numbers(41);
    for number in 0..4 {
        let Room { mut scene, window } = room_with_window(&mut numbers, 0.0);
        let size = size_of(&scene);
        let [far_m, reflectance] = [numbers.within(1.0, 8.0), numbers.within(0.2, 0.9)];
        let wall = Panel {
            corner: DVec3::new(-8.0, -far_m, -4.0),
            u: DVec3::X * (16.0 + size.x),
            v: DVec3::Z * (4.0 + numbers.within(0.5, 3.0) * size.z),
        };
        add_panel(&mut scene, wall.corner, wall.u, wall.v, diffuse(reflectance));
        scene.environment =
            Some(Environment { ground_reflectance: 0.0, openings: vec![window], ..even(1.0) });
        let settings = Settings { max_samples: Some(1 << 10), seed: number, ..settings() };
        let found = run(&scene, &settings);
        let expected: Vec<f64> = scene.sensors[0]
            .points()
            .into_iter()
            .map(|it| {
                let place = [it.position, it.normal];
                through_window(&window, &wall, reflectance, [DVec3::ZERO, size], place)
            })
            .collect();
        let sum: f64 = found.point_intervals(0).iter().map(|it| it.value).sum();
        let wanted: f64 = expected.iter().sum();
        println!("{number}: {:.4} of {wanted:.4} lx", sum / wanted);
        assert!((sum / wanted - 1.0).abs() < 0.015, "{number}: {sum}, not {wanted} lx");
    }
}

/// Sensor points of a hidden room that lie in it, before the one outside.
const INDOORS: usize = 4;

/// A room with a window under an overhang, before a wall, over a ground, with the sun in some;
/// sensor points in it and one outside.
fn hidden_room(numbers: &mut Numbers, number: u64) -> Scene {
    let Room { mut scene, window } = room_with_window(numbers, 0.6);
    let size = size_of(&scene);
    let mut environment = outside(numbers);
    if number % 2 == 1 {
        let [altitude_deg, azimuth_deg] = [numbers.within(15.0, 70.0), numbers.within(0.0, 360.0)];
        let centre = SkyPoint { altitude_deg, azimuth_deg };
        environment.sun = Some(Sun { centre, normal_illuminance_lx: 20_000.0 });
    }
    let far_m = numbers.within(2.0, 8.0);
    let width = DVec3::X * (20.0 + size.x);
    let left = DVec3::new(-10.0, 0.0, 0.0);
    let mut panel = |corner: DVec3, u: DVec3, v: DVec3, reflectance: f64| {
        add_panel(&mut scene, corner, u, v, diffuse(reflectance));
    };
    panel(left, width, DVec3::NEG_Y * far_m, 0.3);
    let high = DVec3::Z * numbers.within(0.5, 3.0) * size.z;
    panel(left + DVec3::NEG_Y * far_m, width, high, numbers.within(0.2, 0.9));
    if !number.is_multiple_of(3) {
        let out_m = numbers.within(0.3, 0.9) * far_m;
        panel(left + DVec3::Z * size.z, width, DVec3::NEG_Y * out_m, 0.5);
    }
    if number % 4 < 2 {
        environment.openings.push(window);
    } else {
        let pane = Bsdf::Pane(Pane::Clear { eta: ETA });
        add_panel(&mut scene, window.origin, window.u, window.v, pane);
    }
    scene.environment = Some(environment);
    let at = |x: f64, y: f64, z: f64| size * DVec3::new(x, y, z);
    let outside = DVec3::new(0.5 * size.x, -0.5 * far_m, 0.02);
    let places = [
        (at(0.3, 0.3, 0.3), DVec3::Z),
        (at(0.7, 0.8, 0.3), DVec3::Z),
        (at(0.5, 0.98, 0.5), DVec3::NEG_Y),
        (at(0.5, 0.5, 0.9), DVec3::NEG_Z),
        (outside, DVec3::Z),
    ];
    scene.sensors = vec![points("points", &places)];
    scene
}

/// Each value with its standard error.
fn with_errors(estimates: &Estimates) -> Vec<[f64; 2]> {
    let rows = &estimates.sensors[0].replicate_lx;
    let n = rows.len() as f64;
    let of_point = |point: usize| {
        let lx = rows.iter().map(|row| row[point]).sum::<f64>() / n;
        let squares = rows.iter().map(|row| (row[point] - lx) * (row[point] - lx));
        [lx, (squares.sum::<f64>() / (n * (n - 1.0))).sqrt()]
    };
    (0..rows[0].len()).map(of_point).collect()
}

/// Over 60 values in 12 rooms, of mean 0 and spread 1 in joint standard errors; a bias of half a
/// standard error of all is found. In rooms the survey saves more than half of the samples.
#[test]
fn it_agrees_with_plain_paths_in_rooms_at_random() {
    let mut numbers = Numbers(43);
    let (mut off, mut gains) = (Vec::new(), Vec::new());
    for number in 0..12 {
        let scene = hidden_room(&mut numbers, number);
        let find = |estimator, importance, samples, seed| {
            let max_samples = Some(samples);
            let max_bounces = (number % 5 == 4).then_some(3);
            let settings =
                Settings { estimator, importance, max_bounces, max_samples, seed, ..settings() };
            with_errors(&run(&scene, &settings))
        };
        let found = find(EstimatorKind::Auto, Switch::Auto, 1 << 9, number);
        let plain = find(EstimatorKind::Auto, Switch::Off, 1 << 7, number + 100);
        let paths = find(EstimatorKind::Path, Switch::Off, 1 << 11, number + 200);
        for (point, (([own, error], [path, path_error]), [_, plain_error])) in
            found.iter().zip(&paths).zip(&plain).enumerate()
        {
            off.push((own - path) / libm::hypot(*error, *path_error));
            if point < INDOORS {
                gains.push(libm::log2(plain_error * plain_error / (4.0 * error * error)));
            }
        }
    }
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let squares: Vec<f64> = off.iter().map(|z| z * z).collect();
    let (bias, spread) = (mean(&off), mean(&squares).sqrt());
    let gain = libm::exp2(mean(&gains));
    let what = format!("mean {bias:.3}, spread {spread:.3}, gain {gain:.2}");
    println!("{what}");
    assert!(bias.abs() < 0.5 && (0.7..1.35).contains(&spread), "{what}");
    assert!(gain > 2.0, "{what}");
}

/// A lamp in a room before whose window a bright shutter is closed, the sky behind it: paths that
/// are led from the room to the shutter and back end, and give what they gave without openings.
#[test]
fn paths_end_between_a_room_and_a_closed_shutter() {
    let mut numbers = Numbers(47);
    let Room { mut scene, window } = room_with_window(&mut numbers, 0.8);
    let [edge_u, edge_v] = [window.u, window.v].map(|edge| 0.2 * edge.normalize());
    let corner = window.origin - edge_u - edge_v + DVec3::NEG_Y * 0.03;
    let (u, v) = (window.u + 2.0 * edge_u, window.v + 2.0 * edge_v);
    add_panel(&mut scene, corner, u, v, diffuse(0.7));
    let size = size_of(&scene);
    scene.lights.push(point_light(size * DVec3::new(0.4, 0.5, 0.8), 500.0));
    let mut environment = outside(&mut numbers);
    environment.ground_reflectance = 0.0;
    let settings = Settings { max_samples: Some(1 << 8), ..settings() };
    scene.environment = Some(environment.clone());
    let without = run(&scene, &settings);
    environment.openings.push(window);
    scene.environment = Some(environment);
    let led = run(&scene, &settings);
    assert!(led.rays < 4 * without.rays, "{} rays, {} without", led.rays, without.rays);
    for (own, other) in with_errors(&led).iter().zip(with_errors(&without)) {
        let off = (own[0] - other[0]) / libm::hypot(own[1], other[1]);
        assert!(off.abs() < 4.5, "{own:?}, {other:?} without openings");
    }
}
