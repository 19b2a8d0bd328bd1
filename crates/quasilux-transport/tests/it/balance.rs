//! Flux is neither made nor lost.

use crate::materials::tells_of_trapped_light;
use crate::scenes::{diffuse, diffuse_cube, mirror, point_light, points, room};
use glam::DVec3;
use quasilux_transport::{EstimatorKind, Settings, simulate};

#[test]
fn closed_rooms_lose_nothing() {
    for estimator in [EstimatorKind::Photon, EstimatorKind::Path, EstimatorKind::Bidirectional] {
        let settings =
            Settings { estimator, max_samples: Some(1 << 12), rel_tol: 0.0, ..Settings::default() };
        let flux = simulate(&diffuse_cube(&[(0.0, 0.0)]), &settings, &mut ()).flux;
        assert_eq!((flux.lost_lm, flux.cut_lm), (0.0, 0.0));
        assert!((flux.absorbed_lm / flux.emitted_lm - 1.0).abs() < 1e-12);
    }
}

#[test]
fn what_leaves_an_open_room_is_counted() {
    let mut scene = room(DVec3::ONE, diffuse(0.5));
    scene.mesh.triangles.truncate(10);
    scene.lights.push(point_light(DVec3::splat(0.5), 10.0));
    scene.sensors.push(points("p", &[(DVec3::new(0.5, 0.5, 0.1), DVec3::Z)]));
    let settings = Settings { max_bounces: Some(3), rel_tol: 0.05, ..Settings::default() };
    let flux = simulate(&scene, &settings, &mut ()).flux;
    assert!(flux.lost_lm > 0.1 * flux.emitted_lm && flux.cut_lm > 0.0);
    let sum = flux.absorbed_lm + flux.lost_lm + flux.cut_lm;
    assert!((sum / flux.emitted_lm - 1.0).abs() < 1e-12);
}

#[test]
fn a_hall_of_perfect_mirrors_ends_with_a_warning() {
    let mut scene = room(DVec3::ONE, mirror(1.0));
    scene.lights.push(point_light(DVec3::splat(0.4), 10.0));
    scene.sensors.push(points("p", &[(DVec3::new(0.5, 0.5, 0.1), DVec3::Z)]));
    let settings = Settings {
        estimator: EstimatorKind::Path,
        replicates: 2,
        max_samples: Some(2),
        rel_tol: 0.05,
        ..Settings::default()
    };
    let estimates = simulate(&scene, &settings, &mut ());
    assert!(tells_of_trapped_light(&estimates), "{:?}", estimates.caveats);
}
