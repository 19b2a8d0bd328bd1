//! Tables that are hard in one way each, and what several tests share.

use quasilux_photometry::{Grid, SphericalTable, Symmetry};
use std::f64::consts::PI;

/// A deterministic generator (SplitMix64, Steele, Lea and Flood 2014).
pub(crate) struct Generator(pub(crate) u64);

impl Generator {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Uniform in [0, 1).
    pub(crate) fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// A table on angles in degrees from a function of (theta, phi) in degrees.
pub(crate) fn table(
    theta_deg: &[f64],
    phi_deg: &[f64],
    symmetry: Symmetry,
    value: impl Fn(f64, f64) -> f64,
) -> SphericalTable {
    let radians = |degrees: &[f64]| degrees.iter().map(|d| d / 180.0 * PI).collect();
    let values = theta_deg
        .iter()
        .flat_map(|&t| phi_deg.iter().map(move |&p| (t, p)))
        .map(|(t, p)| value(t, p));
    SphericalTable::new(Grid {
        theta_rad: radians(theta_deg),
        phi_rad: radians(phi_deg),
        symmetry,
        values: values.collect(),
    })
    .unwrap()
}

/// `first`, `first + step`, ... up to `last`.
pub(crate) fn steps(first: f64, step: f64, last: f64) -> Vec<f64> {
    let count = ((last - first) / step).round() as usize;
    (0..=count).map(|i| first + step * i as f64).collect()
}

/// The hard cases, by name.
pub(crate) fn hard_tables() -> Vec<(&'static str, SphericalTable)> {
    let asymmetric =
        |t: f64, p: f64| 100.0 + t + 3.0 * (p - 100.0).abs() * t / 180.0 + p % 7.0 * 20.0;
    let checkered = |t: f64, p: f64| {
        if ((t / 30.0) as i64 + (p / 45.0) as i64) % 2 == 0 { 0.0 } else { 5.0 }
    };
    vec![
        (
            "asymmetric",
            table(&steps(0.0, 20.0, 180.0), &steps(0.0, 30.0, 360.0), Symmetry::None, |t, p| {
                asymmetric(t, p % 360.0)
            }),
        ),
        (
            "uneven and open",
            table(
                &[0.0, 7.0, 30.0, 95.0, 171.0],
                &[10.0, 50.0, 55.0, 200.0, 300.0],
                Symmetry::Open,
                asymmetric,
            ),
        ),
        (
            "needle",
            table(&steps(0.0, 1.0, 90.0), &steps(0.0, 5.0, 360.0), Symmetry::None, |t, p| {
                if t == 40.0 && p == 120.0 { 1e6 } else { 0.0 }
            }),
        ),
        (
            "zero corners",
            table(&steps(0.0, 30.0, 180.0), &steps(0.0, 45.0, 360.0), Symmetry::None, |t, p| {
                checkered(t, p % 360.0)
            }),
        ),
        (
            "fine at the north pole",
            table(&steps(0.0, 0.1, 2.0), &steps(0.0, 15.0, 90.0), Symmetry::Quadrant, |t, p| {
                2.0 - t + p / 90.0
            }),
        ),
        (
            "fine at the south pole",
            table(
                &steps(178.0, 0.1, 180.0),
                &steps(0.0, 15.0, 180.0),
                Symmetry::Bilateral,
                |t, p| t - 178.0 + p / 90.0,
            ),
        ),
        (
            "downwards",
            table(
                &steps(0.0, 5.0, 90.0),
                &steps(90.0, 15.0, 270.0),
                Symmetry::Bilateral,
                |t, p| 90.0 - t + p / 10.0,
            ),
        ),
        (
            "upwards",
            table(&steps(90.0, 10.0, 180.0), &steps(0.0, 22.5, 360.0), Symmetry::None, |t, p| {
                t - 90.0 + if p % 360.0 < 90.0 { 30.0 } else { 0.0 }
            }),
        ),
        (
            "single plane",
            table(&steps(0.0, 5.0, 180.0), &[0.0], Symmetry::Rotational, |t, _| (t - 60.0).abs()),
        ),
        (
            "half of the sphere",
            table(&steps(0.0, 15.0, 180.0), &steps(-90.0, 15.0, 90.0), Symmetry::Sector, |t, p| {
                50.0 + t + p.abs() + p / 3.0
            }),
        ),
        (
            "sector with dark ends",
            table(
                &[20.0, 50.0, 90.0, 110.0, 165.0],
                &[100.0, 130.0, 200.0, 205.0, 330.0],
                Symmetry::Sector,
                |t, p| if t < 60.0 || p > 320.0 { 0.0 } else { t + p % 7.0 * 20.0 },
            ),
        ),
        ("two parallels", table(&[0.0, 180.0], &[0.0], Symmetry::Rotational, |t, _| t)),
        (
            "two planes",
            table(&steps(0.0, 10.0, 180.0), &[0.0, 180.0], Symmetry::Bilateral, |t, p| {
                (t - 60.0).abs() + p
            }),
        ),
        (
            "beam of one degree at the nadir",
            table(&steps(0.0, 0.1, 90.0), &[0.0], Symmetry::Rotational, |t, _| {
                1e5 * libm::exp(-2.77 * t * t) + if t < 45.0 { 0.0 } else { 1e-6 }
            }),
        ),
        (
            "light at the horizon only",
            table(&steps(0.0, 30.0, 180.0), &steps(0.0, 30.0, 360.0), Symmetry::None, |t, p| {
                if t == 90.0 { p % 90.0 } else { 0.0 }
            }),
        ),
    ]
}

/// A tenth of a degree both ways: 300 by 3600 cells.
pub(crate) fn fine_table() -> SphericalTable {
    let (theta, phi) = (steps(0.0, 0.1, 30.0), steps(0.0, 0.1, 90.0));
    table(&theta, &phi, Symmetry::Quadrant, |t, p| {
        libm::exp(-t / 10.0) * (2.0 + libm::cos(0.4 * p) + (10.0 * t).round() % 7.0)
    })
}
