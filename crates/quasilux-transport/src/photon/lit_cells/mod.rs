//! Photon emission from directly lit surfaces in place of point-like lights (Voloboy, Dmitriev and
//! Kopylov 2003): the first shot.
//!
//! The direct light of lights without extent needs no sampling: it can be computed anywhere. So the
//! first flight of their photons is left out, and lit surfaces take the place of the lights, `L* =
//! Le - Lep + I Lep` (Voloboy, Dmitriev and Kopylov 2003, after Kopylov 2002). A secondary photon
//! chooses a pair of cell and light with the flux that goes on there, absorption folded in, by one
//! table; its place in the cell follows the linear density of
//! [`warp::sample_linear_triangle`](sample_linear_triangle). No photon is spent on being absorbed
//! where it first lands.
//!
//! Deviation: the piecewise linear picture only says where to look. At the place that was drawn the
//! illuminance is computed, shadow ray included, and the photon carries `E(x) albedo / (density of
//! x)`: the picture's error changes weights and causes no bias, as long as its density is above 0
//! wherever light may land. Part of the photons therefore go by what would land if nothing stood in
//! the way. And a pair says which way the light came, so the scattering function is sampled as it
//! stands: mirrors, glass and rough surfaces need nothing stored and no photons of their own.
//!
//! Lights with an area emit as ever, in proportion to their flux.
//!
//! Read on at `lit` for the picture, at [`crate::photon::first_shot`] for when it is used.

mod lit;
#[cfg(test)]
mod tests;

use crate::codec::Writer;
use crate::context::Context;
use crate::lights::{Incidence, Lights};
use crate::photon::receiver::Arrival;
use crate::purpose::Purpose;
use crate::spectrum::Spectrum;
use crate::world::Interaction;
use crate::world::subdivision::SubTriangle;
use lit::{Beam, LitCell, LitFacet};
use quasilux_bvh::RayQuery;
use quasilux_sampling::warp::sample_linear_triangle;
use quasilux_sampling::{Discrete, Sampler};
use rayon::prelude::*;

/// More pairs of a facet and a light that faces it than this are not looked at: photons leave the
/// lights instead.
const MAX_PAIRS: usize = 1 << 21;
/// Rays that a pair takes at least.
const LOOKS: u64 = 6;
/// Share of the photons that go where light would land if nothing stood in the way.
const UNSEEN: f64 = 0.1;

/// Where secondary photons come from.
pub(crate) struct LitCells {
    cells: Vec<DrawnCell>,
    /// Over the cells, and past them the lights with an area.
    by_flux: Discrete,
    /// Number among all lights of the first with an area.
    first_area_light: usize,
    flux_share: f64,
    /// Rays that it took to make this.
    pub(crate) rays: u64,
}

/// A cell with a density for places in it.
#[derive(Clone, Copy)]
struct DrawnCell {
    cell: SubTriangle,
    facet: u32,
    light: u32,
    front: bool,
    /// Flux that goes on at its corners, in lm/m^2.
    density: [f64; 3],
}

/// Start that was drawn for a photon.
pub(crate) enum Drawn {
    /// A lit place, if light reaches it.
    Place(LitPlace),
    /// A light with an area, and what is left to draw a direction by; the photon stands for this
    /// share of the usual flux.
    Light { number: usize, u: [f64; 2], flux_share: f64 },
}

/// A place where light of a point-like light arrives unless something stands in the way.
#[derive(Clone, Copy)]
pub(crate) struct LitPlace {
    pub(crate) at: Interaction,
    /// Number of the light.
    pub(crate) light: u32,
    pub(crate) incidence: Incidence,
    /// Flux that arrives there over that of a photon of all lights, before absorption.
    pub(crate) flux_share: f64,
}

impl LitPlace {
    /// The ray that finds out whether light comes here.
    pub(crate) fn shadow_ray<S: Spectrum>(&self, context: &Context<'_, S>) -> RayQuery {
        let Incidence { direction, distance_m, .. } = self.incidence;
        context.world.ray_origin(&self.at).shadow_ray(direction, distance_m, RayQuery::NONE)
    }

    /// The light that comes here.
    pub(crate) fn arrival(&self) -> Arrival<'_> {
        let direction = -self.incidence.direction;
        Arrival { direction, found: Some(&self.at), bounces: 0, is_drawn: true }
    }

    /// Whether it does.
    pub(crate) fn is_lit<S: Spectrum>(&self, context: &Context<'_, S>) -> bool {
        let Incidence { direction, distance_m, .. } = self.incidence;
        let from = context.world.ray_origin(&self.at);
        context.world.is_visible(from, direction, distance_m, RayQuery::NONE)
    }
}

