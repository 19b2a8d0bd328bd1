//! Light from outside on a path: asked for at its vertices, and found where it leaves the scene.

use super::{Path, PathWork};
use crate::bsdf::BsdfSample;
use crate::context::Context;
use crate::lights::{Asking, SunSample};
use crate::path::daylight::{FromOutside, Whence};
use crate::purpose::Purpose;
use crate::spectrum::Spectrum;
use crate::world::Interaction;
use crate::world::vertex::{Surface, Vertex};
use quasilux_sampling::Sampler;

/// How a vertex asked for light along the direction in which the path left it.
#[derive(Clone, Copy)]
pub(super) struct AskedOutside {
    place: Asking,
    /// Density in sr^-1 of the direction.
    pdf_sr: f64,
}

impl AskedOutside {
    /// `None` where nothing is outside.
    pub(super) fn new<S: Spectrum>(
        context: &Context<'_, S>,
        vertex: &Vertex<'_, S>,
        pdf_sr: f64,
    ) -> Option<Self> {
        context.lights.outside.as_ref().map(|_| Self { place: Asking::at(vertex), pdf_sr })
    }
}

impl<S: Spectrum> Path<'_, S> {
    /// Asks for what comes through one point of the openings or from a bright pixel, and from one
    /// point of the sun.
    pub(super) fn sample_direct_outside(
        &mut self,
        context: &Context<'_, S>,
        vertex: &Vertex<'_, S>,
        work: &mut PathWork<S>,
    ) {
        let Some(outside) = &context.lights.outside else { return };
        let surface = self.bounces_asked;
        if outside.is_asked_for() {
            let purpose = Purpose::Opening { surface };
            let u = context.draw(&mut self.sampler, purpose, Sampler::next_2d);
            let sample = outside.light_sample(vertex, u);
            if let (Some(daylight), Some(sample)) = (&mut self.daylight, &sample) {
                daylight.note_asked(Whence::Outside(sample.direction));
            }
            self.ask(sample, vertex, work);
        }
        self.sample_direct_suns(context, vertex, work);
        if outside.has_sun() {
            let purpose = Purpose::Sun { surface };
            let u = context.draw(&mut self.sampler, purpose, Sampler::next_2d);
            self.ask(outside.sun_sample(vertex, u), vertex, work);
        }
    }

    /// Asks for some of the suns at a surface: who keeps light apart by direction knows what they
    /// give straight to a sensor.
    fn sample_direct_suns(
        &mut self,
        context: &Context<'_, S>,
        vertex: &Vertex<'_, S>,
        work: &mut PathWork<S>,
    ) {
        let (Some(outside), Some(daylight)) = (&context.lights.outside, &mut self.daylight) else {
            return;
        };
        if vertex.is_sensor() {
            return;
        }
        let purpose = Purpose::Sun { surface: self.bounces_asked };
        let u = context.draw(&mut self.sampler, purpose, Sampler::next_1d);
        let PathWork { shadows, suns, .. } = work;
        daylight.suns.samples(outside, vertex, u, suns, |SunSample { sun, light_sample }| {
            daylight.note_asked(Whence::Sun(sun));
            shadows.ask(self.number, vertex, &light_sample);
        });
    }

    /// Notes how the vertex that it leaves asked along its new direction: panes that let it
    /// straight through change nothing.
    pub(super) fn note_asked_outside(
        &mut self,
        context: &Context<'_, S>,
        at: &Interaction,
        surface: &Surface<'_, S>,
        next: &BsdfSample<S>,
    ) {
        let is_straight = |_: &AskedOutside| {
            let is_pane = context.world.bsdf(at).straight_transmittance(1.0).is_some();
            is_pane && next.wi.z < 0.0
        };
        self.asked_outside = match next.pdf_sr {
            Some(pdf_sr) => {
                let vertex = Vertex::on(&context.world, at, surface, self.beta);
                AskedOutside::new(context, &vertex, pdf_sr)
            }
            None => self.asked_outside.filter(is_straight),
        };
    }

    /// Adds what it finds where it leaves the scene.
    pub(super) fn add_outside(&mut self, context: &Context<'_, S>, bounces: u32) {
        let Some(outside) = &context.lights.outside else { return };
        let mut found_cd_m2 = outside.luminance_cd_m2(self.direction);
        match self.asked_outside {
            Some(AskedOutside { place, pdf_sr }) => {
                let ratio = outside.pdf_sr(place, self.direction) / pdf_sr;
                found_cd_m2 /= 1.0 + ratio * ratio;
            }
            // Nobody can have asked for the sun along this way.
            None => found_cd_m2 += outside.sun_cd_m2(self.direction),
        }
        let light = self.beta_emitted * found_cd_m2;
        if self.daylight.is_some() {
            let whence = match self.asked_outside {
                Some(_) => Whence::Outside(self.direction),
                None => Whence::Mirrored(self.direction),
            };
            self.found.from_outside.push(FromOutside { whence, light: light.luminance() });
        } else {
            self.found.add(bounces, light);
        }
    }
}
