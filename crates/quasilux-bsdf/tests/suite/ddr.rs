//! DDR files made from closed forms.

use super::analytic::{Scattering, SpecularGrid, albedo, ddr, difference, glossy, lambert, rough};
use super::{direction, from_front};
use glam::DVec3;
use quasilux_bsdf::WarningKind;
use quasilux_bsdf::{BsdfFormat, Distribution, ScatteringMode, Side, read_bsdf_named, read_ddr};
use quasilux_stats::least_squares_slope;
use std::f64::consts::PI;

/// The table of a surface, from a file of this many degrees at the specular direction.
pub(super) fn table(f: Scattering, step: f64) -> Distribution {
    let read =
        read_ddr(ddr(f, &SpecularGrid::with_step(step)).as_bytes(), ScatteringMode::Reflection);
    let bsdf = read.unwrap().bsdf;
    bsdf.scattering(Side::Front, ScatteringMode::Reflection).unwrap().clone()
}

/// At the stored incidences; the file is bilinear, and so is the table: second order.
#[test]
fn tables_approach_the_closed_form() {
    for (name, f, finest) in [("rough", rough as Scattering, 0.003), ("glossy", glossy, 0.009)] {
        for theta_deg in [0.0, 10.0, 30.0, 60.0, 80.0] {
            let points: Vec<[f64; 2]> = [2.0_f64, 1.0, 0.5]
                .into_iter()
                .map(|step| {
                    let off = difference(f, &table(f, step), direction(theta_deg, 25.0));
                    [libm::log(step), libm::log(off)]
                })
                .collect();
            let order = least_squares_slope(&points);
            let last = libm::exp(points[2][1]);
            println!("{name} at {theta_deg} degrees: order {order:.2}, {last:.4} at half a degree");
            assert!(order > 1.5, "{name} at {theta_deg} degrees: order {order}");
            assert!(last < finest, "{name} at {theta_deg} degrees: {last}");
        }
    }
}

/// What the warning states is the difference between the table and the file: of the order of that
/// from the closed form.
#[test]
fn the_stated_error_is_that_of_resampling() {
    let file = ddr(glossy, &SpecularGrid::with_step(1.0));
    let read = read_ddr(file.as_bytes(), ScatteringMode::Reflection).unwrap();
    let warning = read.warnings.iter().find(|w| w.kind() == WarningKind::Resampled).unwrap();
    assert_eq!((warning.line(), warning.column()), (8, 1));
    let text = warning.to_string();
    let (_, percent) = text.split_once("off by ").unwrap();
    let stated: f64 = percent.split(' ').next().unwrap().parse().unwrap();
    let table = read.bsdf.scattering(Side::Front, ScatteringMode::Reflection).unwrap();
    let found = 100.0 * difference(glossy, table, direction(30.0, 0.0));
    assert!(stated > 0.1 * found && stated < 3.0 * found, "{stated} % stated, {found} % found");
}

/// Between incidences of the file, some 20 degrees apart: at most so much, and a lobe has one peak,
/// in the mirror direction. Lobes that stay where they are stored would be two, and off by 0.15,
/// 0.48, 0.81 and 0.44 where the glossy one is.
#[test]
fn lobes_move_with_the_mirror_direction() {
    for (name, f, most) in [
        ("rough", rough as Scattering, [0.008, 0.025, 0.08, 0.08]),
        ("glossy", glossy, [0.006, 0.01, 0.05, 0.18]),
    ] {
        let table = table(f, 0.5);
        for (theta_deg, most) in [5.0, 20.0, 45.0, 70.0].into_iter().zip(most) {
            let wi = direction(theta_deg, 0.0);
            let off = difference(f, &table, wi);
            let in_plane = |i: i32| table.evaluate(wi, direction(0.25 * f64::from(i), 180.0))[0];
            let all: Vec<f64> = (-340..=340).map(in_plane).collect();
            let highest = all.iter().copied().fold(0.0, f64::max);
            let is_peak =
                |i: &usize| all[*i] > all[i - 1].max(all[i + 1]) && all[*i] > 0.1 * highest;
            let peaks: Vec<f64> =
                (1..680).filter(is_peak).map(|i| 0.25 * (i as f64 - 340.0)).collect();
            println!("{name} at {theta_deg} degrees: {off:.4}, peaks {peaks:?}");
            assert!(off < most, "{name} at {theta_deg} degrees: {off}");
            if name == "glossy" {
                assert!(peaks.len() == 1 && (peaks[0] - theta_deg).abs() <= 2.5, "{peaks:?}");
            }
        }
    }
}

