//! How much surfaces send into one direction at most.

use crate::bsdf::{Bsdf, TransportMode};
use crate::spectrum::Spectrum;
use glam::DVec3;
use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, TAU};

/// Directions that are looked at where no formula is known, in height and around.
const HEIGHTS: u32 = 24;
const AZIMUTHS: u32 = 24;
/// What may lie between them.
const MARGIN: f64 = 1.3;

/// Largest values of a scattering function f over pairs of directions.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Peak {
    /// Of f, in sr^-1.
    pub(super) value_sr: f64,
    /// Of f times the cosine of one of the directions; for Lambertian surfaces, where that cosine
    /// is known of each place, f alone.
    pub(super) with_cosine_sr: f64,
    pub(super) is_lambertian: bool,
}

impl Peak {
    /// Nothing, of surfaces that scatter into finitely many directions.
    pub(super) fn new<S: Spectrum>(bsdf: &Bsdf<S>) -> Self {
        match bsdf {
            Bsdf::Mirror(_) | Bsdf::Dielectric(_) | Bsdf::Pane(_) => Self::default(),
            Bsdf::Diffuse(_) | Bsdf::Translucent(_) => {
                let up = DVec3::Z;
                let sides = [up, -up]
                    .map(|wi| bsdf.evaluate(up, wi, true, TransportMode::Importance).max_channel());
                let value_sr = sides[0].max(sides[1]);
                Self { value_sr, with_cosine_sr: value_sr, is_lambertian: true }
            }
            Bsdf::Conductor(_) | Bsdf::Plastic(_) | Bsdf::Measured(_) => Self::looked_up(bsdf),
        }
    }

    fn looked_up<S: Spectrum>(bsdf: &Bsdf<S>) -> Self {
        let height = |number: u32| {
            let theta = FRAC_PI_2 * (f64::from(number) + 0.02) / f64::from(HEIGHTS);
            libm::sincos(theta)
        };
        let mut peak = Self { value_sr: 0.0, with_cosine_sr: FRAC_1_PI, is_lambertian: false };
        for out in 0..HEIGHTS {
            let (sin, cos) = height(out);
            let wo = DVec3::new(sin, 0.0, cos);
            let special = [DVec3::new(-sin, 0.0, cos), -wo, DVec3::Z];
            let all = (0..HEIGHTS * AZIMUTHS).flat_map(|number| {
                let (sin, cos) = height(number / AZIMUTHS);
                let azimuth = TAU * f64::from(number % AZIMUTHS) / f64::from(AZIMUTHS);
                let (y, x) = libm::sincos(azimuth);
                [cos, -cos].map(|z| DVec3::new(sin * x, sin * y, z))
            });
            for wi in all.chain(special) {
                for front in [true, false] {
                    let value = bsdf.evaluate(wo, wi, front, TransportMode::Importance);
                    let value_sr = MARGIN * value.max_channel();
                    peak.value_sr = peak.value_sr.max(value_sr);
                    let cos = wi.z.abs().max(wo.z);
                    peak.with_cosine_sr = peak.with_cosine_sr.max(value_sr * cos);
                }
            }
        }
        peak
    }
}
