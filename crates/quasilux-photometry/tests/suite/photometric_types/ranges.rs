//! What the ranges of the angles mean: sectors, mirror images, deviations.

use super::{A_AND_B, File, direction, spread, uneven};
use crate::tables::steps;
use quasilux_photometry::{PhotometricType, Symmetry, WarningKind, read_ies};
use std::f64::consts::PI;

/// Across the border the intensity jumps from its value there to zero: no cell of interpolation.
#[test]
fn outside_the_sector_there_is_no_light() {
    let constant = |_: f64, _: f64| 100.0;
    for photometric_type in A_AND_B {
        for (h, v, h_ends, v_ends) in [
            (uneven(-90.0), uneven(-90.0), [-90.0, 90.0], [-90.0, 90.0]),
            (uneven(0.0), uneven(-90.0), [-90.0, 90.0], [-90.0, 90.0]),
            (vec![-40.0, 0.0, 20.0], vec![-10.0, 50.0], [-40.0, 20.0], [-10.0, 50.0]),
            (vec![0.0, 60.0], vec![0.0, 35.0], [-60.0, 60.0], [-35.0, 35.0]),
        ] {
            let file =
                File { photometric_type, horizontal_deg: &h, vertical_deg: &v, candela: &constant };
            let photometry = file.photometry();
            assert_eq!(photometry.table().symmetry(), Symmetry::Sector);
            let at = |h, v| photometry.intensity_cd(direction(photometric_type, h, v));
            for (side, end) in [(1.0, h_ends[1]), (-1.0, h_ends[0])] {
                assert!((at(end - side * 1e-9, 2.0) - 100.0).abs() < 1e-9);
                let beyond = at(end + side * 1e-9, 2.0);
                // Beyond a pole lies the other side of the sphere, which is dark as well.
                assert_eq!(beyond, 0.0, "{photometric_type:?} H {end}");
            }
            for (side, end) in [(1.0, v_ends[1]), (-1.0, v_ends[0])] {
                assert!((at(2.0, end - side * 1e-9) - 100.0).abs() < 1e-9);
                assert_eq!(at(2.0, end + side * 1e-9), 0.0, "{photometric_type:?} V {end}");
            }
            // The solid angle of a box: its longitude times the difference of the latitude's sines.
            let sine = |degrees: f64| libm::sin(degrees / 180.0 * PI);
            let (lat, long) = match photometric_type {
                PhotometricType::A => (v_ends, h_ends),
                _ => (h_ends, v_ends),
            };
            let expected_lm =
                100.0 * (long[1] - long[0]) / 180.0 * PI * (sine(lat[1]) - sine(lat[0]));
            assert!(
                (photometry.flux_lm() / expected_lm - 1.0).abs() < 1e-12,
                "{photometric_type:?}"
            );
        }
    }
}

#[test]
fn mirrored_halves_are_those_of_the_whole_file() {
    let candela = |h: f64, v: f64| 1000.0 - 7.0 * h.abs() - 0.03 * v.abs() * h.abs();
    for photometric_type in A_AND_B {
        let photometry = |h: &[f64], v: &[f64]| {
            File { photometric_type, horizontal_deg: h, vertical_deg: v, candela: &candela }.read()
        };
        let five = |first| steps(first, 5.0, 90.0);
        let (whole, no_warnings) = photometry(&five(-90.0), &five(-90.0));
        assert!(no_warnings.is_empty(), "{no_warnings:?}");
        let (half, no_warnings) = photometry(&five(0.0), &five(-90.0));
        assert!(no_warnings.is_empty(), "{no_warnings:?}");
        let (quarter, warnings) = photometry(&five(0.0), &five(0.0));
        assert_eq!(warnings, [WarningKind::VerticalMirror]);
        for other in [half, quarter] {
            assert_eq!(other.table().theta_rad(), whole.table().theta_rad());
            assert_eq!(other.flux_lm(), whole.flux_lm());
            for i in 0..500 {
                let direction = whole.sample(spread(i)).unwrap().direction;
                assert_eq!(other.intensity_cd(direction), whole.intensity_cd(direction));
            }
        }
    }
}

#[test]
fn unusual_ranges_are_warned_of_or_refused() {
    let constant = |_: f64, _: f64| 1.0;
    let file = |photometric_type, horizontal_deg, vertical_deg| File {
        photometric_type,
        horizontal_deg,
        vertical_deg,
        candela: &constant,
    };
    let (a, b) = (PhotometricType::A, PhotometricType::B);
    let warned: [(_, &[f64], &[f64], &[WarningKind]); 4] = [
        (b, &[-60.0, 60.0], &[-90.0, 90.0], &[WarningKind::HorizontalRange]),
        (a, &[-90.0, 90.0], &[-15.0, 10.0], &[WarningKind::VerticalRange]),
        (b, &[0.0, 90.0], &[0.0, 90.0], &[WarningKind::VerticalMirror]),
        (a, &[-180.0, 0.0, 180.0], &[-90.0, 90.0], &[WarningKind::HorizontalRange]),
    ];
    for (photometric_type, h, v, expected) in warned {
        assert_eq!(file(photometric_type, h, v).read().1, expected, "{h:?} {v:?}");
    }
    let refused: [(_, &[f64], &[f64], _, _); 4] = [
        (b, &[-120.0, 90.0], &[-90.0, 90.0], 6, "horizontal angles between -90 and 90"),
        (a, &[-90.0, 90.0], &[0.0, 180.0], 5, "vertical angles between -90 and 90"),
        (a, &[0.0, 360.0], &[-90.0, 90.0], 6, "horizontal angles between -180 and 180"),
        (b, &[0.0], &[-90.0, 90.0], 6, "two or more"),
    ];
    for (photometric_type, h, v, line, message) in refused {
        let error = read_ies(file(photometric_type, h, v).text().as_bytes()).unwrap_err();
        assert_eq!(error.line(), line, "{error}");
        assert!(error.to_string().contains(message), "{error}");
    }
}
