//! No digit is lost near the poles, however narrow the ring and however near.
//!
//! The reference is Gauss quadrature of `value x sin(x)` in the distance `x` from the pole: a sum
//! of positive terms, so that its relative error is a few units in the last place at any scale. In
//! a rotationally symmetric table the first coordinate of a sample is the part of that integral
//! that lies nearer to the pole (near theta = 0), or the rest (near theta = pi).

use crate::quadrature::GAUSS_5;
use crate::tables::table;
use glam::DVec3;
use quasilux_photometry::{Angles, SphericalTable, Symmetry};
use std::f64::consts::{PI, TAU};

/// Distances from the pole, four a decade from 1e-9 to 1e-3 radians.
fn distances_rad() -> impl Iterator<Item = f64> {
    (0..=24).map(|i| libm::exp10(-9.0 + 0.25 * f64::from(i)))
}

/// Profiles in value at the pole, at a distance of `width` and at one radian, and the widths.
const PROFILES: [[f64; 3]; 4] =
    [[1.0, 1.0, 1.0], [0.0, 1.0, 0.5], [3.0, 0.0, 1.0], [1e-6, 1e6, 1.0]];
const WIDTHS_RAD: [f64; 4] = [2e-9, 1e-6, 1.745e-3, 0.5];

/// A linear profile between nodes over the distance from a pole, and its integral.
struct Profile {
    knots_rad: [f64; 3],
    values: [f64; 3],
}

impl Profile {
    /// Every profile with every width.
    fn all() -> impl Iterator<Item = Self> {
        WIDTHS_RAD.into_iter().flat_map(|width_rad| {
            PROFILES.map(|values| Self { knots_rad: [0.0, width_rad, 1.0], values })
        })
    }

    fn value(&self, x: f64) -> f64 {
        let i = usize::from(x > self.knots_rad[1]);
        let ([start, end], [a, b]) = (self.cell(i), [self.values[i], self.values[i + 1]]);
        (a * (end - x) + b * (x - start)) / (end - start)
    }

    fn max_value(&self) -> f64 {
        self.values.iter().copied().fold(0.0, f64::max)
    }

    /// Integral over solid angle of the cap of radius `x`.
    fn cap(&self, x: f64) -> f64 {
        let panels = (0..2).flat_map(|i| {
            let [start, end] = self.cell(i);
            let (start, end) = (start.min(x), end.min(x));
            // Five nodes are exact to the last digit on pieces of an eighth.
            let piece = (end - start) / 8.0;
            (0..8).map(move |j| [start + piece * f64::from(j), start + piece * f64::from(j + 1)])
        });
        let quadrature = |[start, end]: [f64; 2]| -> f64 {
            let terms = GAUSS_5.map(|(node, weight)| {
                let x = 0.5 * (start + end) + 0.5 * (end - start) * node;
                weight * self.value(x) * libm::sin(x)
            });
            0.5 * (end - start) * terms.iter().sum::<f64>()
        };
        TAU * panels.map(quadrature).sum::<f64>()
    }

    fn cell(&self, i: usize) -> [f64; 2] {
        [self.knots_rad[i], self.knots_rad[i + 1]]
    }

    /// The table around the pole theta = 0.
    fn north(&self) -> SphericalTable {
        let degrees = self.knots_rad.map(|x| x / PI * 180.0);
        table(&degrees, &[0.0], Symmetry::Rotational, |t, _| {
            self.values[degrees.iter().position(|&node| node == t).unwrap()]
        })
    }

    /// The table around the pole theta = pi.
    fn south(&self) -> SphericalTable {
        let degrees = self.knots_rad.map(|x| 180.0 - x / PI * 180.0);
        let ascending = [degrees[2], degrees[1], degrees[0]];
        table(&ascending, &[0.0], Symmetry::Rotational, |t, _| {
            self.values[degrees.iter().position(|&node| node == t).unwrap()]
        })
    }
}

/// The distance of a direction from its nearer pole.
fn distance_rad(direction: DVec3) -> f64 {
    let horizontal = (direction.x * direction.x + direction.y * direction.y).sqrt();
    libm::atan2(horizontal, direction.z.abs())
}

/// Near theta = 0 both coordinate and angle can be as small as they like: relative errors.
#[test]
fn samples_near_theta_0_keep_all_digits() {
    for profile in Profile::all() {
        let (table, flux) = (profile.north(), profile.cap(1.0));
        assert!((table.integral() / flux - 1.0).abs() < 1e-14);
        for x in distances_rad() {
            let u0 = profile.cap(x) / flux;
            for u1 in [0.0, 0.3, 0.7] {
                let sample = table.sample([u0, u1]).unwrap();
                let sampled_rad = distance_rad(sample.direction);
                let back = profile.cap(sampled_rad) / flux;
                assert!((back / u0 - 1.0).abs() < 2e-13, "x {x:e}: {u0:e} became {back:e}");
                let density = profile.value(sampled_rad) / flux;
                let error = (sample.pdf_sr - density).abs();
                assert!(error <= 1e-14 * density + 1e-14 * profile.max_value() / flux, "x {x:e}");
                let inverted = table.invert(sample.direction);
                assert!((inverted[0] / u0 - 1.0).abs() < 2e-13, "x {x:e}: {inverted:?}");
                assert!((inverted[1] - u1).abs() < 1e-15, "x {x:e}: {inverted:?}");
            }
        }
    }
}

/// Near theta = pi the coordinate is near 1 and the angle near pi: their last digits, 1e-16 and
/// 4e-16, are all that may be lost, whatever is between them.
#[test]
fn samples_near_theta_pi_lose_the_last_digit_only() {
    for profile in Profile::all() {
        let (table, flux) = (profile.south(), profile.cap(1.0));
        for x in distances_rad() {
            let u0 = 1.0 - profile.cap(x) / flux;
            let sample = table.sample([u0, 0.3]).unwrap();
            let sampled_rad = distance_rad(sample.direction);
            let density_per_rad = TAU * profile.value(sampled_rad) * libm::sin(sampled_rad) / flux;
            let tolerance = 1e-15 + 1e-14 * density_per_rad;
            let back = 1.0 - profile.cap(sampled_rad) / flux;
            assert!((back - u0).abs() < tolerance, "x {x:e}: {u0} became {back}");
            let inverted = table.invert(sample.direction);
            assert!((inverted[0] - u0).abs() < tolerance, "x {x:e}: {inverted:?}");
        }
    }
}

/// A direction given near a pole has the value of its own distance.
#[test]
fn densities_near_the_poles_are_those_of_the_distance() {
    for profile in Profile::all() {
        let (north, south, flux) = (profile.north(), profile.south(), profile.cap(1.0));
        for x in distances_rad() {
            let direction = Angles { theta_rad: x, phi_rad: 2.0 }.direction();
            let expected = profile.value(x) / flux;
            let density = north.pdf(direction);
            let error = (density - expected).abs();
            assert!(error <= 1e-14 * expected + 1e-15 * profile.max_value() / flux, "x {x:e}");
            if x > 1e-6 && profile.knots_rad[1] > 1e-3 {
                let mirrored = DVec3::new(direction.x, direction.y, -direction.z);
                assert!((south.pdf(mirrored) / expected - 1.0).abs() < 1e-8, "x {x:e}");
            }
        }
    }
}
