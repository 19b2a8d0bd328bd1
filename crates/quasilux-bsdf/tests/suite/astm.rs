//! ASTM E1392 files made from closed forms.

use super::analytic::{Scattering, difference, glossy, lambert, rough};
use super::{direction, from_front};
use quasilux_bsdf::WarningKind;
use quasilux_bsdf::{
    BsdfFormat, Distribution, Parsed, ScatteringMode, Side, luminance, read_astm, read_bsdf,
};
use std::f64::consts::{FRAC_PI_2, PI};

/// A file with `phi_i` half a turn, exits over half a turn and steps of this many degrees.
fn file(f: Scattering, step: u32) -> String {
    let mut text =
        "Source: closed form\nNUM_POINTS 1\nVARS theta_i,phi_i,theta_s,phi_s,BRDF\n".to_owned();
    for theta_i in [0, 20, 40, 60, 80] {
        for theta_s in (0..90).step_by(step as usize) {
            for phi_s in (0..=180).step_by(2 * step as usize) {
                let angles = [theta_i, 180, theta_s, phi_s].map(f64::from);
                let [wi, wo] = [direction(angles[0], 180.0), direction(angles[2], angles[3])];
                let [a, b, c, d] = angles.map(f64::to_radians);
                text += &format!("{a:.7},{b:.7},{c:.7},{d:.7},{:.8}\n", f(wi, wo));
            }
        }
    }
    text
}

fn table(text: &str) -> Distribution {
    let bsdf = read_astm(text.as_bytes()).unwrap().bsdf;
    bsdf.scattering(Side::Front, ScatteringMode::Reflection).unwrap().clone()
}

/// At half the steps near a quarter of the difference: second order. What is left of Lambert's
/// surface is the linear cosine between polar angles.
#[test]
fn tables_approach_the_closed_form() {
    for (name, f, most) in [("lambert", lambert as Scattering, 3e-4), ("rough", rough, 0.03)] {
        for theta_deg in [0.0, 20.0, 60.0, 80.0] {
            let wi = direction(theta_deg, 25.0);
            let [off, less] = [6, 3].map(|step| difference(f, &table(&file(f, step)), wi));
            println!("{name} at {theta_deg} degrees: {off:.5}, then {less:.5}");
            let is_second_order = name == "lambert" || off > 2.5 * less;
            assert!(less < most && is_second_order, "{name} at {theta_deg}: {off}, {less}");
        }
    }
}

#[test]
fn degrees_blanks_colours_and_any_order_are_read() {
    let text = "VARS theta_i phi_i theta_s phi_s X Y Z\n# degrees\n\n\
                30 0 60 90  0.3 0.2 0.1\n30 0 0 0  0.3 0.2 0.1\n30 0 60 270  0.3 0.2 0.1\n\
                30 0 60 0  0.3 0.2 -0.1\n30 0 60 180  0.3 0.2 0.1\n";
    let read = read_bsdf(text.as_bytes()).unwrap();
    assert_eq!(read.bsdf.facts().format, BsdfFormat::Astm);
    let warnings: Vec<WarningKind> = read.warnings.iter().map(|w| w.kind()).collect();
    assert_eq!(warnings[..2], [WarningKind::AnglesInDegrees, WarningKind::NegativeScattering]);
    let table = read.bsdf.scattering(Side::Front, ScatteringMode::Reflection).unwrap();
    assert!(table.is_coloured() && table.is_isotropic());
    let f = table.evaluate(direction(30.0, 0.0), direction(60.0, 90.0));
    let luminance = 0.2126 * f[0] + 0.7152 * f[1] + 0.0722 * f[2];
    assert!((luminance - 0.2).abs() < 1e-4, "{f:?}");
}

/// Planes of incidence 0 and 90 degrees; along the normal there is one, for both.
#[test]
fn planes_of_incidence_are_told_apart() {
    let mut text = "VARS theta_i,phi_i,theta_s,phi_s,f\n".to_owned();
    for (theta_i, phi_i, f) in [(0.0, 0.0, 0.1), (1.0, 0.0, 0.2), (1.0, FRAC_PI_2, 0.3)] {
        for phi_s in [0.0, 1.5, 3.0, 4.5, 5.5] {
            text += &format!("{theta_i},{phi_i},0.5,{phi_s},{f}\n");
        }
    }
    let table = table(&text);
    assert!(!table.is_isotropic());
    let f = |theta_rad: f64, phi_deg| {
        table.evaluate(from_front(theta_rad.to_degrees(), phi_deg), direction(20.0, 0.0))[0]
    };
    for (found, expected) in
        [(f(0.0, 0.0), 0.1), (f(1.0, 0.0), 0.2), (f(1.0, 90.0), 0.3), (f(1.0, 45.0), 0.25)]
    {
        assert!((found / expected - 1.0).abs() < 0.05, "{found} for {expected}");
    }
}

