//! Where a path or a walk turns: a sensor, a light, a surface that scatters.
//!
//! Directions are drawn from a mixture of what suits the vertex and of lookouts, and weighed by the
//! density of the whole mixture (one-sample balance heuristic, Veach and Guibas 1995): lookouts
//! change the error and never the mean.

use crate::emission::Emission;
use crate::hint::Lookout;
use crate::light::PointLight;
use crate::metal::Metal;
use crate::random::Xoshiro;
use glam::DVec3;
use std::f64::consts::{FRAC_1_PI, TAU};

/// What a vertex does with light.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Scatter<'a> {
    /// Takes light from the side of the normal by its cosine: a sensor. An even light gives it so.
    Cosine,
    /// Reflects matt.
    Matt { reflectance: f64 },
    /// Reflects and transmits matt.
    Sheet { reflectance: f64, transmittance: f64 },
    /// Reflects as rough metal from a direction `wo` that points away.
    Metal { metal: &'a Metal, wo: DVec3 },
    /// Shines.
    Lamp { light: &'a PointLight, emission: &'a Emission },
}

/// Which lookouts directions go to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Looking<'a> {
    pub(crate) at: &'a [Lookout],
    /// The share of directions that go there.
    pub(crate) share: f64,
}

/// A vertex.
#[derive(Clone, Debug)]
pub(crate) struct Vertex<'a> {
    pub(crate) position: DVec3,
    /// Unit normal on the side that light came to; the aim of a lamp.
    pub(crate) normal: DVec3,
    pub(crate) scatter: Scatter<'a>,
    looking: Looking<'a>,
    /// Numbers of lookouts that are seen.
    seen: Vec<usize>,
}

impl<'a> Scatter<'a> {
    /// Whether something goes to the side of the normal alone.
    const fn is_one_sided(&self) -> bool {
        matches!(self, Self::Cosine | Self::Matt { .. } | Self::Metal { .. })
    }

    /// The share of light that goes on, by which walks survive.
    pub(crate) fn kept(&self) -> f64 {
        match self {
            Self::Cosine | Self::Lamp { .. } => 1.0,
            Self::Matt { reflectance } => *reflectance,
            Self::Sheet { reflectance, transmittance } => reflectance + transmittance,
            Self::Metal { metal, .. } => metal.most_kept(),
        }
    }
}

impl<'a> Vertex<'a> {
    pub(crate) fn new(
        position: DVec3,
        normal: DVec3,
        scatter: Scatter<'a>,
        looking: Looking<'a>,
    ) -> Self {
        let horizon = scatter.is_one_sided().then_some(normal);
        let is_seen = |&number: &usize| looking.at[number].is_seen(position, horizon);
        let seen: Vec<usize> = if looking.share > 0.0 {
            (0..looking.at.len()).filter(is_seen).collect()
        } else {
            Vec::new()
        };
        let share = if seen.is_empty() { 0.0 } else { looking.share };
        Self { position, normal, scatter, looking: Looking { share, ..looking }, seen }
    }

    pub(crate) const fn share(&self) -> f64 {
        self.looking.share
    }

    /// Sends fewer directions to the lookouts.
    pub(crate) const fn limit_share(&mut self, most: f64) {
        self.looking.share = self.looking.share.min(most);
    }

    /// What the vertex does with light of a unit direction, its cosine included: 1 times the cosine
    /// at a sensor, `f cos` in sr^-1 at a surface, the intensity of a lamp in cd.
    pub(crate) fn value(&self, direction: DVec3) -> f64 {
        let cos = direction.dot(self.normal);
        match self.scatter {
            Scatter::Cosine => cos.max(0.0),
            Scatter::Matt { reflectance } => reflectance * FRAC_1_PI * cos.max(0.0),
            Scatter::Sheet { reflectance, transmittance } => {
                let share = if cos > 0.0 { reflectance } else { transmittance };
                share * FRAC_1_PI * cos.abs()
            }
            Scatter::Metal { metal, wo } => metal.value(self.normal, wo, direction),
            Scatter::Lamp { light, .. } => light.intensity_cd(direction),
        }
    }

    /// A direction of the mixture; it may go where nothing comes from.
    pub(crate) fn sample(&self, random: &mut Xoshiro) -> DVec3 {
        let choice = random.uniform();
        if choice < self.looking.share {
            let number = (choice / self.looking.share * self.seen.len() as f64) as usize;
            let lookout = &self.looking.at[self.seen[number.min(self.seen.len() - 1)]];
            return lookout.sample(self.position, [random.uniform(), random.uniform()]);
        }
        match self.scatter {
            Scatter::Cosine | Scatter::Matt { .. } => cosine(self.normal, random),
            Scatter::Sheet { reflectance, transmittance } => {
                let is_reflected = random.uniform() * (reflectance + transmittance) < reflectance;
                cosine(if is_reflected { self.normal } else { -self.normal }, random)
            }
            Scatter::Metal { metal, wo } => metal.sample(self.normal, wo, random),
            Scatter::Lamp { light, emission } => emission.sample(light.aim, random),
        }
    }

    /// Its density in solid angle.
    pub(crate) fn pdf(&self, direction: DVec3) -> f64 {
        let cos = direction.dot(self.normal);
        let own = match self.scatter {
            Scatter::Cosine | Scatter::Matt { .. } => cos.max(0.0) * FRAC_1_PI,
            Scatter::Sheet { reflectance, transmittance } => {
                let share = if cos > 0.0 { reflectance } else { transmittance };
                share / (reflectance + transmittance) * cos.abs() * FRAC_1_PI
            }
            Scatter::Metal { metal, wo } => metal.pdf(self.normal, wo, direction),
            Scatter::Lamp { light, emission } => emission.pdf(light.aim, direction),
        };
        if self.looking.share == 0.0 {
            return own;
        }
        let pdf = |&number: &usize| self.looking.at[number].pdf(self.position, direction);
        let looked = self.seen.iter().map(pdf).sum::<f64>() / self.seen.len() as f64;
        (1.0 - self.looking.share) * own + self.looking.share * looked
    }
}

/// A direction about a normal, density cos / pi.
pub(crate) fn cosine(normal: DVec3, random: &mut Xoshiro) -> DVec3 {
    let square = random.uniform();
    let radius = square.sqrt();
    let (sin, cos) = libm::sincos(TAU * random.uniform());
    let (s, t) = normal.any_orthonormal_pair();
    let height = (1.0 - square).max(0.0).sqrt();
    (s * (radius * cos) + t * (radius * sin) + normal * height).normalize()
}
