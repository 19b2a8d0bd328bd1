//! Direct light of point-like lights, computed without sampling or from one light chosen by its
//! unshadowed illuminance.

use crate::spectrum::Spectrum;
use crate::world::World;
use crate::world::vertex::Vertex;
use crate::world::visibility::{LightSample, Receiver, ShadowQueue};
use glam::DVec3;
use quasilux_sampling::choose_weights;
use quasilux_scene::{Light, Scene};

/// The lights without extent: points, and luminaires without a luminous area.
pub(crate) struct PointLikes<'a>(Vec<&'a Light>);

/// The centre of a light.
#[derive(Clone, Copy)]
pub(crate) struct LightCentre {
    pub(crate) position: DVec3,
    pub(crate) flux_lm: f64,
}

impl<'a> PointLikes<'a> {
    pub(crate) fn new(scene: &'a Scene) -> Self {
        let is_pointlike = |light: &&Light| match light {
            Light::Point(_) => true,
            Light::Luminaire(luminaire) => !luminaire.is_area(),
            Light::Area(_) => false,
        };
        Self(scene.lights.iter().filter(is_pointlike).collect())
    }

    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(crate) fn get(&self, index: usize) -> Option<&'a Light> {
        self.0.get(index).copied()
    }

    /// Their positions and fluxes.
    pub(crate) fn iter(&self) -> impl Iterator<Item = LightCentre> {
        let centre =
            |light: &&Light| LightCentre { position: position(light), flux_lm: light.flux_lm() };
        self.0.iter().map(centre)
    }

    /// Luminous intensity in cd of the light `index` toward a unit direction.
    pub(crate) fn intensity_cd(&self, index: u32, direction: DVec3) -> f64 {
        intensity_cd(self.0[index as usize], direction)
    }

    /// Light of each that is not behind the side `n` of a place, or of all where both sides count,
    /// if nothing stands in the way.
    pub(crate) fn unshadowed(
        &self,
        place: DVec3,
        n: DVec3,
        takes_both_sides: bool,
    ) -> impl Iterator<Item = Incidence> {
        let sides = [Some(n), takes_both_sides.then_some(-n)].into_iter().flatten();
        sides.flat_map(move |n| {
            self.0.iter().filter_map(move |light| Incidence::new(light, place, n))
        })
    }

    /// What all of them give, every one tested: tells `receive` who gets how much. One light comes
    /// after the other, so that rays toward the same light are neighbours.
    pub(crate) fn all<S: Spectrum>(
        &self,
        world: &World<S>,
        receivers: &[Receiver<'_, S>],
        shadows: &mut ShadowQueue<S>,
        mut receive: impl FnMut(u32, S, u32),
    ) {
        for light in &self.0 {
            for Receiver { who, vertex } in receivers {
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
        let incidence = Incidence::with_cosine(self.0[index], place, cos);
        incidence.map_or(0.0, |incidence| incidence.illuminance_lx)
    }

    /// What one of them gives to a place if nothing stands in the way.
    pub(crate) fn light_sample_of<S: Spectrum>(
        &self,
        index: usize,
        vertex: &Vertex<'_, S>,
    ) -> Option<LightSample<S>> {
        light_sample(self.0[index], vertex)
    }

    /// An estimate of what all of them give from one light, chosen with `u` in proportion to what
    /// it would give unshadowed, but for a [`defensive`] share. `light_samples` is working space.
    pub(crate) fn light_sample<S: Spectrum>(
        &self,
        vertex: &Vertex<'_, S>,
        u: f64,
        light_samples: &mut Vec<LightSample<S>>,
    ) -> Option<LightSample<S>> {
        light_samples.clear();
        light_samples.extend(self.0.iter().filter_map(|light| light_sample(light, vertex)));
        let weights = light_samples.iter().map(|light_sample| light_sample.light.luminance());
        let total: f64 = weights.clone().sum();
        let Some(choice) = choose_weights(u, defensive(weights, total)) else {
            return LightSample::without_choice(total);
        };
        let chosen = light_samples[choice.index];
        Some(LightSample { light: chosen.light * (1.0 / choice.pdf), ..chosen })
    }
}

/// Share of choices among lights that trusts no weight. A bright lamp behind a wall would else take
/// all of them from a weak one that is seen.
const DEFENSIVE_SHARE: f64 = 0.1;

/// Weights of this sum, each with its part of the defensive share: no light that gives anything is
/// chosen with less than `DEFENSIVE_SHARE / n` of n.
pub(super) fn defensive(
    weights: impl Iterator<Item = f64> + Clone,
    total: f64,
) -> impl Iterator<Item = f64> + Clone {
    let count = weights.clone().filter(|weight| *weight > 0.0).count().max(1);
    let each = DEFENSIVE_SHARE * total / count as f64;
    let more = move |weight: f64| {
        if weight > 0.0 { (1.0 - DEFENSIVE_SHARE) * weight + each } else { weight }
    };
    weights.map(more)
}

/// Light of a point-like light at a place, unless something stands in the way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Incidence {
    /// Unit direction to the light.
    pub(crate) direction: DVec3,
    pub(crate) distance_m: f64,
    pub(crate) illuminance_lx: f64,
    /// What a candela would give.
    pub(crate) lx_per_cd: f64,
}

impl Incidence {
    /// E = I cos / d^2 on the side `n`; `None` from behind.
    pub(crate) fn new(light: &Light, place: DVec3, n: DVec3) -> Option<Self> {
        let incidence = Self::with_cosine(light, place, |direction| n.dot(direction));
        // A light right at the place has no direction.
        incidence.filter(|incidence| incidence.lx_per_cd > 0.0)
    }

    /// The same where `cos` gives the cosine that illuminance takes, of a unit direction.
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
