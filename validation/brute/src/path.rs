//! One path from a sensor, with next-event estimation.

use crate::optics::Followed;
use crate::random::Xoshiro;
use crate::roulette::survive;
use crate::sensor::Sensor;
use crate::vertex::{Looking, Scatter, Vertex};
use crate::world::World;

impl<'a> World<'a> {
    /// What one path finds, in lx. Without what point lights give directly where the sensor is a
    /// point: [`Self::direct_point_lx`] gives that without chance.
    pub(crate) fn path_lx(&self, sensor: &Sensor, random: &mut Xoshiro) -> f64 {
        let mut vertex = self.eye(sensor, random);
        let (mut lx, mut beta, mut bounces) = (0.0, 1.0, 0);
        loop {
            if bounces > 0 || sensor.has_area() {
                lx += beta * self.light_of_points(&vertex, random);
            }
            lx += beta * self.light_of_emitters(&vertex, random);
            lx += beta * self.light_of_sun(&vertex, random);
            let direction = vertex.sample(random);
            let value = vertex.value(direction);
            if value <= 0.0 {
                return lx;
            }
            let pdf = vertex.pdf(direction);
            let way = (Followed::Luminance, &mut *random);
            let Some(arrival) = self.follow(vertex.position, direction, way, |_| ()) else {
                return lx;
            };
            beta *= value / pdf * arrival.weight;
            lx += beta * self.luminance_met(&arrival, pdf);
            bounces += 1;
            let Some(mut next) = self.vertex_at(&arrival, self.hints(bounces)) else {
                return lx;
            };
            let Some(gain) = survive(&mut next, bounces, random) else {
                return lx;
            };
            beta *= gain;
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
