//! Photons from outside: sky, ground and sun against closed forms, and against paths.

use crate::images::add_panel;
use crate::outside::{ETA, Numbers, Room, clear_pane, even, outside, room_with_window, through};
use crate::scenes::{diffuse, room};
use glam::DVec3;
use quasilux_scene::bsdf::Pane;
use quasilux_scene::{Bsdf, Environment, Grid, Quantity, Scene, Sensor, SensorShape, Sun};
use quasilux_sky::SkyPoint;
use quasilux_transport::{Estimates, EstimatorKind, Settings, simulate};
use std::f64::consts::PI;

/// A grid over a parallelogram.
fn grid(name: &str, [origin, u, v]: [DVec3; 3], counts: [u32; 2], normal: DVec3) -> Sensor {
    let quantity = Quantity::Mean;
    let grid = Grid { origin, u, v, counts, normal, quantity, target_lx: None };
    Sensor { name: name.to_owned(), shape: SensorShape::Grid(grid) }
}

/// So many samples, without a tolerance.
fn run(scene: &Scene, estimator: EstimatorKind, samples: u64, seed: u64) -> Estimates {
    let max_samples = Some(samples);
    let settings = Settings { estimator, max_samples, rel_tol: 0.0, seed, ..Settings::default() };
    let estimates = simulate(scene, &settings, &mut ());
    assert!(estimates.invalid_contributions == 0 && !estimates.biased);
    estimates
}

/// A mean with its standard error.
#[derive(Clone, Copy, Debug)]
struct Found {
    lx: f64,
    error: f64,
}

/// Of all targets.
fn found(estimates: &Estimates) -> Vec<Found> {
    let sensors = estimates.sensors.iter();
    let of_sensor = sensors.flat_map(|sensor| {
        let rows = &sensor.replicate_lx;
        (0..rows[0].len()).map(|point| {
            let n = rows.len() as f64;
            let lx = rows.iter().map(|row| row[point]).sum::<f64>() / n;
            let squares = rows.iter().map(|row| (row[point] - lx) * (row[point] - lx));
            Found { lx, error: (squares.sum::<f64>() / (n * (n - 1.0))).sqrt() }
        })
    });
    of_sensor.collect()
}

#[test]
fn exploration() {
    let mut numbers = Numbers(std::env::var("SEED").map_or(17, |s| s.parse().unwrap()));
    let samples: u64 = std::env::var("SAMPLES").map_or(1 << 12, |s| s.parse().unwrap());
    let mut sums = std::collections::BTreeMap::new();
    for number in 0..12_u64 {
        let kind = number % 4;
        let with_sun = (number / 4) % 2 == 1;
        let mut scene = lit_room(&mut numbers, kind, with_sun);
        add_sensors(&mut scene);
        let paths = found(&run(&scene, EstimatorKind::Path, samples, number));
        for estimator in [EstimatorKind::Photon, EstimatorKind::Bidirectional, EstimatorKind::Auto] {
            let factor = if estimator == EstimatorKind::Photon { 16 } else { 1 };
            let own = found(&run(&scene, estimator, samples * factor, number + 1000));
            for (a, b) in paths.iter().zip(&own) {
                let z = (b.lx - a.lx) / a.error.hypot(b.error);
                let entry = sums.entry(format!("{estimator:?}")).or_insert((0.0, 0.0, 0));
                entry.0 += z;
                entry.1 += z * z;
                entry.2 += 1;
            }
            println!("{number} kind {kind} sun {with_sun} {estimator:?}");
            for (a, b) in paths.iter().zip(&own) {
                let z = (b.lx - a.lx) / a.error.hypot(b.error);
                println!("   {:9.2} ±{:8.3}  {:9.2} ±{:8.3} z {z:6.2}", a.lx, a.error, b.lx, b.error);
            }
        }
    }
    for (name, (sum, square, n)) in sums {
        let n = f64::from(n);
        println!("{name}: mean z {:.3}, rms {:.3}, n {n}", sum / n, f64::sqrt(square / n));
    }
}

/// A room lit from outside: through a named opening, a pane that is found, an opening that nobody
/// names, or as a courtyard.
fn lit_room(numbers: &mut Numbers, kind: u64, with_sun: bool) -> Scene {
    let Room { mut scene, window } = room_with_window(numbers, 0.6);
    let mut environment = outside(numbers);
    if with_sun {
        let [altitude_deg, azimuth_deg] = [numbers.within(15.0, 60.0), numbers.within(120.0, 240.0)];
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
