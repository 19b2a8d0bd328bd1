//! One photon, from its light to its end: what happens to it at each step.
//!
//! Photons start with equal flux. At each surface they survive with the probability that keeps their
//! luminance: what is absorbed is absorbed whole, and on grey surfaces the weight never changes
//! (Voloboy, Dmitriev and Kopylov 2003). Only rough surfaces, whose directions cannot be drawn in exact
//! proportion, leave it slightly changed. Photons that are steered ([`crate::importance`]) leave each
//! place with the weight that belongs to it instead, by one or more of them or none; and those that are joined
//! to sensors all leave the first surface, with what absorption leaves. What goes on no
//! more is counted as absorbed, whatever was due: so flux balances exactly, and as it should on average.

use crate::bsdf::Mode;
use crate::context::Stage;
use crate::cutoff::{Gain, MAX_EVENTS};
use crate::importance::{Guide, Split, Windows};
use crate::lights::images::Trail;
use crate::lights::{Emission, Emitted};
use crate::photon::first_shot::{Drawn, LitCells, LitPlace};
use crate::purpose::Purpose;
use crate::spectrum::Spectrum;
use crate::world::Interaction;
use glam::DVec3;
use quasilux_sampling::{DimensionHistogram, Sampler};
use std::ops::AddAssign;

/// Flux is counted in this many steps a photon: 2^39 photons fit.
const QUANTA_PER_PHOTON: f64 = (1 << 24) as f64;

/// How photons ended, and what they cost. Flux is in quanta.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct PhotonCounts {
    /// Photons that began, until those from lit places are [taken out](Self::apart_from_flux): those that left lights.
    pub(crate) emitted: u64,
    /// Those from lit places too; what splitting added is not among them.
    pub(crate) begun: u64,
    /// Absorbed, less what splitting added.
    pub(crate) absorbed: i64,
    pub(crate) lost: i64,
    /// Cut after the wanted number of bounces.
    pub(crate) cut: i64,
    /// Photons cut because they would not [end](crate::cutoff).
    pub(crate) endless: u64,
    /// The same of photons that are not in the balance of the flux.
    pub(crate) trapped: u64,
    pub(crate) rays: u64,
    /// Rays among them that join photons to sensors.
    pub(crate) joins: u64,
    /// Surfaces that photons came to.
    pub(crate) events: u64,
    /// Coordinates that each of them used, children of splits by themselves.
    pub(crate) dimensions: DimensionHistogram,
}

/// What sees photons on their way.
pub(crate) trait PhotonReceiver<S> {
    /// Whether photons end where [`Trail::Found`] begins: nobody looks at them further.
    const SPECULAR_ONLY: bool = false;

    /// All that it sees from here on is of the photon whose coordinates come from there.
    fn follow(&mut self, sampler: &Sampler<'_>) {
        let _ = sampler;
    }

    /// A photon flies freely from `from` along `direction` for `length_m`, perhaps endlessly, after
    /// `bounces` reflections; `weight` is its colour, of luminance one or near it.
    fn flight(&mut self, flight: &Flight, weight: S, bounces: u32);

    /// A photon lands on a surface that keeps illuminance.
    fn landing(&mut self, at: &Interaction, weight: S, bounces: u32);

    /// The flight of a photon that came by specular surfaces alone from a light that nothing runs
    /// into; a flight like others unless somebody sees such light in another way.
    fn specular_flight(&mut self, flight: &Flight, weight: S, bounces: u32, trail: Trail) {
        let _ = trail;
        self.flight(flight, weight, bounces);
    }

    /// The landing of such a photon.
    fn specular_landing(&mut self, at: &Interaction, weight: S, bounces: u32, trail: Trail) {
        let _ = trail;
        self.landing(at, weight, bounces);
    }

    /// Nothing more is to come; how many rays it traced itself.
    fn finish(self) -> u64
    where
        Self: Sized,
    {
        0
    }
}

/// A straight piece of a photon's way.
pub(crate) struct Flight {
    pub(crate) from: DVec3,
    pub(crate) direction: DVec3,
    /// Infinite where it leaves the scene.
    pub(crate) length_m: f64,
}

