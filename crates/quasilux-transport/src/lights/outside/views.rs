//! Short views at what light from outside gets to: through each side of each opening, and to the
//! sensors past all of them. They only say how many photons go where.

use super::apertures::Apertures;
use super::{OutsideLight, Portal};
use crate::spectrum::Spectrum;
use crate::world::World;
use crate::world::frame::Frame;
use crate::world::panes::{Passage, transmittances};
use glam::DVec3;
use quasilux_bvh::RayQuery;
use quasilux_sampling::radical_inverse;
use quasilux_sampling::warp::{sample_cosine_hemisphere, sample_triangle};
use quasilux_scene::{Scene, SensorPoint};

/// Rays that look out of each side of an opening at most, and of all together.
const RAYS_OF_A_SIDE: u64 = 16;
const RAYS: u64 = 1 << 16;
/// Sensor points that look out, and the rays of each.
const SENSORS: usize = 64;
const RAYS_OF_A_SENSOR: u64 = 32;

/// Views out of openings.
pub(super) struct Views<'l, 'a, S> {
    outside: &'l OutsideLight<'a>,
    world: &'l World<S>,
    rays_of_a_side: u64,
}

/// A ray that views out, and what would come along it if nothing stood in the way.
struct Look {
    query: RayQuery,
    expected: f64,
}

impl<'l, 'a, S: Spectrum> Views<'l, 'a, S> {
    pub(super) fn new(outside: &'l OutsideLight<'a>, world: &'l World<S>) -> Self {
        let sides = 2 * outside.portals.len().max(1) as u64;
        Self { outside, world, rays_of_a_side: (RAYS / sides).clamp(1, RAYS_OF_A_SIDE) }
    }

    /// Share of the light of sky and ground that gets to the front of each portal, and to the back.
    pub(super) fn of_sky(&self) -> Vec<[f64; 2]> {
        let look = |portal: &Portal, n: DVec3, index: u64| {
            let u = [2, 3].map(|base| radical_inverse(base, index + 1));
            let towards = Frame::around(n).to_world(DVec3::from_array(sample_cosine_hemisphere(u)));
            self.look(portal, n, index, towards, self.outside.luminance_cd_m2(towards))
        };
        self.openness(look)
    }

    /// Share of the light of the sun in this direction that gets to the front of each portal, and
    /// to the back.
    pub(super) fn of_sun(&self, sun: DVec3) -> Vec<[f64; 2]> {
        self.openness(|portal, n, index| {
            let faces = f64::from(u8::from(n.dot(sun) > 0.0));
            self.look(portal, n, index, sun, faces)
        })
    }

    /// A look from a place in a portal, on its side `n`.
    fn look(&self, portal: &Portal, n: DVec3, index: u64, towards: DVec3, expected: f64) -> Look {
        let u = [5, 7].map(|base| radical_inverse(base, index + 1));
        let [a, b, c] = portal.corners.points();
        let weights = sample_triangle(u);
        let place = a * weights[0] + b * weights[1] + c * weights[2];
        let from = self.world.ray_origin_of_sensor(place, n);
        Look { query: from.query(towards), expected }
    }

    fn openness(&self, look: impl Fn(&Portal, DVec3, u64) -> Look) -> Vec<[f64; 2]> {
        let portals = self.outside.portals.iter();
        let views: Vec<Look> = portals
            .flat_map(|portal| [portal.n, -portal.n].map(|n| (portal, n)))
            .flat_map(|(portal, n)| {
                let look = &look;
                (0..self.rays_of_a_side).map(move |index| look(portal, n, index))
            })
            .collect();
        let queries: Vec<RayQuery> = views.iter().map(|look| look.query).collect();
        let mut passages = Vec::new();
        transmittances(self.world, &queries, &mut passages);
        let seen: Vec<f64> = views
            .chunks(self.rays_of_a_side as usize)
            .zip(passages.chunks(self.rays_of_a_side as usize))
            .map(|(views, passages)| {
                let expected: f64 = views.iter().map(|look| look.expected).sum();
                let open = views.iter().zip(passages).filter(|(_, passage)| passage.is_some());
                let found: f64 = open.map(|(look, _)| look.expected).sum();
                if expected > 0.0 { found / expected } else { 0.0 }
            })
            .collect();
        seen.chunks_exact(2).map(|sides| [sides[0], sides[1]]).collect()
    }
}

/// About which part of the light that comes to the sensors from outside comes past all openings; 0
/// where none comes.
pub(super) fn view_past_openings<S: Spectrum>(
    outside: &OutsideLight<'_>,
    scene: &Scene,
    world: &World<S>,
    openings: &Apertures,
) -> f64 {
    let points: Vec<SensorPoint> =
        scene.sensors.iter().flat_map(|sensor| sensor.points()).collect();
    let step = points.len().div_ceil(SENSORS).max(1);
    let (mut queries, mut expected) = (Vec::new(), Vec::new());
    for (number, SensorPoint { position, normal }) in (0..).zip(points.iter().step_by(step)) {
        let from = world.ray_origin_of_sensor(*position, *normal);
        for ray in 0..RAYS_OF_A_SENSOR {
            let index = number * RAYS_OF_A_SENSOR + ray;
            let u = [2, 3].map(|base| radical_inverse(base, index + 1));
            let local = DVec3::from_array(sample_cosine_hemisphere(u));
            let towards = Frame::around(*normal).to_world(local);
            queries.push(from.query(towards));
            expected.push(outside.luminance_cd_m2(towards) * std::f64::consts::PI);
        }
        if let Some(sun) = &outside.sun {
            let lx = sun.normal_illuminance_lx * normal.dot(sun.direction).max(0.0);
            queries.push(from.query(sun.direction));
            expected.push(lx * RAYS_OF_A_SENSOR as f64);
        }
    }
    let mut passages: Vec<Option<Passage<S>>> = Vec::new();
    transmittances(world, &queries, &mut passages);
    let (mut past, mut all) = (0.0, 0.0);
    for ((query, expected), passage) in queries.iter().zip(expected).zip(passages) {
        let Some(Passage { transmitted, .. }) = passage else { continue };
        let found = expected * transmitted.luminance();
        all += found;
        if !openings.is_crossed_after(query.ray.origin, query.ray.direction) {
            past += found;
        }
    }
    if all > 0.0 { past / all } else { 0.0 }
}
