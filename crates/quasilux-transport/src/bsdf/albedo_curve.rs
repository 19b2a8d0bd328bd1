//! How much light a rough surface reflects at once, by angle: the directional albedo
//! `E(cos) = integral of f cos` of [`Ggx`] with any Fresnel factor.
//!
//! No closed form is known for all angles. A midpoint rule over the coordinates of sampled rays
//! finds the integral; it is tabulated when a material is made, and cubic polynomials join the
//! values. The error is below 1e-4 for alpha in [0.0004, 1].
//!
//! The curve bends at cosines of about alpha, and with a Fresnel factor at cosines of about 1:
//! places on it are counted by `s` in [0, 1], `cos = alpha (exp(L s^2) - 1)` with `L = log(1 + 1 /
//! alpha)`.

use super::ggx::{Ggx, sample_reflection};
use glam::DVec3;

/// Even steps of `s`.
pub(super) const CELLS: usize = 96;

/// Of the midpoint rule: azimuths in half a turn, and heights.
const AZIMUTHS: u32 = 48;
const HEIGHTS: u32 = 64;

/// A directional albedo as a function of the cosine with the normal.
#[derive(Clone, Debug)]
pub(super) struct AlbedoCurve {
    alpha: f64,
    /// `L` of the module.
    range: f64,
    /// At the ends of the cells.
    values: Box<[f64]>,
    mean: f64,
}

/// A place on the curve.
#[derive(Clone, Copy, Debug)]
pub(super) struct CurvePlace {
    pub(super) cos: f64,
    /// Derivative of the cosine with respect to `s`.
    pub(super) cos_by_s: f64,
    pub(super) albedo: f64,
}

impl AlbedoCurve {
    /// The albedo of facets that reflect the share `fresnel(cosine with their normal)`.
    pub(super) fn new(ggx: Ggx, fresnel: impl Fn(f64) -> f64) -> Self {
        let alpha = ggx.alpha();
        let range = libm::log1p(1.0 / alpha);
        let mut curve = Self { alpha, range, values: Box::default(), mean: 0.0 };
        let node = |i: usize| directional(ggx, curve.cos_at(i as f64 / CELLS as f64), &fresnel);
        let values = (0..=CELLS).map(node).collect();
        curve.values = values;
        curve.mean = (0..CELLS).map(|cell| curve.integrate(cell, |place| place.albedo)).sum();
        curve
    }

    /// The albedo for light from directions with this cosine.
    pub(super) fn at(&self, cos: f64) -> f64 {
        self.albedo_at(self.s_of(cos))
    }

    /// The mean over diffuse light: the integral of `2 cos E(cos)` over the cosine, of the very
    /// curve that [`Self::at`] gives.
    pub(super) const fn mean(&self) -> f64 {
        self.mean
    }

    /// The place `s` of a cosine.
    pub(super) fn s_of(&self, cos: f64) -> f64 {
        (libm::log1p(cos.max(0.0) / self.alpha) / self.range).min(1.0).sqrt()
    }

    /// Cosine, its derivative by `s`, and albedo at `s`.
    pub(super) fn place(&self, s: f64) -> CurvePlace {
        let grown = self.alpha * libm::exp(self.range * s * s);
        let cos_by_s = 2.0 * self.range * s * grown;
        CurvePlace { cos: self.cos_at(s), cos_by_s, albedo: self.albedo_at(s) }
    }

    /// The part that a cell has of the integral of `2 cos g` over the cosine, by Gauss's rule of
    /// three points.
    pub(super) fn integrate(&self, cell: usize, g: impl Fn(CurvePlace) -> f64) -> f64 {
        let offset = 0.5 * 0.6_f64.sqrt();
        let rule = [(0.5 - offset, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.5 + offset, 5.0 / 18.0)];
        let term = |(way, weight): (f64, f64)| {
            let place = self.place((cell as f64 + way) / CELLS as f64);
            weight * 2.0 * place.cos * place.cos_by_s * g(place)
        };
        rule.map(term).iter().sum::<f64>() / CELLS as f64
    }

    fn cos_at(&self, s: f64) -> f64 {
        (self.alpha * libm::expm1(self.range * s * s)).min(1.0)
    }

    /// Lagrange's cubic through the four nodes around `s`.
    fn albedo_at(&self, s: f64) -> f64 {
        let x = s * CELLS as f64;
        let first = (x as usize).saturating_sub(1).min(CELLS - 3);
        let t = x - first as f64;
        let [a, b, c, d] = [t, t - 1.0, t - 2.0, t - 3.0];
        let v = &self.values[first..first + 4];
        let outer = v[3] * a * b * c - v[0] * b * c * d;
        let inner = v[1] * a * c * d - v[2] * a * b * d;
        (outer / 6.0 + inner / 2.0).clamp(0.0, 1.0)
    }
}

