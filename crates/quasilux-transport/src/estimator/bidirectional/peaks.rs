//! How much surfaces send into one direction at most.
//!
//! On the way between a surface and a place stands a scattering function f with the cosine of that
//! way. For facets with the GGX distribution of width alpha, and t as in `bsdf::ggx`, `f cos_i = D
//! cos_i / (2 (t_o cos_i + t_i cos_o))` times Fresnel's factor. The normal halfway between both
//! directions is the least tilted, and Fresnel's factor the largest, where they lie in one plane
//! with the normal of the surface, so that one angle is left to be searched. All of it together is
//! `1 / (2 pi alpha^3)` at most, which light near the horizon comes to.

use crate::bsdf::{Bsdf, TransportMode};
use crate::spectrum::Spectrum;
use glam::DVec3;
use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, TAU};

/// Directions that are looked at where no formula is known, in height and around.
const HEIGHTS: u32 = 24;
const AZIMUTHS: u32 = 24;
/// Factor on the largest value among them, for what may lie between.
const MARGIN: f64 = 1.3;
/// Cosines for which peaks of facets are known, each by this factor below the one before.
const COSINES: u32 = 56;
const COSINE_STEP: f64 = 0.840_896_415_253_714_6;
/// Other directions that are looked at for each: this many a width of the facets, so far to both
/// sides, and evenly over all.
const BY_WIDTH: i32 = 8;
const WIDTHS: i32 = 12;
const EVENLY: i32 = 64;
/// Factor on the largest value among these, for what may lie between.
const FINE_MARGIN: f64 = 1.1;

/// Largest values of a scattering function f over pairs of directions.
#[derive(Clone, Debug)]
pub(super) struct Peak {
    /// In sr^-1: of Lambertian surfaces f. Else f times the cosine of one of the directions, where
    /// that is no less than the power of [`COSINE_STEP`] with the number of the entry; the last
    /// holds for all.
    values_sr: Vec<f64>,
    pub(super) is_lambertian: bool,
}

impl Peak {
    /// Of a Lambertian surface with this f.
    pub(super) fn lambertian(value_sr: f64) -> Self {
        Self { values_sr: vec![value_sr], is_lambertian: true }
    }

    /// Nothing, of surfaces that scatter into finitely many directions.
    pub(super) fn new<S: Spectrum>(bsdf: &Bsdf<S>) -> Self {
        match (bsdf, bsdf.facet_alpha()) {
            (Bsdf::Mirror(_) | Bsdf::Dielectric(_) | Bsdf::Pane(_), _) => Self::lambertian(0.0),
            (Bsdf::Diffuse(_) | Bsdf::Translucent(_), _) => {
                let up = DVec3::Z;
                let sides = [up, -up]
                    .map(|wi| bsdf.evaluate(up, wi, true, TransportMode::Importance).max_channel());
                Self::lambertian(sides[0].max(sides[1]))
            }
            (_, Some(alpha)) => Self::of_facets(bsdf, alpha),
            (_, None) => Self::looked_up(bsdf),
        }
    }

    /// Of all pairs of directions, in sr^-1.
    pub(super) fn largest_sr(&self) -> f64 {
        self.values_sr.last().copied().unwrap_or_default()
    }

    /// Of pairs of which one has this cosine at least, in sr^-1.
    pub(super) fn largest_above_sr(&self, least_cos: f64) -> f64 {
        let number = (libm::log(least_cos.clamp(0.0, 1.0)) / libm::log(COSINE_STEP)).ceil();
        let last = self.values_sr.len() - 1;
        self.values_sr[if number < last as f64 { number as usize } else { last }]
    }

    fn of_facets<S: Spectrum>(bsdf: &Bsdf<S>, alpha: f64) -> Self {
        let mut largest_sr = 0.0_f64;
        let mut values_sr: Vec<f64> = Vec::new();
        for number in 0..COSINES {
            let theta = libm::acos(libm::pow(COSINE_STEP, f64::from(number)));
            let near = (-BY_WIDTH * WIDTHS..=BY_WIDTH * WIDTHS)
                .map(|it| alpha / f64::from(BY_WIDTH) * f64::from(it));
            let near = near.map(|aside| theta + aside);
            let all = (0..EVENLY).map(|it| FRAC_PI_2 * f64::from(it) / f64::from(EVENLY));
            let low = (0..20).map(|it| FRAC_PI_2 - alpha * libm::exp2(-f64::from(it)));
            let wi = in_plane(theta);
            let sent_sr = |theta: f64| {
                let wo = in_plane(-theta);
                let value = bsdf.evaluate(wo, wi, true, TransportMode::Importance);
                if wo.z > 0.0 { value.max_channel() * wi.z } else { 0.0 }
            };
            let here_sr = near.chain(all).chain(low).map(sent_sr).fold(0.0, f64::max);
            largest_sr = largest_sr.max(FINE_MARGIN * here_sr);
            values_sr.push(largest_sr);
        }
        // Nearer to the horizon.
        let limit_sr = FRAC_1_PI / (2.0 * alpha * alpha * alpha);
        values_sr.push(largest_sr.max(FINE_MARGIN * limit_sr));
        Self { values_sr, is_lambertian: false }
    }

    fn looked_up<S: Spectrum>(bsdf: &Bsdf<S>) -> Self {
        let height = |number: u32| {
            let theta = FRAC_PI_2 * (f64::from(number) + 0.02) / f64::from(HEIGHTS);
            libm::sincos(theta)
        };
        let mut largest_sr = FRAC_1_PI;
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
                    let cos = wi.z.abs().max(wo.z);
                    largest_sr = largest_sr.max(MARGIN * value.max_channel() * cos);
                }
            }
        }
        Self { values_sr: vec![largest_sr], is_lambertian: false }
    }
}

/// At an angle from the normal, to one side or the other.
fn in_plane(theta: f64) -> DVec3 {
    let (sin, cos) = libm::sincos(theta);
    DVec3::new(sin, 0.0, cos)
}
