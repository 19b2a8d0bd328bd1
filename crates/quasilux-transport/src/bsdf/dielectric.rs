//! Smooth dielectric: the specular BSDF of Fresnel reflection and refraction (Walter et al. 2007,
//! without roughness).
//!
//! The front side of its facets is outside. Light is reflected or refracted by chance with
//! Fresnel's probabilities, and neither way loses any. Along a refracted ray basic radiance `L /
//! eta^2` is kept (Veach 1997, section 5.2): radiance followed from where it is wanted is scaled by
//! `(eta_here / eta_there)^2`, flux is not.

use super::fresnel::Boundary;
use super::{BsdfSample, TransportMode};
use crate::spectrum::Spectrum;
use glam::DVec3;
use quasilux_sampling::Sampler;

/// A smooth boundary between the room and a clear medium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Dielectric {
    /// Index inside over index outside.
    eta: f64,
}

impl Dielectric {
    pub(super) const fn new(eta: f64) -> Self {
        Self { eta }
    }

    pub(super) fn sample<S: Spectrum>(
        self,
        wo: DVec3,
        front: bool,
        mode: TransportMode,
        sampler: &mut Sampler<'_>,
    ) -> BsdfSample<S> {
        let eta = if front { self.eta } else { 1.0 / self.eta };
        let boundary = Boundary::new(wo.z, eta);
        let is_reflected = sampler.choose_bool(boundary.reflectance());
        let wi = if is_reflected {
            DVec3::new(-wo.x, -wo.y, wo.z)
        } else {
            DVec3::new(-wo.x / eta, -wo.y / eta, -boundary.cos_refracted).normalize()
        };
        let scale = match mode {
            TransportMode::Radiance if !is_reflected => self.radiance_scale(front),
            TransportMode::Radiance | TransportMode::Importance => 1.0,
        };
        BsdfSample { wi, weight: S::white() * scale, pdf_sr: None }
    }

    /// The factor on radiance that is followed through it, where it comes to the front or to the
    /// back.
    pub(super) fn radiance_scale(self, front: bool) -> f64 {
        let eta = if front { self.eta } else { 1.0 / self.eta };
        1.0 / (eta * eta)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bsdf::fresnel::fresnel;
    use quasilux_sampling::{PointSet, Randomization, Sequence};

    fn sample(
        eta: f64,
        wo: DVec3,
        front: bool,
        mode: TransportMode,
        index: u64,
    ) -> BsdfSample<f64> {
        let points = PointSet::new(Sequence::Sobol, Randomization::Owen, 1);
        Dielectric::new(eta).sample(wo, front, mode, &mut Sampler::new(&points, index))
    }

    #[test]
    fn shares_are_those_of_fresnel_and_rays_those_of_snell() {
        for (eta, front) in [(1.5, true), (1.5, false), (0.75, true), (2.4, false)] {
            let relative = if front { eta } else { 1.0 / eta };
            for cos in [0.1, 0.5, 0.8, 1.0_f64] {
                let wo = DVec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
                let mut reflected = 0;
                for index in 0..1024 {
                    let BsdfSample { wi, weight, .. } =
                        sample(eta, wo, front, TransportMode::Radiance, index);
                    assert!((wi.length() - 1.0).abs() < 1e-14);
                    if wi.z > 0.0 {
                        reflected += 1;
                        assert_eq!((wi, weight), (DVec3::new(-wo.x, -wo.y, wo.z), 1.0));
                    } else {
                        // Snell's law within the plane of incidence, and basic radiance.
                        assert!((wo.x + relative * wi.x).abs() < 1e-14 && wi.y.abs() < 1e-14);
                        assert!((weight * relative * relative - 1.0).abs() < 1e-14);
                        let flux = sample(eta, wo, front, TransportMode::Importance, index);
                        assert_eq!((flux.wi, flux.weight), (wi, 1.0));
                    }
                }
                // 1024 Sobol' points lie evenly within two.
                let wanted = 1024.0 * fresnel(cos, relative);
                assert!((f64::from(reflected) - wanted).abs() <= 2.0, "{reflected} {wanted}");
            }
        }
    }

    /// `L / eta^2` is kept both ways: the scaled share of a refracted ray is that of its reverse
    /// times `eta^-4`, the squares of both relative indices (Veach 1997, section 5.2).
    #[test]
    fn refraction_is_reciprocal() {
        let scaled_share = |cos: f64, front: bool| {
            let wo = DVec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
            let samples =
                (0..1 << 14).map(|index| sample(1.5, wo, front, TransportMode::Radiance, index));
            let refracted: Vec<_> = samples.filter(|next| next.wi.z < 0.0).collect();
            let sum: f64 = refracted.iter().map(|next| next.weight).sum();
            (sum / f64::from(1 << 14), -refracted[0].wi.z)
        };
        for cos in [0.1, 0.6, 0.9] {
            let (there, cos_behind) = scaled_share(cos, true);
            let (back, cos_again) = scaled_share(cos_behind, false);
            assert!((cos_again - cos).abs() < 1e-14);
            // Shares are counted to a sample or two of 2^14.
            let quotient = there / back * (1.5 * 1.5 * 1.5 * 1.5);
            assert!((quotient - 1.0).abs() < 4e-4, "{quotient}");
        }
    }
}
