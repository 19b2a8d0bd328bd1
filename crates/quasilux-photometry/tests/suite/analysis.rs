//! Figures of luminaires that are known in closed form.

use crate::corpus::{name, published_files, published_files_of};
use quasilux_photometry::analysis::{Plane, PlaneCurve, Spread, ZonalFlux};
use quasilux_photometry::{Analysis, PhotometricType, Photometry, read_ies, read_ldt};
use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt::Write;

/// A file of type C from a function of (gamma, C) in degrees.
fn luminaire(gamma: &[f64], c: &[f64], cd: impl Fn(f64, f64) -> f64) -> Photometry {
    let list = |numbers: &[f64]| {
        numbers.iter().fold(String::new(), |mut text, x| {
            write!(text, "{x:?} ").expect("strings grow");
            text
        })
    };
    let mut file = format!(
        "IESNA:LM-63-2002\n[TEST] closed form\nTILT=NONE\n1 1000 1 {} {} 1 2 0 0 0\n1 1 20\n",
        gamma.len(),
        c.len()
    );
    for line in [gamma, c] {
        writeln!(file, "{}", list(line)).expect("strings grow");
    }
    for c in c {
        let plane: Vec<f64> = gamma.iter().map(|gamma| cd(*gamma, *c)).collect();
        writeln!(file, "{}", list(&plane)).expect("strings grow");
    }
    read_ies(file.as_bytes()).expect("a luminaire file").photometry
}

fn steps(step: f64, last: f64) -> Vec<f64> {
    (0..=(last / step).round() as usize).map(|i| step * i as f64).collect()
}

fn cosine(gamma_deg: f64) -> f64 {
    libm::cos(gamma_deg / 180.0 * PI).max(0.0)
}

fn degrees(spread: Option<Spread>) -> f64 {
    spread.expect("a beam").angle_rad() / PI * 180.0
}

fn assert_near(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((found - expected).abs() <= tolerance, "{what}: {found}, not {expected}");
}

#[test]
fn an_isotropic_source_is_wide_and_even() {
    let analysis = Analysis::new(&luminaire(&[0.0, 180.0], &[0.0], |_, _| 50.0));
    assert_near(analysis.flux_lm, 200.0 * PI, 1e-10, "flux");
    assert_near(analysis.downward_flux_lm, 100.0 * PI, 1e-10, "downward");
    let code = analysis.flux_code;
    for (cone, share) in [0.25, 0.5, 0.75].into_iter().enumerate() {
        assert_near(code.lower[cone], share, 1e-14, "lower");
        assert_near(code.upper[cone], share, 1e-14, "upper");
    }
    assert_near(code.percent()[3], 50.0, 1e-12, "N4");
    assert_near(code.percent()[4], 20.0 * PI, 1e-12, "N5: of 1000 lm");
    assert_near(analysis.efficacy_lm_w.expect("20 W"), 10.0 * PI, 1e-12, "efficacy");
    for plane in analysis.planes {
        for spread in [plane.beam, plane.centre_beam, plane.field] {
            assert_near(degrees(spread), 360.0, 1e-12, "a full turn");
        }
    }
    let maximum = analysis.maximum.expect("light");
    assert_eq!((maximum.intensity_cd, maximum.angles.gamma_rad), (50.0, 0.0));
    // A zone of the sphere has the flux 2 pi I (cos a - cos b).
    for (zone, flux_lm) in analysis.zones_lm.iter().enumerate() {
        let [top, bottom] = [zone, zone + 1].map(|i| libm::cos(PI * i as f64 / 18.0));
        assert_near(*flux_lm, 100.0 * PI * (top - bottom), 1e-11, "zone");
    }
}

/// Shares of cos^n below gamma are `1 - cos^(n + 1)`; on steps of h the table misses them by h^2.
#[test]
fn powers_of_the_cosine_have_their_angles_and_codes() {
    let step = 0.1;
    let h = step / 180.0 * PI;
    for n in [1.0, 2.0, 6.0, 30.0] {
        let lamp = luminaire(&steps(step, 90.0), &[0.0], |g, _| 1000.0 * libm::pow(cosine(g), n));
        let analysis = Analysis::new(&lamp);
        let tolerance = n * h * h;
        assert_near(analysis.flux_lm, 2000.0 * PI / (n + 1.0), 1000.0 * tolerance, "flux");
        for (share, cosine) in analysis.flux_code.lower.iter().zip([0.75, 0.5, 0.25]) {
            assert_near(*share, 1.0 - libm::pow(cosine, n + 1.0), tolerance, "flux code");
        }
        assert_eq!((analysis.flux_code.downward, analysis.flux_code.upward), (1.0, 0.0));
        for plane in analysis.planes {
            let half_angle = |share: f64| 360.0 / PI * libm::acos(libm::pow(share, 1.0 / n));
            assert_near(degrees(plane.beam), half_angle(0.5), 180.0 / PI * tolerance, "beam");
            assert_near(degrees(plane.field), half_angle(0.1), 180.0 / PI * tolerance, "field");
            assert_eq!(plane.centre_beam, plane.beam);
        }
    }
}

