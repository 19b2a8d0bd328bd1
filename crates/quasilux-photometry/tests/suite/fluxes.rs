//! Integrated fluxes against figures that other programs got from the same files.
//!
//! Programs sum over zones where quasilux integrates. Where a file's figure is known to come from a
//! sum, that very sum must give it: it shows that the table is read right, and that the rest of the
//! difference is the sum's.

use crate::corpus::published_files_of;
use quasilux_photometry::{Angles, Photometry, SphericalTable, read_ies, read_ldt};
use std::f64::consts::{PI, TAU};

/// Lumens by the program Photometric Toolbox, from the notes of the repository that publishes the
/// files (echowuzangye/CU-calculations-based-on-IES-file, `ies/ies_summary.md`).
const PHOTOMETRIC_TOOLBOX_LM: [(&str, f64); 7] = [
    ("cu-1.IES", 9217.18),
    ("cu-2.IES", 5834.2),
    ("cu-3.IES", 13359.57),
    ("cu-4.IES", 5821.76),
    ("cu-5.IES", 753.8),
    ("cu-6.IES", 9230.16),
    ("cu-7.IES", 531.98),
];

/// Lumens that files of absolute photometry give in a keyword of their own, and the part of the
/// candela multiplier that came later than the keyword.
const OWN_KEYWORD: [(&str, &str, f64); 8] = [
    ("cu-1.IES", "_ABSOLUTELUMENS", 1.0),
    ("cu-2.IES", "_ABSOLUTELUMENS", 1.0),
    ("cu-4.IES", "_ABSOLUTELUMENS", 1.0),
    ("cu-5.IES", "_ABSOLUTELUMENS", 1.0),
    ("cu-7.IES", "_ABSOLUTELUMENS", 1.0),
    // Figures of the lamp as measured; the files scale it by 1.32.
    ("guv-B1_module.ies", "_TOTALLUMINAIRELUMENS", 1.32),
    ("photompy-B1_module.ies", "_TOTALLUMINAIRELUMENS", 1.32),
    ("photompy-write_test_original.ies", "_TOTALLUMINAIRELUMENS", 1.32),
];

/// The sum of the zones between listed angles, each with the mean intensity of its ends.
pub(crate) fn sum_of_means_lm(table: &SphericalTable) -> f64 {
    let (theta_rad, rings_cd) = (table.theta_rad(), ring_means_cd(table));
    let pairs = theta_rad.windows(2).zip(rings_cd.windows(2));
    pairs.map(|(ends, cd)| 0.5 * (cd[0] + cd[1]) * zone_sr(ends[0], ends[1])).sum()
}

/// The sum of zones around listed angles that meet halfway between them.
pub(crate) fn midpoint_sum_lm(table: &SphericalTable) -> f64 {
    let theta_rad = table.theta_rad();
    let halfway = theta_rad.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    let borders_rad: Vec<f64> = theta_rad[..1]
        .iter()
        .copied()
        .chain(halfway)
        .chain(theta_rad[theta_rad.len() - 1..].iter().copied())
        .collect();
    let rings_cd = ring_means_cd(table);
    borders_rad.windows(2).zip(rings_cd).map(|(ends, cd)| cd * zone_sr(ends[0], ends[1])).sum()
}

fn zone_sr(from_rad: f64, to_rad: f64) -> f64 {
    TAU * (libm::cos(from_rad) - libm::cos(to_rad))
}

/// The mean over the azimuth, by trapezia, at each polar angle.
fn ring_means_cd(table: &SphericalTable) -> Vec<f64> {
    let phi_rad: Vec<f64> = table.phi_rad().collect();
    let mean_cd = |&theta_rad: &f64| {
        let at = |phi_rad| table.value_at(Angles { theta_rad, phi_rad });
        let pairs = phi_rad.windows(2);
        pairs.map(|pair| 0.5 * (at(pair[0]) + at(pair[1])) * (pair[1] - pair[0]) / TAU).sum()
    };
    table.theta_rad().iter().map(mean_cd).collect()
}

