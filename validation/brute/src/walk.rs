//! One walk from the lights.
//!
//! It brings light to the sensors in two ways, of which each path of light takes one:
//! - the last vertex that scatters is joined to a random place of each sensor, straight or straight
//!   through panes;
//! - the walk itself crosses the area of a sensor, and brings its flux over that area.
//!
//! Light that comes without a vertex that scatters is asked for from the sensor, or counted.

use crate::mode::Mode;
use crate::optics::Followed;
use crate::random::Xoshiro;
use crate::roulette::survive;
use crate::sensor::Sensor;
use crate::start::{Start, Starts};
use crate::vertex::Vertex;
use crate::world::{Piece, World};
use glam::DVec3;

/// A walk crosses areas up to so far behind a surface, so that sensors may lie on it.
const SLACK_M: f64 = 1e-6;

impl World<'_> {
    /// Adds what one walk brings to each sensor, in lx.
    pub(crate) fn walk(
        &self,
        starts: &Starts,
        mode: Mode,
        random: &mut Xoshiro,
        found_lx: &mut [f64],
    ) {
        self.ask_directly(mode, random, found_lx);
        let Some(start) = starts.draw(self, random) else {
            return;
        };
        let (mut origin, mut direction, mut flux_lm) = match start {
            Start::Outside { origin, direction, flux_lm } => (origin, direction, flux_lm),
            Start::Within { vertex, weight } => {
                let direction = vertex.sample(random);
                let pdf = vertex.pdf(direction);
                (vertex.position, direction, weight * vertex.value(direction) / pdf)
            }
        };
        let mut bounces = 0;
        while flux_lm > 0.0 {
            let counts = |piece: &Piece, sensor: &Sensor| match mode {
                Mode::Paths => false,
                Mode::Photons => true,
                Mode::BeamsAndJoins => piece.is_bent || (bounces == 0 && sensor.has_area()),
                Mode::Joins => piece.is_bent,
            };
            let tell = |piece: &Piece| {
                for (sensor, lx) in self.scene.sensors.iter().zip(&mut *found_lx) {
                    if counts(piece, sensor) && crosses(piece, sensor) {
                        *lx += flux_lm * piece.weight / sensor.area_m2();
                    }
                }
            };
            let way = (Followed::Flux, &mut *random);
            let Some(arrival) = self.follow(origin, direction, way, tell) else {
                return;
            };
            flux_lm *= arrival.weight;
            bounces += 1;
            let Some(mut vertex) = self.vertex_at(&arrival, self.aims()) else {
                return;
            };
            if mode != Mode::Photons {
                self.join(&vertex, flux_lm, random, found_lx);
            }
            let Some(gain) = survive(&mut vertex, bounces, random) else {
                return;
            };
            (origin, direction) = (vertex.position, vertex.sample(random));
            let value = vertex.value(direction);
            if value <= 0.0 {
                return;
            }
            flux_lm *= gain * value / vertex.pdf(direction);
        }
    }

    /// What comes from a vertex straight to each sensor.
    fn join(&self, vertex: &Vertex, flux_lm: f64, random: &mut Xoshiro, found_lx: &mut [f64]) {
        for (sensor, lx) in self.scene.sensors.iter().zip(found_lx) {
            let to = sensor.place(random) - vertex.position;
            let square = to.length_squared();
            let direction = to / square.sqrt();
            let cos = -direction.dot(sensor.normal);
            if cos <= 0.0 {
                continue;
            }
            let value = vertex.value(direction);
            if value > 0.0 {
                let passed = self.passed(vertex.position, direction, square.sqrt());
                *lx += flux_lm * value * cos / square * passed;
            }
        }
    }

    /// What comes straight from the lights, where it is not counted: point lights (but for those of
    /// points, which need no chance), emitting triangles, sky and sun.
    fn ask_directly(&self, mode: Mode, random: &mut Xoshiro, found_lx: &mut [f64]) {
        for (sensor, lx) in self.scene.sensors.iter().zip(found_lx) {
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
                *lx += value / pdf * self.straight_luminance(eye.position, direction, pdf);
            }
        }
    }

    /// What is seen in a direction straight or through panes, weighed against asking for it.
    fn straight_luminance(&self, position: DVec3, direction: DVec3, pdf: f64) -> f64 {
        let (seen, passed) = self.straight(position, direction);
        if passed > 0.0 { passed * self.luminance_met(&seen, pdf) } else { 0.0 }
    }
}

fn crosses(piece: &Piece, sensor: &Sensor) -> bool {
    let near_and_far = SLACK_M..piece.length_m + SLACK_M;
    sensor
        .crossing_m(piece.origin, piece.direction)
        .is_some_and(|distance_m| near_and_far.contains(&distance_m))
}
