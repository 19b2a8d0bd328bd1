//! Light tracing of one photon: emission, free flights, scattering, splitting and Russian roulette.
//!
//! Photons start with equal flux, but for those from outside, where it is only about equal. At each
//! surface they survive with the probability that keeps their luminance: what is absorbed is
//! absorbed whole, and on grey surfaces the weight never changes (Voloboy, Dmitriev and Kopylov
//! 2003). Only rough surfaces, whose directions cannot be drawn in exact proportion, leave it
//! slightly changed. Photons that are guided ([`crate::importance`]) leave each place with the
//! weight that belongs to it instead, by one or more of them or none; and those that are connected
//! to sensors all leave the first surface, with what absorption leaves. What goes on no more is
//! counted as absorbed, whatever was due: so flux balances exactly, and as it should on average.

use crate::bsdf::TransportMode;
use crate::context::Context;
use crate::cutoff::{Gain, MAX_EVENTS};
use crate::importance::{GuidingTree, Split, WeightWindows};
use crate::lights::images::LightPathClass;
use crate::lights::{Chosen, Emission, Emitted};
use crate::photon::counts::{PhotonCounts, QUANTA_PER_PHOTON};
use crate::photon::lit_cells::{Drawn, LitCells, LitPlace};
use crate::photon::receiver::{Arrival, PhotonReceiver, SeenPhoton};
use crate::purpose::Purpose;
use crate::spectrum::Spectrum;
use crate::stats::tally::checked_quanta;
use crate::world::Interaction;
use crate::world::flight::Flight;
use glam::DVec3;
use quasilux_sampling::Sampler;

/// A photon on its way, but for where it flies.
pub(crate) struct Photon<'p, S> {
    pub(crate) sampler: Sampler<'p>,
    /// Its colour: the flux that it carries, as a share of that of one photon of all lights.
    pub(crate) weight: S,
    pub(crate) path_class: LightPathClass,
    /// Whether it ends where paths find it.
    specular_only: bool,
    /// Bounces behind it before its first flight.
    bounces: u32,
    gain: Gain,
}

/// Where photons begin.
#[derive(Clone, Copy)]
pub(crate) enum Source<'s> {
    /// At the lights.
    Lights,
    /// Where light of the point-like lights lands, and at the lights with an area.
    LitCells(&'s LitCells),
}

/// Where photons begin, and what guides them.
#[derive(Clone, Copy)]
pub(crate) struct PhotonSetup<'s> {
    pub(crate) source: Source<'s>,
    pub(crate) windows: Option<&'s WeightWindows>,
    /// Without weight windows, photons survive for certain down to this weight.
    pub(crate) certain_weight: f64,
}

impl<'s> PhotonSetup<'s> {
    /// Photons that survive by chance at each surface, unless something guides them.
    pub(crate) fn by_chance(source: Source<'s>, windows: Option<&'s WeightWindows>) -> Self {
        Self { source, windows, certain_weight: f64::INFINITY }
    }
}

impl<'s> Source<'s> {
    /// The lights, or lit cells where there are any.
    pub(crate) fn from_lit_cells(lit_cells: Option<&'s LitCells>) -> Self {
        lit_cells.map_or(Source::Lights, Source::LitCells)
    }

    /// Weight of most photons from here, rounded down to a power of two.
    pub(crate) fn usual_weight(self) -> f64 {
        match self {
            Self::Lights => 1.0,
            Self::LitCells(cells) => libm::ldexp(1.0, libm::ilogb(cells.flux_share())),
        }
    }

    /// Counts of photons from here: with their flux only where it is all that the lights emit.
    pub(crate) fn counted(self, counts: PhotonCounts) -> PhotonCounts {
        match self {
            Self::Lights => counts,
            Self::LitCells(_) => counts.apart_from_flux(),
        }
    }
}

/// How a photon begins.
pub(crate) enum Beginning {
    /// With its flight from a light.
    Flies(Emission),
    /// At a place, if light comes there.
    IfLit(LitPlace),
}

