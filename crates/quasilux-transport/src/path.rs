//! One path, from a sensor point toward the lights.
//!
//! The illuminance at x is `E(x) = integral of L(x, w) cos dw`. A cosine-distributed direction has
//! density cos / pi, so the light that arrives along it counts pi-fold. At each diffuse surface the
//! light that comes there straight from the lights is estimated on the spot (next-event
//! estimation), and the path goes on for the rest. A path may end on an illumination map instead:
//! the map's value stands for the rest. In a few paths, chosen by chance, the rest is also
//! estimated by going on, and the difference to the map, weighted by how few they are, takes the
//! map's error out again: the map is a control variate, and its elements cause no bias.

use crate::path_end::Rest;
use crate::shadow::{Offer, Shadows};
use crate::spectrum::Spectrum;
use crate::stage::Stage;
use crate::world::{Interaction, Scattering, Vantage, mirrored, to_world};
use glam::DVec3;
use quasilux_bvh::Shot;
use quasilux_sampling::SampleCursor;
use quasilux_sampling::warp::sample_cosine_hemisphere;
use std::f64::consts::{FRAC_1_PI, PI};

/// Bounces after which a path goes on for certain; after later ones by chance.
const CERTAIN_BOUNCES: u32 = 2;

/// What one path found, in lx.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Gathered {
    /// Straight from the lights; of the point-like ones only where the start asks for it.
    pub(crate) direct_lx: f64,
    /// After at least one bounce; may be negative where a map is corrected.
    pub(crate) indirect_lx: f64,
    /// Whether the path came to a surface that reflects, so that there may be indirect light.
    pub(crate) reflected: bool,
    /// Whether it was cut on its way.
    pub(crate) endless: bool,
}

/// A path that is over.
pub(crate) struct Ended {
    pub(crate) found: Gathered,
    /// How many coordinates it used.
    pub(crate) dimensions: u32,
}

/// Where a path starts: at a sensor point, on the side `n`.
pub(crate) struct Start<'p, S> {
    pub(crate) from: Vantage,
    pub(crate) n: DVec3,
    /// Whether what it finds holds the direct light of the point-like lights at its start.
    pub(crate) tests_pointlikes: bool,
    pub(crate) rest: &'p Rest<'p, S>,
    pub(crate) cursor: SampleCursor<'p>,
}

/// A path on its way.
pub(crate) struct Path<'p, S> {
    /// Its number among those that travel together.
    number: u32,
    rest: &'p Rest<'p, S>,
    cursor: SampleCursor<'p>,
    from: Vantage,
    /// Unit direction in which it goes on.
    direction: DVec3,
    /// The cosine that the direction was sampled with, for the density; `None` after a mirror.
    cos: Option<f64>,
    /// Factors from radiance along the path to illuminance at its start.
    beta: S,
    /// The same for what the next surface emits itself.
    beta_emitted: S,
    is_first_diffuse: bool,
    awaited: Awaited,
    /// From the point-like lights at its start, in lx.
    pointlikes_lx: f64,
    found: Gathered,
}

/// What a vertex adds to its path once it is known which lights it sees.
#[derive(Clone, Copy, Debug, Default)]
struct Awaited {
    /// Illuminance at the vertex from lights that it turned out to see, in lx.
    arrived_lx: f64,
    /// From that to illuminance at the start.
    to_start: f64,
    /// What the map gives, in lx at the start.
    from_map_lx: f64,
}

/// What the paths that travel together ask of the lights, with working space.
#[derive(Default)]
pub(crate) struct PathWork {
    pub(crate) shadows: Shadows,
    offers: Vec<Offer>,
    weights: Vec<f64>,
}

/// How a path goes on from a diffuse surface: factors on what the next surface sends.
pub(crate) struct Onward {
    /// On the light that the next surface emits itself.
    pub(crate) emitted: f64,
    /// On everything else; 0 ends the path there.
    pub(crate) everything: f64,
}

