//! Emitting facets of which a place asks one point: the facet is chosen by about what it gives to
//! the place, the point evenly over what is seen of it (`seen_triangle`), so that light of a panel
//! nearby has no noise but that of shadows.

use super::coarse_facets::CoarseFacets;
use super::seen_triangle::SeenTriangle;
use super::selection::{
    Asking, ChoiceWork, ChosenLight, DEFENSIVE_SHARE, LightChoice, MIN_MANY, Surroundings,
};
use crate::spectrum::Spectrum;
use crate::world::{Facet, World};
use glam::DVec3;
use quasilux_sampling::warp::sample_triangle;
use quasilux_sampling::{Discrete, DiscreteSample};

/// Some emitting facets.
pub(super) struct FacetGroup {
    /// In ascending order.
    facets: Vec<u32>,
    /// By luminance times area.
    by_flux: Discrete,
    /// By what they give to a place; without it by flux.
    choice: Option<LightChoice>,
    /// Where all are weighed.
    coarse: Option<CoarseFacets>,
}

/// A place on an emitting facet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EmitterPlace {
    pub(crate) facet: u32,
    pub(crate) position: DVec3,
}

/// Place on an emitting facet, with the density in m^-2 that it was drawn with.
pub(super) struct DrawnPlace {
    pub(super) drawn: EmitterPlace,
    pub(super) pdf_m2: f64,
}

impl FacetGroup {
    /// `None` where nothing shines. Places that ask lie within `bounds`; where they lie anywhere,
    /// many facets are chosen by flux.
    pub(super) fn new<S: Spectrum>(
        world: &World<S>,
        facets: impl Iterator<Item = u32>,
        bounds: Option<[DVec3; 2]>,
    ) -> Option<Self> {
        let flux = |facet: u32| {
            let facet = &world.facets[facet as usize];
            facet.emitted_cd_m2 * facet.area_m2()
        };
        let facets: Vec<u32> = facets.filter(|facet| flux(*facet) > 0.0).collect();
        let fluxes: Vec<f64> = facets.iter().map(|facet| flux(*facet)).collect();
        let is_table_possible = facets.len() < MIN_MANY || bounds.is_some();
        let choice = is_table_possible.then(|| LightChoice::new(facets.len(), bounds));
        let all = facets.iter().map(|facet| &world.facets[*facet as usize]);
        let weighs_all = choice.as_ref().is_some_and(|choice| !choice.has_tables());
        let coarse = weighs_all.then(|| CoarseFacets::new(all, world.bounds()));
        Some(Self { by_flux: Discrete::new(&fluxes)?, choice, coarse, facets })
    }

    /// In ascending order.
    pub(super) fn facets(&self) -> &[u32] {
        &self.facets
    }

    /// Their luminance times area, in cd.
    pub(super) fn intensity_cd(&self) -> f64 {
        self.by_flux.total()
    }

    /// Uniform over area within equal luminance.
    pub(super) fn sample_by_flux<S: Spectrum>(
        &self,
        world: &World<S>,
        u: [f64; 2],
    ) -> EmitterPlace {
        let choice = self.by_flux.sample(u[0]);
        let facet = self.facets[choice.index];
        let weights = sample_triangle([choice.u_remapped, u[1]]);
        EmitterPlace { facet, position: world.facets[facet as usize].point(weights) }
    }

    /// A point of which a place asks; `None` where nothing of them is before it.
    pub(super) fn sample_point<S: Spectrum>(
        &self,
        world: &World<S>,
        place: Asking,
        u: [f64; 2],
        work: &mut ChoiceWork,
    ) -> Option<DrawnPlace> {
        let chosen = match &self.choice {
            Some(choice) => choice.choose_without_candidates(
                place,
                u[0],
                |light, around| self.weight_around(world, light, around),
                self.weights(place),
                work,
            )?,
            None => {
                let DiscreteSample { index: light, pdf, u_remapped } = self.by_flux.sample(u[0]);
                ChosenLight { light, pdf, u_remapped }
            }
        };
        let facet = self.facets[chosen.light];
        if place.own == Some(facet) {
            return None;
        }
        let seen = seen(&world.facets[facet as usize], place)?;
        let position = seen.sample_point([chosen.u_remapped, u[1]]);
        let pdf_m2 = chosen.pdf * seen.pdf_m2(position);
        Some(DrawnPlace { drawn: EmitterPlace { facet, position }, pdf_m2 })
    }

    /// Density in m^-2 of [`Self::sample_point`].
    pub(super) fn pdf_m2<S: Spectrum>(
        &self,
        world: &World<S>,
        place: Asking,
        asked: EmitterPlace,
    ) -> f64 {
        let Ok(light) = self.facets.binary_search(&asked.facet) else { return 0.0 };
        if place.own == Some(asked.facet) {
            return 0.0;
        }
        let seen = seen(&world.facets[asked.facet as usize], place);
        let Some(seen) = seen else { return 0.0 };
        let probability = match &self.choice {
            Some(choice) => choice.probability(
                light,
                place,
                |light, around| self.weight_around(world, light, around),
                self.weights(place),
            ),
            None => self.by_flux.pdf(light),
        };
        probability * seen.pdf_m2(asked.position)
    }

    /// About what each gives to a place.
    fn weights(&self, place: Asking) -> impl Iterator<Item = f64> {
        let all = self.coarse.iter().flat_map(move |coarse| coarse.weights(place));
        let others = move |(facet, weight)| if place.own == Some(facet) { 0.0 } else { weight };
        self.facets.iter().copied().zip(all).map(others)
    }

    /// About what a facet gives in some surroundings, in lx.
    fn weight_around<S: Spectrum>(
        &self,
        world: &World<S>,
        light: usize,
        around: &Surroundings,
    ) -> f64 {
        let facet = &world.facets[self.facets[light] as usize];
        let [a, b, c] = facet.corners();
        let centre = (a + b + c) / 3.0;
        let radii_m = [a, b, c].map(|corner| (corner - centre).length());
        let normal_cd = facet.emitted_cd_m2 * facet.area_m2();
        // A quarter of it is the mean over all directions.
        let intensity_cd = |direction: DVec3| {
            normal_cd * (facet.front_normal.dot(direction).max(0.0) + 0.25 * DEFENSIVE_SHARE)
        };
        around.lx(centre, radii_m.into_iter().fold(0.0, f64::max), intensity_cd)
    }
}

fn seen(facet: &Facet, place: Asking) -> Option<SeenTriangle> {
    SeenTriangle::new(facet.corners(), facet.front_normal, place.position)
}
