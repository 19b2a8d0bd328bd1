//! Tables whose flux and intensity are known by other means.

use crate::tables::{Generator, hard_tables, steps, table};
use quasilux_photometry::{Angles, SphericalTable, Symmetry, read_ies};
use std::f64::consts::{PI, TAU};

#[test]
fn isotropic_flux_is_four_pi_times_the_intensity() {
    for theta in [vec![0.0, 180.0], steps(0.0, 5.0, 180.0), steps(0.0, 0.1, 180.0)] {
        let isotropic = table(&theta, &steps(0.0, 45.0, 360.0), Symmetry::None, |_, _| 7.0);
        assert!((isotropic.integral() / (28.0 * PI) - 1.0).abs() < 1e-13);
    }
}

/// Linear interpolation of a cosine on steps of h errs by h^2 / 12 of it in the mean.
#[test]
fn lambertian_flux_tends_to_pi_times_the_intensity() {
    for step in [5.0, 1.0, 0.1] {
        let lambertian = table(&steps(0.0, step, 90.0), &[0.0], Symmetry::Rotational, |t, _| {
            libm::cos(t / 180.0 * PI)
        });
        let h = step / 180.0 * PI;
        let error = 1.0 - lambertian.integral() / PI;
        assert!((error / (h * h / 12.0) - 1.0).abs() < 0.01, "step {step}: {error:e}");
    }
}

#[test]
fn flux_agrees_with_brute_force() {
    for (name, table) in hard_tables() {
        let expected = brute_force(&table);
        assert!(
            (table.integral() / expected - 1.0).abs() < 1e-10,
            "{name}: {} {expected}",
            table.integral()
        );
    }
}

/// Simpson's rule with 200 panels between neighbouring parallels, trapezia (exact) between
/// azimuths.
fn brute_force(table: &SphericalTable) -> f64 {
    let mut azimuths: Vec<f64> = table.phi_rad().collect();
    azimuths.dedup();
    let ring = |theta_rad: f64| -> f64 {
        azimuths
            .windows(2)
            .map(|pair| {
                let phi_rad = 0.5 * (pair[0] + pair[1]);
                (pair[1] - pair[0]) * table.value_at(Angles { theta_rad, phi_rad })
            })
            .sum()
    };
    let integrand = |theta_rad: f64| ring(theta_rad) * libm::sin(theta_rad);
    table
        .theta_rad()
        .windows(2)
        .map(|ends| {
            let h = (ends[1] - ends[0]) / 400.0;
            let weighted = (0..=400).map(|i| {
                let weight = if i == 0 || i == 400 { 1.0 } else { 2.0 + 2.0 * f64::from(i % 2) };
                weight * integrand((ends[0] + h * f64::from(i)).min(ends[1]))
            });
            weighted.sum::<f64>() * h / 3.0
        })
        .sum()
}

#[test]
fn azimuths_may_be_turns_off() {
    let mut generator = Generator(5);
    for (name, table) in hard_tables() {
        for _ in 0..1000 {
            let theta_rad = PI * generator.uniform();
            let phi_rad = TAU * generator.uniform();
            let value = table.value_at(Angles { theta_rad, phi_rad });
            for turned in [phi_rad - TAU, phi_rad + TAU] {
                let other = table.value_at(Angles { theta_rad, phi_rad: turned });
                assert!((value - other).abs() <= 1e-9 * value.max(1.0), "{name}");
            }
        }
    }
}

/// The same quantities by hand, from the numbers of the file: bilinear in degrees, C asymmetric.
#[test]
fn intensity_of_a_file_is_bilinear_in_its_angles() {
    let file = b"IESNA:LM-63-2002\n[TEST] by hand\nTILT=NONE\n\
        1 -1 2.0 3 4 1 2 0 0 0\n0.5 1 10\n0 30 90\n0 90 180 360\n\
        100 50 10\n100 80 20\n100 60 0\n100 50 10\n";
    let photometry = read_ies(file).unwrap().photometry;
    let cases = [
        // gamma, C, intensity: multiplier 2 x ballast factor 0.5 = 1.
        (0.0, 0.0, 100.0),
        (15.0, 45.0, 0.25 * (100.0 + 100.0 + 50.0 + 80.0)),
        (45.0, 135.0, 0.5 * (0.75 * 80.0 + 0.25 * 20.0) + 0.5 * (0.75 * 60.0)),
        (60.0, 270.0, 0.25 * (60.0 + 0.0 + 50.0 + 10.0)),
        (90.0, 10.0, 10.0 + 10.0 / 90.0 * 10.0),
        (91.0, 10.0, 0.0),
    ];
    for (gamma_deg, c_deg, expected) in cases {
        let (sin_gamma, cos_gamma) = libm::sincos(f64::to_radians(gamma_deg));
        let (sin_c, cos_c) = libm::sincos(f64::to_radians(c_deg));
        let z = if gamma_deg == 90.0 { 0.0 } else { -cos_gamma };
        let direction = glam::DVec3::new(sin_gamma * cos_c, sin_gamma * sin_c, z);
        let intensity_cd = photometry.intensity_cd(direction);
        assert!(
            (intensity_cd - expected).abs() < 1e-11,
            "{gamma_deg} {c_deg}: {intensity_cd} {expected}"
        );
    }
}

/// The directions of tabulated angles at the borders of a sector are in it, whatever the rounding
/// of their sines and cosines.
#[test]
fn borders_of_a_sector_belong_to_it() {
    for start_deg in 0..360 {
        let ends_deg = [f64::from(start_deg), f64::from(start_deg) + 40.0];
        let sector = table(&[10.0, 90.0], &ends_deg, Symmetry::Sector, |_, _| 1.0);
        for (theta_deg, phi_deg) in [30.0, 45.0, 89.0].map(|t| ends_deg.map(|p| (t, p))).concat() {
            let [theta_rad, phi_rad] = [theta_deg, phi_deg].map(|deg: f64| deg / 180.0 * PI);
            let direction = Angles { theta_rad, phi_rad }.direction();
            assert_eq!(sector.value(direction), 1.0, "{theta_deg}, {phi_deg}");
        }
    }
}

/// Values without arc tangents against those with them, at random directions and right at nodes,
/// but for the ends, where rounding decides: 1e-13 of the greatest value is ten times what rounding
/// makes of the steepest table.
#[test]
fn directions_have_the_values_of_their_angles() {
    let mut generator = Generator(11);
    for (name, table) in hard_tables() {
        let inner = |nodes: &[f64]| nodes[1..nodes.len() - 1].to_vec();
        let phi_rad = inner(&table.phi_rad().collect::<Vec<f64>>());
        let mut angles: Vec<Angles> = inner(table.theta_rad())
            .iter()
            .flat_map(|&theta_rad| {
                phi_rad.iter().map(move |&phi_rad| Angles { theta_rad, phi_rad })
            })
            .collect();
        for _ in 0..2000 {
            let theta_rad = libm::acos(2.0 * generator.uniform() - 1.0);
            angles.push(Angles { theta_rad, phi_rad: TAU * generator.uniform() });
        }
        let largest_off = 1e-13 * table.maximum().value;
        for direction in angles.into_iter().map(Angles::direction) {
            let off = table.value(direction) - table.value_at(Angles::from_direction(direction));
            assert!(off.abs() < largest_off, "{name}, {direction}: off by {off}");
        }
    }
}
