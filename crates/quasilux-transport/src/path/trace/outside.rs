//! Light from outside on a path: asked for at its vertices, and found where it leaves the scene.
//!
//! What comes to a vertex straight or through panes is no matter of maps: the vertex asks for it,
//! and paths that end on a map still go on through panes for their share of it.

use super::{ContinuationWeights, Path, PathWork};
use crate::bsdf::{Bsdf, BsdfSample};
use crate::context::Context;
use crate::lights::{Asking, OnwardDirection, OutsideLight, SunSample};
use crate::path::daylight::{Daylight, DaylightSearch, OutsideSource};
use crate::purpose::Purpose;
use crate::spectrum::Spectrum;
use crate::world::frame::Frame;
use crate::world::vertex::{Surface, Vertex};
use crate::world::{Interaction, RayOrigin};
use glam::DVec3;
use quasilux_sampling::Sampler;
use quasilux_sampling::warp::sample_cosine_hemisphere;
use std::f64::consts::{FRAC_1_PI, PI};

/// How a vertex asked for light along the direction in which the path left it.
#[derive(Clone, Copy)]
pub(super) struct AskedOutside {
    place: Asking,
    /// Density in sr^-1 of the direction.
    pdf_sr: f64,
}

/// Factors on light from outside: on what the ray finds, and on what it would past panes.
#[derive(Clone, Copy)]
pub(super) struct OutsideFactors<S> {
    pub(super) here: S,
    pub(super) past_panes: S,
}

impl<S: Spectrum> OutsideFactors<S> {
    /// After a surface that sends on the part `weight`, in all `beta`; `is_straight` where it is a
    /// pane that let the path through.
    pub(super) fn after(
        self,
        beta: S,
        weight: S,
        onward: &ContinuationWeights,
        is_straight: bool,
    ) -> Self {
        if is_straight {
            let past_panes = self.past_panes * weight * onward.past_panes;
            Self { here: past_panes, past_panes }
        } else {
            Self { here: beta * onward.emitted, past_panes: beta * onward.past_panes }
        }
    }
}

/// Whether light goes straight through.
pub(super) fn is_pane<S: Spectrum>(bsdf: &Bsdf<S>) -> bool {
    bsdf.is_specular() && bsdf.straight_transmittance(1.0).is_some()
}

impl AskedOutside {
    /// `None` where nothing is outside.
    pub(super) fn new<S: Spectrum>(
        context: &Context<'_, S>,
        vertex: &Vertex<'_, S>,
        pdf_sr: f64,
    ) -> Option<Self> {
        let place = Asking::at(vertex);
        context.lights.outside.as_ref().map(|_| Self { place, pdf_sr })
    }
}

/// The share of paths that leave their start through the openings, as if they asked there for light
/// from outside. Of what shines back from beyond them, facades and reveals, cosine-distributed
/// directions find little where openings are small. All others lose no more than this share, and
/// no contribution grows by more than a ninth.
const SHARE_THROUGH_OPENINGS: f64 = 0.1;
/// Share of paths that leave their start through the openings where they seek nothing but what is
/// beyond them: the most, for they may be others than those that are known.
const SHARE_OF_SEARCH: f64 = 0.75;

/// The share of paths with that search that leave their start through openings.
fn onward_share(search: Option<&DaylightSearch<'_>>) -> f64 {
    let is_search = search.is_some_and(|search| search.only_from_beyond);
    if is_search { SHARE_OF_SEARCH } else { SHARE_THROUGH_OPENINGS }
}

/// The most in lx that a path with that search finds where it runs into what is outside, of 1
/// cd/m2: beside openings directions are drawn so much less often, and no surface sends on more
/// than it gets.
pub(crate) fn most_of_a_path_lx(outside: &OutsideLight<'_>, search: &DaylightSearch<'_>) -> f64 {
    let share = if outside.has_portals() { onward_share(Some(search)) } else { 0.0 };
    PI / (1.0 - share)
}

