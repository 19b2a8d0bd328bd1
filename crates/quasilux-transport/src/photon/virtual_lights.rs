//! Virtual point lights of pictures (Keller, "Instant Radiosity", SIGGRAPH 1997): where photons
//! land on diffuse surfaces, a small light stands for what these send on.
//!
//! A place x with the normal n gets from a landing of the flux phi on a surface of reflectance r
//!
//! ```text
//! E = phi r / pi * v * min(g, max),     g = cos_x cos_y / d^2
//! ```
//!
//! where v says whether they see each other. `max` bounds what one light may give; paths that leave
//! x take the rest with the weight max(0, 1 - max / g) of their first hit (Kollig and Keller, Monte
//! Carlo and Quasi-Monte Carlo Methods 2004), so nothing is lost.
//!
//! A block of pixels takes some of the lights (`choice`), and its places sum over those (`sum`).

mod selection;
mod sum;

pub(crate) use sum::{AskedLight, MAX_PROBES, Receiving, Sums};

use crate::bsdf::TransportMode;
use crate::context::{Context, Stream};
use crate::photon::counts::PhotonCounts;
use crate::photon::receiver::{PhotonReceiver, SeenPhoton};
use crate::photon::trace::{Lead, Source, trace_photon};
use crate::spectrum::Spectrum;
use crate::world::Interaction;
use glam::DVec3;
use quasilux_sampling::Sampler;
use std::f64::consts::{FRAC_1_PI, PI};
use std::ops::Range;

/// One virtual light gives no more than this share of all of them would, were they spread evenly
/// over the surfaces.
const MAX_SHARE: f64 = 0.3;
/// Normals of one surface differ by no more than this cosine says.
const MIN_COS: f64 = 0.95;
/// Places of one surface lie no further from its plane than this share of their distance.
const MAX_SLOPE: f64 = 0.1;
/// Cells of space along each axis, as a power of two, in the order of the lights.
const CELL_BITS: u32 = 10;

/// The lights that photons of one replicate leave behind.
pub(crate) struct VirtualLights<S> {
    lights: Vec<VirtualLight<S>>,
    /// The bound on g, in m^-2.
    max_per_m2: f64,
    /// Past this distance nothing is left to paths, where they find nothing but diffuse surfaces.
    pub(crate) reach_m: Option<f64>,
}

/// What all surfaces have in common.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Surfaces {
    area_m2: f64,
    /// Whether paths meet nothing but diffuse surfaces that do not emit, and no light past them.
    only_diffuse: bool,
}

/// A landing of a photon.
#[derive(Clone, Copy, Debug)]
struct VirtualLight<S> {
    position: DVec3,
    n: DVec3,
    facet: u32,
    /// Flux that the surface sends on, over pi, in lm.
    sent_on: S,
    /// The luminance of that.
    weight: f64,
    /// Reflections of the light behind it, its own too.
    bounces: u32,
}

/// A place on one side of a surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Site {
    pub(crate) position: DVec3,
    pub(crate) n: DVec3,
}

/// The way to a light.
pub(crate) struct ShadowSegment {
    /// Unit direction.
    pub(crate) direction: DVec3,
    pub(crate) distance_m: f64,
    /// The facet that the light lies on.
    pub(crate) facet: u32,
}

impl Surfaces {
    pub(crate) fn new<S: Spectrum>(context: &Context<'_, S>) -> Self {
        let world = &context.world;
        let is_diffuse = |facet| world.bsdf_of(facet).keeps_illuminance();
        Self {
            area_m2: world.facets.iter().map(|facet| facet.area_m2()).sum(),
            only_diffuse: !context.lights.can_be_met() && world.facets.iter().all(is_diffuse),
        }
    }
}

impl Site {
    pub(crate) fn new(at: &Interaction) -> Self {
        Self { position: at.position, n: at.n }
    }

