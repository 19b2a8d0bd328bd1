//! Thin dielectric slab: the specular BSDF of a flat pane drawn as a single sheet, which mirrors
//! light or lets it straight through.
//!
//! A clear pane has two boundaries of reflectance r each, and light goes to and fro between them.
//! For each polarisation the series gives `R = 2 r / (1 + r)` reflected and `T = (1 - r) / (1 + r)`
//! let through (Stokes 1862, without absorption); unpolarised light has the mean of both. A stated
//! transmittance scales T at all angles; a measured pane has tables by angle instead, whose sides
//! may reflect differently. As the index is the same before and behind, radiance is not scaled.

use super::BsdfSample;
use super::fresnel::Boundary;
use crate::spectrum::Spectrum;
use glam::DVec3;
use quasilux_sampling::Sampler;
use quasilux_scene::bsdf::{self as scene, AngularTable};

/// A flat pane of no thickness.
#[derive(Clone, Debug)]
pub(crate) enum Pane<S> {
    /// Fresnel's boundaries, with T scaled by `tint`.
    Glass { eta: f64, tint: S },
    /// Tables by angle.
    Measured {
        transmittance: AngularTable,
        front_reflectance: AngularTable,
        back_reflectance: AngularTable,
    },
}

impl<S: Spectrum> Pane<S> {
    pub(super) fn new(pane: &scene::Pane) -> Self {
        match pane {
            scene::Pane::Clear { eta } => Self::Glass { eta: *eta, tint: S::white() },
            scene::Pane::Tinted { eta, transmittance } => {
                let tint =
                    S::from_rgb(*transmittance) * (1.0 / scene::Pane::clear_transmittance(*eta));
                Self::Glass { eta: *eta, tint }
            }
            scene::Pane::Measured { transmittance, front_reflectance, back_reflectance } => {
                Self::Measured {
                    transmittance: transmittance.clone(),
                    front_reflectance: front_reflectance.clone(),
                    back_reflectance: back_reflectance.clone(),
                }
            }
        }
    }

    /// The share of light that goes straight through, at an angle of cosine `cos` to the normal.
    pub(crate) fn pane_transmittance(&self, cos: f64) -> S {
        match self {
            Self::Glass { eta, tint } => *tint * (1.0 - clear_reflectance(cos, *eta)),
            Self::Measured { transmittance, .. } => S::white() * transmittance.at(cos),
        }
    }

    /// The share that is mirrored on the front, or on the back.
    pub(crate) fn pane_reflectance(&self, cos: f64, front: bool) -> S {
        S::white()
            * match self {
                Self::Glass { eta, .. } => clear_reflectance(cos, *eta),
                Self::Measured { front_reflectance, .. } if front => front_reflectance.at(cos),
                Self::Measured { back_reflectance, .. } => back_reflectance.at(cos),
            }
    }

    pub(super) fn albedo(&self, wo: DVec3, front: bool) -> S {
        self.pane_reflectance(wo.z, front) + self.pane_transmittance(wo.z)
    }

    pub(super) fn sample(
        &self,
        wo: DVec3,
        front: bool,
        sampler: &mut Sampler<'_>,
    ) -> Option<BsdfSample<S>> {
        let mirrored = self.pane_reflectance(wo.z, front);
        let straight = self.pane_transmittance(wo.z);
        let sum = mirrored.luminance() + straight.luminance();
        if sum <= 0.0 {
            return None;
        }
        let p_mirrored = mirrored.luminance() / sum;
        let (wi, share, p) = if sampler.choose_bool(p_mirrored) {
            (DVec3::new(-wo.x, -wo.y, wo.z), mirrored, p_mirrored)
        } else {
            (-wo, straight, 1.0 - p_mirrored)
        };
        Some(BsdfSample { wi, weight: share * (1.0 / p), pdf_sr: None })
    }
}

