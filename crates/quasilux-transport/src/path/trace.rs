//! Path tracing with next-event estimation and Russian roulette (Kajiya 1986): one path, from a
//! sensor or a pixel toward the lights.
//!
//! The illuminance at x is `E(x) = integral of L(x, w) cos dw`. A cosine-distributed direction has
//! density cos / pi, so the light that arrives along it counts pi-fold. At each surface that is
//! not specular the light that comes there straight from the lights is estimated on the spot
//! (next-event estimation), and the path goes on for the rest. A path may end on an illumination
//! map instead: the map's value stands for the rest.
//!
//! Many paths travel together (`wave`): all rays of a step are traced at once ([`Path::query`],
//! [`Path::arrive`]), and so are the shadow rays that the paths asked for. What they see comes by
//! [`Path::on_visibility`], and is added where the next ray of the path arrives. The light of area
//! lights and from outside is weighed against the direction in which the path goes on by the power
//! heuristic (Veach and Guibas 1995): `add_emitted`, `outside`.
//!
//! Read on at `direct_light`, `specular_way` (area lights over mirrors), `outside` (sky and sun)
//! and `map_end` (ends on maps).

mod direct_light;
mod map_end;
pub(crate) mod outside;
mod specular_way;

use crate::bsdf::TransportMode;
use crate::context::Context;
use crate::cutoff::Gain;
use crate::lights::images::ImageSamples;
use crate::lights::{Asking, ChoiceWork, SunChoice};
use crate::path::contribution::PathContribution;
use crate::path::daylight::Daylight;
use crate::path::russian_roulette::{CERTAIN_BOUNCES, russian_roulette_factor};
use crate::path::start::{Measurement, PathMaps, Start};
use crate::purpose::Purpose;
use crate::spectrum::Spectrum;
use crate::world::vertex::{Surface, Vertex};
use crate::world::visibility::{Answer, ShadowQueue};
use crate::world::{Interaction, RayOrigin};
use glam::DVec3;
use outside::{AskedOutside, OutsideFactors, first_direction, is_pane};
use quasilux_bvh::RayQuery;
use quasilux_sampling::Sampler;
use specular_way::{Asked, SpecularWay};

/// A path that is over.
pub(crate) struct PathResult<S> {
    pub(crate) found: PathContribution<S>,
    /// How many coordinates it used.
    pub(crate) dimensions: u32,
}

/// A path on its way.
pub(crate) struct Path<'p, S> {
    /// Its number among those that travel together.
    number: u32,
    sampler: Sampler<'p>,
    maps: PathMaps<'p, S>,
    /// Where what comes from outside is kept apart.
    daylight: Option<Daylight<'p>>,
    from: RayOrigin,
    /// Unit direction in which it goes on.
    direction: DVec3,
    last: LastVertex,
    beta: Throughput<S>,
    gain: Gain,
    light: PathLight<S>,
}

/// The vertex that a path left last, as weights of what it runs into need it.
#[derive(Default)]
struct LastVertex {
    /// Density in sr^-1 of the direction as it scatters; `None` where no other could be.
    pdf_sr: Option<f64>,
    /// Where the path last asked for the light of area lights.
    asked_from: Option<Asking>,
    /// The mirrors or panes since then, where it asked for area lights behind them.
    specular_way: Option<SpecularWay>,
    /// Where and how it last asked for light from outside, if the path left along a direction that
    /// could have been asked along.
    asked_outside: Option<AskedOutside>,
    /// Bounces behind the light that it asks for.
    bounces_asked: u32,
}

/// Factors from radiance along a path to what its start seeks.
struct Throughput<S> {
    /// For light that the next surface reflects.
    all: S,
    /// For what it emits itself.
    emitted: S,
    outside: OutsideFactors<S>,
}

/// Light of a path.
struct PathLight<S> {
    /// From lights that its last vertex turned out to see.
    arrived: S,
    /// From the point-like lights at its start.
    pointlikes: S,
    found: PathContribution<S>,
}