/// The mixture between incidences approaches the surface at second order in their gap, and the
/// warning predicts how far the table is off.
#[test]
fn errors_between_incidences_are_predicted() {
    let mut found = Vec::new();
    for gap in [16.0, 8.0, 4.0] {
        let sigma: Vec<f64> =
            (0..=5).map(|i| 20.0 + gap * f64::from(i)).filter(|sigma| *sigma < 72.0).collect();
        let grid = SpecularGrid { sigma: sigma.clone(), ..SpecularGrid::with_step(0.5) };
        let read = read_ddr(ddr(glossy, &grid).as_bytes(), ScatteringMode::Reflection).unwrap();
        let warning = read.warnings.iter().find(|w| w.kind() == WarningKind::Resampled);
        let text = warning.unwrap().to_string();
        // At incidences of the file, and between them.
        let percent = |before: &str| -> f64 {
            let (_, percent) = text.split_once(before).unwrap();
            percent.split(' ').next().unwrap().parse().unwrap()
        };
        let stated = 0.01 * (percent("off by ") + percent("by about "));
        let table = read.bsdf.scattering(Side::Front, ScatteringMode::Reflection).unwrap();
        let middles = sigma.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        let offs = middles.map(|theta| difference(glossy, table, direction(theta, 0.0)));
        let off = offs.sum::<f64>() / (sigma.len() - 1) as f64;
        println!("each {gap} degrees: {off:.4}, stated {stated:.4}");
        assert!(stated > 0.5 * off && stated < 2.0 * off, "{gap}: {stated} for {off}");
        found.push(off);
    }
    // What resampling leaves is the same at all gaps.
    assert!((found[0] - found[2]) / (found[1] - found[2]) > 3.5, "{found:?}");
}

#[test]
fn lambert_keeps_its_albedo() {
    let table = table(lambert, 4.0);
    for theta_deg in [0.0, 5.0, 45.0, 70.0, 89.0] {
        let wi = direction(theta_deg, -100.0);
        assert!((table.albedo(wi)[0] - albedo(lambert, wi)).abs() < 2e-4);
        assert!(difference(lambert, &table, wi) < 2e-4);
    }
    assert!(table.is_isotropic() && !table.is_coloured());
}

/// Three colours, two azimuths and a closing one, and albedos instead of scales.
#[test]
fn colours_planes_and_albedos_are_read() {
    let values = "1 1 1 1 ".repeat(3);
    let block = |name: &str, scale: &str| format!("{name} kbdf {scale} def {values} enddef\n");
    let head = "TypeSym ASymmetrical 4D\nTypeColorModel RGB\nTypeData Luminance Relative\n\
                psi 3 0 90 360 sigma 1 20 phi 2 0 180 theta 2 0 180\n";
    let text = head.to_owned()
        + &block("red", "0.5 0.1 9")
        + &block("gre", "0.25 0.2 9")
        + &block("blue", "0.125 0.3 9");
    let read = read_bsdf_named("surface.DDT", text.as_bytes()).unwrap();
    assert_eq!(read.bsdf.facts().format, BsdfFormat::Ddr);
    assert!(read.bsdf.scattering(Side::Front, ScatteringMode::Reflection).is_none());
    let table = read.bsdf.scattering(Side::Front, ScatteringMode::Transmission).unwrap();
    assert!(table.is_coloured() && !table.is_isotropic());
    assert_eq!(table.incidences().len(), 2);
    for (phi_deg, expected) in [
        (0.0, [0.5, 0.25, 0.125]),
        (90.0, [0.1, 0.2, 0.3]),
        (45.0, [0.3, 0.225, 0.2125]),
        (225.0, [0.3, 0.225, 0.2125]),
        // A third of the way from 90 to 360.
        (180.0, [0.1 + 0.4 / 3.0, 0.2 + 0.05 / 3.0, 0.3 - 0.175 / 3.0]),
    ] {
        let found = table.albedo(from_front(20.0, phi_deg));
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-9, "{phi_deg}: {found} for {expected}");
        }
    }
}