impl LitCells {
    /// Looks where the light lands; `None` where no point-like light's goes on, where first looks
    /// alone would take more rays than these, and for more than [`MAX_PAIRS`].
    pub(crate) fn new<S: Spectrum>(context: &Context<'_, S>, max_rays: u64) -> Option<Self> {
        let beams = Beam::all(context);
        let facets = 0..context.world.facets.len() as u32;
        let facing = |beam: &Beam<'_, '_, S>| {
            facets.clone().filter(|&facet| beam.faces(facet).is_some()).count()
        };
        let pairs = beams.iter().map(facing).sum::<usize>();
        if pairs > MAX_PAIRS || pairs as u64 * LOOKS > max_rays {
            return None;
        }
        let (mut lit, mut rays) = (Vec::new(), 0);
        for beam in &beams {
            let of_facets: Vec<LitFacet> =
                facets.clone().into_par_iter().map(|facet| beam.lit_cells_of(facet)).collect();
            for of_facet in of_facets {
                lit.extend(of_facet.cells);
                rays += of_facet.rays;
            }
        }
        Self::from_picture(&lit, &context.lights, rays)
    }

    fn from_picture(lit: &[LitCell], lights: &Lights<'_>, rays: u64) -> Option<Self> {
        let sum_lm = |values: fn(&LitCell) -> [f64; 3]| -> f64 {
            lit.iter().map(|cell| integral_lm(cell.area_m2, values(cell))).sum()
        };
        let (seen_lm, open_lm) = (sum_lm(|cell| cell.seen), sum_lm(|cell| cell.open));
        // Where nothing is seen at all, go by what may be.
        let unseen = if seen_lm > 0.0 { (UNSEEN * seen_lm / open_lm).min(1.0) } else { 1.0 };
        let cells: Vec<DrawnCell> = lit
            .iter()
            .map(|&LitCell { cell, facet, light, front, seen, open, .. }| {
                let density = std::array::from_fn(|i| seen[i] + unseen * open[i]);
                DrawnCell { cell, facet, light, front, density }
            })
            .collect();
        let first_area_light = lights.pointlikes.len();
        let of_cells = lit.iter().zip(&cells);
        let fluxes: Vec<f64> = of_cells
            .map(|(lit, drawn)| integral_lm(lit.area_m2, drawn.density))
            .chain((first_area_light..lights.len()).map(|number| lights.flux_of_lm(number)))
            .collect();
        if seen_lm + open_lm <= 0.0 {
            return None;
        }
        let by_flux = Discrete::new(&fluxes)?;
        let flux_share = by_flux.total() / lights.flux_lm;
        Some(Self { cells, by_flux, first_area_light, flux_share, rays })
    }

    /// Puts them among the decisions.
    pub(crate) fn put(&self, out: &mut Writer) {
        for DrawnCell { cell: _, facet, light, front, density } in &self.cells {
            out.value(facet);
            out.value(light);
            out.value(front);
            density.iter().for_each(|lm_m2| out.value(lm_m2));
        }
        out.value(&self.flux_share);
    }

    /// Flux that a photon stands for, as a share of that of one photon of all lights, before its
    /// place changes it.
    pub(crate) fn flux_share(&self) -> f64 {
        self.flux_share
    }

    /// Where the photon of a sampler starts; its first coordinate chooses, what is left of it and
    /// the next give the place. `None` where no light can arrive.
    pub(crate) fn draw<S: Spectrum>(
        &self,
        context: &Context<'_, S>,
        sampler: &mut Sampler<'_>,
    ) -> Option<Drawn> {
        let (choice, u) = context.draw(sampler, Purpose::Emission, |sampler| {
            (sampler.choose_leading(&self.by_flux), [sampler.remapped_1d(), sampler.next_1d()])
        });
        let Some(drawn) = self.cells.get(choice.index) else {
            let number = self.first_area_light + choice.index - self.cells.len();
            return Some(Drawn::Light { number, u, flux_share: self.flux_share });
        };
        let weights = sample_linear_triangle(drawn.density, u);
        let density_lm_m2: f64 = drawn.density.iter().zip(weights).map(|(d, w)| d * w).sum();
        let at = context.world.interaction_on(drawn.facet, drawn.front, drawn.cell.point(weights));
        let light = context.lights.pointlikes.get(drawn.light as usize)?;
        let incidence = Incidence::new(light, context.world.ray_origin(&at).position(), at.n)?;
        // E over the density of the place (m^-2), which is density_lm_m2 over the sum of all
        // fluxes.
        let flux_share = incidence.illuminance_lx / density_lm_m2 * self.flux_share;
        // What is not finite or negative goes on to where it is counted as invalid.
        let arrives = incidence.illuminance_lx != 0.0 && flux_share != 0.0;
        arrives.then_some(Drawn::Place(LitPlace { at, light: drawn.light, incidence, flux_share }))
    }
}

/// The integral of a linear function over a triangle.
fn integral_lm(area_m2: f64, corners_lm_m2: [f64; 3]) -> f64 {
    area_m2 * corners_lm_m2.iter().sum::<f64>() / 3.0
}