impl<'p, S: Spectrum> Path<'p, S> {
    /// The path number `number`; it asks for the light of the area lights and the luminaires with an
    /// area at its start.
    pub(crate) fn start(
        stage: &Stage<'_, S>,
        number: u32,
        Start { from, n, rest, mut cursor, .. }: Start<'p, S>,
        work: &mut PathWork,
    ) -> Self {
        let first = sample_cosine_hemisphere(cursor.next_2d());
        let beta = S::white() * PI;
        let mut path = Self {
            number,
            rest,
            cursor,
            from,
            direction: to_world(n, first),
            cos: Some(first[2]),
            beta,
            beta_emitted: beta,
            is_first_diffuse: true,
            awaited: Awaited { to_start: 1.0, ..Awaited::default() },
            pointlikes_lx: 0.0,
            found: Gathered::default(),
        };
        path.ask_emitters(stage, n, work);
        path.ask_area_luminaires(stage, n, work);
        path
    }

    /// The ray along which it goes on.
    pub(crate) fn shot(&self) -> Shot {
        self.from.shot(self.direction)
    }

    /// Light in lx that the path asked for has arrived where it asked.
    pub(crate) fn receive(&mut self, illuminance_lx: f64) {
        self.awaited.arrived_lx += illuminance_lx;
    }

    /// Light in lx of a point-like light has arrived at its start.
    pub(crate) fn receive_at_start(&mut self, illuminance_lx: f64) {
        self.pointlikes_lx += illuminance_lx;
    }

    /// What happens where the ray after `bounces` reflections ends, on a surface or nowhere; whether
    /// the path goes on. All that it asked for before must have arrived.
    pub(crate) fn arrive(
        &mut self,
        stage: &Stage<'_, S>,
        bounces: u32,
        at: Option<&Interaction>,
        work: &mut PathWork,
    ) -> bool {
        self.add_awaited(bounces);
        let Some(at) = at else { return false };
        self.add_emitted(stage, bounces, at);
        let scattering = stage.world.facet(at).scattering;
        let reflected = self.beta * scattering.reflectance();
        let is_last = stage.max_bounces.is_some_and(|most| bounces >= most);
        if is_last || reflected.max_channel() == 0.0 {
            return false;
        }
        self.found.reflected = true;
        self.from = stage.world.vantage(at);
        match scattering {
            Scattering::Mirror(_) => self.reflect(bounces, reflected, at.n),
            Scattering::Diffuse(_) => self.scatter(stage, bounces, reflected, at, work),
        }
    }

    /// What it found. All that it asked for must have arrived.
    pub(crate) fn end(mut self) -> Ended {
        self.add_awaited(1);
        self.found.direct_lx += self.pointlikes_lx;
        Ended { found: self.found, dimensions: self.cursor.used() }
    }

    /// Gives it up on its way.
    pub(crate) fn cut(&mut self) {
        self.found.endless = true;
    }

    /// Goes on in the mirror direction.
    fn reflect(&mut self, bounces: u32, reflected: S, n: DVec3) -> bool {
        let factor = self.survive(bounces, reflected).everything;
        self.direction = mirrored(self.direction, n);
        self.cos = None;
        self.beta = reflected * factor;
        self.beta_emitted = self.beta;
        factor != 0.0
    }

    /// Asks for the direct light on a diffuse surface and goes on for the rest.
    fn scatter(
        &mut self,
        stage: &Stage<'_, S>,
        bounces: u32,
        reflected: S,
        at: &Interaction,
        work: &mut PathWork,
    ) -> bool {
        // From illuminance here to illuminance at the start.
        let to_start = reflected * FRAC_1_PI;
        self.awaited.to_start = to_start.luminance();
        self.ask_area_luminaires(stage, at.n, work);
        self.ask_pointlikes(stage, at.n, work);
        self.ask_emitters(stage, at.n, work);
        let map_stands = self.is_first_diffuse && (bounces == 0 || stage.max_bounces.is_none());
        let onward = match self.rest {
            Rest::Map(end) if map_stands => {
                let from_map = (to_start * end.illuminance_lx(at)).luminance();
                let onward = end.correct(&mut self.cursor);
                self.awaited.from_map_lx = from_map * (1.0 - onward.everything);
                onward
            }
            _ => self.survive(bounces, reflected),
        };
        let seeks_emitters = onward.emitted != 0.0 && stage.lights.emitters.is_some();
        if onward.everything == 0.0 && !seeks_emitters {
            return false;
        }
        self.is_first_diffuse = false;
        let local = sample_cosine_hemisphere([self.cursor.rest_1d(), self.cursor.next_1d()]);
        self.direction = to_world(at.n, local);
        self.cos = Some(local[2]);
        self.beta = to_start * (PI * onward.everything);
        self.beta_emitted = to_start * (PI * onward.emitted);
        true
    }

