//! Multiple scattering between microfacets: the lobe with density `(1 - E(cos)) cos / (pi (1 - mean
//! E))` (Kulla and Conty 2017).
//!
//! On smooth metal only grazing light is scattered several times, and it leaves at grazing angles:
//! a cosine lobe would seldom go there. The density is taken as constant in `s` within each cell of
//! the [`AlbedoCurve`], so that inversion is a search in 96 sums.

use super::albedo_curve::{AlbedoCurve, CELLS};
use glam::DVec3;
use quasilux_sampling::Discrete;
use std::f64::consts::TAU;

/// Directions of multiply scattered light.
#[derive(Clone, Debug)]
pub(super) struct MultipleScattering {
    cells: Discrete,
}

impl MultipleScattering {
    pub(super) fn new(curve: &AlbedoCurve) -> Self {
        let multiple_scattering = |cell| curve.integrate(cell, |place| 1.0 - place.albedo).max(0.0);
        let weights: Vec<f64> = (0..CELLS).map(multiple_scattering).collect();
        let cells = Discrete::new(&weights).expect("rough surfaces catch light at low angles");
        Self { cells }
    }
}

/// A direction above the surface, density in solid angle.
pub(super) fn sample_multiple_scattering(
    multiple_scattering: &MultipleScattering,
    curve: &AlbedoCurve,
    u: [f64; 2],
) -> DVec3 {
    let choice = multiple_scattering.cells.sample(u[0]);
    let cos = curve.place((choice.index as f64 + choice.u_remapped) / CELLS as f64).cos;
    let radius = ((1.0 - cos) * (1.0 + cos)).sqrt();
    let (sin, cos_azimuth) = libm::sincos(TAU * u[1]);
    DVec3::new(radius * cos_azimuth, radius * sin, cos)
}

/// Density of [`sample_multiple_scattering`] with respect to solid angle (sr^-1).
pub(super) fn pdf_multiple_scattering(
    multiple_scattering: &MultipleScattering,
    curve: &AlbedoCurve,
    wi: DVec3,
) -> f64 {
    if wi.z <= 0.0 {
        return 0.0;
    }
    let s = curve.s_of(wi.z);
    let cell = ((s * CELLS as f64) as usize).min(CELLS - 1);
    multiple_scattering.cells.pdf(cell) * CELLS as f64 / (TAU * curve.place(s).cos_by_s)
}

/// The coordinates that [`sample_multiple_scattering`] maps to `wi`.
#[cfg_attr(not(test), expect(dead_code, reason = "the third function of a distribution"))]
pub(super) fn invert_multiple_scattering(
    multiple_scattering: &MultipleScattering,
    curve: &AlbedoCurve,
    wi: DVec3,
) -> [f64; 2] {
    let x = curve.s_of(wi.z) * CELLS as f64;
    let cell = (x as usize).min(CELLS - 1);
    let turn = libm::atan2(wi.y, wi.x) / TAU;
    [multiple_scattering.cells.invert(cell, x - cell as f64), turn - turn.floor()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bsdf::ggx::Ggx;
    use quasilux_stats::sphere_jacobian;

    #[test]
    fn the_density_belongs_to_the_map_and_the_map_can_be_undone() {
        for alpha in [0.0004, 0.05, 0.36, 1.0] {
            let curve = AlbedoCurve::new(Ggx::new(alpha), |_| 1.0);
            let multiple_scattering = MultipleScattering::new(&curve);
            for u in [[0.01, 0.2], [0.13, 0.8], [0.4, 0.31], [0.77, 0.6], [0.95, 0.05]] {
                let wi = sample_multiple_scattering(&multiple_scattering, &curve, u);
                let map =
                    |u| sample_multiple_scattering(&multiple_scattering, &curve, u).to_array();
                let product = pdf_multiple_scattering(&multiple_scattering, &curve, wi)
                    * sphere_jacobian(map, u, 1e-6);
                assert!((product - 1.0).abs() < 1e-4, "{alpha} {u:?}: {product}");
                let [a, b] = invert_multiple_scattering(&multiple_scattering, &curve, wi);
                assert!(
                    (a - u[0]).abs() < 1e-9 && (b - u[1]).abs() < 1e-12,
                    "{alpha} {u:?}: {a} {b}"
                );
            }
        }
    }
}
