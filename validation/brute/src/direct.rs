//! Light asked for at a vertex: point lights, emitting triangles, the sun.
//!
//! Rays of directions that were drawn may come to a triangle that shines or to the sun as well:
//! each is weighed by the balance heuristic of both ways. Where mirrors or glass bent the way, or a
//! pane mirrored it, the light cannot be asked for, and the ray counts in full.

use crate::light::PointLight;
use crate::random::Xoshiro;
use crate::sky::Sun;
use crate::vertex::Vertex;
use crate::world::{Arrival, World};

/// Up to this many point lights all are asked at every vertex, else one of them.
const ASK_ALL: usize = 3;

impl World<'_> {
    /// Next-event estimation of point lights: of all, or of one in proportion to what it gives
    /// without shadows.
    pub(crate) fn light_of_points(&self, vertex: &Vertex, random: &mut Xoshiro) -> f64 {
        let lights = &self.scene.lights;
        if lights.len() <= ASK_ALL {
            return self.light_of_all_points(vertex);
        }
        let all: f64 = lights.iter().map(|light| unshadowed(vertex, light)).sum();
        let mut left = random.uniform() * all;
        for light in lights {
            let own = unshadowed(vertex, light);
            if own > 0.0 && left < own {
                return all * self.passed_to(vertex, light);
            }
            left -= own;
        }
        0.0
    }

    /// What all point lights give by themselves.
    pub(crate) fn light_of_all_points(&self, vertex: &Vertex) -> f64 {
        let lit = |light| {
            let own = unshadowed(vertex, light);
            if own > 0.0 { own * self.passed_to(vertex, light) } else { 0.0 }
        };
        self.scene.lights.iter().map(lit).sum()
    }

    fn passed_to(&self, vertex: &Vertex, light: &PointLight) -> f64 {
        let to = light.position - vertex.position;
        let distance = to.length();
        self.passed(vertex.position, to / distance, distance)
    }

    /// Next-event estimation of emitting triangles, weighed against directions of the mixture.
    pub(crate) fn light_of_emitters(&self, vertex: &Vertex, random: &mut Xoshiro) -> f64 {
        if self.emitters.is_empty() {
            return 0.0;
        }
        let number = self.choose_emitter(random);
        let triangle = &self.scene.triangles[number];
        let to = triangle.place(random) - vertex.position;
        let square = to.length_squared();
        let direction = to / square.sqrt();
        let cos_of_light = -direction.dot(triangle.double_area().normalize());
        let value = vertex.value(direction);
        if value <= 0.0 || cos_of_light <= 1e-12 {
            return 0.0;
        }
        let pdf_of_light = self.pdf_per_m2[number] * square / cos_of_light;
        let pdf = pdf_of_light + vertex.pdf(direction);
        let passed = self.passed(vertex.position, direction, square.sqrt());
        value * triangle.luminance_cd_m2 * passed / pdf
    }

    /// The number of an emitting triangle, chosen by flux.
    pub(crate) fn choose_emitter(&self, random: &mut Xoshiro) -> usize {
        let choice = random.uniform();
        let number = self.emitters.partition_point(|emitter| emitter.flux_up_to <= choice);
        self.emitters[number.min(self.emitters.len() - 1)].triangle
    }

    /// Next-event estimation of the sun, weighed likewise.
    pub(crate) fn light_of_sun(&self, vertex: &Vertex, random: &mut Xoshiro) -> f64 {
        let Some(sun) = &self.scene.sun else {
            return 0.0;
        };
        let direction = sun.sample(random);
        let value = vertex.value(direction);
        if value <= 0.0 {
            return 0.0;
        }
        let pdf = 1.0 / Sun::solid_angle_sr() + vertex.pdf(direction);
        let passed = self.passed(vertex.position, direction, f64::INFINITY);
        value * sun.luminance_cd_m2() * passed / pdf
    }

    /// The luminance that a ray came to, weighed against next-event estimation; `pdf` is the
    /// density that its first direction was drawn with.
    pub(crate) fn luminance_met(&self, arrival: &Arrival, pdf: f64) -> f64 {
        let share = |pdf_of_light: f64| {
            if arrival.is_bent { 1.0 } else { pdf / (pdf + pdf_of_light) }
        };
        let direction = arrival.direction;
        let Some(met) = &arrival.met else {
            let sky = self.scene.sky.map_or(0.0, |sky| sky.luminance_cd_m2(direction));
            let sun = self
                .scene
                .sun
                .filter(|sun| sun.is_met(direction))
                .map_or(0.0, |sun| sun.luminance_cd_m2() * share(1.0 / Sun::solid_angle_sr()));
            return sky + sun;
        };
        let triangle = &self.scene.triangles[met.triangle];
        let cos = -direction.dot(met.front);
        if triangle.luminance_cd_m2 == 0.0 || cos <= 0.0 {
            return 0.0;
        }
        let square = arrival.distance_m * arrival.distance_m;
        triangle.luminance_cd_m2 * share(self.pdf_per_m2[met.triangle] * square / cos)
    }
}

/// What a point light gives to a vertex, shadows left out.
fn unshadowed(vertex: &Vertex, light: &PointLight) -> f64 {
    let to = light.position - vertex.position;
    let square = to.length_squared();
    let direction = to / square.sqrt();
    let value = vertex.value(direction);
    if value <= 0.0 { 0.0 } else { value * light.intensity_cd(-direction) / square }
}
