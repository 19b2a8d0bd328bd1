//! One path from a sensor, with next-event estimation.

use crate::optics::{Course, Followed};
use crate::random::Xoshiro;
use crate::roulette::survive;
use crate::sensor::Sensor;
use crate::vertex::{Looking, Scatter, Vertex};
use crate::world::World;
use glam::DVec3;

/// Places so near to an aim lie on it.
const SLACK_M: f64 = 1e-6;

impl<'a> World<'a> {
    /// What one path finds, in lx. Without what point lights give directly where the sensor is a
    /// point: [`Self::direct_point_lx`] gives that without chance.
    pub(crate) fn path_lx(&self, sensor: &Sensor, random: &mut Xoshiro) -> f64 {
        let eye = self.eye(sensor, random);
        let points_lx = if sensor.has_area() { self.light_of_points(&eye, random) } else { 0.0 };
        points_lx + self.path_from(eye, 0, random)
    }

    /// The same of the light alone whose last vertex is seen through an aim, straight or straight
    /// through panes.
    pub(crate) fn aimed_path_lx(&self, sensor: &Sensor, random: &mut Xoshiro) -> f64 {
        let through = Looking { at: &self.keyholes, share: 1.0 };
        let eye = Vertex::new(sensor.place(random), sensor.normal, Scatter::Cosine, through);
        if eye.share() == 0.0 {
            return 0.0;
        }
        let direction = eye.sample(random);
        let value = eye.value(direction);
        if value <= 0.0 {
            return 0.0;
        }
        let pdf = eye.pdf(direction);
        let way = Course { followed: Followed::Luminance, random };
        let arrival = self.follow(eye.position, direction, way, |_| ());
        let arrival = arrival.filter(|it| {
            !it.is_bent && self.is_through_aim(eye.position, direction, it.distance_m)
        });
        let Some((weight, vertex)) =
            arrival.and_then(|it| Some((it.weight, self.vertex_at(&it, self.hints(1))?)))
        else {
            return 0.0;
        };
        let points = self.light_of_points(&vertex, random);
        value / pdf * weight * (points + self.path_from(vertex, 1, random))
    }

    /// Whether a straight way from a place goes through an aim before its end. Aims that the place
    /// or the end lies on do not count, from whichever end the way is seen.
    pub(crate) fn is_through_aim(&self, place: DVec3, direction: DVec3, far_m: f64) -> bool {
        let mut crossings =
            self.scene.aims.iter().filter_map(|aim| aim.crossing_m(place, direction));
        crossings.any(|at_m| at_m > SLACK_M && at_m < far_m - SLACK_M)
    }

    /// What comes to a vertex, but for the direct light of point lights; `bounces` led to it.
    fn path_from<'w>(
        &'w self,
        mut vertex: Vertex<'w>,
        mut bounces: u32,
        random: &mut Xoshiro,
    ) -> f64 {
        let (mut found, mut beta) = (0.0, 1.0);
        loop {
            found += beta * self.light_of_emitters(&vertex, random);
            found += beta * self.light_of_sun(&vertex, random);
            let direction = vertex.sample(random);
            let value = vertex.value(direction);
            if value <= 0.0 {
                return found;
            }
            let pdf = vertex.pdf(direction);
            let way = Course { followed: Followed::Luminance, random };
            let Some(arrival) = self.follow(vertex.position, direction, way, |_| ()) else {
                return found;
            };
            beta *= value / pdf * arrival.weight;
            found += beta * self.luminance_met(&arrival, pdf);
            bounces += 1;
            let Some(mut next) = self.vertex_at(&arrival, self.hints(bounces)) else {
                return found;
            };
            let Some(gain) = survive(&mut next, bounces, random) else {
                return found;
            };
            beta *= gain;
            found += beta * self.light_of_points(&next, random);
            vertex = next;
        }
    }

    /// What all point lights give directly at the middle, in lx.
    pub(crate) fn direct_point_lx(&self, sensor: &Sensor) -> f64 {
        let hints = self.hints(0);
        let vertex = Vertex::new(sensor.position, sensor.normal, Scatter::Cosine, hints);
        self.light_of_all_points(&vertex)
    }

    /// Where a path starts.
    pub(crate) fn eye(&self, sensor: &Sensor, random: &mut Xoshiro) -> Vertex<'a> {
        let hints = self.hints(0);
        Vertex::new(sensor.place(random), sensor.normal, Scatter::Cosine, hints)
    }

    fn hints(&self, bounces: u32) -> Looking<'a> {
        Looking { at: &self.scene.hints, share: self.scene.share_of_hints(bounces) }
    }
}
