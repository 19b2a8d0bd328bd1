//! MERL files made from closed forms.

use super::analytic::{Scattering, difference, lambert, rough};
use super::direction;
use glam::DVec3;
use quasilux_bsdf::WarningKind;
use quasilux_bsdf::{Distribution, ScatteringMode, Side, read_bsdf, read_merl};
use std::f64::consts::{FRAC_PI_2, PI};

/// Half angles, difference angles and azimuths of the database.
const COUNTS: [usize; 3] = [90, 90, 180];

/// A file of a surface whose channels are f, f / 2 and f / 4; below the horizon nothing is
/// measured.
pub(super) fn file(f: Scattering, counts: [usize; 3]) -> Vec<u8> {
    let mut bytes: Vec<u8> =
        counts.iter().flat_map(|&count| (count as i32).to_le_bytes()).collect();
    let [halves, differences, azimuths] = counts;
    for (factor, scale) in [(1.0, 1500.0), (0.5, 1500.0 / 1.15), (0.25, 1500.0 / 1.66)] {
        for i in 0..halves {
            let part = i as f64 / halves as f64;
            let half_rad = FRAC_PI_2 * part * part;
            for j in 0..differences {
                let difference_deg = 90.0 * j as f64 / differences as f64;
                for k in 0..azimuths {
                    let local = direction(difference_deg, 180.0 * k as f64 / azimuths as f64);
                    let [wi, wo] = [local, DVec3::new(-local.x, -local.y, local.z)].map(|v| {
                        let (sin, cos) = libm::sincos(half_rad);
                        DVec3::new(cos * v.x + sin * v.z, v.y, cos * v.z - sin * v.x)
                    });
                    let is_measured = wi.z > 0.0 && wo.z > 0.0;
                    let value = if is_measured { factor * scale * f(wi, wo) } else { -1.0 };
                    bytes.extend(value.to_le_bytes());
                }
            }
        }
    }
    bytes
}

fn table(f: Scattering) -> Distribution {
    let read = read_merl(&file(f, COUNTS)).unwrap();
    let warned: Vec<WarningKind> = read.warnings.iter().map(|w| w.kind()).collect();
    assert_eq!(warned[..2], [WarningKind::MissingValues, WarningKind::Resampled]);
    println!("{}", read.warnings[1]);
    read.bsdf.scattering(Side::Front, ScatteringMode::Reflection).unwrap().clone()
}

#[test]
fn tables_of_the_size_of_the_database_follow_the_closed_form() {
    for (name, f, most) in [("lambert", lambert as Scattering, 0.001), ("rough", rough, 0.02)] {
        let table = table(f);
        assert!(table.is_isotropic() && table.is_coloured());
        for theta_deg in [0.0, 10.0, 33.0, 60.0, 75.0] {
            let wi = direction(theta_deg, 25.0);
            let off = difference(f, &table, wi);
            println!("{name} at {theta_deg} degrees: {off:.5}");
            assert!(off < most, "{name} at {theta_deg} degrees: {off}");
            let [red, green, blue] = table.evaluate(wi, direction(30.0, 200.0));
            assert!((green / red - 0.5).abs() < 1e-9 && (blue / red - 0.25).abs() < 1e-9);
        }
    }
}

/// The name of the angles: a value at one half angle and difference angle.
#[test]
fn a_value_stands_where_its_angles_say() {
    let counts = [4, 6, 4];
    let mut bytes = file(lambert, counts);
    bytes[12..].fill(0);
    // Half angle 2 of 4: 22.5 degrees; difference angle 2 of 6: 30 degrees; azimuth 2 of 4: 90
    // degrees. All channels.
    let triple = (2 * 6 + 2) * 4 + 2;
    for channel in 0..3 {
        let first = 12 + 8 * (channel * 96 + triple);
        bytes[first..first + 8].copy_from_slice(&1500_f64.to_le_bytes());
    }
    let read = read_bsdf(&bytes).unwrap();
    let table = read.bsdf.scattering(Side::Front, ScatteringMode::Reflection).unwrap();
    let half = direction(22.5, 0.0);
    let (sin, cos) = libm::sincos(30.0 * PI / 180.0);
    let (across, along) = (sin * DVec3::Y, cos * half);
    let f = table.evaluate(along + across, along - across);
    // The incidence is between two that are stored, and the grid is not the file's.
    assert!(f[0] > 0.7 && f[0] <= 1.0 + 1e-12, "{f:?}");
    assert!((f[1] / f[0] - 1.15).abs() < 1e-9 && (f[2] / f[0] - 1.66).abs() < 1e-9);
    assert_eq!(table.evaluate(direction(0.0, 0.0), direction(0.0, 0.0)), [0.0; 3]);
}

#[test]
fn what_is_no_merl_file_is_refused() {
    let mut bytes = file(lambert, [2, 2, 2]);
    assert!(read_merl(&bytes[..100]).is_err());
    assert!(read_merl(b"").is_err());
    bytes[12 + 8..12 + 16].copy_from_slice(&f64::NAN.to_le_bytes());
    let error = read_merl(&bytes).unwrap_err();
    assert_eq!((error.line(), error.column()), (1, 21), "{error}");
}