/// The Lambertian code is 44 75 94 100, its angles are 120 and 168.52 degrees.
#[test]
fn a_lambertian_source_is_as_the_books_say() {
    let analysis = Analysis::new(&luminaire(&steps(2.5, 90.0), &[0.0], |g, _| 318.0 * cosine(g)));
    let code = analysis.flux_code.percent().map(f64::round);
    assert_eq!(code, [44.0, 75.0, 94.0, 100.0, 100.0]);
    assert_near(degrees(analysis.planes[0].beam), 120.0, 1e-9, "60 degrees is a node");
    assert_near(degrees(analysis.planes[1].field), 168.52, 0.01, "field");
}

#[test]
fn a_batwing_has_the_angle_of_its_outer_flanks() {
    // 40 cd at nadir, 100 cd at 50 degrees in C0 and C180, straight to 0 at 70; half of it in C90.
    let wing = |gamma: f64, c: f64| {
        let share = if c % 180.0 == 90.0 { 0.5 } else { 1.0 };
        match gamma {
            0.0 => 40.0,
            50.0 => 100.0 * share,
            _ => 0.0,
        }
    };
    let analysis = Analysis::new(&luminaire(
        &[0.0, 50.0, 70.0, 90.0],
        &[0.0, 90.0, 180.0, 270.0, 360.0],
        wing,
    ));
    let [along, across] = analysis.planes;
    assert_near(degrees(along.beam), 120.0, 1e-12, "from -60 to 60");
    assert_near(degrees(along.centre_beam), 132.0, 1e-12, "20 of 100 cd at 66 degrees");
    assert_near(degrees(along.field), 136.0, 1e-12, "10 of 100 cd at 68 degrees");
    assert_near(degrees(across.beam), 120.0, 1e-12, "half of its own maximum");
    let maximum = analysis.maximum.expect("light");
    assert_eq!((maximum.intensity_cd, maximum.angles.c_rad), (100.0, 0.0));
    assert_near(maximum.angles.gamma_rad, 50.0 / 180.0 * PI, 1e-15, "gamma");
    assert_eq!(analysis.measured_planes, 5);
}

#[test]
fn a_needle_is_found_where_it_is() {
    let needle = |gamma: f64, c: f64| if gamma == 40.0 && c == 120.0 { 1e6 } else { 0.0 };
    let analysis = Analysis::new(&luminaire(&steps(1.0, 90.0), &steps(5.0, 360.0), needle));
    let maximum = analysis.maximum.expect("light");
    assert_eq!(maximum.intensity_cd, 1e6);
    assert_near(maximum.angles.c_rad, 120.0 / 180.0 * PI, 1e-15, "C");
    assert_near(maximum.angles.gamma_rad, 40.0 / 180.0 * PI, 1e-15, "gamma");
    for plane in analysis.planes {
        assert_eq!((plane.maximum_cd, plane.beam, plane.field), (0.0, None, None));
    }
    assert_near(analysis.zones_lm.iter().sum(), analysis.flux_lm, 1e-9, "zones");
    assert_near(analysis.flux_code.lower[1], 1.0, 1e-14, "all of it within 60 degrees");
}

#[test]
fn a_dark_luminaire_has_no_angles() {
    let analysis = Analysis::new(&luminaire(&[0.0, 90.0], &[0.0], |_, _| 0.0));
    assert_eq!((analysis.maximum, analysis.planes[0].beam), (None, None));
    assert_eq!(analysis.flux_code.percent(), [0.0; 5]);
}

#[test]
fn an_uplight_shines_about_zenith() {
    let up = |gamma: f64, _: f64| 100.0 * cosine(180.0 - gamma);
    let angles: Vec<f64> = steps(2.5, 90.0).into_iter().map(|x| x + 90.0).collect();
    let analysis = Analysis::new(&luminaire(&angles, &[0.0], up));
    let beam = analysis.planes[0].beam.expect("a beam");
    assert_near(beam.start_rad, 2.0 / 3.0 * PI, 1e-12, "start");
    assert_near(beam.end_rad, 4.0 / 3.0 * PI, 1e-12, "end");
    let code = analysis.flux_code;
    assert_eq!((code.lower, code.downward, code.upward), ([0.0; 3], 0.0, 1.0));
    assert_near(code.upper[1], 0.75, 1e-3, "FCU2/FCU4");
    assert!(analysis.planes[0].centre_beam.is_none());
}

