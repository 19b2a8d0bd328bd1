//! Tables made of functions approach them as they are refined.

use super::analytic::{Scattering, albedo, difference, glossy, lambert, rough};
use super::direction;
use quasilux_bsdf::{
    AngleBasis, BandDefinition, Distribution, GriddedTable, KlemsTable, TensorTree,
};
use quasilux_stats::least_squares_slope;
use std::f64::consts::FRAC_PI_2;

/// Bands of equal width, patches about as wide as high.
fn basis(bands: usize) -> AngleBasis {
    let band = |i: usize| BandDefinition::new(90.0 * (i + 1) as f64 / bands as f64, 1 + 5 * i);
    AngleBasis::new("even", &(0..bands).map(band).collect::<Vec<_>>()).unwrap()
}

fn klems(f: Scattering, bands: usize) -> Distribution {
    Distribution::Klems(KlemsTable::from_function(basis(bands), basis(bands), f).unwrap())
}

fn tree(f: Scattering, is_isotropic: bool, log_side: usize) -> Distribution {
    Distribution::TensorTree(TensorTree::from_function(is_isotropic, log_side, f).unwrap())
}

fn lobes(f: Scattering, parts: u32) -> Distribution {
    let step_rad = FRAC_PI_2 / f64::from(parts);
    let theta_rad: Vec<f64> = (0..parts).map(|i| f64::from(i) * step_rad).collect();
    let offset = |i: u32| 0.25 * step_rad * f64::from(i) * (1.0 + f64::from(i) / 16.0);
    let offsets_rad: Vec<f64> = (0..100).map(offset).filter(|x| *x < FRAC_PI_2).collect();
    Distribution::Gridded(GriddedTable::from_function(&theta_rad, &offsets_rad, f).unwrap())
}

/// The mean difference from f over incidences that no table stores.
fn mean_difference(f: Scattering, table: &Distribution) -> f64 {
    let thetas_deg = [3.1, 12.7, 24.2, 36.8, 44.3, 52.9, 63.4];
    let off = |theta_deg: f64| difference(f, table, direction(theta_deg, 4.0 * theta_deg));
    thetas_deg.map(off).iter().sum::<f64>() / thetas_deg.len() as f64
}

#[test]
fn lambert_is_itself_in_any_table() {
    let tables = [klems(lambert, 4), tree(lambert, true, 2), tree(lambert, false, 2)];
    for table in tables.iter().chain([&lobes(lambert, 9)]) {
        let exact: f64 = if matches!(table, Distribution::Gridded(_)) { 4e-4 } else { 1e-12 };
        for theta_deg in [0.0, 17.0, 45.0, 80.0] {
            let wi = direction(theta_deg, 100.0);
            assert!((table.albedo(wi)[0] / albedo(lambert, wi) - 1.0).abs() < exact.max(1e-5));
            assert!(difference(lambert, table, wi) < exact, "{} {theta_deg}", table.kind());
        }
    }
}

/// f is constant in boxes: its mean difference is of first order in their width. Between lobes it
/// is of second order in the gap between incidences, as long as that is much wider than the gaps
/// between exits, which are 2.5 degrees at most and stay so.
#[test]
fn tables_approach_the_function_at_the_expected_order() {
    type Maker = Box<dyn Fn(u32) -> Distribution>;
    let makers: [(&str, f64, Maker); 4] = [
        ("Klems", 0.9, Box::new(|level| klems(rough, 4 << level))),
        ("rank 3", 0.9, Box::new(|level| tree(rough, true, 3 + level as usize))),
        ("rank 4", 0.9, Box::new(|level| tree(rough, false, 2 + level as usize))),
        ("lobes", 1.6, Box::new(|level| lobes(rough, 5 << level))),
    ];
    for (name, least, maker) in makers {
        let offs = [0, 1, 2].map(|level| mean_difference(rough, &maker(level)));
        let point = |level: usize| [level as f64, libm::log2(offs[level])];
        let order = -least_squares_slope(&[0, 1, 2].map(point));
        println!("{name}: {offs:.4?}, order {order:.2}");
        assert!(order > least, "{name}: order {order}");
    }
}

/// Means of boxes keep the light of a lobe of some degrees.
#[test]
fn narrow_lobes_keep_their_light() {
    let wi = direction(40.0, 30.0);
    let exact = albedo(glossy, wi);
    for (name, fine) in [("rank 3", tree(glossy, true, 7)), ("lobes", lobes(glossy, 72))] {
        let off = (fine.albedo(wi)[0] / exact - 1.0).abs();
        println!("{name}: {off:.5}");
        assert!(off < 0.01, "{name}: {off}");
    }
}

#[test]
fn what_is_no_table_is_none() {
    let below = |_, _| -1.0;
    assert!(KlemsTable::from_function(basis(2), basis(2), below).is_none());
    assert!(TensorTree::from_function(true, 2, below).is_none());
    assert!(TensorTree::from_function(true, 2, |_, _| f64::NAN).is_none());
    assert!(TensorTree::from_function(true, 0, lambert).is_none());
    assert!(TensorTree::from_function(false, 8, lambert).is_none());
    assert!(GriddedTable::from_function(&[0.0], &[0.1], below).is_none());
    assert!(GriddedTable::from_function(&[0.2, 0.1], &[0.1], lambert).is_none());
    assert!(GriddedTable::from_function(&[1.6], &[0.1], lambert).is_none());
    assert!(GriddedTable::from_function(&[0.0], &[f64::NAN], lambert).is_none());
}

/// Values that f64 has only a few digits of are nothing, and no sample is drawn from them.
#[test]
fn tiny_values_are_nothing() {
    let tiny = |_, _| 5e-320;
    let lobes = GriddedTable::from_function(&[0.0, 0.5], &[0.1], tiny).unwrap();
    let table = Distribution::Gridded(lobes);
    assert_eq!(table.albedo(direction(20.0, 0.0)), [0.0; 3]);
    assert!(table.sample(direction(20.0, 0.0), [0.5; 2]).is_none());
}
