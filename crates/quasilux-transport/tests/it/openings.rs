//! Rooms beside brighter rooms: light through openings, and lamps that walls hide.

use crate::cameras::camera;
use crate::images::add_panel;
use crate::scenes::{diffuse, point_light, points, room};
use glam::DVec3;
use quasilux_scene::{Camera, Scene};
use quasilux_stats::deep;
use quasilux_transport::{Estimates, EstimatorKind, Pixel, Settings, simulate};
use std::f64::consts::PI;

/// Two rooms together, and where the wall between them stands.
const SIZE: DVec3 = DVec3::new(6.2, 3.0, 2.7);
const WALL_M: f64 = 3.1;
/// A corner of the hole in the wall.
const HOLE: DVec3 = DVec3::new(WALL_M, 1.3, 1.0);
/// Where sensors are in the room on the left.
const PLACES: [(DVec3, DVec3); 4] = [
    (DVec3::new(0.6, 0.7, 0.8), DVec3::Z),
    (DVec3::new(1.9, 2.1, 1.5), DVec3::X),
    (DVec3::new(2.6, 1.1, 2.0), DVec3::NEG_Y),
    (DVec3::new(1.2, 2.4, 0.5), DVec3::NEG_X),
];

/// Two rooms with a lamp of this intensity each, and a square hole of this side between them.
fn two_rooms([left_cd, right_cd]: [f64; 2], hole_m: f64) -> Scene {
    let mut scene = room(SIZE, diffuse(0.6));
    let end = HOLE + DVec3::splat(hole_m);
    let mut wall = |low: [f64; 2], high: [f64; 2]| {
        let corner = DVec3::new(WALL_M, low[0], low[1]);
        let [width_m, height_m] = [high[0] - low[0], high[1] - low[1]];
        add_panel(&mut scene, corner, DVec3::Y * width_m, DVec3::Z * height_m, diffuse(0.6));
    };
    wall([0.0, 0.0], [HOLE.y, SIZE.z]);
    wall([end.y, 0.0], [SIZE.y, SIZE.z]);
    wall([HOLE.y, 0.0], [end.y, HOLE.z]);
    wall([HOLE.y, end.z], [end.y, SIZE.z]);
    if hole_m == 0.0 {
        // The seams of the four parts need no light either.
        let corner = DVec3::new(WALL_M + 0.01, 0.0, 0.0);
        add_panel(&mut scene, corner, DVec3::Y * SIZE.y, DVec3::Z * SIZE.z, diffuse(0.6));
    }
    for (x, intensity_cd) in [(1.5, left_cd), (4.7, right_cd)] {
        if intensity_cd > 0.0 {
            scene.lights.push(point_light(DVec3::new(x, 1.4, 2.2), intensity_cd));
        }
    }
    scene.sensors.push(points("places", &PLACES));
    scene
}

/// A night lamp beside a bright room, behind a keyhole of 1 cm.
fn keyhole() -> Scene {
    two_rooms([0.3, 1e5], 0.01)
}

fn run(scene: &Scene, estimator: EstimatorKind, samples: u64, seed: u64) -> Estimates {
    let max_samples = Some(samples);
    let settings = Settings { estimator, seed, max_samples, rel_tol: 0.02, ..Settings::default() };
    simulate(scene, &settings, &mut ())
}

/// A lamp of 10^6 cd behind a wall takes nothing from what is known of one of 0.3 cd before it:
/// values are those without it. Where lights are chosen by what they would give unshadowed, one of
/// a million surfaces asks the weak one, and half of its light is missing; 10 % is found here.
#[test]
fn a_hidden_lamp_takes_no_choice_from_a_weak_one() {
    let [beside, alone] = [1e6, 0.0].map(|right_cd| two_rooms([0.3, right_cd], 0.0));
    for seed in 0..4 {
        let reference = run(&alone, EstimatorKind::Path, 1 << 12, seed).point_intervals(0);
        let estimates = run(&beside, EstimatorKind::Path, 1 << 12, seed + 10).point_intervals(0);
        for (found, expected) in estimates.iter().zip(&reference) {
            let widths = [found, expected].map(|interval| interval.half_width.unwrap_or(0.0));
            let both_lx = libm::hypot(widths[0], widths[1]).max(1e-3 * expected.value);
            let off_lx = (found.value - expected.value).abs();
            assert!(off_lx < 2.5 * both_lx, "seed {seed}: {found:?}, alone {expected:?}");
            assert!(both_lx < 0.1 * expected.value, "seed {seed}: {found:?} says too little");
        }
    }
}

