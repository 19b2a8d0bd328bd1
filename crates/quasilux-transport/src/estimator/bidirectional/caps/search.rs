//! The largest `f / p` of a technique by itself, searched for over its paths: weights cannot hide a
//! cap that is too low here.

use super::surfaces::{Peaks, Surfaces};
use crate::bsdf::TransportMode;
use crate::context::Context;
use crate::control::watch::Watch;
use crate::estimator::bidirectional::engine::Engine;
use crate::estimator::bidirectional::light_subpath::is_narrow;
use crate::estimator::bidirectional::plan::{JoinEdge, Receiver};
use crate::lights::Asking;
use crate::scenes::{diffuse, point_light, points, room};
use crate::sensors::targets;
use crate::settings::{EstimatorKind, Settings};
use crate::world::Interaction;
use crate::world::frame::Frame;
use glam::DVec3;
use quasilux_scene::bsdf::{Conductor, Plastic, Translucent};
use quasilux_scene::{Bsdf, Material, Rgb, Scene};
use std::f64::consts::{PI, TAU};

/// Scenes at random.
const SCENES: u64 = 300;
/// Places of a search, those that it climbs from, and steps of each.
const PLACES: u32 = 200;
const STARTS: usize = 3;
const STEPS: u32 = 160;

/// Numbers that look random (Knuth's MMIX generator).
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next() * count as f64) as usize
    }

    /// Between powers of ten.
    fn decades(&mut self, low: f64, high: f64) -> f64 {
        libm::exp10(low + (high - low) * self.next())
    }

    fn place(&mut self, size: DVec3) -> DVec3 {
        size * DVec3::new(self.next(), self.next(), self.next())
    }

    fn direction(&mut self) -> DVec3 {
        let (z, phi) = (2.0 * self.next() - 1.0, TAU * self.next());
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * libm::cos(phi), r * libm::sin(phi), z)
    }

    fn bsdf(&mut self) -> Bsdf {
        let share = 0.05 + 0.9 * self.next();
        let (reflectance, alpha) = (Rgb::grey(share), self.decades(-3.39, 0.0));
        match self.below(4) {
            0 => diffuse(share),
            1 => {
                let transmittance = Rgb::grey((1.0 - share) * self.next());
                Bsdf::Translucent(Translucent { reflectance, transmittance })
            }
            2 => Bsdf::Conductor(Conductor { reflectance, alpha }),
            _ => Bsdf::Plastic(Plastic { reflectance, eta: 1.1 + self.next(), alpha }),
        }
    }

    /// A room with triangles in it, lamps, and places that look anywhere, some close to a wall.
    fn scene(&mut self) -> Scene {
        let size = DVec3::new(self.decades(-1.0, 1.0), self.decades(-1.0, 1.0), 2.5);
        // Black ones leave the largest value to the triangles.
        let walls = if self.next() < 0.4 { diffuse(0.0) } else { self.bsdf() };
        let mut scene = room(size, walls);
        for triangle in 0..self.below(4) {
            let first = scene.mesh.positions.len() as u32;
            let corner = self.place(size);
            let sides = [(); 2].map(|()| self.direction() * self.decades(-2.0, 0.3));
            scene.mesh.positions.extend([corner, corner + sides[0], corner + sides[1]]);
            scene.mesh.triangles.push([first, first + 1, first + 2]);
            scene.mesh.material_of.push(scene.materials.len() as u32);
            scene.mesh.object_of.push(0);
            let bsdf = self.bsdf();
            scene.materials.push(Material { name: format!("triangle {triangle}"), bsdf });
        }
        // Alike, or of five decades.
        let decades = if self.next() < 0.5 { 0.3 } else { 5.0 };
        for _ in 0..1 + self.below(5) {
            let (place, intensity_cd) = (self.place(size), self.decades(-1.0, decades - 1.0));
            scene.lights.push(point_light(place, intensity_cd));
        }
        let near_wall = self.place(size) * DVec3::new(1.0, 1.0, 0.0) + DVec3::Z * 0.01;
        let places = [near_wall, self.place(size)].map(|place| (place, self.direction()));
        scene.sensors.push(points("probes", &places));
        scene
    }
}