/// A photon that is about to fly.
pub(crate) struct Departure<'p, S> {
    pub(crate) photon: Photon<'p, S>,
    pub(crate) start: Emission,
}

/// Traces the photon of one index by itself, with all that it is split into: the slow twin of
/// [`crate::photon::wave::PhotonWave`].
pub(crate) fn trace_photon<'p, S: Spectrum>(
    context: &Context<'_, S>,
    setup: PhotonSetup<'_>,
    sampler: Sampler<'p>,
    receiver: &mut impl PhotonReceiver<S>,
    counts: &mut PhotonCounts,
) {
    let mut photon = Photon::new(sampler).for_receiver(receiver);
    counts.emitted += 1;
    counts.begun += 1;
    let mut generation: Vec<Departure<'p, S>> = Vec::new();
    match photon.begin(context, setup.source, counts) {
        Some(Beginning::Flies(start)) => generation.push(Departure { photon, start }),
        Some(Beginning::IfLit(place)) => {
            counts.rays += 1;
            if !place.is_lit(context) {
                return counts.end(&photon);
            }
            photon.receive(&place);
            photon.scatter(context, setup, &place.arrival(), counts, |next| generation.push(next));
        }
        None => return counts.end(&photon),
    }
    for bounces in 0..MAX_EVENTS {
        let mut next = Vec::new();
        for Departure { photon, start: Emission { from, direction } } in generation {
            counts.rays += 1;
            let found = context.world.trace(from, direction);
            photon.show(context, from.position(), direction, found.as_ref(), bounces, receiver);
            let arrival = Arrival { direction, found: found.as_ref(), bounces, is_drawn: false };
            photon.scatter(context, setup, &arrival, counts, |departure| next.push(departure));
        }
        if next.is_empty() {
            return;
        }
        generation = next;
    }
    generation.iter().for_each(|departure| counts.give_up(&departure.photon));
}

/// A place that photons leave from again.
#[derive(Clone, Copy)]
struct ScatteringPoint<'a> {
    at: &'a Interaction,
    /// Where the light came from.
    wo: DVec3,
    guide: Option<&'a GuidingTree>,
}

impl<'p, S: Spectrum> Photon<'p, S> {
    /// The photon that takes its coordinates from `sampler`.
    pub(crate) fn new(sampler: Sampler<'p>) -> Self {
        Self {
            sampler,
            weight: S::white(),
            path_class: LightPathClass::Found,
            specular_only: false,
            bounces: 0,
            gain: Gain::NONE,
        }
    }

    /// The photon as a receiver wants it.
    pub(crate) fn for_receiver<R: PhotonReceiver<S>>(self, _: &R) -> Self {
        Self { specular_only: R::SPECULAR_ONLY, ..self }
    }

    /// Draws its beginning; `None` where nothing emits, where what was drawn carries nothing, or
    /// where no light can land. Counts what it carries less than a photon of all lights, or more.
    pub(crate) fn begin(
        &mut self,
        context: &Context<'_, S>,
        source: Source<'_>,
        counts: &mut PhotonCounts,
    ) -> Option<Beginning> {
        let begins = self.draw_beginning(context, source);
        let carried = if begins.is_some() { self.quanta() } else { Some(0) };
        // NaN is refused where it lands.
        counts.withheld += QUANTA_PER_PHOTON as i64 - carried.unwrap_or(0);
        begins
    }

    fn draw_beginning(
        &mut self,
        context: &Context<'_, S>,
        source: Source<'_>,
    ) -> Option<Beginning> {
        let lights = &context.lights;
        let Emitted { emission, path_class, share, .. } = match source {
            Source::Lights => lights.emit(&context.world, context.purposes, &mut self.sampler)?,
            Source::LitCells(cells) => match cells.draw(context, &mut self.sampler)? {
                Drawn::Place(place) => return Some(Beginning::IfLit(place)),
                Drawn::Light { number, u, flux_share } => {
                    self.weight = S::white() * flux_share;
                    let chosen = Chosen { number, u };
                    lights.emit_from(chosen, &context.world, context.purposes, &mut self.sampler)?
                }
            },
        };
        self.path_class = path_class;
        if share != 1.0 {
            self.weight = self.weight * share;
        }
        Some(Beginning::Flies(emission))
    }

