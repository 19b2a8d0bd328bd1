//! Direct light of area lights (emitting facets), by light sampling and BSDF sampling with multiple
//! importance sampling.
//!
//! Light that reaches a surface straight from an area light is estimated both by a point on the
//! light and by the direction in which the path goes on, which may happen to meet a light; each is
//! weighted by the power heuristic (Veach 1997, section 9.2.3), or by the balance heuristic where
//! light subpaths are weighed beside them. Points have little noise but that of shadows, so that
//! the more they are trusted, the better: half the variance of the balance heuristic was measured.
//! Densities are compared in solid angle, sr^-1. Flat panes between change no direction: light
//! through them is estimated in both ways, too.

use crate::lights::facet_group::{DrawnPlace, EmitterPlace, FacetGroup};
use crate::lights::selection::{Asking, ChoiceWork};
use crate::spectrum::Spectrum;
use crate::world::World;
use crate::world::vertex::Vertex;
use crate::world::visibility::LightSample;
use glam::DVec3;
use quasilux_scene::{Light, Scene};
use std::f64::consts::PI;

/// All emitting facets.
pub(crate) struct Emitters {
    group: FacetGroup,
    brightest_cd_m2: f64,
}

/// A point on an emitting facet, as a place that asks for it sees it.
pub(crate) struct EmitterPoint {
    /// Unit direction to it.
    pub(crate) direction: DVec3,
    /// Luminance times cosine, in lx/sr: illuminance for each steradian of light of its luminance,
    /// were all of it to arrive.
    pub(crate) lx_sr: f64,
    /// Density with which it was drawn.
    pub(crate) pdf_sr: f64,
    /// The part of the photons from it that mirrors between keep.
    pub(crate) kept: f64,
}

impl Emitters {
    /// `None` where no facet emits.
    pub(crate) fn new<S: Spectrum>(scene: &Scene, world: &World<S>) -> Option<Self> {
        let is_area = |light: &Light| matches!(light, Light::Area(_));
        if !scene.lights.iter().any(is_area) {
            return None;
        }
        let group = FacetGroup::new(world, 0..world.facets.len() as u32, world.bounds())?;
        let facets = group.facets().iter().map(|facet| &world.facets[*facet as usize]);
        let brightest_cd_m2 = facets.map(|facet| facet.emitted_cd_m2).fold(0.0, f64::max);
        Some(Self { group, brightest_cd_m2 })
    }

    /// Their flux in lm: pi times luminance times area.
    pub(crate) fn flux_lm(&self) -> f64 {
        PI * self.group.intensity_cd()
    }

    /// The illuminance in lx right in front of the brightest: pi times luminance.
    pub(crate) fn largest_lx(&self) -> f64 {
        PI * self.brightest_cd_m2
    }

    /// A point from which a photon leaves: uniform over area within equal luminance.
    pub(crate) fn sample_point<S: Spectrum>(&self, world: &World<S>, u: [f64; 2]) -> EmitterPlace {
        self.group.sample_by_flux(world, u)
    }

    /// Direct light from one point on the lights, weighted against other techniques, `None` from
    /// behind either. The weight is that of its density over this and `beside_sr` together.
    pub(crate) fn light_sample<S: Spectrum>(
        &self,
        world: &World<S>,
        vertex: &Vertex<'_, S>,
        u: [f64; 2],
        beside_sr: impl FnOnce(&EmitterPoint) -> f64,
        work: &mut ChoiceWork,
    ) -> Option<LightSample<S>> {
        let place = Asking::at(vertex);
        let drawn = self.group.sample_point(world, place, u, work)?;
        let DrawnPlace { drawn: EmitterPlace { facet: number, position: point }, pdf_m2 } = drawn;
        let facet = &world.facets[number as usize];
        let toward = point - place.position;
        let distance_m = toward.length();
        let direction = toward / distance_m;
        let cos = vertex.cos(direction);
        let cos_light = -facet.front_normal.dot(direction);
        if cos <= 0.0 || cos_light <= 0.0 {
            return None;
        }
        // L cos / (pdf of the light's point + pdf of the others), the weight multiplied out.
        let pdf_sr = pdf_m2 * distance_m * distance_m / cos_light;
        let lx_sr = facet.emitted_cd_m2 * cos;
        let illuminance_lx =
            lx_sr / (pdf_sr + beside_sr(&EmitterPoint { direction, lx_sr, pdf_sr, kept: 1.0 }));
        let light = vertex.weight(direction) * illuminance_lx;
        let light_sample = LightSample::unless_dark(direction, distance_m, light, illuminance_lx)?;
        Some(LightSample { facet: number, ..light_sample })
    }

    /// Density in m^-2 with which [`Self::light_sample`] finds a place on them from another.
    pub(crate) fn pdf_m2<S: Spectrum>(
        &self,
        world: &World<S>,
        place: Asking,
        asked: EmitterPlace,
    ) -> f64 {
        self.group.pdf_m2(world, place, asked)
    }
}
