//! Surfaces with a closed form, as functions and as files made from them.

use glam::DVec3;
use quasilux_bsdf::Distribution;
use quasilux_photometry::Angles;
use std::f64::consts::PI;
use std::fmt::Write as _;

/// f(wi, wo) in 1/sr, both with positive z.
pub(super) type Scattering = fn(DVec3, DVec3) -> f64;

/// Lambert's surface of reflectance 0.6.
pub(super) fn lambert(_: DVec3, _: DVec3) -> f64 {
    0.6 / PI
}

/// GGX microfacets (Walter et al. 2007) of roughness 0.3, without Fresnel's term.
pub(super) fn rough(wi: DVec3, wo: DVec3) -> f64 {
    ggx(0.3, wi, wo)
}

/// The same of roughness 0.1: a lobe of some degrees.
pub(super) fn glossy(wi: DVec3, wo: DVec3) -> f64 {
    ggx(0.1, wi, wo)
}

fn ggx(alpha: f64, wi: DVec3, wo: DVec3) -> f64 {
    let half = (wi + wo).normalize();
    let a2 = alpha * alpha;
    let cos2 = half.z * half.z;
    let root = cos2 * (a2 - 1.0) + 1.0;
    let d = a2 / (PI * root * root);
    // The masking term over the cosines stays finite at the horizon.
    let lambda = |z: f64| (a2 + (1.0 - a2) * z * z).sqrt();
    d * 0.5 / (wo.z * lambda(wi.z) + wi.z * lambda(wo.z))
}

/// Angles of a DDR file in degrees.
pub(super) struct SpecularGrid {
    pub(super) sigma: Vec<f64>,
    pub(super) phi: Vec<f64>,
    pub(super) theta: Vec<f64>,
}

impl SpecularGrid {
    /// Incidences up to 80 degrees; angles from the specular direction whose spacing is `step`
    /// there and twice that 10 degrees away, over half a turn.
    pub(super) fn with_step(step: f64) -> Self {
        let mut theta = vec![0.0];
        while let Some(&last) = theta.last().filter(|&&last| last < 180.0 - step) {
            theta.push(last + step * (1.0 + last / 10.0));
        }
        theta.retain(|theta| *theta < 180.0);
        theta.push(180.0);
        let planes = (60.0 / step).round() as u32;
        let phi = (0..=planes).map(|i| 180.0 * f64::from(i) / f64::from(planes)).collect();
        Self { sigma: vec![0.0, 10.0, 30.0, 60.0, 80.0], phi, theta }
    }
}

/// A direction around the specular one, for an incident direction at azimuth 0.
pub(super) fn around_specular(sigma: f64, theta: f64, phi: f64) -> DVec3 {
    let (sin, cos) = libm::sincos(sigma.to_radians());
    let local = super::direction(theta, phi);
    DVec3::new(cos * local.x - sin * local.z, local.y, sin * local.x + cos * local.z)
}

/// A DDR file of a surface that is mirrored in the plane of incidence.
pub(super) fn ddr(f: Scattering, grid: &SpecularGrid) -> String {
    let list = |name: &str, angles: &[f64]| {
        let words: String = angles.iter().map(|angle| format!(" {angle:.6}")).collect();
        format!("{name} {}\n{words}\n", angles.len())
    };
    let mut text = ";; made from a closed form\nSource Generated\nTypeSym PlaneSymmetrical\n\
                    TypeColorModel BW\nTypeData Luminance Absolute\n"
        .to_owned();
    text += &list("sigma", &grid.sigma);
    text += &list("phi", &grid.phi);
    text += &list("theta", &grid.theta);
    text += &format!("bw\n kbdf\n{}\n def\n", " 2.0".repeat(grid.sigma.len()));
    for &sigma in &grid.sigma {
        let wi = super::direction(sigma, 0.0);
        let _ = writeln!(text, ";; Sigma = {sigma}");
        for &phi in &grid.phi {
            for &theta in &grid.theta {
                let wo = around_specular(sigma, theta, phi);
                // Below the horizon nothing is measured: the value at the horizon goes on.
                let wo = DVec3::new(wo.x, wo.y, wo.z.max(0.0)).normalize();
                let _ = write!(text, " {:.9}", PI * f(wi, wo) / 2.0);
            }
            text.push('\n');
        }
    }
    text + " enddef\n"
}

/// The directional-hemispherical share by quadrature: midpoints in both spherical angles.
pub(super) fn albedo(f: Scattering, wi: DVec3) -> f64 {
    const ROWS: u32 = 400;
    const COLUMNS: u32 = 400;
    let (mut sum, cell) = (0.0, 0.5 * PI / f64::from(ROWS) * (2.0 * PI / f64::from(COLUMNS)));
    for i in 0..ROWS {
        let theta_rad = 0.5 * PI * (f64::from(i) + 0.5) / f64::from(ROWS);
        for j in 0..COLUMNS {
            let phi_rad = 2.0 * PI * (f64::from(j) + 0.5) / f64::from(COLUMNS);
            let wo = Angles { theta_rad, phi_rad }.direction();
            sum += f(wi, wo) * wo.z * libm::sin(theta_rad) * cell;
        }
    }
    sum
}

/// The mean difference of a table from f over the mean of f, over exits of equal projected solid
/// angle.
pub(super) fn difference(f: Scattering, table: &Distribution, wi: DVec3) -> f64 {
    let (mut difference, mut sum) = (0.0, 0.0);
    for i in 0..90 {
        for j in 0..90 {
            let sine = ((f64::from(i) + 0.5) / 90.0).sqrt();
            let wo = super::direction(libm::asin(sine).to_degrees(), 4.0 * (f64::from(j) + 0.5));
            let exact = f(wi, wo);
            difference += (table.evaluate(wi, wo)[0] - exact).abs();
            sum += exact;
        }
    }
    difference / sum
}