/// The direction in which a path leaves a sensor point with the side `n`. Its density counts for
/// light from outside; where other light is weighed, the direction passes for cosine-distributed in
/// all ways to find it, so that their weights still sum up to one.
pub(super) fn first_direction<S: Spectrum>(
    context: &Context<'_, S>,
    from: RayOrigin,
    n: DVec3,
    search: Option<&DaylightSearch<'_>>,
    u: [f64; 2],
) -> OnwardDirection {
    let outside = context.lights.outside.as_ref();
    if let Some(outside) = outside.filter(|outside| outside.has_portals()) {
        let place = Asking::at(&Vertex::<S>::sensor(from, n));
        let nothing = OnwardDirection { direction: n, pdf_sr: 1.0, weight: 0.0 };
        return outside.sample_onward(place, n, onward_share(search), u).unwrap_or(nothing);
    }
    let first = DVec3::from_array(sample_cosine_hemisphere(u));
    let direction = Frame::around(n).to_world(first);
    OnwardDirection { direction, pdf_sr: first.z * FRAC_1_PI, weight: PI }
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
        let surface = self.last.bounces_asked;
        if outside.is_asked_for() {
            let purpose = Purpose::Opening { surface };
            let u = context.draw(&mut self.sampler, purpose, Sampler::next_2d);
            let search = self.daylight.as_ref().map(|daylight| &daylight.search);
            let share = if vertex.is_sensor() { onward_share(search) } else { 0.0 };
            let sample = outside.light_sample(vertex, share, u);
            if let (Some(daylight), Some(sample)) = (&mut self.daylight, &sample) {
                let source = OutsideSource::Outside(sample.direction);
                daylight.note_asked(source, vertex.reflects(sample.direction));
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
        let purpose = Purpose::Sun { surface: self.last.bounces_asked };
        let u = context.draw(&mut self.sampler, purpose, Sampler::next_1d);
        let PathWork { shadows, suns, .. } = work;
        daylight.search.suns.samples(outside, vertex, u, suns, |sample| {
            let SunSample { sun, place, light_sample } = sample;
            let is_reflected = vertex.reflects(light_sample.direction);
            daylight.note_asked(OutsideSource::Sun(sun, place), is_reflected);
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
        let is_straight = |_: &AskedOutside| is_pane(surface.bsdf) && next.wi.z < 0.0;
        self.last.asked_outside = match next.pdf_sr {
            Some(pdf_sr) => {
                let vertex = Vertex::on(&context.world, at, surface, self.beta.all);
                AskedOutside::new(context, &vertex, pdf_sr)
            }
            None => self.last.asked_outside.filter(is_straight),
        };
    }

    /// Notes the named openings on its way to a surface, where it matters what is beyond them.
    pub(super) fn note_openings(&mut self, context: &Context<'_, S>, at: &Interaction) {
        let Self { from, direction, daylight, .. } = self;
        if let (Some(outside), Some(daylight)) = (&context.lights.outside, daylight)
            && daylight.search.only_from_beyond
            && outside.names_openings()
        {
            // An opening in a pane is passed when the path goes on from there.
            let rounding = *direction * context.world.hair_m();
            let way = [from.position() - rounding, at.position - rounding];
            if outside.opens(way) {
                daylight.pass_opening();
            }
        }
    }

    /// Notes on which side of a surface it goes on. Sheets are the openings where none are named.
    pub(super) fn note_side(&mut self, context: &Context<'_, S>, next: &BsdfSample<S>) {
        let Some(daylight) = &mut self.daylight else { return };
        if next.wi.z > 0.0 {
            daylight.reflect();
        } else if context.lights.outside.as_ref().is_some_and(|it| !it.names_openings()) {
            daylight.pass_opening();
        }
    }

    /// Whether anything that a surface sends counts: of some paths not what it reflects.
    pub(super) fn may_count(&self, bsdf: &Bsdf<S>) -> bool {
        !self.daylight.as_ref().is_some_and(Daylight::leaves_reflected) || bsdf.lets_through()
    }

    /// Adds what it finds where it leaves the scene.
    pub(super) fn add_outside(&mut self, context: &Context<'_, S>, bounces: u32) {
        let Some(outside) = &context.lights.outside else { return };
        let mut found_cd_m2 = outside.luminance_cd_m2(self.direction);
        match self.last.asked_outside {
            Some(AskedOutside { place, pdf_sr }) => {
                let ratio = outside.pdf_sr(place, self.direction) / pdf_sr;
                found_cd_m2 /= 1.0 + ratio * ratio;
            }
            // Nobody can have asked for the sun along this way.
            None => found_cd_m2 += outside.sun_cd_m2(self.direction),
        }
        let light = self.beta.outside.here * found_cd_m2;
        if let Some(daylight) = &self.daylight {
            let source = match self.last.asked_outside {
                Some(_) => OutsideSource::Outside(self.direction),
                None => OutsideSource::Mirrored(self.direction),
            };
            self.light.found.from_outside.push(daylight.found(source, light.luminance()));
            return;
        }
        self.light.found.add(bounces, light);
    }

    /// Throughput of the path to a surface: where it has ended on a map, of light from outside past
    /// panes alone.
    pub(super) fn carried(&self, bsdf: &Bsdf<S>) -> S {
        let has_ended = self.beta.all.max_channel() == 0.0 && is_pane(bsdf);
        if has_ended { self.beta.outside.past_panes } else { self.beta.all }
    }
}
