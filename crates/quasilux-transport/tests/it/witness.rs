//! The witness: light that the estimate misses withdraws intervals, and plain rooms keep theirs.

use crate::materials::add_box;
use crate::scenes::{diffuse, level_grid, point_light, points, room};
use crate::spotlight::spotlight;
use glam::DVec3;
use quasilux_scene::light::Luminaire;
use quasilux_scene::{Light, Scene};
use quasilux_transport::{Estimates, EstimatorKind, Settings, simulate};
use std::f64::consts::{FRAC_1_PI, TAU};

/// Numbers that look random (Knuth's MMIX generator).
struct Numbers(u64);

impl Numbers {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((self.0 >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// A place in a room, no nearer to its walls than this.
    fn place(&mut self, size: DVec3, margin_m: f64) -> DVec3 {
        let coordinate = |numbers: &mut Self, most: f64| numbers.between(margin_m, most - margin_m);
        DVec3::new(coordinate(self, size.x), coordinate(self, size.y), coordinate(self, size.z))
    }
}

/// A room of random size with one point light, and sensors in the air, on a plane and upside down.
struct Room {
    scene: Scene,
    size: DVec3,
    reflectance: f64,
    sensors: Vec<[DVec3; 2]>,
}

fn random_room(numbers: &mut Numbers) -> Room {
    let size =
        DVec3::new(numbers.between(2.0, 8.0), numbers.between(2.0, 6.0), numbers.between(2.2, 4.0));
    let reflectance = numbers.between(0.2, 0.75);
    let mut scene = room(size, diffuse(reflectance));
    scene.lights.push(point_light(numbers.place(size, 0.3), numbers.between(50.0, 500.0)));
    let sensors: Vec<[DVec3; 2]> =
        [DVec3::Z, DVec3::NEG_Z, DVec3::X].map(|n| [numbers.place(size, 0.4), n]).to_vec();
    let places: Vec<(DVec3, DVec3)> = sensors.iter().map(|[at, n]| (*at, *n)).collect();
    scene.sensors.push(points("probes", &places));
    scene.sensors.push(level_grid(DVec3::new(0.2, 0.2, 0.8), [size.x - 0.4, size.y - 0.4], [3, 2]));
    Room { scene, size, reflectance, sensors }
}

fn run(scene: &Scene, estimator: EstimatorKind, seed: u64) -> Estimates {
    let max_samples = Some(1 << 12);
    let settings = Settings { estimator, seed, rel_tol: 0.03, max_samples, ..Settings::default() };
    simulate(scene, &settings, &mut ())
}

fn contradicted(estimates: &Estimates) -> usize {
    let points = estimates.sensors.iter().flat_map(|sensor| &sensor.contradicted);
    points.filter(|contradicted| **contradicted).count()
}

/// A beam that lights a spot of some millimetres on the floor, which paths do not meet. What the
/// spot sends straight to a sensor has a closed form, that of a small Lambertian source, and comes
/// on top of what is there without the beam: a lower bound of the truth.
#[test]
fn intervals_that_miss_a_beam_are_withdrawn() {
    const HEIGHT_M: f64 = 0.002;
    const DIMMING: f64 = 100.0;
    let mut numbers = Numbers(7);
    let (mut too_low, mut withdrawn) = (0, 0);
    for seed in 0..12 {
        let Room { mut scene, size, reflectance, sensors } = random_room(&mut numbers);
        let without = run(&scene, EstimatorKind::Path, seed);
        let spot = DVec3 { z: 0.0, ..numbers.place(size, 0.5) };
        let Light::Luminaire(lamp) = spotlight(spot + DVec3::Z * HEIGHT_M) else { continue };
        scene.lights.push(Light::Luminaire(Luminaire { dimming: DIMMING, ..lamp }));
        // Only what falls within 6 degrees is counted: at least 8000 cd up to 4.
        let flux_lm = TAU * (1.0 - libm::cos(4.0_f64.to_radians())) * 8000.0 * DIMMING;
        let found = run(&scene, EstimatorKind::Path, seed);
        let intervals = found.point_intervals(0);
        for (point, [at, n]) in sensors.iter().enumerate() {
            let way = spot - *at;
            let cosines = (n.dot(way) / way.length()).max(0.0) * (at.z / way.length());
            let lux = flux_lm * reflectance * FRAC_1_PI * cosines / way.length_squared();
            let least = without.point_intervals(0)[point].value + lux;
            let value = found.sensors[0].replicate_lx.iter().map(|row| row[point]).sum::<f64>()
                / found.sensors[0].replicate_lx.len() as f64;
            let is_low = value < 0.9 * least;
            too_low += usize::from(is_low);
            withdrawn += usize::from(is_low && intervals[point].half_width.is_none());
            let holds = intervals[point]
                .half_width
                .is_none_or(|half_width| value + 3.0 * half_width > least - 0.05 * least);
            assert!(holds, "seed {seed}: {:?} is {least} lx at least", intervals[point]);
        }
    }
    assert!(too_low >= 6 && withdrawn == too_low, "{withdrawn} of {too_low}");
}

/// Rooms with furniture and lights near the ceiling: not one point of them all is contradicted, and
/// the witness takes a tenth of the rays at most.
#[test]
fn plain_rooms_are_not_contradicted() {
    let mut numbers = Numbers(11);
    for seed in 0..24 {
        let Room { mut scene, size, .. } = random_room(&mut numbers);
        let low = DVec3 { z: 0.0, ..numbers.place(size, 0.6) };
        add_box(&mut scene, low, low + DVec3::new(0.4, 0.5, 0.7), diffuse(0.4));
        for _ in 0..4 {
            let mut at = numbers.place(size, 0.3);
            at.z = size.z - numbers.between(0.02, 0.2);
            scene.lights.push(Light::Point(quasilux_scene::light::PointLight {
                position: at,
                intensity_cd: numbers.between(20.0, 200.0),
            }));
        }
        let estimator = if seed % 2 == 0 { EstimatorKind::Path } else { EstimatorKind::Selected };
        let found = run(&scene, estimator, seed);
        assert_eq!(contradicted(&found), 0, "seed {seed}, {estimator:?}");
    }
}
