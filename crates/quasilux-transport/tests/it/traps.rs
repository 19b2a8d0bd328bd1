//! Scenes that look easy and are not.

use crate::scenes::{diffuse, diffuse_cube, point_light, points, room};
use glam::DVec3;
use quasilux_scene::light::AreaLight;
use quasilux_scene::{Light, Material, Scene};
use quasilux_transport::{EstimatorKind, Settings, simulate};
use std::f64::consts::PI;

/// A panel of 1 m x 1 m that shines down from `height`, in a black room of 2.5 m.
fn panel_at(height: f64) -> Scene {
    let mut scene = room(DVec3::new(4.0, 4.0, 2.5), diffuse(0.0));
    scene.materials.push(Material { name: "panel".to_owned(), bsdf: diffuse(0.0) });
    let mesh = &mut scene.mesh;
    let first = mesh.positions.len() as u32;
    let corners = [(1.5, 1.5), (1.5, 2.5), (2.5, 2.5), (2.5, 1.5)];
    mesh.positions.extend(corners.map(|(x, y)| DVec3::new(x, y, height)));
    for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
        mesh.triangles.push([first + a, first + b, first + c]);
        mesh.material_of.push(1);
        mesh.object_of.push(0);
    }
    let luminance_cd_m2 = 1000.0;
    let triangles = vec![12, 13];
    let light = AreaLight { material: 1, triangles, area_m2: 1.0, luminance_cd_m2 };
    scene.lights.push(Light::Area(light));
    scene
}

/// A panel drawn onto the ceiling, in its very plane: the light of a point under its centre is the
/// configuration factor of a square of half side a at distance d, four times
/// `a/s atan(a/s) / pi` with `s^2 = a^2 + d^2` (Siegel and Howell 1981, configuration 3).
#[test]
fn a_panel_flush_in_the_ceiling_shines() {
    let mut scene = panel_at(2.5);
    let distance_m = 0.2;
    let below = DVec3::new(2.0, 2.0, 2.5 - distance_m);
    scene.sensors.push(points("below", &[(below, DVec3::Z)]));
    let s = (0.25 + distance_m * distance_m).sqrt();
    let factor = 4.0 / PI * (0.5 / s) * libm::atan(0.5 / s);
    for estimator in [EstimatorKind::Path, EstimatorKind::Bidirectional] {
        let settings = Settings { estimator, ..Settings::default() };
        let interval = simulate(&scene, &settings, &mut ()).point_intervals(0)[0];
        let wanted = 1000.0 * PI * factor;
        let allowed = 1.5 * interval.half_width.unwrap();
        let found = format!("{estimator:?}: {interval:?}, wanted {wanted}");
        assert!((interval.value - wanted).abs() <= allowed, "{found}");
    }
}

/// Two rooms joined by a hole of 1 cm: a few paths find no light in the dark one, which is no
/// proof that there is none.
#[test]
fn light_that_was_not_found_is_not_zero() {
    let mut scene = room(DVec3::new(2.0, 1.0, 1.0), diffuse(0.5));
    let corners = |z: [f64; 2]| {
        [[0.0, z[0]], [1.0, z[0]], [1.0, z[1]], [0.0, z[1]]].map(|[y, z]| DVec3::new(1.0, y, z))
    };
    for z in [[0.0, 0.99], [0.999, 1.0]] {
        let first = scene.mesh.positions.len() as u32;
        scene.mesh.positions.extend(corners(z));
        for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
            scene.mesh.triangles.push([first + a, first + b, first + c]);
            scene.mesh.material_of.push(0);
            scene.mesh.object_of.push(0);
        }
    }
    scene.lights.push(point_light(DVec3::new(0.5, 0.5, 0.5), 10.0));
    scene.sensors.push(points("dark", &[(DVec3::new(1.5, 0.5, 0.01), DVec3::Z)]));
    let estimator = EstimatorKind::Path;
    let settings = Settings { estimator, max_samples: Some(1 << 9), ..Settings::default() };
    let estimates = simulate(&scene, &settings, &mut ());
    let interval = estimates.point_intervals(0)[0];
    assert!(!estimates.tolerance_reached, "{interval:?}");
    assert!(interval.half_width.is_none() || interval.value > 0.0, "{interval:?}");
}

