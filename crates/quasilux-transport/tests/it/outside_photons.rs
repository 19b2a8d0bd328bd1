//! Photons from outside: sky, ground and sun against closed forms, and against paths.

use crate::images::add_panel;
use crate::outside::{ETA, Numbers, Room, clear_pane, even, outside, room_with_window, through};
use crate::scenes::{diffuse, point_light};
use glam::DVec3;
use quasilux_scene::bsdf::Pane;
use quasilux_scene::{Bsdf, Environment, Grid, Opening, Quantity, Scene, Sensor, SensorShape, Sun};
use quasilux_sky::SkyPoint;
use quasilux_transport::{Estimates, EstimatorKind, Settings, simulate};
use std::f64::consts::PI;

/// A grid over a parallelogram.
fn grid(name: &str, [origin, u, v]: [DVec3; 3], counts: [u32; 2], normal: DVec3) -> Sensor {
    let quantity = Quantity::Mean;
    let grid = Grid { origin, u, v, counts, normal, quantity, target_lx: None };
    Sensor { name: name.to_owned(), shape: SensorShape::Grid(grid) }
}

/// This many samples, without a tolerance.
fn run(scene: &Scene, estimator: EstimatorKind, samples: u64, seed: u64) -> Estimates {
    let max_samples = Some(samples);
    let settings = Settings { estimator, max_samples, rel_tol: 0.0, seed, ..Settings::default() };
    let estimates = simulate(scene, &settings, &mut ());
    assert!(estimates.invalid_contributions == 0 && !estimates.biased);
    estimates
}

/// A mean with its standard error.
#[derive(Clone, Copy, Debug)]
struct LuxWithError {
    lx: f64,
    error: f64,
}

/// Of all targets.
fn found(estimates: &Estimates) -> Vec<LuxWithError> {
    let sensors = estimates.sensors.iter();
    let of_sensor = sensors.flat_map(|sensor| {
        let rows = &sensor.replicate_lx;
        (0..rows[0].len()).map(|point| {
            let n = rows.len() as f64;
            let lx = rows.iter().map(|row| row[point]).sum::<f64>() / n;
            let squares = rows.iter().map(|row| (row[point] - lx) * (row[point] - lx));
            LuxWithError { lx, error: (squares.sum::<f64>() / (n * (n - 1.0))).sqrt() }
        })
    });
    of_sensor.collect()
}

/// Standard errors between what was found and what is expected.
fn z(found: LuxWithError, expected: LuxWithError) -> f64 {
    (found.lx - expected.lx) / libm::hypot(found.error, expected.error)
}

/// Sides of a black plate in the open: openings around it, in part or twice, change nothing.
#[test]
fn an_even_sky_and_the_sun_light_a_plate_in_the_open() {
    let [altitude_deg, normal_illuminance_lx] = [40.0, 5000.0];
    let centre = SkyPoint { altitude_deg, azimuth_deg: 90.0 };
    let sun = Sun { centre, normal_illuminance_lx };
    let mut environment = Environment { ground_reflectance: 0.25, ..even(1000.0) };
    let opening = |origin: DVec3, u: DVec3, v: DVec3| Opening { origin, u, v };
    let above = opening(DVec3::new(-0.5, -0.2, 0.4), DVec3::X * 1.2, DVec3::new(0.0, 0.9, 0.3));
    let beside = opening(DVec3::new(1.5, -1.0, -1.0), DVec3::Y * 2.0, DVec3::Z * 2.0);
    let mut scene = crate::images::empty();
    add_panel(&mut scene, DVec3::ZERO, DVec3::X, DVec3::Y, diffuse(0.0));
    let (x, y) = (DVec3::X * 0.8, DVec3::Y * 0.8);
    let east = DVec3::new(1.01, 0.1, -0.4);
    scene.sensors = vec![
        grid("up", [DVec3::new(0.1, 0.1, 0.01), x, y], [2, 1], DVec3::Z),
        grid("down", [DVec3::new(0.1, 0.1, -0.01), x, y], [1, 1], DVec3::NEG_Z),
        grid("east", [east, y, DVec3::Z * 0.8], [1, 1], DVec3::X),
    ];
    for (seed, with_sun, openings) in [
        (1, false, vec![]),
        (2, true, vec![]),
        (3, true, vec![above]),
        (4, true, vec![above, beside, above]),
        (5, false, vec![beside]),
    ] {
        environment.sun = Some(sun).filter(|_| with_sun);
        scene.environment = Some(Environment { openings, ..environment.clone() });
        let normal_lx = if with_sun { normal_illuminance_lx } else { 0.0 };
        let (sin, cos) = libm::sincos(altitude_deg.to_radians());
        let level_lx = 1000.0 * PI + normal_lx * sin;
        let below_lx = 0.25 * level_lx;
        let upright_lx = 0.5 * (1000.0 * PI + below_lx) + normal_lx * cos;
        let expected = [level_lx, level_lx, below_lx, upright_lx];
        let photons = found(&run(&scene, EstimatorKind::Photon, 1 << 14, seed));
        for (own, lx) in photons.into_iter().zip(expected) {
            let z = z(own, LuxWithError { lx, error: 1e-6 * lx });
            assert!(z.abs() < 4.5 && own.error < 0.02 * lx, "{seed}: {own:?}, not {lx}");
        }
    }
}

