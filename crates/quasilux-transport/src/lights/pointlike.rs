//! Direct light of point-like lights, computed without sampling or from one light chosen by its
//! unshadowed illuminance.

use crate::lights::coarse_lights::CoarseLights;
use crate::lights::selection::{Asking, ChoiceWork, DEFENSIVE_SHARE, LightChoice, Surroundings};
use crate::spectrum::Spectrum;
use crate::world::World;
use crate::world::vertex::Vertex;
use crate::world::visibility::{LightRequest, LightSample, ShadowQueue};
use glam::DVec3;
use quasilux_scene::{Light, Scene};
use std::f64::consts::PI;

/// The lights without extent: points, and luminaires without a luminous area.
pub(crate) struct PointLikes<'a> {
    lights: Vec<&'a Light>,
    /// Approximations of the same lights, by which one is chosen.
    coarse: CoarseLights<'a>,
    choice: LightChoice,
}

/// A light that was chosen.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Choice {
    /// Among those of its kind.
    pub(crate) number: usize,
    /// Probability of the choice.
    pub(crate) pdf: f64,
}

/// The centre of a light.
#[derive(Clone, Copy)]
pub(crate) struct LightCentre {
    pub(crate) position: DVec3,
    pub(crate) flux_lm: f64,
}

impl<'a> PointLikes<'a> {
    /// `bounds` are those of the geometry.
    pub(crate) fn new(scene: &'a Scene, bounds: Option<[DVec3; 2]>) -> Self {
        let is_pointlike = |light: &&Light| match light {
            Light::Point(_) => true,
            Light::Luminaire(luminaire) => !luminaire.is_area(),
            Light::Area(_) => false,
        };
        let lights: Vec<&Light> = scene.lights.iter().filter(is_pointlike).collect();
        let coarse = CoarseLights::points(&lights);
        let choice = LightChoice::new(lights.len(), bounds);
        Self { lights, coarse, choice }
    }

    pub(crate) fn len(&self) -> usize {
        self.lights.len()
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.lights.is_empty()
    }

    pub(crate) fn get(&self, index: usize) -> Option<&'a Light> {
        self.lights.get(index).copied()
    }

    /// Their positions and fluxes.
    pub(crate) fn iter(&self) -> impl Iterator<Item = LightCentre> {
        let centre =
            |light: &&Light| LightCentre { position: position(light), flux_lm: light.flux_lm() };
        self.lights.iter().map(centre)
    }

    /// Luminous intensity in cd of the light `index` toward a unit direction.
    pub(crate) fn intensity_cd(&self, index: u32, direction: DVec3) -> f64 {
        intensity_cd(self.lights[index as usize], direction)
    }

    /// Tests all lights for all receivers, and tells `receive` who gets how much light. One light
    /// comes after the other, so that rays toward the same light are neighbours.
    pub(crate) fn all<S: Spectrum>(
        &self,
        world: &World<S>,
        receivers: &[LightRequest<'_, S>],
        shadows: &mut ShadowQueue<S>,
        mut receive: impl FnMut(u32, S, u32),
    ) {
        for light in &self.lights {
            for LightRequest { who, vertex } in receivers {
                if let Some(light_sample) = light_sample(light, vertex) {
                    shadows.ask(*who, vertex, &light_sample);
                }
            }
            shadows.answer(world, &mut receive);
        }
    }

    /// The illuminance in lx by one of them on the side `n` of a place, or on both, as if nothing
    /// stood in the way.
    pub(crate) fn illuminance_lx(
        &self,
        index: usize,
        place: DVec3,
        n: DVec3,
        takes_both_sides: bool,
    ) -> f64 {
        let cos = |direction: DVec3| {
            let cos = n.dot(direction);
            if takes_both_sides { cos.abs() } else { cos }
        };
        let incidence = Incidence::with_cosine(self.lights[index], place, cos);
        incidence.map_or(0.0, |incidence| incidence.illuminance_lx)
    }

    /// Light from one of them to a place if nothing stands in the way.
    pub(crate) fn light_sample_of<S: Spectrum>(
        &self,
        index: usize,
        vertex: &Vertex<'_, S>,
    ) -> Option<LightSample<S>> {
        light_sample(self.lights[index], vertex)
    }

    /// Coordinates of the choice among them.
    pub(crate) fn dimensions_of_choice(&self) -> u32 {
        self.choice.dimensions()
    }

    /// One of them, chosen with a probability that can be told: of few in proportion to what each
    /// gives unshadowed, of many by a table.
    pub(crate) fn choose(&self, place: Asking, u: f64, work: &mut ChoiceWork) -> Option<Choice> {
        if self.lights.len() == 1 {
            return Some(Choice { number: 0, pdf: 1.0 });
        }
        let around =
            |light: usize, around: &Surroundings| weight_around(self.lights[light], around);
        let chosen =
            self.choice.choose_without_candidates(place, u, around, self.weights(place), work)?;
        Some(Choice { number: chosen.light, pdf: chosen.pdf })
    }

    /// The probability of [`Self::choose`].
    pub(crate) fn probability(&self, number: usize, place: Asking) -> f64 {
        if self.lights.len() == 1 {
            return 1.0;
        }
        let around =
            |light: usize, around: &Surroundings| weight_around(self.lights[light], around);
        self.choice.probability(number, place, around, self.weights(place))
    }

    /// Unshadowed illuminance in lx that each gives to a place, without the cosine where light
    /// counts from both sides.
    fn weights(&self, place: Asking) -> impl Iterator<Item = f64> {
        let Asking { position, side, .. } = place;
        let lx = move |number| {
            self.illuminance_lx(number, position, side.unwrap_or(DVec3::Z), side.is_none())
        };
        // Where light counts from both sides, no cosine is known.
        let intensity = move |number: usize| {
            let toward = self::position(self.lights[number]) - position;
            let square_m2 = toward.length_squared();
            intensity_cd(self.lights[number], -toward / square_m2.sqrt()) / square_m2
        };
        (0..self.lights.len())
            .map(move |number| if side.is_some() { lx(number) } else { intensity(number) })
    }

    /// Whether so many that a table chooses.
    pub(crate) fn are_many(&self) -> bool {
        self.choice.has_tables()
    }

    /// An estimate of what all of them give from one light, chosen with `u` by about what it would
    /// give unshadowed.
    pub(crate) fn light_sample<S: Spectrum>(
        &self,
        vertex: &Vertex<'_, S>,
        u: [f64; 2],
        work: &mut ChoiceWork,
    ) -> Option<LightSample<S>> {
        if let [only] = self.lights[..] {
            return light_sample(only, vertex);
        }
        let place = Asking::at(vertex);
        let weigh = |lights: &[usize]| {
            let mut weights = self.coarse.weights(lights, place);
            if !vertex.is_plain() {
                for (weight, light) in weights.iter_mut().zip(lights) {
                    let toward = position(self.lights[*light]) - place.position;
                    *weight *= vertex.weight(toward.normalize_or_zero()).luminance();
                }
            }
            weights
        };
        let around =
            |light: usize, around: &Surroundings| weight_around(self.lights[light], around);
        let Some(chosen) = self.choice.choose(place, u, around, weigh, work) else {
            return LightSample::without_choice(work.total());
        };
        let light_sample = light_sample(self.lights[chosen.light], vertex)?;
        Some(LightSample { light: light_sample.light * (1.0 / chosen.pdf), ..light_sample })
    }
}

