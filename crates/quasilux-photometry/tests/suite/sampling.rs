//! Sample, density and inverse belong together, and to the table.

use crate::published::luminaires;
use crate::quadrature::Boxes;
use crate::tables::{Generator, fine_table, hard_tables, table};
use glam::DVec3;
use quasilux_photometry::{Angles, SphericalTable, Symmetry};
use quasilux_stats::sphere_jacobian;
use std::f64::consts::{PI, TAU};

/// The hard tables, and those of published files.
fn tables() -> impl Iterator<Item = (String, SphericalTable)> {
    let hard = hard_tables().into_iter().map(|(name, table)| (name.to_owned(), table));
    let fine = ("a tenth of a degree both ways".to_owned(), fine_table());
    hard.chain([fine])
        .chain(luminaires().map(|(name, photometry)| (name, photometry.table().clone())))
}

#[test]
fn inverse_returns_the_coordinates() {
    for (name, table) in tables() {
        let mut generator = Generator(1);
        for _ in 0..5000 {
            let u = [generator.uniform(), generator.uniform()];
            let sample = table.sample(u).unwrap();
            let back = table.invert(sample.direction);
            let error = (back[0] - u[0]).abs().max((back[1] - u[1]).abs());
            assert!(error < 1e-9, "{name}: {u:?} became {back:?}");
        }
    }
}

/// Each sample's value over its density is the flux, and the flux is that of quadrature: the
/// estimate has no variance and no bias.
#[test]
fn every_sample_estimates_the_flux_exactly() {
    for (name, table) in tables() {
        let sphere = Boxes { theta_rad: vec![0.0, PI], phi_rad: vec![0.0, TAU] };
        let flux = sphere.integrals(&table)[0];
        let mut generator = Generator(3);
        for _ in 0..2000 {
            let sample = table.sample([generator.uniform(), generator.uniform()]).unwrap();
            let estimate = table.value(sample.direction) / sample.pdf_sr;
            assert!((estimate / table.integral() - 1.0).abs() < 1e-12, "{name}: {estimate}");
            // The quadrature of the coarsest table errs by 1e-8: one band from pole to pole.
            assert!((estimate / flux - 1.0).abs() < 1e-7, "{name}: {estimate} for {flux}");
        }
    }
}

#[test]
fn every_sample_has_light_and_unit_length() {
    let below_1 = 1.0_f64.next_down();
    for (name, table) in tables() {
        for u0 in [0.0, 1e-300, 1e-18, 0.25, 0.5, 0.75, below_1, 1.0] {
            for u1 in [0.0, 1e-300, 1e-18, 0.25, 0.5, 0.75, below_1, 1.0] {
                let sample = table.sample([u0, u1]).unwrap();
                assert!(sample.pdf_sr > 0.0 && sample.pdf_sr.is_finite(), "{name} {u0} {u1}");
                assert!((sample.direction.length() - 1.0).abs() < 1e-15, "{name} {u0} {u1}");
            }
        }
    }
}

#[test]
fn a_dark_table_has_no_directions() {
    let dark = table(&[0.0, 90.0], &[0.0], Symmetry::Rotational, |_, _| 0.0);
    assert_eq!(dark.sample([0.5, 0.5]), None);
    assert_eq!(dark.pdf(DVec3::Z), 0.0);
    assert!(dark.invert(DVec3::X).iter().all(|u| (0.0..=1.0).contains(u)));
}

/// A sector from 20 to 60 degrees ends at 60 for directions up to 220, and begins at 20 for those
/// beyond.
#[test]
fn outside_a_sector_the_nearer_border_is_inverted() {
    let sector = table(&[30.0, 150.0], &[20.0, 60.0], Symmetry::Sector, |_, p| p);
    for (phi_deg, expected) in [(61.0, 1.0), (219.0, 1.0), (221.0, 0.0), (19.0, 0.0)] {
        let angles = Angles { theta_rad: 1.0, phi_rad: phi_deg / 180.0 * PI };
        assert_eq!(sector.value_at(angles), 0.0, "{phi_deg}");
        assert_eq!(sector.invert(angles.direction())[1], expected, "{phi_deg}");
    }
}

/// At 300 places of each table where the density varies by less than a thousandth over the
/// differences, of half-width 1e-6: these err by less than 1e-6 there, and the bound of 1e-5 finds
/// a density that is wrong by as much.
#[test]
fn density_is_the_inverse_of_the_jacobian() {
    for (name, table) in tables() {
        let mut generator = Generator(2);
        let (mut compared, mut drawn, step) = (0, 0, 1e-6);
        while compared < 300 {
            let u = [0.01 + 0.98 * generator.uniform(), 0.01 + 0.98 * generator.uniform()];
            let sample = |u| table.sample(u).unwrap();
            let pdf_sr = sample(u).pdf_sr;
            let varies = [[-1.0, 0.0], [1.0, 0.0], [0.0, -1.0], [0.0, 1.0]].iter().any(|side| {
                let beside = sample([u[0] + step * side[0], u[1] + step * side[1]]);
                (beside.pdf_sr / pdf_sr - 1.0).abs() > 1e-3
            });
            drawn += 1;
            assert!(drawn < 600, "{name}: only {compared} places off the edges");
            if varies {
                continue;
            }
            let stretch_sr = sphere_jacobian(|u| sample(u).direction.to_array(), u, step);
            let product = stretch_sr * pdf_sr;
            assert!((product - 1.0).abs() < 1e-5, "{name}: {product} at {u:?}");
            compared += 1;
        }
    }
}

/// The map is continuous: no jump of theta at the borders of azimuth cells.
#[test]
fn neighbours_stay_neighbours() {
    let (_, table) = hard_tables().swap_remove(0);
    for i in 0..10_000 {
        let u1 = f64::from(i) / 10_000.0;
        let [a, b] = [u1, u1 + 1e-7].map(|u1| table.sample([0.37, u1]).unwrap().direction);
        assert!((a - b).length() < 1e-5, "a jump at {u1}");
    }
}
