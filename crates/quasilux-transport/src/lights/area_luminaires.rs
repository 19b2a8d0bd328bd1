//! Direct light of luminaires with a luminous area, by sampling points of their shape.
//!
//! The light that the shape S of a luminaire gives to a point x with normal n is `E = integral over
//! S of I(w) p(w, y) (n.-w) / |x - y|^2 dy`, with w from y to x and p(w, y) the part of the
//! intensity I(w) that leaves around y (`quasilux_photometry::LuminousShape`). A place y drawn from
//! the silhouette along w0, from the centre to x, has density p(w0, y), so one place estimates E by
//! `I(w) p(w, y) / p(w0, y) (n.-w) / |x - y|^2`. The ratio is 1 on flat shapes and at most `|x - c|
//! / |x - y| A(w0) / A(w)` on others, A the projected area: near the end of a thin tube it is
//! large. From afar the estimate is that of a point, without noise.
//!
//! The shapes are no surfaces: they cast no shadow, reflect nothing, and no path finds light by
//! running into one.

use crate::lights::coarse_lights::CoarseLights;
use crate::lights::pointlike::{Choice, LightCentre};
use crate::lights::selection::{Asking, ChoiceWork, DEFENSIVE_SHARE, LightChoice, Surroundings};
use crate::spectrum::Spectrum;
use crate::world::World;
use crate::world::vertex::Vertex;
use crate::world::visibility::LightSample;
use glam::DVec3;
use quasilux_photometry::SurfacePoint;
use quasilux_scene::light::Luminaire;
use quasilux_scene::{Light, Scene};
use std::f64::consts::PI;

/// Of many, this many are asked where a path starts: the choice there has most of the noise, and
/// rays that start together cost little.
const AT_SENSOR: u32 = 4;
/// Places along each coordinate from which a shape is probed for surfaces that cut it.
const PROBES: u32 = 4;

/// The luminaires with a luminous area.
pub(crate) struct AreaLuminaires<'a> {
    lights: Vec<AreaLuminaire<'a>>,
    /// Approximations of the same luminaires, by which one is chosen.
    coarse: CoarseLights<'a>,
    choice: LightChoice,
}

/// A luminaire that was chosen, and a place on it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ChosenPlace {
    pub(crate) choice: Choice,
    pub(crate) place: SurfacePoint,
}

/// Incident light from a place on a luminous shape.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlaceIncidence {
    /// Unit direction to the place.
    pub(crate) direction: DVec3,
    pub(crate) distance_m: f64,
    /// Over the density of the place, without the choice of the luminaire.
    pub(crate) illuminance_lx: f64,
}

struct AreaLuminaire<'a> {
    luminaire: &'a Luminaire,
    flux_lm: f64,
    radius_m: f64,
}

impl<'a> AreaLuminaires<'a> {
    /// `bounds` are those of the geometry.
    pub(crate) fn new(scene: &'a Scene, bounds: Option<[DVec3; 2]>) -> Self {
        let luminaires = scene.lights.iter().filter_map(|light| match light {
            Light::Luminaire(luminaire) if luminaire.is_area() => Some(AreaLuminaire {
                luminaire,
                flux_lm: luminaire.flux_lm(),
                radius_m: luminaire.shape.radius_m(),
            }),
            _ => None,
        });
        let lights: Vec<AreaLuminaire<'_>> = luminaires.collect();
        let luminaires = lights.iter().map(|light| light.luminaire);
        let coarse = CoarseLights::with_areas(luminaires);
        let choice = LightChoice::new(lights.len(), bounds);
        Self { lights, coarse, choice }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.lights.is_empty()
    }