/// About what a light gives in some surroundings, in lx.
fn weight_around(light: &Light, around: &Surroundings) -> f64 {
    let mean_cd = light.flux_lm() / (4.0 * PI);
    let intensity_cd = |direction| intensity_cd(light, direction) + DEFENSIVE_SHARE * mean_cd;
    around.lx(position(light), 0.0, intensity_cd)
}

/// Light of a point-like light at a place, unless something stands in the way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Incidence {
    /// Unit direction to the light.
    pub(crate) direction: DVec3,
    pub(crate) distance_m: f64,
    pub(crate) illuminance_lx: f64,
    /// Illuminance in lx for each candela.
    pub(crate) lx_per_cd: f64,
}

impl Incidence {
    /// E = I cos / d^2 on the side `n`; `None` from behind.
    pub(crate) fn new(light: &Light, place: DVec3, n: DVec3) -> Option<Self> {
        let incidence = Self::with_cosine(light, place, |direction| n.dot(direction));
        // A light right at the place has no direction.
        incidence.filter(|incidence| incidence.lx_per_cd > 0.0)
    }

    /// E = I cos / d^2 where `cos` gives the cosine that illuminance takes, of a unit direction.
    fn with_cosine(light: &Light, place: DVec3, cos: impl FnOnce(DVec3) -> f64) -> Option<Self> {
        let toward = self::position(light) - place;
        let distance_m = toward.length();
        let direction = toward / distance_m;
        let cos = cos(direction);
        if cos <= 0.0 {
            return None;
        }
        let square_m2 = distance_m * distance_m;
        let illuminance_lx = intensity_cd(light, -direction) * cos / square_m2;
        Some(Self { direction, distance_m, illuminance_lx, lx_per_cd: cos / square_m2 })
    }
}

fn light_sample<S: Spectrum>(light: &Light, vertex: &Vertex<'_, S>) -> Option<LightSample<S>> {
    let cos = |direction| vertex.cos(direction);
    let Incidence { direction, distance_m, illuminance_lx, .. } =
        Incidence::with_cosine(light, vertex.position(), cos)?;
    let light = vertex.weight(direction) * illuminance_lx;
    LightSample::unless_dark(direction, distance_m, light, illuminance_lx)
}

/// Luminous intensity in cd along a unit direction.
fn intensity_cd(light: &Light, direction: DVec3) -> f64 {
    match light {
        Light::Point(point) => point.intensity_cd,
        Light::Luminaire(luminaire) => luminaire.intensity_cd(direction),
        Light::Area(_) => unreachable!("area lights are not point-like"),
    }
}

fn position(light: &Light) -> DVec3 {
    match light {
        Light::Point(point) => point.position,
        Light::Luminaire(luminaire) => luminaire.position,
        Light::Area(_) => unreachable!("area lights are not point-like"),
    }
}