/// The mean over a square cell of what comes through an opening, by a rule that is exact for cubic
/// functions.
fn mean_through(
    opening: &Opening,
    environment: &Environment,
    transmittance: impl Fn(f64) -> f64 + Copy,
    [origin, u, v, n]: [DVec3; 4],
) -> f64 {
    let place = |i: i32| 0.5 + f64::from(2 * i - 1) / (2.0 * 3_f64.sqrt());
    let at = |i: i32| origin + u * place(i % 2) + v * place(i / 2);
    (0..4).map(|i| through(opening, environment, transmittance, [at(i), n])).sum::<f64>() / 4.0
}

/// In black rooms, through openings that are named, panes that are found, and openings that nobody
/// names: of 12 values none is 4.5 standard errors off, of at most 4 %, or 20 % where photons have
/// to find the opening.
#[test]
fn windows_give_the_integral_of_what_is_behind_them() {
    let mut numbers = Numbers(23);
    for number in 0..6 {
        let Room { mut scene, window } = room_with_window(&mut numbers, 0.0);
        let mut environment = outside(&mut numbers);
        let (is_named, is_glazed) = (number % 3 == 0, number % 3 == 1);
        if is_glazed {
            let pane = Bsdf::Pane(Pane::Clear { eta: ETA });
            add_panel(&mut scene, window.origin, window.u, window.v, pane);
        } else if is_named {
            environment.openings.push(window);
        }
        let middle = window.origin + 0.5 * (window.u + window.v);
        let level = DVec3::new(middle.x - 0.2, 1.0, 0.1);
        let back = DVec3::new(middle.x - 0.2, 2.5, 1.0);
        let cells = [
            [level, DVec3::X * 0.4, DVec3::Y * 0.4, DVec3::Z],
            [back, DVec3::X * 0.4, DVec3::Z * 0.4, DVec3::NEG_Y],
        ];
        scene.sensors =
            cells.map(|[origin, u, v, n]| grid("cell", [origin, u, v], [1, 1], n)).to_vec();
        scene.environment = Some(environment.clone());
        let (samples, most) = if is_named || is_glazed { (1 << 17, 0.04) } else { (1 << 19, 0.2) };
        let photons = found(&run(&scene, EstimatorKind::Photon, samples, number));
        for (own, cell) in photons.into_iter().zip(cells) {
            let passed = |cos| if is_glazed { clear_pane(cos) } else { 1.0 };
            let lx = mean_through(&window, &environment, passed, cell);
            let off = z(own, LuxWithError { lx, error: 1e-4 * lx });
            assert!(off.abs() < 4.5 && own.error < most * lx, "{number}: {own:?}, not {lx}");
        }
    }
}

/// What photons find in rooms at random, and paths that are connected to light subpaths, beside
/// what paths find: over 64 values each, of mean 0 and spread 1 in joint standard errors. A bias of
/// half a standard error of all is found.
#[test]
fn photons_and_paths_agree_in_rooms_at_random() {
    let mut numbers = Numbers(29);
    let ways = [(EstimatorKind::Photon, 1 << 12), (EstimatorKind::Bidirectional, 1 << 6)];
    let mut all: [Vec<f64>; 2] = Default::default();
    for number in 0..8 {
        let mut scene = lit_room(&mut numbers, number % 4, number >= 4);
        add_sensors(&mut scene);
        let max_bounces = (number % 3 == 1).then_some(3);
        let find = |estimator, samples, seed| {
            let settings = Settings {
                estimator,
                max_bounces,
                max_samples: Some(samples),
                rel_tol: 0.0,
                seed,
                ..Settings::default()
            };
            let estimates = simulate(&scene, &settings, &mut ());
            assert!(estimates.invalid_contributions == 0 && !estimates.biased);
            found(&estimates)
        };
        let paths = find(EstimatorKind::Path, 1 << 8, number);
        for ((estimator, samples), all) in ways.into_iter().zip(&mut all) {
            let own = find(estimator, samples, number + 100);
            all.extend(own.into_iter().zip(&paths).map(|(own, path)| z(own, *path)));
        }
    }
    for ((estimator, _), all) in ways.iter().zip(&all) {
        let n = all.len() as f64;
        let mean = all.iter().sum::<f64>() / n;
        let spread = (all.iter().map(|z| z * z).sum::<f64>() / n).sqrt();
        let what = format!("{estimator:?}: mean {mean:.3}, spread {spread:.3}");
        println!("{what}");
        assert!(mean.abs() < 0.5 && (0.7..1.35).contains(&spread), "{what}");
    }
}

