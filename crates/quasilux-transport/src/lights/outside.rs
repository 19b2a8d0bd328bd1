//! Light from outside: sky, ground and sun, infinitely far away.
//!
//! A ray that leaves the scene finds the luminance of the sky or of the ground. Places indoors ask
//! for it through openings, too: one of their triangles is chosen by about what the sky gives
//! through it, a direction evenly over what is seen of it (`seen_triangle`). Both ways are weighed
//! by the power heuristic, so that an opening that stands somewhere else, or for a part, costs
//! noise and no light. The sun's disk is small: it is asked for, and found by rays alone that no
//! place could ask along.

use crate::lights::seen_triangle::SeenTriangle;
use crate::lights::selection::Asking;
use crate::spectrum::Spectrum;
use crate::world::frame::Frame;
use crate::world::vertex::Vertex;
use crate::world::visibility::LightSample;
use crate::world::{Facet, World};
use glam::DVec3;
use quasilux_sampling::choose_weights;
use quasilux_scene::{Environment, Opening, Scene};
use quasilux_sky::SUN_RADIUS_DEG;
use std::f64::consts::TAU;

/// Share of choices that trusts no luminance.
const DEFENSIVE_SHARE: f64 = 0.1;
/// What a cosine counts at least: openings reach further than their centres.
const MIN_COSINE: f64 = 0.1;

/// The sky, the ground and the sun of a scene.
pub(crate) struct OutsideLight<'a> {
    environment: &'a Environment,
    /// Triangles of the openings.
    portals: Vec<Portal>,
    sun: Option<SunDisk>,
    /// A distance in m beyond everything.
    beyond_m: f64,
}

struct Portal {
    corners: [DVec3; 3],
    n: DVec3,
}

struct SunDisk {
    frame: Frame,
    direction: DVec3,
    normal_illuminance_lx: f64,
    luminance_cd_m2: f64,
    /// One less the cosine of its radius.
    height: f64,
}

/// A portal as a place chooses it.
struct Seen {
    triangle: SeenTriangle,
    weight: f64,
}

impl<'a> OutsideLight<'a> {
    /// `None` where nothing is outside.
    pub(super) fn new<S: Spectrum>(scene: &'a Scene, world: &World<S>) -> Option<Self> {
        let environment = scene.environment.as_ref()?;
        let named = environment.openings.iter().flat_map(Opening::triangles);
        let mut portals: Vec<[DVec3; 3]> = named.collect();
        if portals.is_empty() {
            let lets_through = |facet: &&Facet| {
                let bsdf = world.bsdf_of(facet);
                bsdf.transmits() || bsdf.straight_transmittance(1.0).is_some()
            };
            let panes = world.facets.iter().filter(lets_through);
            portals = panes.map(|facet| facet.corners()).collect();
        }
        let portals = portals.into_iter().filter_map(Portal::new).collect();
        let radius = SUN_RADIUS_DEG.to_radians();
        let sun = environment.sun.zip(environment.sun_direction()).map(|(sun, direction)| {
            SunDisk {
                frame: Frame::around(direction),
                direction,
                normal_illuminance_lx: sun.normal_illuminance_lx,
                luminance_cd_m2: environment.sun_luminance_cd_m2(),
                // Differences of cosines would lose digits.
                height: 2.0 * libm::pow(libm::sin(0.5 * radius), 2.0),
            }
        });
        let far_m = world.bounds().map_or(0.0, |[low, high]| low.length().max(high.length()));
        let openings = environment.openings.iter();
        let far_m = openings.map(|it| it.origin.length()).fold(far_m, f64::max);
        Some(Self { environment, portals, sun, beyond_m: 1e3 * (far_m + world.size_m() + 1.0) })
    }

    /// An illuminance in lx that is large for this scene.
    pub(super) fn reference_lx(&self) -> f64 {
        let of_sun = self.sun.as_ref().map_or(0.0, |sun| sun.normal_illuminance_lx);
        self.environment.horizontal_illuminance_lx() + of_sun
    }

    /// Whether places ask for its light through openings.
    pub(crate) fn has_portals(&self) -> bool {
        !self.portals.is_empty()
    }

    /// Whether the disk of the sun shines.
    pub(crate) fn has_sun(&self) -> bool {
        self.sun.is_some()
    }

    /// What a ray finds that leaves the scene, but for the sun, in cd/m2.
    pub(crate) fn luminance_cd_m2(&self, direction: DVec3) -> f64 {
        self.environment.luminance_cd_m2(direction)
    }

    /// What it finds of the sun.
    pub(crate) fn sun_cd_m2(&self, direction: DVec3) -> f64 {
        let on_disk =
            |sun: &&SunDisk| 0.5 * (direction - sun.direction).length_squared() <= sun.height;
        self.sun.as_ref().filter(on_disk).map_or(0.0, |sun| sun.luminance_cd_m2)
    }