/// The integral of `f cos` over the hemisphere: the mean of the weights of [`sample_reflection`].
///
/// At grazing incidence the weights fall to 0 close to the horizon, at the second coordinate 1:
/// that coordinate is `1 - v^2`, and midpoints in v.
fn directional(ggx: Ggx, cos: f64, fresnel: impl Fn(f64) -> f64) -> f64 {
    let wo = DVec3::new(((1.0 - cos) * (1.0 + cos)).sqrt(), 0.0, cos);
    let mut sum = 0.0;
    for azimuth in 0..AZIMUTHS {
        let u = (f64::from(azimuth) + 0.5) / f64::from(2 * AZIMUTHS);
        for height in 0..HEIGHTS {
            let v = (f64::from(height) + 0.5) / f64::from(HEIGHTS);
            let wi = sample_reflection(ggx, wo, [u, 1.0 - v * v]);
            let weight = ggx.weight(wo, wi);
            if weight > 0.0 {
                sum += 2.0 * v * weight * fresnel(wi.dot((wo + wi).normalize()));
            }
        }
    }
    sum / f64::from(AZIMUTHS * HEIGHTS)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bsdf::fresnel::{fresnel, schlick};

    /// The integral over facet normals instead of sampled rays: `f cos d omega_i = D F G2 (wo m) /
    /// cos_o d omega_m`, with tan = alpha (exp(L v) - 1).
    fn by_normals(alpha: f64, cos: f64, fresnel: impl Fn(f64) -> f64) -> f64 {
        let ggx = Ggx::new(alpha);
        let wo = DVec3::new(((1.0 - cos) * (1.0 + cos)).sqrt(), 0.0, cos);
        let range = libm::log(1.0 + 1e5 / alpha);
        let (rows, columns) = (1500, 400);
        let mut sum = 0.0;
        for row in 0..rows {
            let grown = libm::exp(range * (f64::from(row) + 0.5) / f64::from(rows));
            let tan = alpha * (grown - 1.0);
            let z = 1.0 / (1.0 + tan * tan).sqrt();
            // d omega_m = sin d theta = tan cos^3 d tan.
            let solid = tan * z * z * z * alpha * grown * range;
            for column in 0..columns {
                let azimuth = std::f64::consts::PI * (f64::from(column) + 0.5) / f64::from(columns);
                let (sin, cos) = libm::sincos(azimuth);
                let m = DVec3::new(tan * z * cos, tan * z * sin, z);
                let across = wo.dot(m);
                let wi = m * (2.0 * across) - wo;
                if across > 0.0 && wi.z > 0.0 {
                    sum += ggx.evaluate(wo, wi) * fresnel(across) * wi.z * 4.0 * across * solid;
                }
            }
        }
        sum * std::f64::consts::TAU / f64::from(rows * columns)
    }

    #[test]
    fn the_curve_is_the_integral_between_its_nodes_too() {
        let factors: [fn(f64) -> f64; 3] = [|_| 1.0, schlick, |cos| fresnel(cos, 1.5)];
        let mut worst = 0.0_f64;
        for alpha in [0.0004, 0.01, 0.1, 0.36, 1.0] {
            for factor in factors {
                let curve = AlbedoCurve::new(Ggx::new(alpha), factor);
                for cos in [1e-4, 0.003, 0.02, 0.11, 0.37, 0.81, 1.0] {
                    let (found, wanted) = (curve.at(cos), by_normals(alpha, cos, factor));
                    worst = worst.max((found - wanted).abs());
                }
            }
        }
        assert!(worst < 1e-4, "{worst:e}");
    }

    /// Heitz's closed case: at normal incidence with alpha = 1, `t_o = t_i = 1` for all rays and
    /// the integral is elementary: `1 - log 2`.
    #[test]
    fn the_roughest_surface_has_a_closed_form_at_normal_incidence() {
        let curve = AlbedoCurve::new(Ggx::new(1.0), |_| 1.0);
        assert!((curve.at(1.0) - (1.0 - std::f64::consts::LN_2)).abs() < 5e-5);
    }

    #[test]
    fn the_mean_is_that_of_the_curve() {
        for alpha in [0.0004, 0.1, 1.0] {
            let curve = AlbedoCurve::new(Ggx::new(alpha), schlick);
            // In the square of the cosine, whose density is even in diffuse light.
            let n = 400_000;
            let at = |i: u32| curve.at(((f64::from(i) + 0.5) / f64::from(n)).sqrt());
            let mean = (0..n).map(at).sum::<f64>() / f64::from(n);
            // The root in the argument costs digits at 0.
            assert!((mean - curve.mean()).abs() < 1e-7, "{alpha}: {mean} {}", curve.mean());
        }
    }
}