    pub(crate) fn get(&self, index: usize) -> Option<&'a Luminaire> {
        self.lights.get(index).map(|light| light.luminaire)
    }

    /// Their centres and fluxes.
    pub(crate) fn iter(&self) -> impl Iterator<Item = LightCentre> {
        self.lights.iter().map(|&AreaLuminaire { luminaire, flux_lm, .. }| LightCentre {
            position: luminaire.position,
            flux_lm,
        })
    }

    /// Whether any of them may light the side `n` of a surface at `position`, were nothing in the
    /// way.
    pub(crate) fn may_light(&self, position: DVec3, n: DVec3) -> bool {
        self.lights.iter().any(|light| light.approx_illuminance_lx(position, Some(n)) != 0.0)
    }

    /// Whether they are many, so that a choice among them takes coordinates of its own.
    pub(crate) fn are_many(&self) -> bool {
        self.choice.dimensions() > 1
    }

    /// How many of them are asked where a path starts.
    pub(crate) fn asked_at_sensor(&self) -> u32 {
        if self.are_many() { AT_SENSOR } else { u32::from(!self.is_empty()) }
    }

    /// An estimate of what all of them give: what one place on one of them offers. `u` leads to the
    /// place; where they are not many its first coordinate chooses the luminaire, too.
    pub(crate) fn light_sample<S: Spectrum>(
        &self,
        vertex: &Vertex<'_, S>,
        u_choice: Option<[f64; 2]>,
        u: [f64; 2],
        work: &mut ChoiceWork,
    ) -> Option<LightSample<S>> {
        let place = Asking::at(vertex);
        let around = |light: usize, around: &Surroundings| self.lights[light].weight_around(around);
        let weigh = |lights: &[usize]| self.coarse.weights(lights, place);
        let chosen = self.choice.choose(place, u_choice.unwrap_or(u), around, weigh, work);
        let Some(chosen) = chosen else {
            return LightSample::without_choice(work.total());
        };
        let u = if u_choice.is_some() { u } else { [chosen.u_remapped, u[1]] };
        let light_sample = self.lights[chosen.light].light_sample(vertex, u)?;
        let light = light_sample.light * (1.0 / chosen.pdf);
        Some(LightSample { light, ..light_sample })
    }

    /// One of them, chosen with a probability that can be told, and a place on it.
    pub(crate) fn choose(
        &self,
        at: Asking,
        u: [f64; 2],
        work: &mut ChoiceWork,
    ) -> Option<ChosenPlace> {
        let around = |light: usize, around: &Surroundings| self.lights[light].weight_around(around);
        let weights =
            self.lights.iter().map(|light| light.approx_illuminance_lx(at.position, at.side));
        let chosen = self.choice.choose_without_candidates(at, u[0], around, weights, work)?;
        let light = &self.lights[chosen.light];
        let towards = light.centre_direction(at.position);
        let place = light.luminaire.shape.sample_silhouette(towards, [chosen.u_remapped, u[1]]);
        let choice = Choice { number: chosen.light, pdf: chosen.pdf };
        Some(ChosenPlace { choice, place })
    }

    /// The probability of the choice of [`Self::choose`].
    pub(crate) fn probability(&self, number: usize, at: Asking) -> f64 {
        let around = |light: usize, around: &Surroundings| self.lights[light].weight_around(around);
        let weights =
            self.lights.iter().map(|light| light.approx_illuminance_lx(at.position, at.side));
        self.choice.probability(number, at, around, weights)
    }

    /// Incident light from a place on one of the luminaires, over the density of its silhouette as
    /// seen from a position; `cos` gives the cosine that illuminance takes.
    pub(crate) fn incidence(
        &self,
        number: usize,
        place: &SurfacePoint,
        position: DVec3,
        cos: impl FnOnce(DVec3) -> f64,
    ) -> Option<PlaceIncidence> {
        let light = &self.lights[number];
        light.incidence(place, position, light.centre_direction(position), cos)
    }

    /// How many have a shape that encloses a volume which surfaces pass through: part of their
    /// light starts behind these.
    pub(crate) fn cut_by_surfaces<S: Spectrum>(&self, world: &World<S>) -> u64 {
        self.lights.iter().filter(|light| is_cut(light.luminaire, world)).count() as u64
    }
}

