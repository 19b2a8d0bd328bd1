//! ASTM E1392 files made from closed forms.

use super::analytic::{Scattering, difference, lambert, rough};
use super::{direction, from_front};
use quasilux_photometry::Deviation;
use quasilux_photometry::bsdf::{BsdfFormat, Distribution, Side, Way, read_astm, read_bsdf};
use std::f64::consts::FRAC_PI_2;

/// A file with `phi_i` half a turn, exits over half a turn and steps of so many degrees.
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
    bsdf.scattering(Side::Front, Way::Reflection).unwrap().clone()
}

/// At half the steps near a quarter of the difference: second order. What is left of Lambert's surface is the linear cosine
/// between polar angles.
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
    let warnings: Vec<Deviation> = read.warnings.iter().map(|w| w.deviation()).collect();
    assert_eq!(warnings[..2], [Deviation::NegativeScattering, Deviation::AnglesInDegrees]);
    let table = read.bsdf.scattering(Side::Front, Way::Reflection).unwrap();
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
        for phi_s in [0.0, 2.0, 4.0] {
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
        (format!("{vars}0,0,95,0,1\n"), "2:1", "0 to 90 degrees"),
        (format!("{vars}{grid}"), "2:1", "a full grid of 2 polar angles by 2 azimuths"),
    ] {
        let error = read_astm(text.as_bytes()).expect_err(&text);
        assert!(error.to_string().starts_with(&format!("{place}: ")), "{text:?}: {error}");
        assert!(error.expected().contains(expected), "{text:?}: {error}");
    }
}