/// Light of the bright room comes through a keyhole that one of 10^5 paths meets, and is as much as
/// that of the night lamp: no run of a second knows it, and none says that it does. 12 points, 32
/// in the deep variant: bounds that are too small at one point in five are found in 14 of 15 cases.
#[test]
fn light_behind_a_keyhole_is_told_by_all_seeds() {
    for seed in 0..if deep() { 8 } else { 3 } {
        let estimates = run(&keyhole(), EstimatorKind::Auto, 512, seed);
        let unseen = estimates.sensors[0].unseen.as_ref().expect("a bound");
        let intervals = estimates.point_intervals(0);
        for (interval, unseen_lx) in intervals.iter().zip(&unseen.point_lx) {
            assert!(*unseen_lx > interval.value, "seed {seed}: {interval:?}, {unseen_lx} lx");
        }
        assert!(!estimates.tolerance_reached, "seed {seed}");
    }
}

/// Rooms alike on both sides of a wall, or of a door, keep nobody waiting.
#[test]
fn rooms_alike_are_no_secret() {
    for (seed, hole_m) in [(1, 0.0), (2, 0.0), (3, 1.2), (4, 1.2)] {
        let estimates = run(&two_rooms([100.0, 120.0], hole_m), EstimatorKind::Auto, 1 << 13, seed);
        assert!(estimates.tolerance_reached, "{hole_m}: {:?}", estimates.sensors[0].unseen);
    }
}

/// A hole that few plain paths find.
#[test]
fn light_through_a_hole_is_found() {
    let scene = two_rooms([0.0, 1000.0], 0.25);
    let estimates = run(&scene, EstimatorKind::Auto, 1 << 12, 1);
    let reference = run(&scene, EstimatorKind::Path, 1 << 15, 2).point_intervals(0);
    for (found, expected) in estimates.point_intervals(0).iter().zip(&reference) {
        let Some((a, b)) = found.half_width.zip(expected.half_width) else { continue };
        assert!(
            (found.value - expected.value).abs() < 2.5 * libm::hypot(a, b),
            "{found:?}, {expected:?}"
        );
        assert!(a < 0.2 * found.value);
    }
}

/// Of what a few paths of a pixel find of a keyhole's light most is too little; with the bound on
/// unseen light it is not.
#[test]
fn pixels_may_miss_the_light_of_a_keyhole_and_say_so() {
    let (from, on_wall) = (DVec3::new(2.5, 1.6, 1.3), DVec3::new(0.0, 1.6, 1.3));
    let mut scene = keyhole();
    scene.sensors = vec![points("wall", &[(on_wall, DVec3::X)])];
    let lit = run(&scene, EstimatorKind::Bidirectional, 1 << 14, 99).point_intervals(0)[0];
    assert!(lit.half_width.unwrap() < 0.2 * lit.value, "{lit:?}");
    let least_cd_m2 = 0.6 / PI * (lit.value - lit.half_width.unwrap());
    scene.sensors.clear();
    let eye = Camera { vertical_fov_rad: 0.02, resolution: [2, 2], ..camera(from, on_wall) };
    scene.cameras.push(eye);
    let pictures = (0..20).map(|seed| run(&scene, EstimatorKind::Auto, 2, seed));
    let pixels: Vec<Pixel> = pictures.flat_map(|it| it.cameras[0].pixels.to_vec()).collect();
    let too_low = |with_unseen: f32| {
        let most = |pixel: &Pixel| {
            let unseen = pixel.unseen_cd_m2.unwrap();
            pixel.luminance_cd_m2 + pixel.half_width_cd_m2.unwrap_or(0.0) + with_unseen * unseen
        };
        pixels.iter().filter(|pixel| f64::from(most(pixel)) < least_cd_m2).count()
    };
    assert_eq!(too_low(1.0), 0, "of {}, {least_cd_m2} cd/m2", pixels.len());
    assert!(too_low(0.0) > 20, "nothing was tested: {} of {}", too_low(0.0), pixels.len());
}