impl AreaLuminaire<'_> {
    /// About what it gives to the side `n` of a surface unshadowed, in lx: the light of a point,
    /// the distance softened by the shape's extent, and a share for what the shape has beside its
    /// centre. 0 only where all of the shape is behind the surface; with no side nothing is behind.
    fn approx_illuminance_lx(&self, position: DVec3, side: Option<DVec3>) -> f64 {
        let toward = self.luminaire.position - position;
        if side.is_some_and(|n| n.dot(toward) <= -self.radius_m) {
            return 0.0;
        }
        let square_m2 = toward.length_squared() + self.radius_m * self.radius_m;
        let direction = toward.normalize_or_zero();
        let intensity_cd = self.luminaire.intensity_cd(-direction);
        let mean_cd = self.flux_lm / (4.0 * PI);
        let cos = side.map_or(1.0, |n| n.dot(direction).max(0.0));
        (intensity_cd * cos + DEFENSIVE_SHARE * mean_cd) / square_m2
    }

    /// About the illuminance in lx that it gives in some surroundings, unshadowed.
    fn weight_around(&self, around: &Surroundings) -> f64 {
        let mean_cd = self.flux_lm / (4.0 * PI);
        let intensity_cd =
            |direction| self.luminaire.intensity_cd(direction) + DEFENSIVE_SHARE * mean_cd;
        around.lx(self.luminaire.position, self.radius_m, intensity_cd)
    }

    /// From its centre to a position, in its frame.
    fn centre_direction(&self, position: DVec3) -> DVec3 {
        let luminaire_from_world = self.luminaire.world_from_luminaire.transpose();
        let from_centre = luminaire_from_world * (position - self.luminaire.position);
        from_centre.normalize_or(DVec3::NEG_Z)
    }

    /// Of a place drawn from the silhouette along `centre_direction`.
    fn incidence(
        &self,
        place: &SurfacePoint,
        position: DVec3,
        centre_direction: DVec3,
        cos: impl FnOnce(DVec3) -> f64,
    ) -> Option<PlaceIncidence> {
        let Luminaire { shape, world_from_luminaire, .. } = self.luminaire;
        let toward = place_m(self.luminaire, place) - position;
        let distance_m = toward.length();
        let direction = toward / distance_m;
        let cos = cos(direction);
        let share = shape.pdf_silhouette(world_from_luminaire.transpose() * -direction, place);
        let drawn = shape.pdf_silhouette(centre_direction, place);
        if cos <= 0.0 || share <= 0.0 || drawn <= 0.0 {
            return None;
        }
        let intensity_cd = self.luminaire.intensity_cd(-direction);
        let illuminance_lx = intensity_cd * (share / drawn) * cos / (distance_m * distance_m);
        Some(PlaceIncidence { direction, distance_m, illuminance_lx })
    }

    /// One place on the shape, with the estimator at the head of this module.
    fn light_sample<S: Spectrum>(
        &self,
        vertex: &Vertex<'_, S>,
        u: [f64; 2],
    ) -> Option<LightSample<S>> {
        let position = vertex.position();
        let centre_direction = self.centre_direction(position);
        let place = self.luminaire.shape.sample_silhouette(centre_direction, u);
        let cos = |direction| vertex.cos(direction);
        let PlaceIncidence { direction, distance_m, illuminance_lx } =
            self.incidence(&place, position, centre_direction, cos)?;
        let light = vertex.weight(direction) * illuminance_lx;
        LightSample::unless_dark(direction, distance_m, light, illuminance_lx)
    }
}

/// A place of a luminaire's shape in the world, in m.
pub(crate) fn place_m(luminaire: &Luminaire, place: &SurfacePoint) -> DVec3 {
    luminaire.position + luminaire.world_from_luminaire * place.position_m
}

/// Looks through a solid shape between places on opposite sides; flat ones may lie in a surface.
fn is_cut<S: Spectrum>(luminaire: &Luminaire, world: &World<S>) -> bool {
    let shape = luminaire.shape;
    let parts = || (0..PROBES).map(|part| (f64::from(part) + 0.5) / f64::from(PROBES));
    let is_open = |axis: DVec3, u: [f64; 2]| {
        let [low_m, high_m] =
            [-axis, axis].map(|toward| place_m(luminaire, &shape.sample_silhouette(toward, u)));
        let direction = (high_m - low_m).normalize_or(DVec3::Z);
        let from = world.ray_origin_of_light(low_m, direction);
        // As far from the end as from the start.
        let distance_m = (high_m - low_m).length() - 2.0 * (from.position() - low_m).length();
        distance_m <= 0.0 || world.is_visible(from, direction, distance_m, u32::MAX)
    };
    shape.is_solid()
        && DVec3::AXES.iter().any(|&axis| parts().any(|u| parts().any(|v| !is_open(axis, [u, v]))))
}
