//! One walk from the lights.
//!
//! It brings light to the sensors in two ways, of which each path of light takes one:
//! - the last vertex that scatters is joined to a random place of each sensor, straight or straight
//!   through panes;
//! - the walk itself crosses the area of a sensor, and brings its flux over that area.
//!
//! Light that comes without a vertex that scatters is asked for from the sensor, or counted.
//! Emitting triangles, sky and sun may be asked for over mirrors and through glass too, point
//! lights not.

use crate::mode::Mode;
use crate::optics::{Course, Followed};
use crate::random::Xoshiro;
use crate::roulette::survive;
use crate::sensor::Sensor;
use crate::start::{Start, Starts};
use crate::vertex::{Scatter, Vertex};
use crate::world::{Piece, World};
use glam::DVec3;

/// A walk crosses areas up to so far behind a surface, so that sensors may lie on it.
const SLACK_M: f64 = 1e-6;

/// A walk, or a copy of one, that leaves a light or a vertex.
struct Walker {
    origin: DVec3,
    direction: DVec3,
    flux_lm: f64,
    bounces: u32,
    /// In how many boxes it has been.
    depth: usize,
}

/// What one walk of a mode finds.
struct Finding<'a> {
    mode: Mode,
    /// Whether it starts at a point light.
    is_point: bool,
    /// Of each sensor.
    lx: &'a mut [f64],
}

impl World<'_> {
    /// Adds what one walk brings to each sensor, in lx.
    pub(crate) fn walk(&self, starts: &Starts, mode: Mode, random: &mut Xoshiro, lx: &mut [f64]) {
        self.sample_direct_light(mode, random, lx);
        let Some(start) = starts.draw(self, random) else {
            return;
        };
        let mut finding = Finding { mode, is_point: false, lx };
        let (origin, direction, flux_lm) = match start {
            Start::Outside { origin, direction, flux_lm } => (origin, direction, flux_lm),
            Start::Within { vertex, weight } => {
                finding.is_point = matches!(vertex.scatter, Scatter::Lamp { .. });
                let direction = vertex.sample(random);
                let pdf = vertex.pdf(direction);
                (vertex.position, direction, weight * vertex.value(direction) / pdf)
            }
        };
        let mut walkers = vec![Walker { origin, direction, flux_lm, bounces: 0, depth: 0 }];
        while let Some(walker) = walkers.pop() {
            if walker.flux_lm > 0.0 {
                self.step(walker, &mut finding, random, &mut walkers);
            }
        }
    }

    /// Goes to the next vertex and leaves it, as one or several walks.
    fn step(
        &self,
        walker: Walker,
        finding: &mut Finding,
        random: &mut Xoshiro,
        walkers: &mut Vec<Walker>,
    ) {
        let tell = |piece: &Piece| {
            for (number, sensor) in self.scene.sensors.iter().enumerate() {
                let lm = walker.flux_lm * piece.weight;
                if crosses(piece, sensor) && self.counts(finding, &walker, piece, sensor) {
                    finding.lx[number] += lm / sensor.area_m2();
                }
            }
        };
        let way = Course { followed: Followed::Flux, random };
        let Some(arrival) = self.follow(walker.origin, walker.direction, way, tell) else {
            return;
        };
        let mut flux_lm = walker.flux_lm * arrival.weight;
        let bounces = walker.bounces + 1;
        let Some(mut vertex) = self.vertex_at(&arrival, self.aims()) else {
            return;
        };
        if finding.mode != Mode::Photons {
            self.join(&vertex, flux_lm, finding, random);
        }
        let depth = walker.depth.max(self.scene.depth(vertex.position));
        let copies = (walker.depth..depth).fold(1, |copies, _| copies * self.scene.copies.max(1));
        flux_lm /= f64::from(copies);
        let position = vertex.position;
        for _ in 0..copies {
            let Some(gain) = survive(&mut vertex, bounces, random) else {
                continue;
            };
            let direction = vertex.sample(random);
            let value = vertex.value(direction);
            if value > 0.0 {
                let flux_lm = flux_lm * gain * value / vertex.pdf(direction);
                walkers.push(Walker { origin: position, direction, flux_lm, bounces, depth });
            }
        }
    }

    /// Whether light of a walker that crosses a sensor on this piece is counted.
    fn counts(&self, finding: &Finding, walker: &Walker, piece: &Piece, sensor: &Sensor) -> bool {
        let mode = finding.mode;
        if walker.bounces == 0 {
            return mode.counts_direct(sensor) || (finding.is_point && piece.is_bent);
        }
        let (origin, direction) = (walker.origin, walker.direction);
        let is_aimed = || {
            let far_m = sensor.crossing_m(origin, direction);
            far_m.is_some_and(|far_m| self.is_through_aim(origin, direction, far_m))
        };
        let counts_aimed = mode == Mode::BeamsAndJoins && sensor.has_area();
        mode == Mode::Photons || piece.is_bent || (counts_aimed && is_aimed())
    }

    /// What comes from a vertex straight to each sensor.
    fn join(&self, vertex: &Vertex, flux_lm: f64, finding: &mut Finding, random: &mut Xoshiro) {
        for (sensor, lx) in self.scene.sensors.iter().zip(&mut *finding.lx) {
            let to = sensor.place(random) - vertex.position;
            let square = to.length_squared();
            let distance = square.sqrt();
            let direction = to / distance;
            let cos = -direction.dot(sensor.normal);
            let is_aimed = || self.is_through_aim(vertex.position, direction, distance);
            if cos <= 0.0 || (finding.mode.leaves_out_aimed(sensor) && is_aimed()) {
                continue;
            }
            let value = vertex.value(direction);
            if value > 0.0 {
                let passed = self.passed(vertex.position, direction, distance);
                *lx += flux_lm * value * cos / square * passed;
            }
        }
    }

    /// What comes from the lights without a vertex that scatters, where it is not counted: straight
    /// from point lights (but at points, which need no chance), over mirrors and through glass too
    /// from emitting triangles, sky and sun.
    fn sample_direct_light(&self, mode: Mode, random: &mut Xoshiro, found_lx: &mut [f64]) {
        for (sensor, lx) in self.scene.sensors.iter().zip(found_lx) {
            if mode == Mode::KeyholesAndJoins {
                *lx += self.aimed_path_lx(sensor, random);
            }
            if mode.counts_direct(sensor) {
                continue;
            }
            let eye = self.eye(sensor, random);
            if sensor.has_area() {
                *lx += self.light_of_points(&eye, random);
            }
            let is_lit = !self.emitters.is_empty() || self.scene.sky.is_some();
            if !is_lit && self.scene.sun.is_none() {
                continue;
            }
            *lx += self.light_of_emitters(&eye, random) + self.light_of_sun(&eye, random);
            let direction = eye.sample(random);
            let value = eye.value(direction);
            if value > 0.0 {
                let pdf = eye.pdf(direction);
                let way = Course { followed: Followed::Luminance, random };
                if let Some(seen) = self.follow(eye.position, direction, way, |_| ()) {
                    *lx += value / pdf * seen.weight * self.luminance_met(&seen, pdf);
                }
            }
        }
    }
}

fn crosses(piece: &Piece, sensor: &Sensor) -> bool {
    let near_and_far = SLACK_M..piece.length_m + SLACK_M;
    sensor
        .crossing_m(piece.origin, piece.direction)
        .is_some_and(|distance_m| near_and_far.contains(&distance_m))
}
