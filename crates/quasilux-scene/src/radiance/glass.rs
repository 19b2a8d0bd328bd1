//! Panes of Radiance's `glass`: one sheet that stands for a pane with two surfaces.
//!
//! Its transmissivity is the share of light that is left after one way straight through the body.
//! At an angle the way is longer by the cosine inside, and light goes to and fro between both
//! surfaces, each polarisation for itself (Born and Wolf 1999, section 1.5 and 1.6; G. J. Ward,
//! Radiance's `glass`).

use crate::Rgb;
use crate::bsdf::{AngularNode, AngularTable, Pane};
use std::f64::consts::FRAC_PI_2;

/// The refractive index where none is given.
pub(crate) const INDEX: f64 = 1.52;

/// Steps of the tables from the normal to the horizon: 2 degrees, 1 beyond 60 degrees. The lines
/// between them are off by less than 0.001 up to 85 degrees.
const DEGREES_APART: [(u32, u32); 2] = [(0, 2), (60, 1)];

/// Transmitted and reflected over incident flux.
struct PaneShares {
    transmitted: f64,
    reflected: f64,
}

/// The pane of a grey glass.
pub(crate) fn grey(eta: f64, transmissivity: f64) -> Pane {
    let degrees = (0..=90_u32).filter(|&degrees| {
        let (from, apart) = DEGREES_APART[usize::from(degrees >= DEGREES_APART[1].0)];
        (degrees - from).is_multiple_of(apart)
    });
    let angle =
        |degrees: u32| if degrees == 90 { FRAC_PI_2 } else { f64::from(degrees).to_radians() };
    let angles: Vec<f64> = degrees.map(angle).collect();
    let table = |share: fn(PaneShares) -> f64| {
        let node = |&theta_rad: &f64| AngularNode {
            theta_rad,
            share: share(shares(eta, transmissivity, theta_rad)).clamp(0.0, 1.0),
        };
        AngularTable::new(angles.iter().map(node).collect()).expect("angles rise to 90 degrees")
    };
    Pane::measured(table(|it| it.transmitted), table(|it| it.reflected))
}

/// The pane of a coloured glass, which at an angle takes as much of the light as at none.
pub(crate) fn coloured(eta: f64, transmissivity: Rgb) -> Pane {
    let clear = Pane::clear_transmittance(eta);
    let normal = |share: f64| shares(eta, share, 0.0).transmitted.min(clear);
    Pane::Tinted { eta, transmittance: Rgb(transmissivity.0.map(normal)) }
}

/// Of unpolarised light that comes at an angle.
fn shares(eta: f64, transmissivity: f64, theta_rad: f64) -> PaneShares {
    let (sin, cos) = libm::sincos(theta_rad);
    let cos = if theta_rad >= FRAC_PI_2 { 0.0 } else { cos };
    let inside = (1.0 - sin * sin / (eta * eta)).max(0.0).sqrt();
    if cos <= 0.0 || inside <= 0.0 {
        return PaneShares { transmitted: 0.0, reflected: 1.0 };
    }
    let passed = libm::pow(transmissivity, 1.0 / inside);
    let amplitudes =
        [(cos - eta * inside) / (cos + eta * inside), (inside - eta * cos) / (inside + eta * cos)];
    let [across, along] = amplitudes.map(|amplitude| {
        let r = amplitude * amplitude;
        let left = 1.0 - r * r * passed * passed;
        let transmitted = (1.0 - r) * (1.0 - r) * passed / left;
        PaneShares { transmitted, reflected: r + r * passed * transmitted }
    });
    PaneShares {
        transmitted: 0.5 * (across.transmitted + along.transmitted),
        reflected: 0.5 * (across.reflected + along.reflected),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The values that the names of Honeybee's own windows promise, and 0.96 -> 0.881 as
    /// docs/from-radiance.md has it.
    #[test]
    fn transmissivity_becomes_transmittance() {
        for (transmissivity, transmittance) in
            [(0.697_576_181_538_433_1, 0.64), (0.958_415_432_861_059_6, 0.88), (0.96, 0.8815)]
        {
            let found = shares(INDEX, transmissivity, 0.0).transmitted;
            assert!((found - transmittance).abs() < 1e-4, "{found} is not {transmittance}");
        }
        let Pane::Tinted { transmittance, .. } = coloured(INDEX, Rgb([0.96, 1.0, 0.0])) else {
            panic!("a coloured pane")
        };
        assert!((transmittance.0[0] - 0.8815).abs() < 1e-4 && transmittance.0[2] == 0.0);
        assert_eq!(transmittance.0[1], Pane::clear_transmittance(INDEX));
    }

    /// Light is neither made nor lost in clear glass, and reversed sums agree: rays to and fro,
    /// added one by one, are the slow twin.
    #[test]
    fn rays_to_and_fro_add_up_to_the_closed_form() {
        for degrees in [0.0_f64, 30.0, 60.0, 80.0, 89.0] {
            let theta_rad = degrees.to_radians();
            let clear = shares(INDEX, 1.0, theta_rad);
            assert!((clear.transmitted + clear.reflected - 1.0).abs() < 1e-12);
            let (mut transmitted, mut reflected) = (0.0, 0.0);
            let refracted = libm::asin(libm::sin(theta_rad) / INDEX);
            let passed = libm::pow(0.7, 1.0 / libm::cos(refracted));
            for polarisation in [libm::sin, libm::tan] {
                // Fresnel's equations by angles, with their limit at the normal.
                let ratio =
                    polarisation(theta_rad - refracted) / polarisation(theta_rad + refracted);
                let amplitude = if degrees == 0.0 { 0.52 / 2.52 } else { ratio };
                let r = amplitude * amplitude;
                let mut inside = 0.5 * (1.0 - r);
                reflected += 0.5 * r;
                for bounce in 0..2000 {
                    inside *= passed;
                    let out = inside * (1.0 - r);
                    *(if bounce % 2 == 0 { &mut transmitted } else { &mut reflected }) += out;
                    inside *= r;
                }
            }
            let tinted = shares(INDEX, 0.7, theta_rad);
            assert!((tinted.transmitted - transmitted).abs() < 1e-9, "{degrees}");
            assert!((tinted.reflected - reflected).abs() < 1e-9, "{degrees}");
        }
    }

    #[test]
    fn tables_are_near_the_formula() {
        let Pane::Measured { transmittance, front_reflectance, .. } = grey(INDEX, 0.7) else {
            panic!("a table")
        };
        for tenth in 0..850 {
            let theta_rad = f64::from(tenth) / 900.0 * FRAC_PI_2;
            let PaneShares { transmitted, reflected } = shares(INDEX, 0.7, theta_rad);
            assert!((transmittance.at_angle(theta_rad) - transmitted).abs() < 1e-3, "{tenth}");
            assert!((front_reflectance.at_angle(theta_rad) - reflected).abs() < 1e-3, "{tenth}");
        }
        assert_eq!(front_reflectance.at_angle(FRAC_PI_2), 1.0);
    }
}