/// Requests for light of the paths that travel together, with working space.
#[derive(Default)]
pub(crate) struct PathWork<S> {
    pub(crate) shadows: ShadowQueue<S>,
    choice: ChoiceWork,
    suns: SunChoice,
    images: ImageSamples<S>,
}

/// How a path goes on from a surface: factors on what the next surface sends.
struct ContinuationWeights {
    /// On the light that the next surface emits itself, and on what comes straight from outside.
    emitted: f64,
    /// On what comes from outside through panes.
    past_panes: f64,
    /// On everything else; 0 ends the path there.
    everything: f64,
}

impl ContinuationWeights {
    /// For certain, with everything.
    const ALL: Self = Self { emitted: 1.0, past_panes: 1.0, everything: 1.0 };
}

/// A path at a surface that it leaves again.
struct Scattering<'w, S> {
    /// Reflections before this one.
    bounces: u32,
    surface: &'w Surface<'w, S>,
    onward: ContinuationWeights,
}

impl<'p, S: Spectrum> Path<'p, S> {
    /// The path number `number`; where it seeks illuminance it asks for the light of the area
    /// lights and the luminaires with an area at its start.
    pub(crate) fn start(
        context: &Context<'_, S>,
        number: u32,
        start: Start<'p, S>,
        work: &mut PathWork<S>,
    ) -> Self {
        let Start { from, measurement, maps, daylight, mut sampler } = start;
        let (direction, pdf_sr, beta) = match measurement {
            Measurement::Illuminance { n, .. } => {
                let u = context.draw(&mut sampler, Purpose::FirstDirection, Sampler::next_2d);
                let first = first_direction(context, from, n, daylight.as_ref(), u);
                (first.direction, Some(first.pdf_sr), S::white() * first.weight)
            }
            Measurement::Luminance { direction } => (direction, None, S::white()),
        };
        let mut path = Self {
            number,
            sampler,
            maps,
            daylight: daylight.map(Daylight::new),
            from,
            direction,
            last: LastVertex { pdf_sr, ..LastVertex::default() },
            beta: Throughput {
                all: beta,
                emitted: beta,
                outside: OutsideFactors { here: beta, past_panes: beta },
            },
            gain: Gain::NONE,
            light: PathLight {
                arrived: S::black(),
                pointlikes: S::black(),
                found: PathContribution::default(),
            },
        };
        if let Measurement::Illuminance { n, tests_pointlikes } = measurement {
            path.sample_direct_at_start(context, n, tests_pointlikes, work);
        }
        path
    }

    /// Asks for the light of the lights at the sensor point that it starts from.
    fn sample_direct_at_start(
        &mut self,
        context: &Context<'_, S>,
        n: DVec3,
        tests_pointlikes: bool,
        work: &mut PathWork<S>,
    ) {
        self.light.found.list_terms(context.listed_terms);
        let vertex = Vertex::sensor(self.from, n);
        work.shadows.max_bounces = context.max_bounces.unwrap_or(u32::MAX);
        if tests_pointlikes {
            self.sample_direct_images(context, &vertex, work);
        }
        self.sample_direct_emitters(context, &vertex, work);
        self.sample_direct_emitter_images(context, &vertex, work);
        self.sample_direct_area_luminaires(context, &vertex, work);
        self.sample_direct_outside(context, &vertex, work);
        self.last.asked_outside =
            self.last.pdf_sr.and_then(|pdf_sr| AskedOutside::new(context, &vertex, pdf_sr));
        let pdf_sr = vertex.pdf_sr(self.direction);
        self.last.pdf_sr = Some(pdf_sr);
        self.last.specular_way = self.specular_way(context, pdf_sr);
    }

    /// The ray along which it goes on.
    pub(crate) fn query(&self) -> RayQuery {
        self.from.query(self.direction)
    }