/// Threads change no bit, and lamps beside the sky are no matter of the outside: all estimators
/// find what paths do.
#[test]
fn threads_change_no_bit_beside_lamps() {
    let mut numbers = Numbers(31);
    let mut scene = lit_room(&mut numbers, 1, true);
    add_sensors(&mut scene);
    scene.lights.push(point_light(DVec3::new(1.0, 1.5, 2.0), 300.0));
    let find = |estimator, samples, threads| {
        let settings =
            Settings { estimator, max_samples: Some(samples), rel_tol: 0.0, ..Settings::default() };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| found(&simulate(&scene, &settings, &mut ())))
    };
    let paths = find(EstimatorKind::Path, 1 << 8, 2);
    for (estimator, samples) in [
        (EstimatorKind::Photon, 1 << 12),
        (EstimatorKind::BidirectionalMap, 1 << 4),
        (EstimatorKind::Auto, 1 << 7),
    ] {
        let [one, two] = [1, 2].map(|threads| find(estimator, samples, threads));
        for (one, two) in one.iter().zip(&two) {
            assert_eq!(one.lx.to_bits(), two.lx.to_bits(), "{estimator:?}");
        }
        let is_biased = estimator == EstimatorKind::BidirectionalMap;
        for (own, path) in one.into_iter().zip(&paths) {
            let off = z(own, *path).abs();
            assert!(off < 4.5 || is_biased, "{estimator:?}: {own:?}, not {path:?}");
        }
    }
}

/// A room lit from outside: through a named opening, a pane that is found, an opening that nobody
/// names, or as a courtyard.
fn lit_room(numbers: &mut Numbers, kind: u64, with_sun: bool) -> Scene {
    let Room { mut scene, window } = room_with_window(numbers, 0.6);
    let mut environment = outside(numbers);
    if with_sun {
        let [altitude_deg, azimuth_deg] =
            [numbers.within(15.0, 60.0), numbers.within(120.0, 240.0)];
        let centre = SkyPoint { altitude_deg, azimuth_deg };
        environment.north_deg = 0.0;
        environment.sun = Some(Sun { centre, normal_illuminance_lx: 30_000.0 });
    }
    match kind {
        0 => environment.openings.push(window),
        1 => {
            let pane = Bsdf::Pane(Pane::Clear { eta: ETA });
            add_panel(&mut scene, window.origin, window.u, window.v, pane);
        }
        2 => (),
        _ => {
            // Without its ceiling.
            let high = scene.mesh.positions.iter().fold(0.0, |high: f64, at| high.max(at.z));
            let is_ceiling = |triangle: usize| {
                scene.mesh.corners(triangle as u32).iter().all(|corner| corner.z == high)
            };
            let kept: Vec<usize> =
                (0..scene.mesh.triangles.len()).filter(|number| !is_ceiling(*number)).collect();
            scene.mesh.triangles = kept.iter().map(|k| scene.mesh.triangles[*k]).collect();
            scene.mesh.material_of = kept.iter().map(|k| scene.mesh.material_of[*k]).collect();
            scene.mesh.object_of = kept.iter().map(|k| scene.mesh.object_of[*k]).collect();
        }
    }
    scene.environment = Some(environment);
    scene
}

fn add_sensors(scene: &mut Scene) {
    let [low, high] = scene.mesh.bounds().unwrap();
    let size = high - low;
    let at = |x: f64, y: f64, z: f64| low + size * DVec3::new(x, y, z);
    let (u, v) = (DVec3::X * 0.6 * size.x, DVec3::Y * 0.6 * size.y);
    scene.sensors = vec![
        grid("floor", [at(0.2, 0.2, 0.05), u, v], [2, 2], DVec3::Z),
        grid("up", [at(0.2, 0.2, 0.8), u, v], [2, 1], DVec3::NEG_Z),
        grid("wall", [at(0.2, 0.9, 0.2), u, DVec3::Z * 0.6 * size.z], [2, 1], DVec3::NEG_Y),
    ];
}