    /// Takes the light that comes to a place.
    pub(crate) fn receive(&mut self, place: &LitPlace) {
        self.path_class = LightPathClass::Shown(place.light);
        self.weight = S::white() * place.flux_share;
    }

    /// Shows a flight to the receiver, and where it landed.
    pub(crate) fn show(
        &self,
        context: &Context<'_, S>,
        from: DVec3,
        direction: DVec3,
        found: Option<&Interaction>,
        bounces: u32,
        receiver: &mut impl PhotonReceiver<S>,
    ) {
        let bounces = bounces + self.bounces;
        receiver.follow(&self.sampler);
        let length_m = found.map_or(f64::INFINITY, |at| at.distance_m);
        let flight = Flight { from, direction, length_m };
        let landing = found.filter(|at| context.world.bsdf(at).keeps_illuminance());
        let is_specular = self.path_class != LightPathClass::Found && bounces > 0;
        let specular_class = is_specular.then_some(self.path_class);
        let photon = SeenPhoton { weight: self.weight, bounces, specular_class };
        receiver.flight(&flight, &photon);
        if let Some(at) = landing {
            receiver.landing(at, &photon);
        }
    }

    /// Goes on after a flight, alone or with children, or does not; `depart` gets all that go on.
    pub(crate) fn scatter(
        mut self,
        context: &Context<'_, S>,
        setup: PhotonSetup<'_>,
        arrival: &Arrival<'_>,
        counts: &mut PhotonCounts,
        mut depart: impl FnMut(Departure<'p, S>),
    ) {
        let Some(arrived) = self.quanta() else { return counts.refuse(&self) };
        let Some(at) = arrival.found else {
            counts.lost += arrived;
            return counts.end(&self);
        };
        counts.events += 1;
        let bsdf = context.world.bsdf(at);
        let wo = context.world.frame(at).to_local(-arrival.direction);
        let bounces = arrival.bounces + self.bounces;
        let luminance = self.weight.luminance();
        let left = (self.weight * bsdf.albedo(wo, at.front, TransportMode::Importance)).luminance();
        if quanta(left).is_none() {
            counts.absorbed += arrived;
            return counts.refuse(&self);
        }
        if !self.gain.grow(left / luminance, bounces) {
            return counts.give_up(&self);
        }
        let window = setup.windows.filter(|_| bsdf.keeps_illuminance()).and_then(|w| w.at(at));
        // Of drawn places those are rare that absorb much, so all photons go on from there.
        let is_certain = arrival.is_drawn || left >= setup.certain_weight;
        let survivor = if is_certain { left } else { luminance };
        let split = Split::new(left, window.map_or(survivor, |window| window.weight));
        let bounce = Purpose::Bounce { surface: bounces + 1 };
        let whole = split.expected.floor();
        let one_more = context
            .draw(&mut self.sampler, bounce, |sampler| sampler.choose_bool(split.expected - whole));
        let count = whole as u32 + u32::from(one_more);
        counts.absorbed += arrived;
        if count == 0 {
            return counts.end(&self);
        }
        if context.max_bounces.is_some_and(|most| bounces >= most) {
            return self.cut(count, &split, counts);
        }
        self.bounces += u32::from(arrival.is_drawn);
        let guide = window.map(|window| &window.guide);
        let (point, share) = (ScatteringPoint { at, wo, guide }, 1.0 / split.expected);
        for mut photon in self.into_split(count) {
            match photon.leave(context, bounce, &point, share) {
                Some(start) => depart_valid(photon, start, counts, &mut depart),
                None => counts.end(&photon),
            }
        }
    }

    /// Ends it, and all that it would be split into, at the limit of bounces.
    fn cut(self, count: u32, split: &Split, counts: &mut PhotonCounts) {
        let Some(of_each) = quanta(split.weight) else { return counts.refuse(&self) };
        let goes_on = i64::from(count) * of_each;
        counts.absorbed -= goes_on;
        counts.cut += goes_on;
        counts.end(&self);
    }

    /// The photon, and the children that it is split into, with coordinates of their own.
    fn into_split(self, count: u32) -> impl Iterator<Item = Self> {
        let children: Vec<Sampler<'p>> =
            (1..count).map(|child| self.sampler.child(child)).collect();
        let Self { weight, path_class, specular_only, bounces, gain, .. } = self;
        let child =
            move |sampler| Self { sampler, weight, path_class, specular_only, bounces, gain };
        std::iter::once(self).chain(children.into_iter().map(child))
    }

    /// Takes a direction away from a surface, and its share of what leaves there.
    fn leave(
        &mut self,
        context: &Context<'_, S>,
        bounce: Purpose,
        point: &ScatteringPoint<'_>,
        share: f64,
    ) -> Option<Emission> {
        let ScatteringPoint { at, wo, guide } = *point;
        let (world, bsdf) = (&context.world, context.world.bsdf(at));
        let (next, share) = context.draw(&mut self.sampler, bounce, |sampler| match guide {
            Some(guide) => {
                let guided = guide.sample([sampler.remapped_1d(), sampler.next_1d()]);
                Some((bsdf.sample_lambertian(guided.u)?, share / guided.density))
            }
            None => Some((bsdf.sample(wo, at.front, TransportMode::Importance, sampler)?, share)),
        })?;
        self.weight = self.weight * next.weight * share;
        if self.weight.luminance() == 0.0 {
            return None;
        }
        self.path_class = self.path_class.after(&context.images, bsdf, at.facet, next.wi.z > 0.0);
        let from = if next.wi.z > 0.0 { world.ray_origin(at) } else { world.ray_origin_behind(at) };
        Some(Emission { from, direction: world.frame(at).to_world(next.wi) })
    }

    /// Its flux; `None` where it is not finite, negative or too large.
    fn quanta(&self) -> Option<i64> {
        quanta(self.weight.luminance())
    }
}

/// Emits the scattered photon unless it is invalid or no receiver needs it.
fn depart_valid<'p, S: Spectrum>(
    photon: Photon<'p, S>,
    start: Emission,
    counts: &mut PhotonCounts,
    depart: &mut impl FnMut(Departure<'p, S>),
) {
    let Some(goes_on) = photon.quanta() else { return counts.refuse(&photon) };
    counts.absorbed -= goes_on;
    if photon.specular_only && photon.path_class == LightPathClass::Found {
        counts.cut += goes_on;
        return counts.end(&photon);
    }
    depart(Departure { photon, start });
}

fn quanta(weight: f64) -> Option<i64> {
    checked_quanta(weight, QUANTA_PER_PHOTON)
}

impl PhotonCounts {
    /// Records a photon that ended.
    pub(crate) fn end<S>(&mut self, photon: &Photon<'_, S>) {
        self.dimensions.record(photon.sampler.used());
    }

    /// Cuts a photon that would fly on for ever.
    pub(crate) fn give_up<S: Spectrum>(&mut self, photon: &Photon<'_, S>) {
        self.endless += 1;
        match photon.quanta() {
            Some(quanta) => self.cut += quanta,
            None => self.invalid += 1,
        }
        self.end(photon);
    }

    /// Ends a photon whose flux is not finite, negative or too large, and counts it as invalid.
    fn refuse<S>(&mut self, photon: &Photon<'_, S>) {
        self.invalid += 1;
        self.end(photon);
    }
}