    /// Takes the outcome of a request for light.
    pub(crate) fn on_visibility(&mut self, answer: &Answer<S>) {
        if let Some(daylight) = &mut self.daylight {
            let light = answer.bounces.map(|_| answer.light.luminance());
            self.light.found.from_outside.extend(daylight.answered(light));
        } else if let Some(bounces) = answer.bounces {
            self.receive(answer.light, bounces);
        }
    }

    /// Light that the path asked for has arrived where it asked, after this many mirrors and panes.
    fn receive(&mut self, light: S, bounces: u32) {
        if bounces == 0 {
            self.light.arrived += light;
        } else {
            self.light.found.add(self.last.bounces_asked + bounces, light);
        }
    }

    /// Light of a point-like light has arrived at its start, through this many panes.
    pub(crate) fn receive_at_start(&mut self, light: S, panes: u32) {
        if panes == 0 {
            self.light.pointlikes += light;
        } else {
            self.light.found.add(panes, light);
        }
    }

    /// Handles the end of the ray after `bounces` reflections, on a surface or nowhere; returns
    /// whether the path goes on. All that it asked for before must have arrived.
    pub(crate) fn arrive(
        &mut self,
        context: &Context<'_, S>,
        bounces: u32,
        at: Option<&Interaction>,
        work: &mut PathWork<S>,
    ) -> bool {
        self.add_arrived();
        match at {
            Some(at) => self.add_emitted(context, bounces, at),
            None => self.add_outside(context, bounces),
        }
        let Some(at) = at else { return false };
        self.note_openings(context, at);
        let surface = &Surface::new(&context.world, at, self.direction);
        let &Surface { bsdf, wo, .. } = surface;
        if !self.may_count(bsdf) {
            return false;
        }
        let carried = self.carried(bsdf);
        let goes_on = carried * bsdf.albedo(wo, at.front, TransportMode::Radiance);
        let is_last = context.max_bounces.is_some_and(|most| bounces >= most);
        if is_last || goes_on.max_channel() == 0.0 {
            return false;
        }
        self.gather(context, bounces, at, surface, work);
        let albedo = goes_on.max_channel() / carried.max_channel();
        if !self.gain.grow(albedo, bounces) {
            self.cut();
            return false;
        }
        let onward = self
            .end_on_map(context, bounces, at)
            .unwrap_or_else(|| self.russian_roulette(context, bounces, albedo));
        let seeks_emitted = onward.emitted != 0.0 && context.lights.can_be_met();
        if onward.everything == 0.0 && !seeks_emitted {
            return false;
        }
        self.scatter(context, at, &Scattering { bounces, surface, onward })
    }

    /// Next-event estimation at a surface: the light that comes there straight from the lights, and
    /// that of caustics.
    fn gather(
        &mut self,
        context: &Context<'_, S>,
        bounces: u32,
        at: &Interaction,
        surface: &Surface<'_, S>,
        work: &mut PathWork<S>,
    ) {
        let bsdf = surface.bsdf;
        // Past mirrors alone, paths find nothing but facets that emit and what is outside.
        self.light.found.reflected |= !bsdf.is_specular() || context.lights.can_be_met();
        self.last.bounces_asked = bounces + 1;
        if !bsdf.is_specular() {
            self.sample_direct_all(context, bounces + 1, at, surface, work);
        }
        if bsdf.keeps_illuminance() {
            self.add_caustics(context, bounces, at);
        }
    }

    /// Draws the direction in which it goes on; whether there is one.
    fn scatter(
        &mut self,
        context: &Context<'_, S>,
        at: &Interaction,
        scattering: &Scattering<'_, S>,
    ) -> bool {
        let &Scattering { bounces, surface, ref onward } = scattering;
        let &Surface { bsdf, frame, wo, .. } = surface;
        let bounce = Purpose::Bounce { surface: bounces + 1 };
        let next = context.draw(&mut self.sampler, bounce, |sampler| {
            bsdf.sample(wo, at.front, TransportMode::Radiance, sampler)
        });
        let Some(next) = next else { return false };
        self.note_specular_way(context, at, &next);
        self.note_side(context, &next);
        self.note_asked_outside(context, at, surface, &next);
        let world = &context.world;
        self.from =
            if next.wi.z > 0.0 { world.ray_origin(at) } else { world.ray_origin_behind(at) };
        self.direction = frame.to_world(next.wi);
        self.last.pdf_sr = next.pdf_sr;
        let beta = self.beta.all * next.weight;
        let is_straight = next.wi.z < 0.0 && is_pane(bsdf);
        self.beta.outside = self.beta.outside.after(beta, next.weight, onward, is_straight);
        self.beta.all = beta * onward.everything;
        self.beta.emitted = beta * onward.emitted;
        true
    }