#[test]
fn what_is_no_astm_file_is_refused_with_its_place() {
    let vars = "VARS theta_i,phi_i,theta_s,phi_s,f\n";
    let grid = "0,0,0.1,0,1\n0,0,0.1,1,1\n0,0,0.2,0,1\n";
    for (text, place, expected) in [
        ("theta_i\n".to_owned(), "1:1", "VARS"),
        ("VARS phi_i,theta_i\n".to_owned(), "1:6", "the columns theta_i,phi_i"),
        ("VARS theta_i,phi_i,theta_s,phi_s,400nm,500nm\n".to_owned(), "1:1", "one, or R,G,B"),
        (vars.to_owned(), "1:1", "a line for each pair"),
        (format!("{vars}0,0,0\n"), "2:6", "5 numbers a line"),
        (format!("{vars}0,0,0,0,1,2\n"), "2:11", "the end of the line"),
        (format!("{vars}0,0,0,zero,1\n"), "2:7", "an angle"),
        (format!("{vars}95,0,0,0,1\n"), "2:1", "0 to 90 degrees"),
        (format!("{vars}0,0,195,0,1\n"), "2:1", "0 to 180 degrees"),
        (format!("{vars}{grid}"), "2:1", "a full grid of 2 polar angles by 2 azimuths"),
    ] {
        let error = read_astm(text.as_bytes()).expect_err(&text);
        assert!(error.to_string().starts_with(&format!("{place}: ")), "{text:?}: {error}");
        assert!(error.expected().contains(expected), "{text:?}: {error}");
    }
}

/// A file in degrees: each incident polar angle with each of the exits, in the plane of incidence
/// 0.
fn in_degrees(
    thetas_i: &[u32],
    thetas_s: &[u32],
    phis_s: &[u32],
    f: impl Fn(f64, f64, f64) -> String,
) -> String {
    let mut text = "VARS theta_i,phi_i,theta_s,phi_s,f\n".to_owned();
    for &theta_i in thetas_i {
        for &theta_s in thetas_s {
            for &phi_s in phis_s {
                let f = f(f64::from(theta_i), f64::from(theta_s), f64::from(phi_s));
                text += &format!("{theta_i},0,{theta_s},{phi_s},{f}\n");
            }
        }
    }
    text
}

/// Of light from azimuth 0, with exit azimuths as in files.
fn glossy_text(theta_i: f64, theta_s: f64, phi_s: f64) -> String {
    format!("{:.8}", glossy(direction(theta_i, 0.0), direction(theta_s, phi_s)))
}

fn found(read: &Parsed, deviation: WarningKind) -> Option<String> {
    let is_meant = |warning: &&quasilux_bsdf::Warning| warning.kind() == deviation;
    read.warnings.iter().find(is_meant).map(ToString::to_string)
}

/// A scan in the plane of incidence or in a quadrant does not tell what leaves it: filling the gap
/// would make several times as much light of a glossy lobe.
#[test]
fn azimuths_too_far_apart_are_refused() {
    let polar: Vec<u32> = (0..90).collect();
    for (phis, gap) in [(&[0, 180][..], 180), (&[0, 45, 90], 270), (&[0], 360), (&[0, 91, 180], 91)]
    {
        let text = in_degrees(&[0, 30], &polar, phis, glossy_text);
        let error = read_astm(text.as_bytes()).expect_err("a gap");
        let line = 2 + polar.len() * phis.len();
        let expected = format!("{line}:1: found exit azimuths that leave a gap of {gap} degrees");
        assert!(error.to_string().starts_with(&expected), "{error}");
    }
    // Along the normal all azimuths are alike.
    for phis in [&[0][..], &[0, 180]] {
        let read = read_astm(in_degrees(&[0], &polar, phis, glossy_text).as_bytes()).unwrap();
        let off = difference(glossy, front(&read, ScatteringMode::Reflection), direction(0.0, 0.0));
        assert!(off < 0.02, "{off}");
        assert!(found(&read, WarningKind::OneIncidence).is_some());
    }
}

fn front(read: &Parsed, mode: ScatteringMode) -> &Distribution {
    read.bsdf.scattering(Side::Front, mode).unwrap()
}

#[test]
fn wide_gaps_between_azimuths_are_told() {
    let polar: Vec<u32> = (0..90).step_by(10).collect();
    for (step, gap) in [(90, Some(90)), (60, Some(60)), (45, None)] {
        let phis: Vec<u32> = (0..360).step_by(step).collect();
        let text = in_degrees(&[0, 30], &polar, &phis, |_, _, _| "0.1".to_owned());
        let read = read_astm(text.as_bytes()).unwrap();
        let expected = gap.map(|gap| {
            format!(
                "{}:1: found exit azimuths that leave a gap of {gap} degrees",
                2 + 9 * phis.len()
            )
        });
        let message = found(&read, WarningKind::AzimuthGap);
        match expected {
            Some(expected) => assert!(message.is_some_and(|m| m.starts_with(&expected))),
            None => assert_eq!(message, None),
        }
    }
}

