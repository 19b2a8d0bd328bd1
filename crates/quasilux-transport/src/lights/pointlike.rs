//! Point-like lights seen from a surface: their direct light is computed, not sampled.

use crate::spectrum::Spectrum;
use crate::world::{Vantage, World};
use glam::DVec3;
use quasilux_sampling::choose_weights;
use quasilux_scene::{Light, Scene};

/// The lights without extent: points, and luminaires without a luminous area.
pub(crate) struct PointLikes<'a>(Vec<&'a Light>);

/// What one of them gives to a surface, were nothing in the way.
struct Unshadowed {
    direction: DVec3,
    distance_m: f64,
    illuminance_lx: f64,
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

    /// Their positions in m and fluxes in lm.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (DVec3, f64)> {
        self.0.iter().map(|light| (position(light), light.flux_lm()))
    }

    /// Illuminance in lx from all of them on the side `n` of a surface, every one tested.
    pub(crate) fn all<S: Spectrum>(
        &self,
        world: &World<S>,
        from: Vantage,
        n: DVec3,
        rays: &mut u64,
    ) -> f64 {
        self.0
            .iter()
            .map(|light| unshadowed(light, from.position(), n))
            .filter(|seen| seen.illuminance_lx != 0.0)
            .map(|seen| seen.shadowed(world, from, rays))
            .sum()
    }

    /// An estimate of [`Self::all`] from one light, chosen with `u` in proportion to what it would
    /// give unshadowed: its only variance comes from shadows. `seen` is scratch space.
    pub(crate) fn one<S: Spectrum>(
        &self,
        world: &World<S>,
        from: Vantage,
        n: DVec3,
        u: f64,
        seen: &mut Vec<f64>,
        rays: &mut u64,
    ) -> f64 {
        let give = |light: &Light| unshadowed(light, from.position(), n).illuminance_lx;
        seen.clear();
        seen.extend(self.0.iter().map(|light| give(light)));
        let total: f64 = seen.iter().sum();
        let Some(choice) = choose_weights(u, seen.iter().copied()) else {
            // Nothing shines here, or a distance of zero made a figure that the tally must refuse.
            return if total == 0.0 { 0.0 } else { f64::NAN };
        };
        let light = unshadowed(self.0[choice.index], from.position(), n);
        if light.shadowed(world, from, rays) == 0.0 { 0.0 } else { total }
    }
}

impl Unshadowed {
    /// The illuminance that is left when shadows are counted.
    fn shadowed<S: Spectrum>(&self, world: &World<S>, from: Vantage, rays: &mut u64) -> f64 {
        *rays += 1;
        let visible = world.is_visible(from, self.direction, self.distance_m, u32::MAX);
        if visible { self.illuminance_lx } else { 0.0 }
    }
}

/// E = I cos / d^2 on the side `n` at `position`; 0 from behind.
fn unshadowed(light: &Light, position: DVec3, n: DVec3) -> Unshadowed {
    let toward = self::position(light) - position;
    let distance_m = toward.length();
    let direction = toward / distance_m;
    let cos = n.dot(direction);
    let illuminance_lx = if cos <= 0.0 {
        0.0
    } else {
        let intensity_cd = match light {
            Light::Point(point) => point.intensity_cd,
            Light::Luminaire(luminaire) => luminaire.intensity_cd(-direction),
            Light::Area(_) => unreachable!("area lights are not point-like"),
        };
        intensity_cd * cos / (distance_m * distance_m)
    };
    Unshadowed { direction, distance_m, illuminance_lx }
}

fn position(light: &Light) -> DVec3 {
    match light {
        Light::Point(point) => point.position,
        Light::Luminaire(luminaire) => luminaire.position,
        Light::Area(_) => unreachable!("area lights are not point-like"),
    }
}