    /// Whether both may lie on the same surface.
    pub(crate) fn goes_with(&self, other: &Self) -> bool {
        let way = other.position - self.position;
        let off_m = self.n.dot(way).abs().max(other.n.dot(way).abs());
        self.n.dot(other.n) > MIN_COS && off_m <= MAX_SLOPE * way.length()
    }
}

impl<S: Spectrum> VirtualLights<S> {
    /// Traces the photons of some indices, one after the other.
    pub(crate) fn trace(
        context: &Context<'_, S>,
        surfaces: Surfaces,
        replicate: u32,
        indices: Range<u64>,
        counts: &mut PhotonCounts,
    ) -> Self {
        let points = context.points(replicate, Stream::PictureLights);
        let photon_lm = context.lights.flux_lm / (indices.end - indices.start) as f64;
        let mut landings = Landings { context, photon_lm, lights: Vec::new() };
        let lead = Lead::by_chance(Source::Lights, None);
        for index in indices {
            trace_photon(context, lead, Sampler::new(&points, index), &mut landings, counts);
        }
        let mut lights = landings.lights;
        let bounds = context.world.bounds().unwrap_or_default();
        lights.sort_by_cached_key(|light| light.order(bounds));
        let max_per_m2 = MAX_SHARE * PI * lights.len() as f64 / surfaces.area_m2;
        let reach_m = surfaces.only_diffuse.then(|| (1.0 / max_per_m2).sqrt());
        Self { lights, max_per_m2, reach_m }
    }

    pub(crate) fn len(&self) -> usize {
        self.lights.len()
    }

    /// The way to a light, if it and a site face each other.
    pub(crate) fn way(&self, number: usize, site: &Site) -> Option<ShadowSegment> {
        let light = &self.lights[number];
        let to_light = light.position - site.position;
        let faces = site.n.dot(to_light) > 0.0 && light.n.dot(to_light) < 0.0;
        faces.then(|| light.way(site))
    }

    /// min(g, max).
    #[inline]
    fn bounded(&self, light: &VirtualLight<S>, site: &Site) -> f64 {
        let to_light = light.position - site.position;
        let square_m2 = to_light.length_squared();
        let cosines = site.n.dot(to_light).max(0.0) * (-light.n.dot(to_light)).max(0.0);
        // A light right at the site gives nothing.
        (cosines / (square_m2 * square_m2).max(f64::MIN_POSITIVE)).min(self.max_per_m2)
    }

    /// The weight of what a path finds at its next surface that comes from a diffuse one with the
    /// density `pdf_sr`, and meets another at this cosine and distance.
    pub(crate) fn left_to_paths(&self, pdf_sr: f64, cos_there: f64, distance_m: f64) -> f64 {
        let g = PI * pdf_sr * cos_there / (distance_m * distance_m);
        if g > self.max_per_m2 { 1.0 - self.max_per_m2 / g } else { 0.0 }
    }
}

impl<S> VirtualLight<S> {
    fn way(&self, site: &Site) -> ShadowSegment {
        let to_light = self.position - site.position;
        let distance_m = to_light.length();
        ShadowSegment { direction: to_light / distance_m, distance_m, facet: self.facet }
    }

    /// Neighbours that face one way follow each other: along a curve through cells of space (Morton
    /// 1966), one for each side of a cube.
    fn order(&self, [low, high]: [DVec3; 2]) -> u64 {
        let axes = self.n.abs().to_array();
        let axis = (1..3).fold(0, |most, axis| if axes[axis] > axes[most] { axis } else { most });
        let side = 2 * axis as u64 + u64::from(self.n[axis] < 0.0);
        let share = (self.position - low) / (high - low).max(DVec3::splat(f64::MIN_POSITIVE));
        let cells = f64::from(1_u32 << CELL_BITS);
        let cell = share.to_array().map(|x| (x * cells).clamp(0.0, cells - 1.0) as u64);
        let bits = (0..CELL_BITS).rev().flat_map(|bit| cell.map(|cell| cell >> bit & 1));
        bits.fold(side, |code, bit| code << 1 | bit)
    }
}