/// In radians up to pi: 0.1 is reflected and 0.05 passes, straight light half a turn from where it
/// comes from.
#[test]
fn exits_behind_the_sheet_are_transmission() {
    for (has_reflection, first) in [(true, 0), (false, 90)] {
        let mut text = "VARS theta_i,phi_i,theta_s,phi_s,f\n".to_owned();
        for theta_i in [0.0_f64, 30.0] {
            for theta_s in (first..=180).step_by(10) {
                for phi_s in (0..360).step_by(45) {
                    let f = match (theta_s <= 90, phi_s) {
                        (true, _) => 0.1,
                        (false, 180) => 0.07,
                        _ => 0.05,
                    };
                    let [a, b, c] =
                        [theta_i, f64::from(theta_s), f64::from(phi_s)].map(f64::to_radians);
                    text += &format!("{a:.6},0,{b:.6},{c:.6},{f}\n");
                }
            }
        }
        let read = read_astm(text.as_bytes()).unwrap();
        assert_eq!(found(&read, WarningKind::AnglesInDegrees), None);
        assert_eq!(
            read.bsdf.scattering(Side::Front, ScatteringMode::Reflection).is_some(),
            has_reflection
        );
        let wi = from_front(30.0, 0.0);
        let passing = front(&read, ScatteringMode::Transmission);
        for (phi_deg, expected) in [(180.0, 0.07), (90.0, 0.05), (0.0, 0.05)] {
            let f = passing.evaluate(wi, from_front(40.0, phi_deg))[0];
            assert!((f / expected - 1.0).abs() < 1e-4, "{f} at {phi_deg}");
        }
        if has_reflection {
            let albedo = front(&read, ScatteringMode::Reflection).albedo(wi)[0];
            assert!((albedo / (0.1 * PI) - 1.0).abs() < 1e-3, "{albedo}");
        }
    }
}

/// Exits of a few degrees, but azimuths of hundreds.
#[test]
fn azimuths_tell_degrees_too() {
    let text = in_degrees(&[0], &[0, 1, 2], &[0, 90, 180, 270], |_, _, _| "2".to_owned());
    let read = read_astm(text.as_bytes()).unwrap();
    let message = found(&read, WarningKind::AnglesInDegrees).unwrap();
    assert!(message.contains("an azimuth of 270; expected radians, 2 pi at most"), "{message}");
}

#[test]
fn the_first_of_repeated_directions_counts() {
    let lines =
        |f: &str| in_degrees(&[0, 40], &[0, 45, 80], &[0, 60, 120, 180], |_, _, _| f.to_owned());
    let (once, again) = (lines("0.1"), lines("9"));
    let (_, again) = again.split_once('\n').unwrap();
    let read = read_astm((once.clone() + again).as_bytes()).unwrap();
    let warning = read.warnings.iter().find(|w| w.kind() == WarningKind::RepeatedDirection);
    let warning = warning.unwrap();
    assert_eq!((warning.line(), warning.count()), (26, 24));
    assert!(warning.to_string().contains("the directions of line 2;"), "{warning}");
    let albedo = front(&read, ScatteringMode::Reflection).albedo(direction(20.0, 0.0))[0];
    assert!((albedo / (0.1 * PI) - 1.0).abs() < 1e-3, "{albedo}");
    // The same values again, and a whole turn that is none, are nothing new.
    let (_, same) = once.split_once('\n').unwrap();
    let read = read_astm((once.clone() + same + "0,0,45,360,0.1\n").as_bytes()).unwrap();
    assert_eq!(found(&read, WarningKind::RepeatedDirection), None);
}

/// Y over pi is 25 %, more saturated than red, green and blue allow.
#[test]
fn colours_outside_keep_their_luminance() {
    let mut text = "VARS theta_i,phi_i,theta_s,phi_s,X,Y,Z\n".to_owned();
    for theta_s in [0.0, 0.8, 1.55] {
        for phi_s in [0.0, 1.5, 3.0] {
            text += &format!("0,0,{theta_s},{phi_s},0.015915,0.0795775,0.0063662\n");
        }
    }
    let read = read_astm(text.as_bytes()).unwrap();
    let albedo = luminance(front(&read, ScatteringMode::Reflection).albedo(direction(0.0, 0.0)));
    assert!((albedo - 0.25).abs() < 1e-3, "{albedo}");
    let message = found(&read, WarningKind::OutOfGamut).unwrap();
    assert!(message.starts_with("2:1: found X 0.015915, Y"), "{message}");
}
