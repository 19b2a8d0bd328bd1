//! One path from a sensor, with next-event estimation.

use crate::light::PointLight;
use crate::random::Xoshiro;
use crate::scene::{Scene, Sensor};
use crate::tree::{Hit, Tree};
use crate::triangle::{Ray, Surface, Triangle};
use glam::DVec3;
use std::f64::consts::{FRAC_1_PI, PI, TAU};

/// Rays start and end so far from surfaces.
const GAP_M: f64 = 1e-8;
/// Up to so many point lights all are asked at every vertex, else one of them.
const ASK_ALL: usize = 3;
/// The least and the most probable survival of Russian roulette.
const SURVIVAL: [f64; 2] = [0.5, 0.97];
/// Bounces without roulette.
const SURE_BOUNCES: u32 = 2;
/// A chain of mirrors ends here: what it still reflects is far below any error.
const MAX_MIRRORS: u32 = 400;

/// A scene made ready.
pub(crate) struct World<'a> {
    pub(crate) scene: &'a Scene,
    tree: Tree,
    emitters: Vec<Emitter>,
    /// Of a triangle, the density in area that it is chosen with as a light.
    pdf_per_m2: Vec<f64>,
}

/// An emitting triangle, and the share of the flux up to and with it.
struct Emitter {
    triangle: usize,
    flux_up_to: f64,
}

/// Where a path looks from: the sensor or a diffuse surface.
struct Vertex {
    position: DVec3,
    normal: DVec3,
    /// What the irradiance over pi counts for: pi at the sensor, times reflectances and
    /// cos / (pi pdf) on the way, over the survival.
    beta: f64,
    bounces: u32,
    hint_share: f64,
    /// Numbers of hints above the horizon.
    hints: Vec<usize>,
}

/// What a ray came to behind mirrors.
struct Arrival {
    ray: Ray,
    hit: Hit,
    /// Product of the mirrors' reflectances.
    reflected: f64,
    has_mirrors: bool,
}

impl<'a> World<'a> {
    pub(crate) fn new(scene: &'a Scene) -> Self {
        let flux = |t: &Triangle| t.luminance_cd_m2 * t.area_m2();
        let total: f64 = scene.triangles.iter().map(flux).sum();
        let mut sum = 0.0;
        let mut emitters = Vec::new();
        for (triangle, shape) in scene.triangles.iter().enumerate() {
            if shape.luminance_cd_m2 > 0.0 {
                sum += flux(shape) / total;
                emitters.push(Emitter { triangle, flux_up_to: sum });
            }
        }
        let pdf = |t: &Triangle| if total > 0.0 { t.luminance_cd_m2 / total } else { 0.0 };
        let pdf_per_m2 = scene.triangles.iter().map(pdf).collect();
        Self { scene, tree: Tree::new(&scene.triangles), emitters, pdf_per_m2 }
    }

    /// What one path finds, in lx, without what point lights give to the sensor directly.
    pub(crate) fn path_lx(&self, sensor: &Sensor, random: &mut Xoshiro) -> f64 {
        let mut vertex = self.vertex(sensor.position, sensor.normal, PI, 0);
        let mut lx = 0.0;
        loop {
            if vertex.bounces > 0 {
                lx += self.light_of_points(&vertex, random);
            }
            lx += self.light_of_emitters(&vertex, random);
            let direction = self.sample(&vertex, random);
            let cos = direction.dot(vertex.normal);
            if cos <= 0.0 {
                return lx;
            }
            let pdf = self.pdf(&vertex, direction);
            let Some(arrival) = self.follow(vertex.position, direction) else {
                return lx;
            };
            let beta = vertex.beta * cos * FRAC_1_PI / pdf * arrival.reflected;
            lx += beta * self.emission(&arrival, pdf);
            match self.next_vertex(&arrival, beta, vertex.bounces + 1, random) {
                Some(next) => vertex = next,
                None => return lx,
            }
        }
    }

    /// What all point lights give directly, in lx.
    pub(crate) fn direct_point_lx(&self, sensor: &Sensor) -> f64 {
        let vertex = self.vertex(sensor.position, sensor.normal, PI, 0);
        let lights = self.scene.lights.iter();
        lights.map(|light| self.lit_by(&vertex, light)).sum()
    }

