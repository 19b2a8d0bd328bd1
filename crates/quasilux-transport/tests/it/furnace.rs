//! A closed room of emitting walls has the same light everywhere: pi L / (1 - r).

use crate::scenes::{all_walls_emit, diffuse, points, room};
use glam::DVec3;
use quasilux_transport::{Estimator, Settings, simulate};
use std::f64::consts::PI;

#[test]
fn illuminance_is_pi_l_over_one_minus_r() {
    for reflectance in [0.0, 0.5, 0.9] {
        for estimator in [Estimator::Path, Estimator::Bidirectional] {
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
            let settings = Settings { estimator, rel_tol: 0.02, ..Settings::default() };
            let estimates = simulate(&scene, &settings, &mut ());
            assert!(estimates.tolerance_reached);
            let wanted = PI * 100.0 / (1.0 - reflectance);
            for interval in estimates.point_intervals(0) {
                let found = format!("{estimator:?} {reflectance}: {interval:?}, wanted {wanted}");
                let allowed = interval.half_width.unwrap() + 0.003 * wanted;
                assert!((interval.value - wanted).abs() <= allowed, "{found}");
            }
        }
    }
}
