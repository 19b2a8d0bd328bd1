//! A hall with a thousand lamps: illuminances are solid angles, in closed form.

use crate::scenes::{diffuse, point_light, room};
use glam::DVec3;
use quasilux_scene::{Grid, Quantity, Scene, Sensor, SensorShape};
use quasilux_transport::{EstimatorKind, Settings, simulate};

const LAMPS: [u32; 2] = [40, 25];

/// Of the sensor.
const CELLS: [u32; 2] = [4, 2];
const SENSOR_HEIGHT_M: f64 = 0.001;

/// Lamps of two strengths, 3 m above the floor of a black hall, a metre from each other.
fn hall() -> Scene {
    let mut scene = room(DVec3::new(41.0, 26.0, 4.0), diffuse(0.0));
    for (position, intensity_cd) in lamps() {
        scene.lights.push(point_light(position, intensity_cd));
    }
    scene.sensors.push(Sensor {
        name: "floor".to_owned(),
        shape: SensorShape::Grid(Grid {
            origin: DVec3::new(0.0, 0.0, SENSOR_HEIGHT_M),
            u: DVec3::X * 41.0,
            v: DVec3::Y * 26.0,
            counts: CELLS,
            normal: DVec3::Z,
            quantity: Quantity::Mean,
            target_lx: None,
        }),
    });
    scene
}

fn lamps() -> impl Iterator<Item = (DVec3, f64)> {
    (0..LAMPS[0]).flat_map(|i| {
        (0..LAMPS[1]).map(move |j| {
            let position = DVec3::new(1.0 + f64::from(i), 1.0 + f64::from(j), 3.0);
            (position, if (i + j) % 2 == 0 { 100.0 } else { 10.0 })
        })
    })
}

/// Solid angle of the rectangle from (0, 0) to (a, b), seen from a distance `h` above (0, 0); odd
/// in `a` and in `b`.
fn corner_solid_angle_sr(a: f64, b: f64, h: f64) -> f64 {
    libm::atan(a * b / (h * (a * a + b * b + h * h).sqrt()))
}

#[test]
fn a_photon_of_a_hall_with_a_thousand_lamps_starts_with_two_coordinates() {
    let scene = hall();
    assert_eq!(scene.lights.len(), 1000);
    let settings =
        Settings { estimator: EstimatorKind::Photon, rel_tol: 0.005, ..Settings::default() };
    let estimates = simulate(&scene, &settings, &mut ());
    let photons = &estimates.dimensions.photon;
    assert_eq!((photons.mean(), photons.counts().len()), (2.0, 3), "and black walls use none");
    assert!(estimates.tolerance_reached);
    for (cell, expected_lx) in expected_means_lx().into_iter().enumerate() {
        let mean = estimates.interval_of(0, |values| values[cell]);
        let half_width_lx = mean.half_width.expect("sixteen replicates");
        let error_lx = (mean.value - expected_lx).abs();
        assert!(error_lx <= 1.5 * half_width_lx, "cell {cell}: {mean:?}, {expected_lx}");
    }
}

/// Of the cells: the lamps' fluxes through them over their area.
fn expected_means_lx() -> Vec<f64> {
    let (width, depth) = (41.0 / f64::from(CELLS[0]), 26.0 / f64::from(CELLS[1]));
    let mean_lx = |i: u32, j: u32| {
        let low = DVec3::new(f64::from(i) * width, f64::from(j) * depth, SENSOR_HEIGHT_M);
        let flux_lm = lamps().map(|(lamp, intensity_cd)| {
            let (x, y, h) = (low.x - lamp.x, low.y - lamp.y, lamp.z - low.z);
            let omega_sr = |x, y| corner_solid_angle_sr(x, y, h);
            let upper = omega_sr(x + width, y + depth) - omega_sr(x, y + depth);
            intensity_cd * (upper - omega_sr(x + width, y) + omega_sr(x, y))
        });
        flux_lm.sum::<f64>() / (width * depth)
    };
    (0..CELLS[1])
        .flat_map(|j| (0..CELLS[0]).map(move |i| (i, j)))
        .map(|(i, j)| mean_lx(i, j))
        .collect()
}