/// A value at one place shows which way the angles go.
#[test]
fn angles_go_from_the_specular_direction_towards_the_normal() {
    let text = "TypeSym ASymmetrical\nTypeColorModel BW\nsigma 1 50 phi 5 0 90 180 270 360\n\
                theta 4 0 30 40 50\n\
                bw def\n 0 0 0 0\n 0 1 1 0\n 0 0 0 0\n 0 0 0 0\n 0 0 0 0 enddef";
    let read = read_ddr(text.as_bytes(), ScatteringMode::Reflection).unwrap();
    let table = read.bsdf.scattering(Side::Front, ScatteringMode::Reflection).unwrap();
    let wi = from_front(50.0, 0.0);
    let at = |phi| {
        let wo = super::analytic::around_specular(50.0, 35.0, phi);
        let wo = DVec3::new(-wo.x, wo.y, wo.z);
        table.evaluate(wi, wo)[0] * PI
    };
    assert!((at(90.0) - 1.0).abs() < 0.1, "{}", at(90.0));
    assert!([0.0, 180.0, 270.0].into_iter().all(|phi| at(phi) < 1e-12));
}

#[test]
fn what_is_no_ddr_file_is_refused_with_its_place() {
    let head = "TypeColorModel BW\nsigma 1 0\nphi 1 0\ntheta 2 0 90\n";
    for (text, place, expected) in [
        ("TypeSym DirSymmetrical".to_owned(), "1:9", "AxiSymmetrical"),
        ("TypeColorModel spectral 31".to_owned(), "1:16", "BW or RGB"),
        ("TypeData Intensity Absolute".to_owned(), "1:10", "Luminance"),
        ("sigma 2 0 100".to_owned(), "1:11", "within 0 and 90 degrees"),
        ("sigma 2 10 10".to_owned(), "1:12", "ascending"),
        ("sigma 1.5 10".to_owned(), "1:7", "a count of sigma"),
        ("colour red".to_owned(), "1:1", "TypeSym"),
        ("phi 1 0\ntheta 1 0\nbw def".to_owned(), "3:1", "sigma before it"),
        (format!("{head};; a comment\nred def 1 1 enddef"), "6:1", "the block bw"),
        (format!("{head}bw def 1 enddef"), "5:10", "2: for each psi"),
        (format!("{head}bw def 1 1 1 enddef"), "5:12", "enddef after 2 values"),
        (format!("{head}bw kbdf 1 1 def"), "5:11", "def, before the values"),
        (format!("{head}bw def 1"), "5:9", "a value"),
    ] {
        let error = read_ddr(text.as_bytes(), ScatteringMode::Reflection).expect_err(&text);
        assert!(error.to_string().starts_with(&format!("{place}: ")), "{text:?}: {error}");
        assert!(error.expected().contains(expected), "{text:?}: {error}");
    }
}

const NARROW: &str = "TypeSym AxiSymmetrical\nTypeColorModel BW\nsigma 1 0\nphi 1 0\n\
    theta 8 0 2 4 6 8 10 20 90\nbw kbdf 1 def\n40 35 21 10 3 0.8 0.05 0.05\nenddef\n";

