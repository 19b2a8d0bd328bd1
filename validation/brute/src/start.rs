//! Where walks from the lights start.
//!
//! A light is chosen half by its flux and half evenly, so that faint lights are not forgotten.
//! Walks from outside start along lines through the openings. With directions of density `q` and a
//! place on one of the openings, each chosen by projected area and all places of it alike, the
//! density of a line per projected area is `q / (sum of projected areas)` times the number of
//! openings that it crosses.

use crate::hint::Lookout;
use crate::random::Xoshiro;
use crate::scene::Source;
use crate::sky::{Sky, Sun};
use crate::vertex::{Looking, Scatter, Vertex, cosine};
use crate::world::World;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// The sources of a world, each with the probability of being chosen.
pub(crate) struct Starts {
    chosen: Vec<Choice>,
}

/// A source that may be chosen.
#[derive(Clone, Copy)]
struct Choice {
    source: Source,
    probability: f64,
}

/// How a walk starts.
pub(crate) enum Start<'a> {
    /// At a light in the scene: luminous flux over probability is `weight` times the value of the
    /// vertex over the density of the direction.
    Within { vertex: Vertex<'a>, weight: f64 },
    /// From outside with this many lm.
    Outside { origin: DVec3, direction: DVec3, flux_lm: f64 },
}

impl Starts {
    pub(crate) fn new(world: &World) -> Self {
        let choice = |source| Choice { source, probability: world.flux_lm(source) };
        let mut chosen: Vec<Choice> = world.scene.sources().into_iter().map(choice).collect();
        chosen.retain(|it| it.probability > 0.0);
        let all_lm: f64 = chosen.iter().map(|it| it.probability).sum();
        let even = 0.5 / chosen.len() as f64;
        chosen.iter_mut().for_each(|it| it.probability = 0.5 * it.probability / all_lm + even);
        Self { chosen }
    }

    /// A light, and the probability that it is chosen; none where all is dark.
    fn choose(&self, random: &mut Xoshiro) -> Option<Choice> {
        let mut left = random.uniform();
        for choice in &self.chosen {
            if left < choice.probability {
                return Some(*choice);
            }
            left -= choice.probability;
        }
        self.chosen.last().copied()
    }

    pub(crate) fn draw<'w>(&self, world: &'w World<'_>, random: &mut Xoshiro) -> Option<Start<'w>> {
        let Choice { source, probability } = self.choose(random)?;
        let mut start = match source {
            Source::Light(number) => {
                let light = &world.scene.lights[number];
                let scatter = Scatter::Lamp { light, emission: &world.emissions[number] };
                let vertex = Vertex::new(light.position, light.aim, scatter, world.aims());
                Some(Start::Within { vertex, weight: 1.0 })
            }
            Source::Emitters => {
                let number = world.choose_emitter(random);
                let triangle = &world.scene.triangles[number];
                let place = triangle.place(random);
                let normal = triangle.double_area().normalize();
                let vertex = Vertex::new(place, normal, Scatter::Cosine, world.aims());
                let weight = triangle.luminance_cd_m2 / world.pdf_per_m2[number];
                Some(Start::Within { vertex, weight })
            }
            Source::Sky => world.scene.sky.and_then(|sky| world.start_of_sky(&sky, random)),
            Source::Sun => world.scene.sun.and_then(|sun| world.start_of_sun(&sun, random)),
        }?;
        match &mut start {
            Start::Within { weight, .. } => *weight /= probability,
            Start::Outside { flux_lm, .. } => *flux_lm /= probability,
        }
        Some(start)
    }
}