    fn vertex(&self, position: DVec3, normal: DVec3, beta: f64, bounces: u32) -> Vertex {
        let hints = &self.scene.hints;
        let seen: Vec<usize> =
            (0..hints.len()).filter(|&h| hints[h].is_seen(position, normal)).collect();
        let hint_share = if seen.is_empty() { 0.0 } else { self.scene.share_of_hints(bounces) };
        Vertex { position, normal, beta, bounces, hint_share, hints: seen }
    }

    /// A direction of the mixture; it may go below the horizon, where there is nothing.
    fn sample(&self, vertex: &Vertex, random: &mut Xoshiro) -> DVec3 {
        let choice = random.uniform();
        let uv = [random.uniform(), random.uniform()];
        if choice < vertex.hint_share {
            let number = (choice / vertex.hint_share * vertex.hints.len() as f64) as usize;
            let hint = &self.scene.hints[vertex.hints[number.min(vertex.hints.len() - 1)]];
            return hint.sample(vertex.position, uv);
        }
        let radius = uv[0].sqrt();
        let (sin, cos) = libm::sincos(TAU * uv[1]);
        let (s, t) = vertex.normal.any_orthonormal_pair();
        let height = (1.0 - uv[0]).max(0.0).sqrt();
        (s * (radius * cos) + t * (radius * sin) + vertex.normal * height).normalize()
    }

    /// Its density in solid angle.
    fn pdf(&self, vertex: &Vertex, direction: DVec3) -> f64 {
        let cosine = direction.dot(vertex.normal).max(0.0) * FRAC_1_PI;
        if vertex.hint_share == 0.0 {
            return cosine;
        }
        let pdf = |&number: &usize| self.scene.hints[number].pdf(vertex.position, direction);
        let hints = vertex.hints.iter().map(pdf).sum::<f64>() / vertex.hints.len() as f64;
        (1.0 - vertex.hint_share) * cosine + vertex.hint_share * hints
    }

    /// Goes on over mirrors to what is none.
    fn follow(&self, origin: DVec3, direction: DVec3) -> Option<Arrival> {
        let (nearest_m, farthest_m) = (GAP_M, f64::INFINITY);
        let mut ray = Ray { origin, direction, nearest_m, farthest_m };
        let mut reflected = 1.0;
        for mirrors in 0..MAX_MIRRORS {
            let hit = self.tree.nearest(&self.scene.triangles, ray)?;
            let triangle = &self.scene.triangles[hit.triangle];
            let Surface::Mirror { reflectance } = triangle.surface else {
                return Some(Arrival { ray, hit, reflected, has_mirrors: mirrors > 0 });
            };
            reflected *= reflectance;
            let n = triangle.double_area().normalize();
            ray.origin += ray.direction * hit.distance_m;
            ray.direction -= n * (2.0 * ray.direction.dot(n));
        }
        None
    }

    /// The luminance met, weighed against next-event estimation, which knows no mirrors.
    fn emission(&self, arrival: &Arrival, pdf: f64) -> f64 {
        let triangle = &self.scene.triangles[arrival.hit.triangle];
        let cos = -arrival.ray.direction.dot(triangle.double_area().normalize());
        if triangle.luminance_cd_m2 == 0.0 || cos <= 0.0 {
            return 0.0;
        }
        if arrival.has_mirrors {
            return triangle.luminance_cd_m2;
        }
        let distance = arrival.hit.distance_m;
        let pdf_of_light = self.pdf_per_m2[arrival.hit.triangle] * distance * distance / cos;
        triangle.luminance_cd_m2 * pdf / (pdf + pdf_of_light)
    }

