//! A closed room of emitting walls has the same light everywhere: pi L / (1 - r).

use crate::scenes::{all_walls_emit, diffuse, point_light, points, room};
use glam::DVec3;
use quasilux_scene::bsdf::Diffuse;
use quasilux_scene::rgb::LUMINANCE_WEIGHTS;
use quasilux_scene::{Bsdf, Grid, Quantity, Rgb, Sensor, SensorShape};
use quasilux_stats::deep;
use quasilux_transport::{EstimatorKind, Settings, Switch, UnseenTolerance, simulate};
use std::f64::consts::PI;

/// Known to 2 %, so that an error of 5 % is found nearly always; with a reflectance of 0.99 to 6 %
/// and one of 15 %, but for the deep variant.
#[test]
fn illuminance_is_pi_l_over_one_minus_r() {
    for reflectance in [0.0, 0.5, 0.9, 0.99] {
        for estimator in [EstimatorKind::Path, EstimatorKind::Bidirectional] {
            let mut scene = room(DVec3::new(4.0, 3.0, 2.5), diffuse(reflectance));
            all_walls_emit(&mut scene, 100.0);
            scene.sensors.push(points(
                "probes",
                &[
                    (DVec3::new(2.0, 1.5, 1.2), DVec3::Z),
                    (DVec3::new(0.3, 0.2, 2.3), DVec3::new(0.6, 0.0, -0.8)),
                    (DVec3::new(3.99, 1.0, 0.01), DVec3::NEG_Z),
                    (DVec3::new(1.0, 0.0, 1.0), DVec3::Y),
                ],
            ));
            let unseen_tol = UnseenTolerance::Off;
            let rel_tol = if deep() || reflectance < 0.95 { 0.02 } else { 0.06 };
            let settings = Settings { estimator, rel_tol, unseen_tol, ..Settings::default() };
            let estimates = simulate(&scene, &settings, &mut ());
            assert!(estimates.tolerance_reached);
            let wanted = PI * 100.0 / (1.0 - reflectance);
            for interval in estimates.point_intervals(0) {
                let found = format!("{estimator:?} {reflectance}: {interval:?}, {wanted}");
                // 40 points: half as wide again, or right programs would fail now and then.
                let allowed = 1.5 * interval.half_width.unwrap() + 0.003 * wanted;
                assert!((interval.value - wanted).abs() <= allowed, "{found}");
            }
        }
    }
}

/// Where one sensor stands at an end of a long room, what leaves there matters more than elsewhere,
/// and light subpaths go on in copies. Errors are in standard errors of a point: their mean over
/// three points and ten seeds has one of 0.32 if the points move together.
#[test]
fn copies_of_light_subpaths_bias_nothing() {
    let (reflectance, luminance_cd_m2) = (0.6, 100.0);
    let mut scene = room(DVec3::new(30.0, 1.0, 1.0), diffuse(reflectance));
    all_walls_emit(&mut scene, luminance_cd_m2);
    let probes = [(29.9, DVec3::Z), (29.5, DVec3::NEG_X), (29.0, DVec3::Y)];
    let probes = probes.map(|(x, normal)| (DVec3::new(x, 0.4, 0.6), normal));
    scene.sensors.push(points("end", &probes));
    let wanted_lx = PI * luminance_cd_m2 / (1.0 - reflectance);
    let run = |importance, seed| {
        let settings = Settings {
            importance,
            seed,
            rel_tol: 0.0,
            max_samples: Some(64),
            unseen_tol: UnseenTolerance::Off,
            ..Settings::default()
        };
        simulate(&scene, &settings, &mut ())
    };
    let values = [Switch::Auto, Switch::Off].map(|it| run(it, 0).point_intervals(0)[0].value);
    assert!(values[0] != values[1], "nothing was copied: {values:?}");
    let off = |seed| {
        let intervals = run(Switch::Auto, seed).point_intervals(0);
        let errors =
            intervals.iter().map(|it| (it.value - wanted_lx) * 2.13 / it.half_width.unwrap());
        errors.sum::<f64>() / intervals.len() as f64
    };
    let errors: Vec<f64> = (0..10).map(off).collect();
    let mean = errors.iter().sum::<f64>() / errors.len() as f64;
    assert!(mean.abs() < 1.0, "{mean}: {errors:?}");
}

/// In a room of one saturated colour the light of each channel c is its own furnace: with white
/// light of flux F and walls of area A, the mean illuminance is F / A times the sum of w_c / (1 -
/// r_c).
#[test]
fn a_deep_blue_room_has_the_light_of_its_channels() {
    let reflectance = Rgb([0.05, 0.05, 0.9]);
    let mut scene = room(DVec3::ONE, Bsdf::Diffuse(Diffuse { reflectance }));
    scene.lights.push(point_light(DVec3::splat(0.5), 100.0));
    // All six walls are alike, so one stands for the mean.
    scene.sensors.push(Sensor {
        name: "wall".to_owned(),
        shape: SensorShape::Grid(Grid {
            origin: DVec3::ZERO,
            u: DVec3::Y,
            v: DVec3::Z,
            counts: [1, 1],
            normal: DVec3::X,
            quantity: Quantity::Mean,
            target_lx: None,
        }),
    });
    let channels = LUMINANCE_WEIGHTS.iter().zip(reflectance.0);
    let wanted = 4.0 * PI * 100.0 / 6.0 * channels.map(|(w, r)| w / (1.0 - r)).sum::<f64>();
    for estimator in [EstimatorKind::Photon, EstimatorKind::Path, EstimatorKind::Bidirectional] {
        let settings = Settings { estimator, rel_tol: 0.005, ..Settings::default() };
        let interval = simulate(&scene, &settings, &mut ()).point_intervals(0)[0];
        let allowed = 1.5 * interval.half_width.unwrap();
        let found = format!("{estimator:?}: {interval:?}, wanted {wanted}");
        assert!((interval.value - wanted).abs() <= allowed, "{found}");
    }
}