/// A point that no surface faces has no indirect light, and a black room has none anywhere: their
/// light is known to the last bit, and the run ends.
#[test]
fn light_that_cannot_be_is_not_looked_for() {
    let mut scene = room(DVec3::ONE, diffuse(0.0));
    scene.lights.push(point_light(DVec3::splat(0.5), 10.0));
    scene.sensors.push(points("floor", &[(DVec3::new(0.5, 0.5, 0.0), DVec3::Z)]));
    let estimates = simulate(&scene, &Settings::default(), &mut ());
    assert!(estimates.tolerance_reached && estimates.unresolved_points == 0);
    let interval = estimates.point_intervals(0)[0];
    assert!((interval.value - 40.0).abs() < 1e-6 && interval.half_width == Some(0.0));
}

/// National grids put a building millions of metres from the origin.
#[test]
fn a_room_far_from_the_origin_is_the_same_room() {
    let near = diffuse_cube(&[(0.0, 0.0), (0.9, 0.9)]);
    let shift = DVec3::new(5.0e6, 4.0e5, 100.0);
    let mut far = near.clone();
    far.mesh.positions.iter_mut().for_each(|position| *position += shift);
    far.lights = vec![point_light(DVec3::splat(5.0) + shift, 50_000.0)];
    let places = near.sensors[0].points().into_iter().map(|p| (p.position + shift, p.normal));
    far.sensors = vec![points("wall", &places.collect::<Vec<_>>())];
    for estimator in [EstimatorKind::Path, EstimatorKind::BidirectionalMap] {
        let settings = Settings {
            estimator,
            rel_tol: 0.005,
            max_samples: Some(1 << 10),
            ..Settings::default()
        };
        let run = |scene| simulate(scene, &settings, &mut ());
        let (near, far) = (run(&near), run(&far));
        for point in 0..2 {
            let direct =
                |estimates: &quasilux_transport::Estimates| estimates.sensors[0].direct_lx[point];
            assert!((direct(&near) / direct(&far) - 1.0).abs() < 1e-6);
            let [a, b] = [&near, &far].map(|estimates| estimates.point_intervals(0)[point].value);
            assert!((a / b - 1.0).abs() < 1e-3, "{estimator:?}: {a} {b}");
        }
    }
}

/// Where no light was found nobody knows how much is missing, unless there is a bound: neither the
/// point has an interval nor any figure of all points. The second place lies behind a closed wall.
#[test]
fn a_dark_point_leaves_no_figure_certain() {
    let mut scene = room(DVec3::splat(2.0), diffuse(0.5));
    let first = scene.mesh.positions.len() as u32;
    let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
    scene.mesh.positions.extend(corners.map(|[x, y]| DVec3::new(x, y, 1.0)));
    for triangle in [[0, 1, 2], [0, 2, 3]] {
        scene.mesh.triangles.push(triangle.map(|k| first + k));
        scene.mesh.material_of.push(0);
        scene.mesh.object_of.push(0);
    }
    scene.lights.push(point_light(DVec3::new(1.0, 1.0, 1.5), 100.0));
    let at = |z| (DVec3::new(0.7, 0.7, z), DVec3::NEG_Z);
    scene.sensors.push(points("places", &[at(1.8), at(0.8)]));
    let bounded = Settings { max_samples: Some(64), ..Settings::default() };
    let estimates = simulate(&scene, &bounded, &mut ());
    let unseen = estimates.sensors[0].unseen.as_ref().expect("a bound");
    assert!(estimates.point_intervals(0)[1].half_width == Some(0.0) && unseen.point_lx[1] > 0.0);
    let settings = Settings { estimator: EstimatorKind::Path, ..bounded };
    let estimates = simulate(&scene, &settings, &mut ());
    assert_eq!((estimates.unresolved_points, estimates.tolerance_reached), (1, false));
    let [lit, dark] = estimates.point_intervals(0)[..] else { panic!("two points") };
    assert!(lit.half_width.is_some() && (dark.value, dark.half_width) == (0.0, None));
    for figure in
        [estimates.average(0), estimates.minimum(0), estimates.maximum(0), estimates.uniformity(0)]
    {
        assert_eq!(figure.half_width, None, "{figure:?}");
    }
}
