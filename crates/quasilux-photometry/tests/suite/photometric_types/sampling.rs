//! Sampled directions of types A and B.

use super::{A_AND_B, File, cell_fluxes_lm, uneven};
use crate::tables::Generator;
use glam::DVec3;
use quasilux_photometry::PhotometricType;
use quasilux_stats::{CellCount, chi_square_test, deep, sidak};
use std::f64::consts::PI;

/// Of the family of two chi-square tests.
const SIGNIFICANCE: f64 = 1e-3;

/// Seed 23, 2^20 samples in 100 cells, 0.1 % for the family of two: of a density that is 2 % wrong
/// on half of the cells (1 % after normalisation) the expected statistic exceeds its mean of 99 by
/// 2^20 x 1e-4 = 105, seven standard deviations. Deep: 2^22 samples find 1 % on half of the cells
/// by the same 105. The first pass shows that such a density is rejected.
#[test]
fn directions_follow_the_density_of_the_file() {
    let (h, v) = (uneven(-90.0), uneven(-90.0));
    let right = |h: f64, v: f64| 600.0 + 3.0 * h - 2.0 * v + 0.01 * h * v;
    let factor = if deep() { 1.01 } else { 1.02 };
    let wrong = |h: f64, v: f64| right(h, v) * if v >= 3.0 { factor } else { 1.0 };
    let level = sidak(SIGNIFICANCE, A_AND_B.len());
    for photometric_type in A_AND_B {
        let file =
            |candela| File { photometric_type, horizontal_deg: &h, vertical_deg: &v, candela };
        let expected = cell_fluxes_lm(&file(&right));
        assert!(chi_square(&file(&wrong), &expected) < level, "a wrong density passed");
        let probability = chi_square(&file(&right), &expected);
        assert!(probability > level, "{photometric_type:?}: {probability:e}");
        let flux_lm: f64 = expected.iter().sum();
        assert!((file(&right).photometry().flux_lm() / flux_lm - 1.0).abs() < 1e-9);
    }
}

/// Sampled directions counted in the cells of the file by their (H, V), which the components give
/// here without the library.
fn chi_square(file: &File<'_>, fluxes_lm: &[f64]) -> f64 {
    let samples: u64 = if deep() { 1 << 22 } else { 1 << 20 };
    let photometry = file.photometry();
    let mut generator = Generator(23);
    let mut observed = vec![0u64; fluxes_lm.len()];
    for _ in 0..samples {
        let u = [generator.uniform(), generator.uniform()];
        let DVec3 { x, y, z } = photometry.sample(u).unwrap().direction;
        let (h, v) = match file.photometric_type {
            PhotometricType::A => (libm::atan2(-y, x), libm::asin(z)),
            _ => (libm::asin(-y), libm::atan2(x, -z)),
        };
        let cell = |angles: &[f64], rad: f64| {
            let degrees = rad / PI * 180.0;
            let beyond = angles.partition_point(|&angle| angle <= degrees);
            beyond.clamp(1, angles.len() - 1) - 1
        };
        let (row, column) = (cell(file.horizontal_deg, h), cell(file.vertical_deg, v));
        observed[row * (file.vertical_deg.len() - 1) + column] += 1;
    }
    let flux_lm: f64 = fluxes_lm.iter().sum();
    let cells: Vec<CellCount> = observed
        .into_iter()
        .zip(fluxes_lm)
        .map(|(observed, cell_lm)| CellCount {
            observed,
            expected: cell_lm / flux_lm * samples as f64,
        })
        .collect();
    chi_square_test(&cells)
}

#[test]
fn samples_invert_and_estimate_the_flux_without_variance() {
    let (h, v) = (uneven(-90.0), uneven(0.0));
    let candela = |h: f64, v: f64| (400.0 + 3.0 * h - 2.0 * v).max(0.0) * f64::from(v < 50.0);
    for photometric_type in A_AND_B {
        let photometry =
            File { photometric_type, horizontal_deg: &h, vertical_deg: &v, candela: &candela }
                .photometry();
        let mut generator = Generator(24);
        for _ in 0..20_000 {
            let u = [generator.uniform(), generator.uniform()];
            let sample = photometry.sample(u).unwrap();
            let back = photometry.invert(sample.direction);
            let error = (back[0] - u[0]).abs().max((back[1] - u[1]).abs());
            assert!(error < 1e-9, "{photometric_type:?}: {u:?} became {back:?}");
            assert_eq!(photometry.pdf_sr(sample.direction), sample.pdf_sr);
            let flux_lm = photometry.intensity_cd(sample.direction) / sample.pdf_sr;
            assert!((flux_lm / photometry.flux_lm() - 1.0).abs() < 1e-14);
        }
    }
}