/// Unpolarised light that a clear pane mirrors, all inner reflections included.
fn clear_reflectance(cos: f64, eta: f64) -> f64 {
    let boundary = Boundary::new(cos, eta);
    boundary.across / (1.0 + boundary.across) + boundary.within / (1.0 + boundary.within)
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasilux_sampling::{PointSet, Randomization, Sequence};
    use quasilux_scene::Rgb;
    use quasilux_scene::bsdf::AngularNode;
    use std::f64::consts::FRAC_PI_2;

    /// Light that passes after 0, 2, 4, ... inner reflections, by Fresnel's sines and tangents.
    fn series(theta_rad: f64, eta: f64) -> f64 {
        let refracted = libm::asin(libm::sin(theta_rad) / eta);
        let (less, more) = (theta_rad - refracted, theta_rad + refracted);
        let through = |root: f64| {
            let r = root * root;
            (0..200)
                .fold((0.0, (1.0 - r) * (1.0 - r)), |(sum, term), _| (sum + term, term * r * r))
                .0
        };
        let across = through(libm::sin(less) / libm::sin(more));
        let within = through(libm::tan(less) / libm::tan(more));
        0.5 * (across + within)
    }

    #[test]
    fn a_clear_pane_lets_the_series_through_and_mirrors_the_rest() {
        for eta in [1.3, 1.5, 1.9] {
            let pane = Pane::<f64>::new(&scene::Pane::Clear { eta });
            for theta_rad in [0.01, 0.3, 0.8, 1.2, 1.5] {
                let cos = libm::cos(theta_rad);
                let through = pane.pane_transmittance(cos);
                assert!((through - series(theta_rad, eta)).abs() < 1e-9, "{eta} {theta_rad}");
                assert!((through + pane.pane_reflectance(cos, true) - 1.0).abs() < 1e-14);
            }
            // Stokes at normal incidence.
            let normal = scene::Pane::clear_transmittance(eta);
            assert!((pane.pane_transmittance(1.0) - normal).abs() < 1e-14);
            assert!(pane.pane_transmittance(0.0).abs() < 1e-14);
        }
    }

    #[test]
    fn a_tinted_pane_is_a_clear_one_scaled() {
        let transmittance = Rgb([0.4, 0.6, 0.2]);
        let tinted = Pane::<Rgb>::new(&scene::Pane::Tinted { eta: 1.5, transmittance });
        let clear = Pane::<f64>::new(&scene::Pane::Clear { eta: 1.5 });
        for cos in [1.0, 0.6, 0.1] {
            let scale = clear.pane_transmittance(cos) / clear.pane_transmittance(1.0);
            for channel in 0..3 {
                let found = tinted.pane_transmittance(cos).channel(channel);
                assert!((found - transmittance.0[channel] * scale).abs() < 1e-15);
            }
            for front in [true, false] {
                let mirrored = Rgb::grey(clear.pane_reflectance(cos, front));
                assert_eq!(tinted.pane_reflectance(cos, front), mirrored);
            }
        }
    }

    #[test]
    fn samples_share_light_as_the_tables_say() {
        let table = |weights_of_paths: [f64; 2]| {
            let nodes = [0.0, FRAC_PI_2].into_iter().zip(weights_of_paths);
            let node = |(theta_rad, share)| AngularNode { theta_rad, share };
            AngularTable::new(nodes.map(node).collect()).unwrap()
        };
        let pane = Pane::<f64>::new(&scene::Pane::Measured {
            transmittance: table([0.8, 0.0]),
            front_reflectance: table([0.0, 0.5]),
            back_reflectance: table([0.2, 0.7]),
        });
        let cos = libm::cos(0.5 * FRAC_PI_2);
        let wo = DVec3::new(0.0, (1.0 - cos * cos).sqrt(), cos);
        let points = PointSet::new(Sequence::Sobol, Randomization::Owen, 1);
        for (front, reflected) in [(true, 0.25), (false, 0.45)] {
            let albedo = 0.4 + reflected;
            assert!((pane.albedo(wo, front) - albedo).abs() < 1e-14);
            let mut mirrored = 0;
            for index in 0..1024 {
                let next = pane.sample(wo, front, &mut Sampler::new(&points, index)).unwrap();
                assert!((next.weight - albedo).abs() < 1e-14 && next.pdf_sr.is_none());
                mirrored += u32::from(next.wi.z > 0.0);
                assert!(next.wi == -wo || next.wi == DVec3::new(0.0, -wo.y, wo.z));
            }
            // 1024 Sobol' points lie evenly within two.
            let expected = 1024.0 * reflected / albedo;
            assert!((f64::from(mirrored) - expected).abs() <= 2.0, "{mirrored} not {expected}");
        }
    }
}