/// A photon on its way, but for where it flies.
pub(crate) struct Photon<'p, S> {
    pub(crate) sampler: Sampler<'p>,
    /// Its colour: the flux that it carries, as a share of that of one photon of all lights.
    pub(crate) weight: S,
    pub(crate) trail: Trail,
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

/// Where photons begin, and what steers them.
#[derive(Clone, Copy)]
pub(crate) struct Lead<'s> {
    pub(crate) source: Source<'s>,
    pub(crate) windows: Option<&'s Windows>,
    /// Where nothing steers them, photons go on for certain with what absorption leaves, if that is so much
    /// of what the first of them carry.
    pub(crate) certain_weight: f64,
}

impl<'s> Lead<'s> {
    /// Photons that survive by chance at each surface, unless something steers them.
    pub(crate) fn by_chance(source: Source<'s>, windows: Option<&'s Windows>) -> Self {
        Self { source, windows, certain_weight: f64::INFINITY }
    }
}

impl<'s> Source<'s> {
    /// The lights, or lit cells where there are any.
    pub(crate) fn of(lit_cells: Option<&'s LitCells>) -> Self {
        lit_cells.map_or(Source::Lights, Source::LitCells)
    }

    /// What most photons from here weigh, rounded down to a power of two.
    pub(crate) fn usual_weight(self) -> f64 {
        match self {
            Self::Lights => 1.0,
            Self::LitCells(cells) => libm::ldexp(1.0, libm::ilogb(cells.flux_share())),
        }
    }

