//! Single reflection by rough surfaces: the GGX distribution of facet normals with Smith's
//! height-correlated masking.
//!
//! With `m = normalize(wo + wi)`, `D` the density of normals (Walter et al. 2007, equation 33) and
//! `t(w) = sqrt(alpha^2 sin^2 + cos^2)`, Smith's `G2 = 1 / (1 + Lambda(wo) + Lambda(wi))` (Heitz
//! 2014, equation 99) becomes `2 cos_o cos_i / (t_o cos_i + t_i cos_o)`, and a mirror-like facet
//! gives `f = D G2 / (4 cos_o cos_i) = D / (2 (t_o cos_i + t_i cos_o))`, without a cosine to divide
//! by.
//!
//! Directions are sampled by visible normals (Heitz 2018): in the space where the distribution is a
//! hemisphere, the reflected ray is uniform on a spherical cap (Dupuy and Benyoub 2023), whose
//! lower edge is raised to where reflected rays can still be above the surface (Eto and Tokuyoshi
//! 2023).

use glam::DVec3;
use std::f64::consts::{FRAC_1_PI, PI, TAU};

/// A distribution of facet normals, alike in all azimuths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ggx {
    alpha: f64,
}

/// The cap that reflected rays are drawn from, as seen from one direction.
struct Cap {
    /// The direction, where the distribution is a hemisphere.
    wo: DVec3,
    /// The lowest z, negated.
    depth: f64,
    /// `(k cos_o + t_o)`: the density of rays is `D / (2 reach)`.
    reach: f64,
}

impl Ggx {
    /// The distribution whose slopes have the width `alpha` in (0, 1].
    pub(super) const fn new(alpha: f64) -> Self {
        Self { alpha }
    }

    pub(super) const fn alpha(self) -> f64 {
        self.alpha
    }

    /// Reflection by facets that reflect all, in sr^-1.
    pub(super) fn evaluate(self, wo: DVec3, wi: DVec3) -> f64 {
        if wi.z <= 0.0 {
            return 0.0;
        }
        let shared = self.stretch(wo) * wi.z + self.stretch(wi) * wo.z;
        self.normals((wo + wi).normalize()) / (2.0 * shared)
    }

    /// Value of `f cos / pdf` for [`sample_reflection`], computed without division by small
    /// numbers.
    pub(super) fn weight(self, wo: DVec3, wi: DVec3) -> f64 {
        let shared = self.stretch(wo) * wi.z + self.stretch(wi) * wo.z;
        if wi.z > 0.0 { wi.z * self.cap(wo).reach / shared } else { 0.0 }
    }

    /// Facet area with normals about `m`, for each unit of solid angle and surface, in sr^-1.
    fn normals(self, m: DVec3) -> f64 {
        let [x, y] = [m.x / self.alpha, m.y / self.alpha];
        let squared = x * x + y * y + m.z * m.z;
        FRAC_1_PI / (self.alpha * self.alpha * squared * squared)
    }

    /// `t` of the module: twice the visible area of the facets, less the surface's own.
    fn stretch(self, w: DVec3) -> f64 {
        let [x, y] = [w.x * self.alpha, w.y * self.alpha];
        (x * x + y * y + w.z * w.z).sqrt()
    }

    fn cap(self, wo: DVec3) -> Cap {
        let t = self.stretch(wo);
        let standard = DVec3::new(wo.x * self.alpha, wo.y * self.alpha, wo.z) / t;
        let s = 1.0 + (wo.x * wo.x + wo.y * wo.y).sqrt();
        let (a2, s2) = (self.alpha * self.alpha, s * s);
        let k = (1.0 - a2) * s2 / (s2 + a2 * wo.z * wo.z);
        Cap { wo: standard, depth: k * standard.z, reach: k * wo.z + t }
    }
}

/// A direction that facets reflect the light from `wo` into, density in solid angle; below the
/// surface where the light would need a second reflection.
pub(super) fn sample_reflection(ggx: Ggx, wo: DVec3, u: [f64; 2]) -> DVec3 {
    let cap = ggx.cap(wo);
    let z = (1.0 - u[1]) * (1.0 + cap.depth) - cap.depth;
    let radius = ((1.0 - z) * (1.0 + z)).max(0.0).sqrt();
    let (sin, cos) = libm::sincos(TAU * u[0]);
    let m = cap.wo + DVec3::new(radius * cos, radius * sin, z);
    let m = DVec3::new(m.x * ggx.alpha, m.y * ggx.alpha, m.z).normalize();
    m * (2.0 * wo.dot(m)) - wo
}