    /// The next vertex, unless the path is absorbed.
    fn next_vertex(
        &self,
        arrival: &Arrival,
        beta: f64,
        bounces: u32,
        random: &mut Xoshiro,
    ) -> Option<Vertex> {
        let triangle = &self.scene.triangles[arrival.hit.triangle];
        let Surface::Grey { reflectance, two_sided } = triangle.surface else {
            return None;
        };
        let front = triangle.double_area().normalize();
        let is_front = front.dot(arrival.ray.direction) < 0.0;
        if reflectance == 0.0 || !(is_front || two_sided) {
            return None;
        }
        let position = arrival.ray.origin + arrival.ray.direction * arrival.hit.distance_m;
        let normal = if is_front { front } else { -front };
        let mut vertex = self.vertex(position, normal, beta * reflectance, bounces);
        let survival = if bounces <= SURE_BOUNCES {
            1.0
        } else {
            // Weights of cosine directions grow by 1 / (1 - share): the square of the reflectance
            // keeps the second moment of long paths finite.
            vertex.hint_share = vertex.hint_share.min(1.0 - reflectance * reflectance);
            let [least, most] = SURVIVAL;
            (reflectance / (1.0 - vertex.hint_share)).clamp(least, most)
        };
        if random.uniform() >= survival {
            return None;
        }
        vertex.beta /= survival;
        Some(vertex)
    }

    /// Next-event estimation of point lights: of all, or of one in proportion to what it gives
    /// without shadows.
    fn light_of_points(&self, vertex: &Vertex, random: &mut Xoshiro) -> f64 {
        let lights = &self.scene.lights;
        if lights.len() <= ASK_ALL {
            return lights.iter().map(|light| self.lit_by(vertex, light)).sum();
        }
        let all: f64 = lights.iter().map(|light| unshadowed(vertex, light)).sum();
        let mut left = random.uniform() * all;
        for light in lights {
            let own = unshadowed(vertex, light);
            if own > 0.0 && left < own {
                return if self.sees(vertex, light.position) { all } else { 0.0 };
            }
            left -= own;
        }
        0.0
    }

    fn lit_by(&self, vertex: &Vertex, light: &PointLight) -> f64 {
        let lx = unshadowed(vertex, light);
        if lx > 0.0 && self.sees(vertex, light.position) { lx } else { 0.0 }
    }

    fn sees(&self, vertex: &Vertex, place: DVec3) -> bool {
        let to = place - vertex.position;
        let distance = to.length();
        let ray = Ray {
            origin: vertex.position,
            direction: to / distance,
            nearest_m: GAP_M,
            farthest_m: distance - GAP_M,
        };
        !self.tree.blocks(&self.scene.triangles, ray)
    }

    /// Next-event estimation of emitting triangles, weighed against directions of the mixture.
    fn light_of_emitters(&self, vertex: &Vertex, random: &mut Xoshiro) -> f64 {
        if self.emitters.is_empty() {
            return 0.0;
        }
        let choice = random.uniform();
        let number = self.emitters.partition_point(|emitter| emitter.flux_up_to <= choice);
        let number = self.emitters[number.min(self.emitters.len() - 1)].triangle;
        let triangle = &self.scene.triangles[number];
        let root = random.uniform().sqrt();
        let along = random.uniform();
        let [a, b, c] = triangle.corners;
        let place = a * (1.0 - root) + b * (root * (1.0 - along)) + c * (root * along);
        let to = place - vertex.position;
        let square = to.length_squared();
        let direction = to / square.sqrt();
        let cos = direction.dot(vertex.normal);
        let cos_of_light = -direction.dot(triangle.double_area().normalize());
        if cos <= 0.0 || cos_of_light <= 1e-12 || !self.sees(vertex, place) {
            return 0.0;
        }
        let pdf_of_light = self.pdf_per_m2[number] * square / cos_of_light;
        let pdf = pdf_of_light + self.pdf(vertex, direction);
        vertex.beta * cos * FRAC_1_PI * triangle.luminance_cd_m2 / pdf
    }
}

/// What a point light gives to a path, shadows left out.
fn unshadowed(vertex: &Vertex, light: &PointLight) -> f64 {
    let to = light.position - vertex.position;
    let cos_times_distance = to.dot(vertex.normal);
    if cos_times_distance <= 0.0 {
        return 0.0;
    }
    let square = to.length_squared();
    let distance = square.sqrt();
    let intensity_cd = light.intensity_cd(to / -distance);
    vertex.beta * FRAC_1_PI * intensity_cd * cos_times_distance / (square * distance)
}