    /// What comes through one point of the openings, weighted against the direction in which the
    /// path goes on.
    pub(crate) fn light_sample<S: Spectrum>(
        &self,
        vertex: &Vertex<'_, S>,
        u: [f64; 2],
    ) -> Option<LightSample<S>> {
        let place = Asking::at(vertex);
        let all = self.seen(place);
        let choice = choose_weights(u[0], all.iter().map(Seen::weight))?;
        let portal = &all[choice.index].as_ref()?.triangle;
        let point = portal.sample_point([choice.u_remapped, u[1]]);
        let direction = (point - place.position).normalize_or_zero();
        let cos = vertex.cos(direction);
        if cos <= 0.0 {
            return None;
        }
        let pdf_sr = self.pdf_of(&all, place, direction);
        let beside_sr = vertex.pdf_sr(direction);
        let lx_sr = self.luminance_cd_m2(direction) * cos;
        let illuminance_lx = lx_sr / (pdf_sr + beside_sr * (beside_sr / pdf_sr));
        let light = vertex.weight(direction) * illuminance_lx;
        LightSample::unless_dark(direction, self.beyond_m, light, illuminance_lx)
    }

    /// Density in sr^-1 with which [`Self::light_sample`] asks along a direction.
    pub(crate) fn pdf_sr(&self, place: Asking, direction: DVec3) -> f64 {
        if self.portals.is_empty() { 0.0 } else { self.pdf_of(&self.seen(place), place, direction) }
    }

    /// What one point of the sun's disk gives.
    pub(crate) fn sun_sample<S: Spectrum>(
        &self,
        vertex: &Vertex<'_, S>,
        u: [f64; 2],
    ) -> Option<LightSample<S>> {
        let sun = self.sun.as_ref()?;
        let down = sun.height * u[0];
        let aside = (down * (2.0 - down)).sqrt();
        let (sin, cos) = libm::sincos(TAU * u[1]);
        let local = DVec3::new(aside * cos, aside * sin, 1.0 - down);
        let direction = sun.frame.to_world(local);
        let cos = vertex.cos(direction);
        if cos <= 0.0 {
            return None;
        }
        let solid_angle_sr = TAU * sun.height;
        let illuminance_lx = sun.luminance_cd_m2 * solid_angle_sr * cos;
        let light = vertex.weight(direction) * illuminance_lx;
        LightSample::unless_dark(direction, self.beyond_m, light, illuminance_lx)
    }

    /// The portals as a place sees them, in their order, with about what comes through each.
    fn seen(&self, place: Asking) -> Vec<Option<Seen>> {
        let mut all: Vec<Option<Seen>> =
            self.portals.iter().map(|portal| self.seen_portal(portal, place)).collect();
        let (total, count) = all
            .iter()
            .flatten()
            .fold((0.0, 0), |(total, count), seen| (total + seen.weight, count + 1));
        let each = DEFENSIVE_SHARE * total / f64::from(count.max(1));
        for seen in all.iter_mut().flatten() {
            seen.weight = (1.0 - DEFENSIVE_SHARE) * seen.weight + each;
        }
        all
    }

    fn seen_portal(&self, portal: &Portal, place: Asking) -> Option<Seen> {
        let [a, b, c] = portal.corners;
        let side = portal.n.dot(place.position - a).signum();
        let triangle = SeenTriangle::new(portal.corners, side * portal.n, place.position)?;
        let towards = ((a + b + c) / 3.0 - place.position).normalize_or_zero();
        let cos = place.side.map_or(1.0, |n| n.dot(towards).max(0.0) + MIN_COSINE);
        let weight = triangle.solid_angle_sr() * cos * self.luminance_cd_m2(towards);
        Some(Seen { triangle, weight })
    }

    fn pdf_of(&self, all: &[Option<Seen>], place: Asking, direction: DVec3) -> f64 {
        let total: f64 = all.iter().map(Seen::weight).sum();
        let mut pdf_sr = 0.0;
        if total <= 0.0 {
            return pdf_sr;
        }
        for (portal, seen) in self.portals.iter().zip(all) {
            let Some((seen, distance_m)) =
                seen.as_ref().zip(portal.distance_m(place.position, direction))
            else {
                continue;
            };
            let cos = portal.n.dot(direction).abs();
            let pdf_m2 = seen.triangle.pdf_m2(place.position + direction * distance_m);
            pdf_sr += seen.weight / total * pdf_m2 * distance_m * distance_m / cos;
        }
        pdf_sr
    }
}

impl Seen {
    fn weight(seen: &Option<Self>) -> f64 {
        seen.as_ref().map_or(0.0, |seen| seen.weight)
    }
}

impl Portal {
    /// `None` without area.
    fn new(corners: [DVec3; 3]) -> Option<Self> {
        let [a, b, c] = corners;
        let n = (b - a).cross(c - a).try_normalize()?;
        Some(Self { corners, n })
    }

    /// How far it is met along a unit direction.
    fn distance_m(&self, from: DVec3, direction: DVec3) -> Option<f64> {
        // T. Moeller, B. Trumbore, "Fast, minimum storage ray/triangle intersection", 1997.
        let [a, b, c] = self.corners;
        let (ab, ac, to) = (b - a, c - a, from - a);
        let p = direction.cross(ac);
        let det = ab.dot(p);
        let q = to.cross(ab);
        let (u, v) = (to.dot(p) / det, direction.dot(q) / det);
        let distance_m = ac.dot(q) / det;
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance_m > 0.0).then_some(distance_m)
    }
}