    /// Russian roulette after the first bounces, by the reflectance of the channel that is left
    /// strongest, so that the weight of a survivor never grows in it and stays bounded in all.
    fn survive(&mut self, bounces: u32, reflected: S) -> Onward {
        if bounces < CERTAIN_BOUNCES {
            return Onward { emitted: 1.0, everything: 1.0 };
        }
        let reflectance = reflected.max_channel() / self.beta.max_channel();
        let survives = self.cursor.choose_bool(reflectance);
        let factor = if survives { 1.0 / reflectance } else { 0.0 };
        Onward { emitted: factor, everything: factor }
    }

    /// Asks for the light of one point on the area lights.
    fn ask_emitters(&mut self, stage: &Stage<'_, S>, n: DVec3, work: &mut PathWork) {
        if let Some(emitters) = &stage.lights.emitters {
            let u = self.cursor.next_2d();
            self.ask(emitters.offer(&stage.world, self.from.position(), n, u), work);
        }
    }

    /// Asks for the light of one place on the luminaires with an area.
    fn ask_area_luminaires(&mut self, stage: &Stage<'_, S>, n: DVec3, work: &mut PathWork) {
        let lights = &stage.lights.area_luminaires;
        if !lights.is_empty() {
            let u = self.cursor.next_2d();
            self.ask(lights.offer(self.from.position(), n, u, &mut work.weights), work);
        }
    }

    /// Asks for the light of one point-like light.
    fn ask_pointlikes(&mut self, stage: &Stage<'_, S>, n: DVec3, work: &mut PathWork) {
        let lights = &stage.lights.pointlikes;
        if !lights.is_empty() {
            let u = self.cursor.next_1d();
            self.ask(lights.offer(self.from.position(), n, u, &mut work.offers), work);
        }
    }

    fn ask(&self, offer: Option<Offer>, work: &mut PathWork) {
        if let Some(offer) = offer {
            work.shadows.ask(self.number, self.from, &offer);
        }
    }

    /// Adds what the vertex after `bounces` reflections was waiting for.
    fn add_awaited(&mut self, bounces: u32) {
        let Awaited { arrived_lx, to_start, from_map_lx } = std::mem::take(&mut self.awaited);
        let found_lx = self.found.after(bounces);
        *found_lx += to_start * arrived_lx;
        *found_lx += from_map_lx;
    }

    /// Adds the light that the place where the ray ends emits itself.
    fn add_emitted(&mut self, stage: &Stage<'_, S>, bounces: u32, at: &Interaction) {
        let emitted_cd_m2 = stage.world.emitted_cd_m2(at);
        if let (true, Some(emitters)) = (emitted_cd_m2 > 0.0, &stage.lights.emitters) {
            let shared = |cos| emitters.weight_of_direction(&stage.world, at, self.direction, cos);
            let weight = self.cos.map_or(1.0, shared);
            *self.found.after(bounces) += self.beta_emitted.luminance() * emitted_cd_m2 * weight;
        }
    }
}

impl Gathered {
    /// Where light belongs that arrives at the vertex after `bounces` reflections, or that the ray
    /// from there runs into.
    fn after(&mut self, bounces: u32) -> &mut f64 {
        if bounces == 0 { &mut self.direct_lx } else { &mut self.indirect_lx }
    }
}