/// The half of the sphere about the beam, evenly lit: for type B below the horizon, for type A on
/// the side of +x.
#[test]
fn webs_with_other_poles_are_analysed_in_the_luminaire_frame() {
    let half_sphere = |kind: u8| {
        let file = format!(
            "IESNA:LM-63-2002\n[TEST] even\nTILT=NONE\n1 -1 1 3 3 {kind} 2 0 0 0\n1 1 10\n\
             -90 0 90\n-90 0 90\n{}",
            "100 100 100\n".repeat(3)
        );
        Analysis::new(&read_ies(file.as_bytes()).expect("a file").photometry)
    };
    let down = half_sphere(2);
    assert_near(down.flux_lm, 200.0 * PI, 1e-10, "flux");
    assert_near(down.downward_flux_lm, 200.0 * PI, 1.0, "all of it down");
    for (cone, share) in [0.25, 0.5, 0.75].into_iter().enumerate() {
        assert_near(down.flux_code.lower[cone], share, 2e-3, "lower");
    }
    for plane in down.planes {
        assert_near(degrees(plane.beam), 180.0, 0.2, "sampled to 0.1 degrees at each end");
    }
    let sideways = half_sphere(3);
    assert_near(sideways.flux_lm, 200.0 * PI, 1e-10, "flux");
    assert_near(sideways.downward_flux_lm, 100.0 * PI, 1e-10, "half of it down");
    for (cone, share) in [0.25, 0.5, 0.75].into_iter().enumerate() {
        assert_near(sideways.flux_code.lower[cone], share, 1e-12, "lower");
        assert_near(sideways.flux_code.upper[cone], share, 1e-12, "upper");
    }
    let beam = sideways.planes[0].beam.expect("a beam");
    assert_near(beam.start_rad, 0.0, 1e-12, "from nadir");
    assert_near(beam.end_rad, PI, 1e-12, "to zenith on the side of C0");
}

/// Each point of a curve is the intensity in its direction; on the sides of a jump too.
#[test]
fn curves_pass_through_the_intensities() {
    let lamp = luminaire(&[0.0, 30.0, 80.0], &[0.0, 100.0, 250.0, 360.0], |gamma, c| {
        200.0 - gamma + if c == 100.0 { gamma } else { 0.0 }
    });
    for plane in Plane::PRINCIPAL {
        let curve = PlaneCurve::new(&lamp, plane);
        let points = curve.points();
        assert!(points.windows(2).all(|pair| pair[0].gamma_rad <= pair[1].gamma_rad));
        assert_eq!([points[0].gamma_rad, points[points.len() - 1].gamma_rad], [-PI, PI]);
        for pair in points.windows(2).filter(|pair| pair[0].gamma_rad < pair[1].gamma_rad) {
            let gamma_rad = 0.5 * (pair[0].gamma_rad + pair[1].gamma_rad);
            let (sin, cos) = libm::sincos(gamma_rad);
            let (sin_c, cos_c) = libm::sincos(plane.c_rad);
            let direction = glam::DVec3::new(sin * cos_c, sin * sin_c, -cos);
            let middle_cd = 0.5 * (pair[0].intensity_cd + pair[1].intensity_cd);
            assert_near(lamp.intensity_cd(direction), middle_cd, 1e-10, "middle");
        }
    }
}

/// Zonal fluxes of published files grow, end at the flux, and the sampled directions divide in the
/// same shares: the inverse transform of a grid of coordinates, 1/256 of the flux each.
#[test]
fn published_files_divide_their_flux_as_they_sample_it() {
    let (Some(ies), Some(ldt)) = (published_files(), published_files_of("ldt")) else {
        return;
    };
    for file in ies.iter().chain(&ldt) {
        let bytes = std::fs::read(file).expect("a file");
        let Ok(read) = (if ldt.contains(file) { read_ldt(&bytes) } else { read_ies(&bytes) })
        else {
            continue;
        };
        let (photometry, name) = (read.photometry, name(file));
        let zones = ZonalFlux::new(&photometry);
        let flux_lm = photometry.flux_lm();
        assert_near(zones.total_lm(), flux_lm, 1e-12 * flux_lm, &name);
        // Cones are no parallels of type B: they cut its cells of coordinates in both directions.
        let is_cut = photometry.facts().photometric_type == PhotometricType::B;
        let columns = if is_cut { 256 } else { 16 };
        let middle = |i: usize, count: usize| (i as f64 + 0.5) / count as f64;
        let directions: Vec<glam::DVec3> = (0..256)
            .flat_map(|i| (0..columns).map(move |j| [middle(i, 256), middle(j, columns)]))
            .filter_map(|u| photometry.sample(u))
            .map(|sample| sample.direction)
            .collect();
        for gamma_rad in [0.5, 1.0, FRAC_PI_2, 2.0] {
            let is_below = |direction: &&glam::DVec3| -direction.z > libm::cos(gamma_rad);
            let sampled =
                directions.iter().filter(is_below).count() as f64 / directions.len() as f64;
            let share = zones.below_lm(gamma_rad) / flux_lm;
            assert_near(sampled, share, 1.0 / 256.0, &name);
        }
    }
}