/// The largest value over the unit cube that a search comes to: it climbs from the best of places
/// at random, one coordinate or all of them at a time.
fn largest<const N: usize>(dice: &mut Dice, value: impl Fn(&[f64; N]) -> f64) -> f64 {
    let mut starts: Vec<([f64; N], f64)> = Vec::new();
    for _ in 0..PLACES {
        let at = [(); N].map(|()| dice.next());
        starts.push((at, value(&at)));
    }
    starts.sort_by(|(_, a), (_, b)| b.total_cmp(a));
    let mut most = 0.0_f64;
    for (mut at, mut here) in starts.into_iter().take(STARTS) {
        for step in 0..STEPS {
            let reach = 0.3 * libm::exp2(-f64::from(step) / 16.0);
            let only = dice.below(2 * N);
            let mut near = at;
            for (axis, u) in near.iter_mut().enumerate() {
                if only >= N || only == axis {
                    *u = (*u + reach * (2.0 * dice.next() - 1.0)).clamp(0.0, 1.0);
                }
            }
            let there = value(&near);
            if there > here {
                (at, here) = (near, there);
            }
        }
        most = most.max(here);
    }
    most
}

/// A side of a facet that scatters, by a number, at a place by two coordinates.
fn place(surfaces: &Surfaces<'_, f64>, side: f64, [u, v]: [f64; 2]) -> Option<Interaction> {
    let sides = 2 * surfaces.facets.len();
    let side = ((side * sides as f64) as usize).min(sides.checked_sub(1)?);
    let r = u.sqrt();
    let weights = [1.0 - r, r * (1.0 - v), r * v];
    let facet = surfaces.facets[side / 2] as u32;
    let at = surfaces.world.interaction_on(facet, side.is_multiple_of(2), weights);
    at.position.is_finite().then_some(at)
}

/// On the upper hemisphere, or the lower.
fn direction([height, around]: [f64; 2], is_above: bool) -> DVec3 {
    let z = height.clamp(1e-6, 1.0);
    let (sin, cos) = libm::sincos(TAU * around);
    let r = (1.0 - z * z).sqrt();
    DVec3::new(r * cos, r * sin, if is_above { z } else { -z })
}

/// Largest contribution in lx of a lamp to an eye path that has lost nothing, over the probability
/// of asking for it.
fn asked_lx(context: &Context<'_, f64>, surfaces: &Surfaces<'_, f64>, u: &[f64; 5]) -> f64 {
    let &[side, a, b, height, around] = u;
    let Some(at) = place(surfaces, side, [a, b]) else { return 0.0 };
    let (bsdf, frame): (_, Frame) = (context.world.bsdf(&at), context.world.frame(&at));
    let wo = direction([height, around], true);
    let lights = &context.lights.pointlikes;
    let both = bsdf.transmits();
    let side = (!both).then_some(at.n);
    let asking = Asking { position: at.position, side, own: Some(at.facet) };
    let of_lamp = |number: usize| {
        let lx = lights.illuminance_lx(number, at.position, at.n, both);
        let probability = lights.probability(number, asking);
        let lamp = lights.iter().nth(number).map(|it| it.position);
        let toward = lamp.map(|lamp| (lamp - at.position).normalize());
        let Some(toward) = toward.filter(|_| lx > 0.0 && probability > 0.0) else { return 0.0 };
        let wi = frame.to_local(toward);
        PI * bsdf.evaluate(wo, wi, at.front, TransportMode::Radiance) * lx / probability
    };
    (0..lights.len()).map(of_lamp).fold(0.0, f64::max)
}