fn photometry(file: &str) -> Option<Photometry> {
    let is_ldt = file.ends_with(".ldt");
    let files = published_files_of(if is_ldt { "ldt" } else { "ies" })?;
    let path = files.iter().find(|path| path.ends_with(file)).unwrap_or_else(|| panic!("{file}"));
    let bytes = std::fs::read(path).unwrap();
    let read = if is_ldt { read_ldt(&bytes) } else { read_ies(&bytes) };
    Some(read.unwrap_or_else(|error| panic!("{file}:{error}")).photometry)
}

#[test]
fn the_sum_of_means_is_that_of_photometric_toolbox() {
    for (file, toolbox_lm) in PHOTOMETRIC_TOOLBOX_LM {
        let Some(photometry) = photometry(file) else {
            return;
        };
        let sum_lm = sum_of_means_lm(photometry.table());
        assert!((sum_lm - toolbox_lm).abs() < 0.0051, "{file}: {sum_lm}, not {toolbox_lm}");
        let integral = photometry.flux_lm() / toolbox_lm;
        assert!((integral - 1.0).abs() < 1.5e-3, "{file}: {integral}");
    }
}

#[test]
fn absolute_photometry_gives_the_lumens_of_its_keyword() {
    for (file, keyword, factor) in OWN_KEYWORD {
        let Some(photometry) = photometry(file) else {
            return;
        };
        let own_lm: f64 = photometry.facts().keyword(keyword).unwrap().parse().unwrap();
        let ratio = photometry.flux_lm() / (own_lm * factor);
        assert!((ratio - 1.0).abs() < 2e-3, "{file}: {ratio}");
    }
}

/// The makers of EULUMDAT files scale intensities so that the sum of midpoint zones is the lamps'
/// flux times the light output ratio; half of the files show it.
#[test]
fn the_midpoint_sum_is_that_of_the_makers_of_eulumdat_files() {
    let Some(files) = published_files_of("ldt") else {
        return;
    };
    let (mut claims, mut midpoint) = (0, 0);
    for file in &files {
        let photometry = read_ldt(&std::fs::read(file).unwrap()).unwrap().photometry;
        let facts = photometry.facts();
        let Some(ratio) = facts.light_output_ratio else {
            continue;
        };
        let claimed_lm = 1000.0 * facts.candela_factor * ratio;
        claims += 1;
        if (midpoint_sum_lm(photometry.table()) / claimed_lm - 1.0).abs() < 5e-4 {
            midpoint += 1;
            let integral = photometry.flux_lm() / claimed_lm;
            assert!((integral - 1.0).abs() < 1.5e-3, "{}: {integral}", file.display());
        }
    }
    println!("midpoint zones give the file's own flux for {midpoint} of {claims} EULUMDAT files");
    assert!(midpoint >= 25, "{midpoint} of {claims}");
}

/// Both sums on a table with a closed form: 1 + cos theta on the sphere, 4 pi lm.
#[test]
fn both_sums_converge_to_the_integral() {
    let text = |steps: u32| {
        let degrees = (0..=steps).map(|i| 180.0 * f64::from(i) / f64::from(steps));
        let angles: Vec<String> = degrees.clone().map(|degrees| degrees.to_string()).collect();
        let candela: Vec<String> =
            degrees.map(|degrees| (1.0 + libm::cos(degrees / 180.0 * PI)).to_string()).collect();
        format!(
            "IESNA91\nTILT=NONE\n1 -1 1 {} 1 1 2 0 0 0\n1 1 1\n{}\n0\n{}\n",
            steps + 1,
            angles.join(" "),
            candela.join(" ")
        )
    };
    for (steps, tolerance) in [(180, 1e-4), (1800, 1e-6)] {
        let photometry = read_ies(text(steps).as_bytes()).unwrap().photometry;
        for flux_lm in [sum_of_means_lm(photometry.table()), midpoint_sum_lm(photometry.table())] {
            assert!((flux_lm / (4.0 * PI) - 1.0).abs() < tolerance, "{steps}: {flux_lm}");
        }
    }
}