/// Takes down where photons land.
struct Landings<'a, 'c, S> {
    context: &'a Context<'c, S>,
    photon_lm: f64,
    lights: Vec<VirtualLight<S>>,
}

impl<S: Spectrum> PhotonReceiver<S> for Landings<'_, '_, S> {
    fn landing(&mut self, at: &Interaction, photon: &SeenPhoton<S>) {
        let Context { world, max_bounces, .. } = self.context;
        let bounces = photon.bounces + 1;
        // One more where it is seen.
        if max_bounces.is_some_and(|max| bounces >= max) {
            return;
        }
        let albedo = world.bsdf(at).albedo(DVec3::Z, at.front, TransportMode::Radiance);
        let sent_on = photon.weight * albedo * (self.photon_lm * FRAC_1_PI);
        let weight = sent_on.luminance();
        if weight > 0.0 && weight.is_finite() {
            let (position, n, facet) = (at.position, at.n, at.facet);
            self.lights.push(VirtualLight { position, n, facet, sent_on, weight, bounces });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A light of this weight above a level floor.
    pub(super) fn light(x: f64, y: f64, weight: f64) -> VirtualLight<f64> {
        let (position, n) = (DVec3::new(x, y, 2.0), DVec3::NEG_Z);
        VirtualLight { position, n, facet: 0, sent_on: weight, weight, bounces: 1 }
    }

    pub(super) fn lights(lights: Vec<VirtualLight<f64>>) -> VirtualLights<f64> {
        VirtualLights { lights, max_per_m2: 0.2, reach_m: None }
    }

    pub(super) const FLOOR: Site = Site { position: DVec3::ZERO, n: DVec3::Z };

    #[test]
    fn what_is_bounded_is_left_to_paths() {
        let lights = lights(vec![light(0.0, 0.0, 1.0), light(3.0, 0.0, 1.0)]);
        for light in &lights.lights {
            let ShadowSegment { direction, distance_m, .. } = light.way(&FLOOR);
            let g = direction.z * direction.z / (distance_m * distance_m);
            let left = lights.left_to_paths(direction.z * FRAC_1_PI, direction.z, distance_m);
            assert!((lights.bounded(light, &FLOOR) - g * (1.0 - left)).abs() < 1e-15);
        }
        assert_eq!(lights.bounded(&lights.lights[0], &FLOOR), 0.2);
        let behind = Site { n: DVec3::NEG_Z, ..FLOOR };
        assert!(lights.bounded(&lights.lights[0], &behind) == 0.0);
        assert!(lights.way(0, &behind).is_none() && lights.way(0, &FLOOR).is_some());
        let there = Site { position: lights.lights[0].position, ..FLOOR };
        assert_eq!(lights.bounded(&lights.lights[0], &there), 0.0);
    }

    #[test]
    fn neighbours_follow_each_other() {
        let bounds = [DVec3::ZERO, DVec3::splat(4.0)];
        let order = |x, y| light(x, y, 1.0).order(bounds);
        assert!(order(0.1, 0.1) < order(0.3, 0.3) && order(0.3, 0.3) < order(3.9, 0.1));
        let turned = VirtualLight { n: DVec3::Z, ..light(3.9, 3.9, 1.0) };
        assert!(turned.order(bounds) < order(0.1, 0.1));
        // A scene without height.
        assert!(light(1.0, 1.0, 1.0).order([DVec3::ZERO, DVec3::new(4.0, 4.0, 0.0)]) > 0);
    }

    #[test]
    fn sites_of_one_surface_go_together() {
        let other = |x, z, n| FLOOR.goes_with(&Site { position: DVec3::new(x, 0.0, z), n });
        assert!(other(0.0, 0.0, DVec3::Z) && other(1.0, 0.05, DVec3::Z));
        assert!(!other(1.0, 0.2, DVec3::Z) && !other(1.0, 0.0, DVec3::X));
    }
}