/// Contribution in sr^-1 m^-2 of each lumen at a light vertex to a target that it is joined to,
/// over the probability of that.
fn joined_sr_m2(surfaces: &Surfaces<'_, f64>, receiver: &Receiver, u: &[f64; 5]) -> f64 {
    let &[side, a, b, height, around] = u;
    let Some(at) = place(surfaces, side, [a, b]) else { return 0.0 };
    let way = receiver.position - at.position;
    let square_m2 = way.length_squared();
    let cos = receiver.n.dot(-way).max(0.0) / square_m2.sqrt();
    let (bsdf, frame): (_, Frame) = (surfaces.world.bsdf(&at), surfaces.world.frame(&at));
    let wi = frame.to_local(way.normalize_or(DVec3::Z));
    if cos == 0.0 || !(wi.z > 0.0 || bsdf.transmits()) {
        return 0.0;
    }
    let wo = direction([height, around], true);
    let edge = JoinEdge { cos, cos_there: wi.z.abs(), square_m2, is_narrow: is_narrow(bsdf) };
    let value = bsdf.evaluate(wo, wi, at.front, TransportMode::Importance) * cos * edge.cos_there
        / (square_m2 * receiver.join_probability(&edge));
    if value.is_finite() { value } else { 0.0 }
}

/// In scenes at random, with lamps, Lambertian surfaces, sheets, metal and coats: a search comes to
/// no more than the cap of asking lamps and that of joins; in scenes of Lambertian surfaces and
/// sheets to a fifth of it in most.
#[test]
fn no_path_of_one_technique_passes_its_cap() {
    let mut dice = Dice(7);
    let settings = Settings { estimator: EstimatorKind::Bidirectional, ..Settings::default() };
    let mut shares: Vec<f64> = Vec::new();
    for number in 0..SCENES {
        let scene = dice.scene();
        let context: Context<'_, f64> = Context::new(&scene, &settings);
        let mut nobody = ();
        let watch = &mut Watch::new(&mut nobody);
        let engine = Engine::new(&context, &targets(&scene), watch).expect("nobody stops it");
        let surfaces = Surfaces::new(&context);
        let is_lambertian = !context.world.bsdfs().iter().any(is_narrow);
        let mut check = |what: &str, found: f64, cap: f64| {
            assert!(found <= cap * (1.0 + 1e-9), "scene {number}, {what}: {found}, cap {cap}");
            if is_lambertian && found > 0.0 {
                shares.push(found / cap);
            }
        };
        let found = largest(&mut dice, |u: &[f64; 5]| asked_lx(&context, &surfaces, u));
        check("lamps", found, surfaces.lit_by_pointlikes(&engine));
        for receiver in &engine.receivers {
            let found = largest(&mut dice, |u: &[f64; 5]| joined_sr_m2(&surfaces, receiver, u));
            check("joins", found, surfaces.joined(receiver));
        }
    }
    shares.sort_by(f64::total_cmp);
    let median = shares[shares.len() / 2];
    assert!(median > 0.2, "half of the caps are {} times what was found", 1.0 / median);
}

/// Peaks of scattering functions that are looked up on a grid, against pairs of directions that
/// were searched for.
#[test]
fn no_pair_of_directions_passes_the_peak() {
    let mut dice = Dice(11);
    let settings = Settings::default();
    for number in 0..SCENES / 4 {
        let scene = dice.scene();
        let context: Context<'_, f64> = Context::new(&scene, &settings);
        let peaks = Peaks::new(&context.world);
        for (bsdf, peak) in context.world.bsdfs().iter().zip(&peaks.0) {
            // Over the peak of all directions that are as high.
            let share = |u: &[f64; 4]| {
                let (wo, wi) = (direction([u[0], u[1]], true), direction([u[2], u[3]], true));
                let f = bsdf.evaluate(wo, wi, true, TransportMode::Importance);
                let cos = if peak.is_lambertian { 1.0 } else { wi.z };
                f * cos / peak.largest_above_sr(wi.z)
            };
            let found = largest(&mut dice, share);
            assert!(found <= 1.0 + 1e-9, "{number}: {bsdf:?}: {found} of its peak");
        }
    }
}
