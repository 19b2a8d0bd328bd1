//! Where light goes that a file gives at (H, V).

use super::{A_AND_B, File, direction, spread, uneven};
use crate::tables::Generator;
use glam::DVec3;
use quasilux_photometry::PhotometricType;
use std::f64::consts::PI;

#[test]
fn a_single_beam_lands_where_its_angles_say() {
    let (h, v) = (uneven(-90.0), uneven(-90.0));
    // By hand: 30 degrees right of the axis in the plane of the horizon, and 30 degrees above it.
    let root = 0.75_f64.sqrt();
    let by_hand = [
        (PhotometricType::B, 30.0, 0.0, DVec3::new(0.0, -0.5, -root)),
        (PhotometricType::B, 0.0, 30.0, DVec3::new(0.5, 0.0, -root)),
        (PhotometricType::B, 30.0, 60.0, DVec3::new(0.75, -0.5, -0.5 * root)),
        (PhotometricType::B, -45.0, -45.0, DVec3::new(-0.5, 0.5_f64.sqrt(), -0.5)),
        (PhotometricType::A, 30.0, 0.0, DVec3::new(root, -0.5, 0.0)),
        (PhotometricType::A, 0.0, 30.0, DVec3::new(root, 0.0, 0.5)),
        (PhotometricType::A, 30.0, 60.0, DVec3::new(0.5 * root, -0.25, root)),
        (PhotometricType::A, -45.0, -45.0, DVec3::new(0.5, 0.5, -0.5_f64.sqrt())),
    ];
    for (photometric_type, beam_h, beam_v, expected) in by_hand {
        let beam = |h, v| if h == beam_h && v == beam_v { 1000.0 } else { 0.0 };
        let file = File { photometric_type, horizontal_deg: &h, vertical_deg: &v, candela: &beam };
        let photometry = file.photometry();
        let peak_cd = photometry.intensity_cd(expected);
        assert!(
            (peak_cd - 1000.0).abs() < 1e-9,
            "{photometric_type:?} {beam_h} {beam_v}: {peak_cd}"
        );
        let angles = photometry.web().angles(expected);
        assert!((angles.horizontal_rad / PI * 180.0 - beam_h).abs() < 1e-12);
        assert!((angles.vertical_rad / PI * 180.0 - beam_v).abs() < 1e-12);
        assert!((photometry.web().direction(angles) - expected).length() < 1e-15);
        // The light is around the beam, not only at it.
        let mean: DVec3 = (0..4096).map(|i| photometry.sample(spread(i)).unwrap().direction).sum();
        assert!(mean.normalize().dot(expected) > 0.99, "{photometric_type:?}: {mean}");
    }
}

#[test]
fn intensities_are_bilinear_in_the_angles_of_the_file() {
    let (h, v) = (uneven(-90.0), uneven(-90.0));
    // Bilinear itself, and positive.
    let candela = |h: f64, v: f64| 900.0 + 2.0 * h - 3.0 * v + 0.02 * h * v;
    for photometric_type in A_AND_B {
        let photometry =
            File { photometric_type, horizontal_deg: &h, vertical_deg: &v, candela: &candela }
                .photometry();
        let mut generator = Generator(21);
        for _ in 0..2000 {
            let [h, v] = [0, 1].map(|_| -90.0 + 180.0 * generator.uniform());
            let found_cd = photometry.intensity_cd(direction(photometric_type, h, v));
            assert!((found_cd - candela(h, v)).abs() < 1e-7, "{photometric_type:?} {h} {v}");
        }
    }
}
