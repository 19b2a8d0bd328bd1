//! Direct light of area lights (emitting facets), by light sampling and BSDF sampling with multiple
//! importance sampling.
//!
//! Light that reaches a surface straight from an area light is estimated both by a point on the
//! light, uniform over its area within equal luminance, and by the direction in which the path goes
//! on, which may happen to meet a light; each is weighted by the balance heuristic (Veach 1997,
//! section 9.2.2). Densities are compared in solid angle, sr^-1. Flat panes between change no
//! direction: light through them is estimated in both ways, too.

use crate::spectrum::Spectrum;
use crate::world::World;
use crate::world::vertex::Vertex;
use crate::world::visibility::LightSample;
use glam::DVec3;
use quasilux_sampling::Discrete;
use quasilux_sampling::warp::sample_triangle;
use quasilux_scene::{Light, Scene};
use std::f64::consts::PI;

/// All emitting facets, to be chosen in proportion to luminance times area.
pub(crate) struct Emitters {
    facets: Vec<u32>,
    by_flux: Discrete,
    brightest_cd_m2: f64,
}

/// A point on an emitting facet.
pub(crate) struct EmitterPoint {
    pub(crate) facet: u32,
    pub(crate) position: DVec3,
}

impl Emitters {
    /// `None` where no facet emits.
    pub(crate) fn new<S: Spectrum>(scene: &Scene, world: &World<S>) -> Option<Self> {
        let is_area = |light: &Light| matches!(light, Light::Area(_));
        if !scene.lights.iter().any(is_area) {
            return None;
        }
        let facets: Vec<u32> = (0..world.facets.len() as u32)
            .filter(|&f| world.facets[f as usize].emitted_cd_m2 > 0.0)
            .collect();
        let weights: Vec<f64> = facets
            .iter()
            .map(|&f| &world.facets[f as usize])
            .map(|facet| facet.emitted_cd_m2 * facet.area_m2())
            .collect();
        let luminances = facets.iter().map(|&f| world.facets[f as usize].emitted_cd_m2);
        let brightest_cd_m2 = luminances.fold(0.0, f64::max);
        Some(Self { by_flux: Discrete::new(&weights)?, facets, brightest_cd_m2 })
    }

    /// Their flux in lm: pi times luminance times area.
    pub(crate) fn flux_lm(&self) -> f64 {
        PI * self.by_flux.total()
    }

    /// The illuminance in lx right in front of the brightest: pi times luminance.
    pub(crate) fn largest_lx(&self) -> f64 {
        PI * self.brightest_cd_m2
    }

    /// A point uniform over area within equal luminance; density in m^-2.
    pub(crate) fn sample_point<S: Spectrum>(&self, world: &World<S>, u: [f64; 2]) -> EmitterPoint {
        let choice = self.by_flux.sample(u[0]);
        let facet = self.facets[choice.index];
        let weights = sample_triangle([choice.u_remapped, u[1]]);
        EmitterPoint { facet, position: world.facets[facet as usize].point(weights) }
    }

    /// Density in m^-2 of [`Self::sample_point`] where the luminance is this.
    pub(crate) fn pdf_m2(&self, emitted_cd_m2: f64) -> f64 {
        emitted_cd_m2 / self.by_flux.total()
    }

    /// What one point on the lights gives, weighted against other techniques, `None` from behind
    /// either. Of a direction and of what a steradian of the light's luminance gives along it in
    /// lx, `beside_sr` is the density of these in sr^-1: that of the direction in which the path
    /// goes on.
    pub(crate) fn light_sample<S: Spectrum>(
        &self,
        world: &World<S>,
        vertex: &Vertex<'_, S>,
        u: [f64; 2],
        beside_sr: impl FnOnce(DVec3, f64) -> f64,
    ) -> Option<LightSample<S>> {
        let place = self.sample_point(world, u);
        let facet = &world.facets[place.facet as usize];
        let toward = place.position - vertex.position();
        let distance_m = toward.length();
        let direction = toward / distance_m;
        let cos = vertex.cos(direction);
        let cos_light = -facet.front_normal.dot(direction);
        if cos <= 0.0 || cos_light <= 0.0 {
            return None;
        }
        // L cos / (pdf of the light's point + pdf of the others), the weight multiplied out.
        let pdf_light = self.pdf_sr(facet.emitted_cd_m2, distance_m, cos_light);
        let lx_sr = facet.emitted_cd_m2 * cos;
        let illuminance_lx = lx_sr / (pdf_light + beside_sr(direction, lx_sr));
        let light = vertex.weight(direction) * illuminance_lx;
        let light_sample = LightSample::unless_dark(direction, distance_m, light, illuminance_lx)?;
        Some(LightSample { facet: place.facet, ..light_sample })
    }

    /// Density in sr^-1 with which [`Self::light_sample`] finds a point on a facet of this
    /// luminance: uniform density over equal luminance, in m^-2, turned into solid angle.
    fn pdf_sr(&self, emitted_cd_m2: f64, distance_m: f64, cos_light: f64) -> f64 {
        emitted_cd_m2 / self.by_flux.total() * distance_m * distance_m / cos_light
    }
}
