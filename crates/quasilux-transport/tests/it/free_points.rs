//! Photons counted at sensor points in the air: squares around them that end before walls.

use crate::scenes::{diffuse, point_light, points, room};
use glam::DVec3;
use quasilux_sampling::{PointSet, Randomization, Sampler, Sequence};
use quasilux_scene::Scene;
use quasilux_transport::{EstimatorKind, Settings, simulate};

/// Rooms at random, with a point light each.
const ROOMS: u64 = 2;
/// Points in each of them, anywhere and facing anywhere.
const POINTS: usize = 8;
/// A few more are so near to a wall, in m, that their squares must be small.
const NEAR_M: f64 = 0.02;
/// Edges of the others.
const EDGE_M: f64 = 0.1;

fn random_room(number: u64, reflectance: f64) -> Scene {
    let coordinates = PointSet::new(Sequence::Independent, Randomization::None, 11);
    let mut sampler = Sampler::new(&coordinates, number);
    let mut within = |low: f64, high: f64| low + (high - low) * sampler.next_1d();
    let size = DVec3::new(within(1.5, 3.0), within(1.5, 3.0), within(1.5, 2.5));
    let mut scene = room(size, diffuse(reflectance));
    let lamp = DVec3::new(0.5, 0.5, 0.85) * size;
    scene.lights.push(point_light(lamp, 100.0));
    let mut places = Vec::new();
    while places.len() < POINTS {
        let place = DVec3::new(within(0.1, 0.9), within(0.1, 0.9), within(0.1, 0.6)) * size;
        let normal = DVec3::new(within(-1.0, 1.0), within(-1.0, 1.0), within(0.2, 1.0));
        let to_lamp = (lamp - place).normalize();
        if normal.normalize().dot(to_lamp) > 0.2 {
            places.push((place, normal.normalize()));
        }
    }
    for along in [0.3, 0.7] {
        places.push((DVec3::new(NEAR_M, along * size.y, 0.4 * size.z), DVec3::Z));
        places.push((DVec3::new(along * size.x, size.y - NEAR_M, 0.3 * size.z), DVec3::Z));
    }
    places.push((lamp - 0.1 * DVec3::Z, DVec3::Z));
    scene.sensors.push(points("air", &places));
    scene
}

fn count(scene: &Scene, estimator: EstimatorKind, samples: u64) -> Vec<[f64; 2]> {
    let max_samples = Some(samples);
    let map_element_m = Some(EDGE_M);
    let settings =
        Settings { estimator, max_samples, map_element_m, rel_tol: 0.0, ..Settings::default() };
    let estimates = simulate(scene, &settings, &mut ());
    let intervals = estimates.point_intervals(0);
    intervals.iter().map(|own| [own.value, own.half_width.expect("photons came")]).collect()
}

/// In a black room the light of the lamp alone, in one with light walls that of paths. A square
/// that reached through a wall would lose a third of it, one that is as large as its distance from
/// the lamp a fifth.
#[test]
fn squares_in_the_air_count_what_paths_find() {
    for (number, reflectance) in (0..ROOMS).flat_map(|number| [(number, 0.0), (number, 0.7)]) {
        let scene = random_room(number, reflectance);
        let counted = count(&scene, EstimatorKind::Photon, 1 << 18);
        let expected = count(&scene, EstimatorKind::Path, 1 << 9);
        for (point, ([counted, half_width], [value, of_paths])) in
            counted.into_iter().zip(expected).enumerate()
        {
            let by_chance = 2.0 * libm::hypot(half_width, of_paths);
            let off = (counted - value).abs();
            // The mean over a square is not the value in its middle.
            let allowed = by_chance + 0.01 * value;
            assert!(
                off < allowed,
                "room {number}, {reflectance}, point {point}: {counted} {value}"
            );
            assert!(by_chance < 0.45 * value, "room {number}, point {point}: says too little");
        }
    }
}