    /// Returns what the path found, once. All that it asked for must have arrived.
    pub(crate) fn end(&mut self) -> PathResult<S> {
        self.add_arrived();
        self.light.found.add(0, self.light.pointlikes);
        PathResult { found: std::mem::take(&mut self.light.found), dimensions: self.sampler.used() }
    }

    /// Gives it up on its way.
    pub(crate) fn cut(&mut self) {
        self.light.found.endless = true;
    }

    /// Weight, at its start, of each lux at a diffuse surface that it meets.
    fn weight(&self, context: &Context<'_, S>, at: &Interaction) -> S {
        let surface = Surface::new(&context.world, at, self.direction);
        Vertex::on(&context.world, at, &surface, self.beta.all).weight(at.n)
    }

    /// Adds the light at a surface that no path finds.
    fn add_caustics(&mut self, context: &Context<'_, S>, bounces: u32, at: &Interaction) {
        let Some(caustics) = self.maps.caustics else { return };
        let most = context.max_bounces.map_or(u32::MAX, |most| most - bounces - 1);
        let to_start = self.weight(context, at);
        for term in caustics.illuminances_lx(at, most) {
            self.light.found.add(bounces + 1 + term.bounces, to_start * term.illuminance_lx);
        }
    }

    /// Russian roulette after the first bounces, by the albedo of the channel that is left
    /// strongest, so that the weight of a survivor never grows in it and stays bounded in all.
    fn russian_roulette(
        &mut self,
        context: &Context<'_, S>,
        bounces: u32,
        albedo: f64,
    ) -> ContinuationWeights {
        if bounces < CERTAIN_BOUNCES {
            return ContinuationWeights::ALL;
        }
        let bounce = Purpose::Bounce { surface: bounces + 1 };
        let factor = context
            .draw(&mut self.sampler, bounce, |sampler| russian_roulette_factor(albedo, sampler));
        ContinuationWeights { emitted: factor, past_panes: factor, everything: factor }
    }

    /// Adds what the last vertex was waiting for.
    fn add_arrived(&mut self) {
        self.light.found.add(self.last.bounces_asked, std::mem::take(&mut self.light.arrived));
    }

    /// Adds the light that the place where the ray ends emits itself.
    fn add_emitted(&mut self, context: &Context<'_, S>, bounces: u32, at: &Interaction) {
        let emitted_cd_m2 = context.world.emitted_cd_m2(at);
        let Some(emitters) = context.lights.emitters.as_ref().filter(|_| emitted_cd_m2 > 0.0)
        else {
            return;
        };
        let cos = at.n.dot(self.direction).abs();
        let asked = match self.last.pdf_sr {
            Some(pdf_sr) => Some(Asked {
                pdf_m2: self.asked_m2(context, emitters, at),
                inverse_of_direction_m2: at.distance_m * at.distance_m / (cos * pdf_sr),
            }),
            None => self.asked_past_specular(context, at),
        };
        let Asked { pdf_m2, inverse_of_direction_m2 } = asked.unwrap_or_default();
        let ratio = if pdf_m2 > 0.0 { pdf_m2 * inverse_of_direction_m2 } else { 0.0 };
        let weight = 1.0 / (1.0 + ratio * ratio);
        self.light.found.add(bounces, self.beta.emitted * (emitted_cd_m2 * weight));
    }
}