/// Density of [`sample_reflection`] with respect to solid angle (sr^-1), above the surface.
pub(super) fn pdf_reflection(ggx: Ggx, wo: DVec3, wi: DVec3) -> f64 {
    if wi.z <= 0.0 {
        return 0.0;
    }
    ggx.normals((wo + wi).normalize()) / (2.0 * ggx.cap(wo).reach)
}

/// The coordinates that [`sample_reflection`] maps to `wi`.
#[cfg_attr(not(test), expect(dead_code, reason = "the third function of a distribution"))]
pub(super) fn invert_reflection(ggx: Ggx, wo: DVec3, wi: DVec3) -> [f64; 2] {
    let cap = ggx.cap(wo);
    let m = wo + wi;
    let m = DVec3::new(m.x, m.y, m.z * ggx.alpha).normalize();
    let standard = m * (2.0 * cap.wo.dot(m)) - cap.wo;
    let azimuth = libm::atan2(standard.y, standard.x) / (2.0 * PI);
    let height = (standard.z + cap.depth) / (1.0 + cap.depth);
    [azimuth - azimuth.floor(), (1.0 - height).clamp(0.0, 1.0)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasilux_stats::sphere_jacobian;

    fn directions() -> impl Iterator<Item = DVec3> {
        [0.001, 0.05, 0.3, 0.7, 0.999, 1.0].into_iter().flat_map(|z: f64| {
            [0.0, 1.0, 4.0].map(|azimuth| {
                let (sin, cos) = libm::sincos(azimuth);
                let r = (1.0 - z * z).sqrt();
                DVec3::new(r * cos, r * sin, z)
            })
        })
    }

    const ALPHAS: [f64; 5] = [0.001, 0.04, 0.25, 0.6, 1.0];

    #[test]
    fn the_density_belongs_to_the_map_and_the_map_can_be_undone() {
        for alpha in ALPHAS {
            let ggx = Ggx::new(alpha);
            for wo in directions() {
                for u in [[0.1, 0.2], [0.4, 0.7], [0.8, 0.05], [0.55, 0.95]] {
                    let wi = sample_reflection(ggx, wo, u);
                    if wi.z <= 0.0 {
                        continue;
                    }
                    let map = |u| sample_reflection(ggx, wo, u).to_array();
                    let product = pdf_reflection(ggx, wo, wi) * sphere_jacobian(map, u, 1e-5);
                    assert!((product - 1.0).abs() < 1e-5, "{alpha} {wo} {u:?}: {product}");
                    let [a, b] = invert_reflection(ggx, wo, wi);
                    let error = (a - u[0]).abs().max((b - u[1]).abs());
                    assert!(error < 1e-9, "{alpha} {wo} {u:?}: {a} {b}");
                }
            }
        }
    }

    #[test]
    fn the_weight_is_the_quotient() {
        for alpha in ALPHAS {
            let ggx = Ggx::new(alpha);
            for (wo, wi) in directions().zip(directions().skip(5)) {
                let quotient = ggx.evaluate(wo, wi) * wi.z / pdf_reflection(ggx, wo, wi);
                let weight = ggx.weight(wo, wi);
                assert!((quotient / weight - 1.0).abs() < 1e-12, "{alpha}: {quotient} {weight}");
                // Twice the raised cap at most.
                assert!(weight <= 2.0);
            }
        }
    }

    /// The projected area of the normals is that of the surface: the integral of D cos is 1.
    #[test]
    fn normals_cover_the_surface_once() {
        for alpha in [0.04, 0.25, 1.0] {
            let ggx = Ggx::new(alpha);
            // With tan = alpha v / (1 - v), v in [0, 1]: smooth.
            let n = 2000;
            let sum: f64 = (0..n)
                .map(|i| {
                    let v = (f64::from(i) + 0.5) / f64::from(n);
                    let tan = alpha * v / (1.0 - v);
                    let cos = 1.0 / (1.0 + tan * tan).sqrt();
                    let m = DVec3::new(tan * cos, 0.0, cos);
                    // d omega = sin d theta = tan cos^3 d tan.
                    let by_v = tan * cos * cos * cos * alpha / ((1.0 - v) * (1.0 - v));
                    TAU * ggx.normals(m) * cos * by_v
                })
                .sum();
            assert!((sum / f64::from(n) - 1.0).abs() < 1e-6, "{alpha}: {sum}");
        }
    }
}