    /// What photons from here count: their flux only where it is all that the lights emit.
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
    stage: &Stage<'_, S>,
    lead: Lead<'_>,
    sampler: Sampler<'p>,
    receiver: &mut impl PhotonReceiver<S>,
    counts: &mut PhotonCounts,
) {
    let mut photon = Photon::new(sampler).for_receiver(receiver);
    counts.emitted += 1;
    counts.begun += 1;
    let mut generation: Vec<Departure<'p, S>> = Vec::new();
    match photon.begin(stage, lead.source) {
        Some(Beginning::Flies(start)) => generation.push(Departure { photon, start }),
        Some(Beginning::IfLit(place)) => {
            counts.rays += 1;
            if !place.is_lit(stage) {
                return counts.end(&photon);
            }
            photon.receive(&place);
            photon.scatter(stage, lead, &place.arrival(), counts, |next| generation.push(next));
        }
        None => return counts.end(&photon),
    }
    for bounces in 0..MAX_EVENTS {
        let mut next = Vec::new();
        for Departure { photon, start: Emission { from, direction } } in generation {
            counts.rays += 1;
            let found = stage.world.trace(from, direction);
            photon.show(stage, from.position(), direction, found.as_ref(), bounces, receiver);
            let arrival = Arrival { direction, found: found.as_ref(), bounces, is_drawn: false };
            photon.scatter(stage, lead, &arrival, counts, |departure| next.push(departure));
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
struct Door<'a> {
    at: &'a Interaction,
    /// Where the light came from.
    wo: DVec3,
    guide: Option<&'a Guide>,
}

/// The end of a flight.
pub(crate) struct Arrival<'a> {
    /// Along which the photon flew.
    pub(crate) direction: DVec3,
    pub(crate) found: Option<&'a Interaction>,
    /// Before this one, since it began.
    pub(crate) bounces: u32,
    /// Whether no flight led here: the place was drawn, from those whose light goes on.
    pub(crate) is_drawn: bool,
}

impl<'p, S: Spectrum> Photon<'p, S> {
    /// The photon that takes its coordinates from `sampler`.
    pub(crate) fn new(sampler: Sampler<'p>) -> Self {
        Self {
            sampler,
            weight: S::white(),
            trail: Trail::Found,
            specular_only: false,
            bounces: 0,
            gain: Gain::NONE,
        }
    }

    /// The photon as a receiver wants it.
    pub(crate) fn for_receiver<R: PhotonReceiver<S>>(self, _: &R) -> Self {
        Self { specular_only: R::SPECULAR_ONLY, ..self }
    }

    /// Draws its beginning; `None` where nothing emits, or where no light can land.
    pub(crate) fn begin(&mut self, stage: &Stage<'_, S>, source: Source<'_>) -> Option<Beginning> {
        let lights = &stage.lights;
        let Emitted { emission, trail } = match source {
            Source::Lights => lights.emit(stage, &mut self.sampler)?,
            Source::LitCells(cells) => match cells.draw(stage, &mut self.sampler)? {
                Drawn::Place(place) => return Some(Beginning::IfLit(place)),
                Drawn::Light { number, u, flux_share } => {
                    self.weight = S::white() * flux_share;
                    lights.emit_from(number, u, stage, &mut self.sampler)?
                }
            },
        };
        self.trail = trail;
        Some(Beginning::Flies(emission))
    }

    /// Takes the light that comes to a place.
    pub(crate) fn receive(&mut self, place: &LitPlace) {
        self.trail = Trail::Shown(place.light);
        self.weight = S::white() * place.flux_share;
    }

    /// Shows a flight to the receiver, and where it landed.
    pub(crate) fn show(
        &self,
        stage: &Stage<'_, S>,
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
        let landing = found.filter(|at| stage.world.bsdf(at).keeps_illuminance());
        if self.trail == Trail::Found || bounces == 0 {
            receiver.flight(&flight, self.weight, bounces);
            if let Some(at) = landing {
                receiver.landing(at, self.weight, bounces);
            }
        } else {
            receiver.specular_flight(&flight, self.weight, bounces, self.trail);
            if let Some(at) = landing {
                receiver.specular_landing(at, self.weight, bounces, self.trail);
            }
        }
    }

    /// Goes on after a flight, alone or with children, or does not; `depart` gets all that go on.
    pub(crate) fn scatter(
        mut self,
        stage: &Stage<'_, S>,
        lead: Lead<'_>,
        arrival: &Arrival<'_>,
        counts: &mut PhotonCounts,
        mut depart: impl FnMut(Departure<'p, S>),
    ) {
        let Some(at) = arrival.found else {
            counts.lost += self.quanta();
            return counts.end(&self);
        };
        counts.events += 1;
        let (bsdf, frame) = (stage.world.bsdf(at), stage.world.frame(at));
        let wo = frame.to_local(-arrival.direction);
        let luminance = self.weight.luminance();
        let left = (self.weight * bsdf.albedo(wo, at.front, Mode::Flux)).luminance();
        if !self.gain.grow(left / luminance, arrival.bounces + self.bounces) {
            return counts.give_up(&self);
        }
        let window = lead.windows.filter(|_| bsdf.keeps_illuminance()).and_then(|w| w.at(at));
        // Of drawn places those are rare that absorb much, so all photons go on from there.
        let is_certain = arrival.is_drawn || left >= lead.certain_weight;
        let survivor = if is_certain { left } else { luminance };
        let split = Split::new(left, window.map_or(survivor, |window| window.weight));
        let whole = split.expected.floor();
        let bounce = Purpose::Bounce { surface: arrival.bounces + self.bounces + 1 };
        let one_more = stage
            .draw(&mut self.sampler, bounce, |sampler| sampler.choose_bool(split.expected - whole));
        let count = whole as u32 + u32::from(one_more);
        let arrived = self.quanta();
        counts.absorbed += arrived;
        if count == 0 {
            return counts.end(&self);
        }
        if stage.max_bounces.is_some_and(|most| arrival.bounces + self.bounces >= most) {
            let goes_on = i64::from(count) * quanta(split.weight);
            counts.absorbed -= goes_on;
            counts.cut += goes_on;
            return counts.end(&self);
        }
        let children: Vec<Sampler<'p>> =
            (1..count).map(|child| self.sampler.child(child)).collect();
        self.bounces += u32::from(arrival.is_drawn);
        let Self { weight, trail, specular_only, bounces, gain, .. } = self;
        let child = |sampler| Self { sampler, weight, trail, specular_only, bounces, gain };
        for mut photon in std::iter::once(self).chain(children.into_iter().map(child)) {
            let guide = window.map(|window| &window.guide);
            let (door, share) = (Door { at, wo, guide }, 1.0 / split.expected);
            match photon.leave(stage, bounce, &door, share) {
                Some(_) if photon.specular_only && photon.trail == Trail::Found => {
                    counts.absorbed -= photon.quanta();
                    counts.cut += photon.quanta();
                    counts.end(&photon);
                }
                Some(start) => {
                    counts.absorbed -= photon.quanta();
                    depart(Departure { photon, start });
                }
                None => counts.end(&photon),
            }
        }
    }

    /// Takes a direction away from a surface, and its share of what leaves there.
    fn leave(
        &mut self,
        stage: &Stage<'_, S>,
        bounce: Purpose,
        door: &Door<'_>,
        share: f64,
    ) -> Option<Emission> {
        let Door { at, wo, guide } = *door;
        let (world, bsdf) = (&stage.world, stage.world.bsdf(at));
        let (next, share) = stage.draw(&mut self.sampler, bounce, |sampler| match guide {
            Some(guide) if bsdf.is_lambertian() => {
                let guided = guide.sample([sampler.remapped_1d(), sampler.next_1d()]);
                Some((bsdf.sample_lambertian(guided.u)?, share / guided.density))
            }
            _ => Some((bsdf.sample(wo, at.front, Mode::Flux, sampler)?, share)),
        })?;
        self.weight = self.weight * next.weight * share;
        if self.weight.luminance() <= 0.0 {
            return None;
        }
        self.trail = self.trail.after(&stage.images, bsdf, at.facet, next.wi.z > 0.0);
        let from = if next.wi.z > 0.0 { world.vantage(at) } else { world.vantage_behind(at) };
        Some(Emission { from, direction: world.frame(at).to_world(next.wi) })
    }

    /// Its flux.
    fn quanta(&self) -> i64 {
        quanta(self.weight.luminance())
    }
}

fn quanta(weight: f64) -> i64 {
    (weight * QUANTA_PER_PHOTON).round_ties_even() as i64
}

impl PhotonCounts {
    /// What they cost, without where their flux went: those from lit cells do not carry all of it.
    pub(crate) fn apart_from_flux(self) -> Self {
        let trapped = self.trapped + self.endless;
        let Self { begun, rays, joins, events, dimensions, .. } = self;
        Self { begun, trapped, rays, joins, events, dimensions, ..Self::default() }
    }

    /// Records a photon that ended.
    pub(crate) fn end<S>(&mut self, photon: &Photon<'_, S>) {
        self.dimensions.record(photon.sampler.used());
    }

    /// Cuts a photon that would fly on for ever.
    pub(crate) fn give_up<S: Spectrum>(&mut self, photon: &Photon<'_, S>) {
        self.endless += 1;
        self.cut += photon.quanta();
        self.end(photon);
    }

    /// Flux of some quanta, as a share of all that was emitted.
    pub(crate) fn share(&self, quanta: i64) -> f64 {
        quanta as f64 / (self.emitted.max(1) as f64 * QUANTA_PER_PHOTON)
    }
}

impl AddAssign for PhotonCounts {
    fn add_assign(&mut self, other: Self) {
        self.emitted += other.emitted;
        self.begun += other.begun;
        self.absorbed += other.absorbed;
        self.lost += other.lost;
        self.cut += other.cut;
        self.endless += other.endless;
        self.trapped += other.trapped;
        self.rays += other.rays;
        self.joins += other.joins;
        self.events += other.events;
        self.dimensions.merge(&other.dimensions);
    }
}

/// Receives nothing, or what the inner one receives.
impl<S, R: PhotonReceiver<S>> PhotonReceiver<S> for Option<R> {
    const SPECULAR_ONLY: bool = R::SPECULAR_ONLY;

    fn follow(&mut self, sampler: &Sampler<'_>) {
        if let Some(receiver) = self {
            receiver.follow(sampler);
        }
    }

    fn flight(&mut self, flight: &Flight, weight: S, bounces: u32) {
        if let Some(receiver) = self {
            receiver.flight(flight, weight, bounces);
        }
    }

    fn landing(&mut self, at: &Interaction, weight: S, bounces: u32) {
        if let Some(receiver) = self {
            receiver.landing(at, weight, bounces);
        }
    }

    fn specular_flight(&mut self, flight: &Flight, weight: S, bounces: u32, trail: Trail) {
        if let Some(receiver) = self {
            receiver.specular_flight(flight, weight, bounces, trail);
        }
    }

    fn specular_landing(&mut self, at: &Interaction, weight: S, bounces: u32, trail: Trail) {
        if let Some(receiver) = self {
            receiver.specular_landing(at, weight, bounces, trail);
        }
    }

    fn finish(self) -> u64 {
        self.map_or(0, R::finish)
    }
}