/// Angles count from the mirror direction: light from elsewhere has its peak there, and the same
/// light in all.
#[test]
fn a_lobe_of_one_incidence_follows_the_mirror_direction() {
    for mode in ScatteringMode::ALL {
        let read = read_ddr(NARROW.as_bytes(), mode).unwrap();
        let table = read.bsdf.scattering(Side::Front, mode).unwrap();
        let along_normal = table.albedo(DVec3::Z)[0];
        for theta_deg in [10.0, 45.0, 60.0] {
            let wi = direction(theta_deg, 0.0);
            let at = |i: i32| table.evaluate(wi, direction(0.1 * f64::from(i), 180.0))[0];
            let peak = (-899..900).max_by(|&a, &b| at(a).total_cmp(&at(b))).unwrap();
            // The cosine in what is moved shifts the peak by less than the lobe's width.
            assert!((0.1 * f64::from(peak) - theta_deg).abs() < 3.0, "{peak} for {theta_deg}");
            let off = table.albedo(wi)[0] / along_normal - 1.0;
            assert!(off.abs() < 1e-9, "{off} at {theta_deg}");
        }
        let is_one_way = |w: &quasilux_bsdf::Warning| w.kind() == WarningKind::OneWayTransmission;
        assert_eq!(read.warnings.iter().any(is_one_way), mode == ScatteringMode::Transmission);
        let last = read.warnings.iter().find(|w| w.kind() == WarningKind::OneIncidence);
        assert!(last.unwrap().found().contains("one incident polar angle, 0.0 degrees"));
    }
}

#[test]
fn what_angles_leave_open_is_told() {
    let file = |symmetry: &str, head: &str, values: usize| {
        let values = "1 ".repeat(values);
        format!("TypeSym {symmetry}\nTypeColorModel BW\n{head}\nbw def {values} enddef")
    };
    let half = "sigma 2 0 40 phi 3 0 90 180 theta 2 0 180";
    let turn = "sigma 2 0 40 phi 5 0 90 180 270 360 theta 2 0 180";
    for (text, deviation, words) in [
        (file("PlaneSymmetrical", half, 12), None, ""),
        (file("ASymmetrical", turn, 20), None, ""),
        (file("AxiSymmetrical", "sigma 2 0 40 phi 1 0 theta 2 0 180", 4), None, ""),
        (
            file("PlaneSymmetrical", "sigma 2 0 40 phi 3 0 45 90 theta 2 0 180", 12),
            Some(WarningKind::AzimuthGap),
            "phi that leave a gap of 180 degrees",
        ),
        (
            file("ASymmetrical", "sigma 2 0 40 phi 2 0 180 theta 2 0 180", 8),
            Some(WarningKind::AzimuthGap),
            "phi that leave a gap of 180 degrees",
        ),
        (
            file("PlaneSymmetrical", &format!("psi 3 0 90 180 {half}"), 36),
            Some(WarningKind::AzimuthGap),
            "incident azimuths that leave a gap of 180 degrees",
        ),
        (
            file("PlaneSymmetrical", &half.replace("theta 2 0", "theta 2 5"), 12),
            Some(WarningKind::SpecularMissing),
            "theta from 5.0 degrees on",
        ),
    ] {
        let read = read_ddr(text.as_bytes(), ScatteringMode::Reflection).unwrap();
        let odd =
            [WarningKind::AzimuthGap, WarningKind::SpecularMissing, WarningKind::OneIncidence];
        let found = read.warnings.iter().find(|w| odd.contains(&w.kind()));
        assert_eq!(found.map(|w| w.kind()), deviation, "{text}");
        assert!(found.is_none_or(|w| w.found().contains(words)), "{found:?}");
    }
}

/// Pages of comments before the head.
#[test]
fn a_long_foreword_of_comments_is_skipped() {
    let text = ";; measured somewhere, by somebody\n".repeat(1000) + NARROW;
    let read = read_bsdf_named("long.ddr", text.as_bytes()).unwrap();
    assert_eq!(read.bsdf.facts().format, BsdfFormat::Ddr);
}

#[test]
fn a_name_that_does_not_tell_the_way_is_told() {
    for (name, is_told) in [("a.ddr", false), ("a.DDT", false), ("stdin", true), ("", true)] {
        let read = read_bsdf_named(name, NARROW.as_bytes()).unwrap();
        let warning = read.warnings.iter().find(|w| w.kind() == WarningKind::UnknownScatteringMode);
        assert_eq!(warning.is_some(), is_told, "{name}");
    }
}
