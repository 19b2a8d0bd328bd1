//! Small bright area lights seen in mirrors beside ordinary light, with images of lights switched
//! off: paths meet them by chance, and the bound on unseen light knows of those that none met.

use crate::images::add_panel;
use crate::scenes::{diffuse, mirror, point_light, points, room};
use glam::DVec3;
use quasilux_scene::light::AreaLight;
use quasilux_scene::{Light, Scene};
use quasilux_stats::deep;
use quasilux_transport::{Estimates, EstimatorKind, Settings, simulate};

const SIZE: DVec3 = DVec3::new(5.0, 4.0, 3.0);
const MIRROR: f64 = 0.9;
const EDGE_M: f64 = 0.03;
const LUMINANCE_CD_M2: f64 = 4e5;

/// A room with a mirror on the wall x = 0, a light in the middle, and nine sensors that look at the
/// mirror.
fn mirrored_room() -> Scene {
    let mut scene = room(SIZE, diffuse(0.5));
    let corner = DVec3::new(1e-3, 0.1, 0.1);
    add_panel(
        &mut scene,
        corner,
        DVec3::Y * (SIZE.y - 0.2),
        DVec3::Z * (SIZE.z - 0.2),
        mirror(MIRROR),
    );
    scene.lights.push(point_light(0.5 * SIZE, 150.0));
    let places: Vec<(DVec3, DVec3)> = places().map(|at| (at, DVec3::NEG_X)).collect();
    scene.sensors.push(points("probes", &places));
    scene
}

fn places() -> impl Iterator<Item = DVec3> {
    (0..9).map(|i| DVec3::new(1.0, 0.8 + 1.2 * f64::from(i % 3), 0.6 + 0.9 * f64::from(i / 3)))
}

/// Adds a small light of this luminance that faces the mirror, at `at`.
fn add_light(scene: &mut Scene, at: DVec3, luminance_cd_m2: f64) {
    let first = scene.mesh.triangles.len() as u32;
    let (u, v) = (DVec3::Z * EDGE_M, DVec3::Y * EDGE_M);
    add_panel(scene, at - 0.5 * (u + v), u, v, diffuse(0.0));
    let material = scene.mesh.material_of[first as usize];
    let triangles = vec![first, first + 1];
    let area_m2 = EDGE_M * EDGE_M;
    scene.lights.push(Light::Area(AreaLight { material, triangles, area_m2, luminance_cd_m2 }));
}

fn run(scene: &Scene, seed: u64, max_samples: u64) -> Estimates {
    let settings = Settings {
        estimator: EstimatorKind::Bidirectional,
        image_depth: Some(0),
        rel_tol: 0.02,
        max_samples: Some(max_samples),
        seed,
        ..Settings::default()
    };
    simulate(scene, &settings, &mut ())
}

/// Adds a panel of 6 m^2 and 100 cd/m^2 that faces the mirror.
fn add_large_panel(scene: &mut Scene) {
    let first = scene.mesh.triangles.len() as u32;
    let corner = DVec3::new(4.5, 0.5, 0.5);
    add_panel(scene, corner, DVec3::Z * 2.0, DVec3::Y * 3.0, diffuse(0.0));
    let material = scene.mesh.material_of[first as usize];
    let triangles = vec![first, first + 1];
    let (area_m2, luminance_cd_m2) = (6.0, 100.0);
    scene.lights.push(Light::Area(AreaLight { material, triangles, area_m2, luminance_cd_m2 }));
}

#[test]
fn values_with_both_numbers_know_of_glints() {
    assert_glints_are_known(&mirrored_room(), LUMINANCE_CD_M2);
}

/// Hits of a large panel in the mirror are many, and say nothing of the small lamp beside it.
#[test]
fn hits_of_another_light_are_no_hits_of_a_glint() {
    let mut scene = mirrored_room();
    add_large_panel(&mut scene);
    // Brighter, for the panel makes the rest brighter.
    assert_glints_are_known(&scene, 4.0 * LUMINANCE_CD_M2);
}

/// What comes over the mirror has a closed form: the image of a small source, `r L A cos cos /
/// d^2`, on top of what there is without it. Six places of the light, sixteen in the deep variant:
/// at each a bound is found that is less than the glint which its value misses.
fn assert_glints_are_known(room: &Scene, luminance_cd_m2: f64) {
    let without = run(room, 1, 1 << 12).point_intervals(0);
    for seed in 0..if deep() { 16 } else { 6 } {
        let mut scene = room.clone();
        let place = |step: f64| (f64::from(seed as u32) * step).fract();
        let at = DVec3::new(
            2.5 + 2.0 * place(0.618),
            0.5 + 3.0 * place(0.7549),
            0.5 + 2.0 * place(0.5698),
        );
        add_light(&mut scene, at, luminance_cd_m2);
        let found = run(&scene, seed, 256);
        let unseen = found.sensors[0].unseen.as_ref().expect("a bound");
        let image = DVec3::new(-at.x, at.y, at.z);
        for (point, place) in places().enumerate() {
            let way = place - image;
            let cosine = way.x / way.length();
            let of_source_cd = MIRROR * luminance_cd_m2 * EDGE_M * EDGE_M;
            let glint_lx = of_source_cd * cosine * cosine / way.length_squared();
            let least_lx = without[point].value + 0.95 * glint_lx;
            let interval = found.point_intervals(0)[point];
            let allowed_lx = 3.0 * interval.half_width.unwrap() + unseen.point_lx[point];
            let about = format!("{interval:?}, unseen {}", unseen.point_lx[point]);
            assert!(interval.value + allowed_lx > least_lx, "{seed}, {point}: {about}, {least_lx}");
            assert!(unseen.point_lx[point] < 100.0 * least_lx, "{seed}, {point}: {about}");
        }
    }
}