impl<'a> World<'a> {
    pub(crate) fn aims(&self) -> Looking<'a> {
        Looking { at: &self.scene.aims, share: self.scene.aim_share }
    }

    /// The flux of a source, or what of it comes in about.
    fn flux_lm(&self, source: Source) -> f64 {
        let openings = &self.scene.openings;
        let area = |cos: &dyn Fn(DVec3) -> f64| openings.iter().map(|it| cos(it.area())).sum();
        let around_m2 = PI * self.radius_m * self.radius_m;
        match source {
            Source::Light(number) => self.emissions[number].flux_lm,
            Source::Emitters => self.emitted_lm,
            Source::Sky => {
                let Some(sky) = self.scene.sky else { return 0.0 };
                let mean = 0.5 * (sky.zenith_luminance_cd_m2 + sky.ground_luminance_cd_m2);
                let areas_m2: f64 = area(&|n| n.length());
                mean * PI * if openings.is_empty() { 4.0 * around_m2 } else { areas_m2 }
            }
            Source::Sun => {
                let Some(sun) = self.scene.sun else { return 0.0 };
                let areas_m2: f64 = area(&|n| n.dot(sun.direction).max(0.0));
                sun.normal_illuminance_lx * if openings.is_empty() { around_m2 } else { areas_m2 }
            }
        }
    }

    fn start_of_sky(&self, sky: &Sky, random: &mut Xoshiro) -> Option<Start<'a>> {
        let openings = &self.scene.openings;
        if openings.is_empty() {
            let z = 2.0 * random.uniform() - 1.0;
            let (sin, cos) = libm::sincos(TAU * random.uniform());
            let radius = ((1.0 - z) * (1.0 + z)).max(0.0).sqrt();
            let toward = DVec3::new(radius * cos, radius * sin, z);
            let spread = 4.0 * PI * sky.luminance_cd_m2(toward);
            return Some(self.around(toward, spread, random));
        }
        let all: f64 = openings.iter().map(|opening| opening.area().length()).sum();
        let opening = chosen(openings, |opening| opening.area().length(), random)?;
        let toward = cosine(opening.area().normalize(), random);
        let place = opening.place([random.uniform(), random.uniform()]);
        // q is cos / pi, by which the projected area grows again.
        let flux_lm = PI * all * sky.luminance_cd_m2(toward) / self.crossed(place, toward);
        Some(self.start_far_off(place, toward, flux_lm))
    }

    fn start_of_sun(&self, sun: &Sun, random: &mut Xoshiro) -> Option<Start<'a>> {
        let openings = &self.scene.openings;
        let toward = sun.sample(random);
        let spread = sun.luminance_cd_m2() * Sun::solid_angle_sr();
        if openings.is_empty() {
            return Some(self.around(toward, spread, random));
        }
        let area = |opening: &Lookout| opening.area().dot(toward).max(0.0);
        let all: f64 = openings.iter().map(area).sum();
        let place = chosen(openings, area, random)?.place([random.uniform(), random.uniform()]);
        let flux_lm = spread * all / self.crossed(place, toward);
        Some(self.start_far_off(place, toward, flux_lm))
    }

    /// How many openings a line comes in through.
    fn crossed(&self, place: DVec3, toward: DVec3) -> f64 {
        let comes_in = |opening: &&Lookout| {
            opening.area().dot(toward) > 0.0 && opening.crossing_m(place, toward).is_some()
        };
        // The line was drawn through one, whatever rounding says.
        (self.scene.openings.iter().filter(comes_in).count() as f64).max(1.0)
    }

    /// A line across a disc as wide as the scene; `spread` is luminance over the density of
    /// directions.
    fn around(&self, toward: DVec3, spread: f64, random: &mut Xoshiro) -> Start<'a> {
        let radius = self.radius_m * random.uniform().sqrt();
        let (sin, cos) = libm::sincos(TAU * random.uniform());
        let (s, t) = toward.any_orthonormal_pair();
        let place = self.middle + s * (radius * cos) + t * (radius * sin);
        self.start_far_off(place, toward, spread * PI * self.radius_m * self.radius_m)
    }

    fn start_far_off(&self, place: DVec3, toward: DVec3, flux_lm: f64) -> Start<'a> {
        Start::Outside {
            origin: place + toward * (2.0 * self.radius_m),
            direction: -toward,
            flux_lm,
        }
    }
}

/// One opening in proportion to a measure of it.
fn chosen(
    openings: &[Lookout],
    measure: impl Fn(&Lookout) -> f64,
    random: &mut Xoshiro,
) -> Option<Lookout> {
    let mut left = random.uniform() * openings.iter().map(&measure).sum::<f64>();
    for opening in openings.iter().filter(|opening| measure(opening) > 0.0) {
        left -= measure(opening);
        if left < 0.0 {
            return Some(*opening);
        }
    }
    openings.iter().rfind(|opening| measure(opening) > 0.0).copied()
}
