//! Light subpaths: photons that leave every surface they come to a vertex that eye subpaths are
//! connected to (Lafortune and Willems 1993, Veach and Guibas 1994).
//!
//! They leave the lamps by flux, scatter as the surfaces do and end by Russian roulette: nothing
//! guides them. What comes from outside eye subpaths find alone.

use crate::bsdf::{Bsdf, TransportMode};
use crate::context::Context;
use crate::cutoff::{Gain, MAX_EVENTS};
use crate::lights::images::LightPathClass;
use crate::lights::{Asking, Emission, Emitted, EmitterPlace};
use crate::path::russian_roulette::{CERTAIN_BOUNCES, russian_roulette_factor};
use crate::path::subpath_weights::{SubpathWeights, product};
use crate::spectrum::Spectrum;
use crate::world::frame::Frame;
use crate::world::vertex::{Surface, Vertex};
use crate::world::{Interaction, RayOrigin};
use glam::DVec3;
use quasilux_bvh::{Hit, RayQuery};
use quasilux_sampling::Sampler;

/// A surface that a light subpath came to and that scatters into more than finitely many
/// directions.
pub(crate) struct LightVertex<S> {
    pub(crate) at: Interaction,
    pub(crate) frame: Frame,
    /// Unit direction that the light came from, in that frame.
    pub(crate) wo: DVec3,
    /// Flux that arrives with each subpath, in lm.
    pub(crate) flux_lm: S,
    /// Surfaces before this one.
    pub(crate) bounces: u32,
    pub(crate) weights: SubpathWeights,
}

/// A light subpath on its way.
struct LightSubpath<'p, S> {
    sampler: Sampler<'p>,
    start: Emission,
    flux_lm: S,
    /// Number of its light.
    light: usize,
    /// [`LightPathClass::Found`] after the first surface, and from emitting facets.
    path_class: LightPathClass,
    /// Its emitting facet, as seen from here straight, in mirrors or behind panes, as long as
    /// nothing else scattered it.
    image: Option<EmitterImage>,
    weights: SubpathWeights,
    gain: Gain,
}

/// An image of an emitting facet, seen from where light of it goes.
#[derive(Clone, Copy)]
struct EmitterImage {
    number: u32,
    left_from: EmitterPlace,
    /// Flights so far, in m.
    distance_m: f64,
    /// Density in m^-2 sr^-1 of photons that leave the facet as this one did.
    emission: f64,
    /// Whether there are panes between.
    behind_panes: bool,
}

/// Working space of light subpaths that are traced together.
#[derive(Default)]
pub(crate) struct LightSubpaths<S> {
    /// Vertices of each, in the order of the starts.
    pub(crate) vertices: Vec<Vec<LightVertex<S>>>,
    queries: Vec<RayQuery>,
    hits: Vec<Option<Hit>>,
    arrivals: Vec<Option<Interaction>>,
    /// Rays traced so far.
    pub(crate) rays: u64,
}

impl<S: Spectrum> LightSubpaths<S> {
    /// Traces a subpath for each sampler to its end, in place of those before; of those without a
    /// sampler nothing.
    pub(crate) fn trace<'p>(
        &mut self,
        context: &Context<'_, S>,
        samplers: impl Iterator<Item = Option<Sampler<'p>>>,
    ) {
        self.vertices.iter_mut().for_each(Vec::clear);
        let mut travelling = Vec::new();
        for (number, sampler) in samplers.enumerate() {
            if number == self.vertices.len() {
                self.vertices.push(Vec::new());
            }
            let subpath = sampler.and_then(|sampler| LightSubpath::new(context, sampler));
            travelling.extend(subpath.map(|subpath| (number, subpath)));
        }
        for bounces in 0..MAX_EVENTS {
            if travelling.is_empty() || context.max_bounces.is_some_and(|most| bounces >= most) {
                return;
            }
            self.queries.clear();
            let query = |start: &Emission| start.from.query(start.direction);
            self.queries.extend(travelling.iter().map(|(_, subpath)| query(&subpath.start)));
            context.world.trace_all(&self.queries, &mut self.hits, &mut self.arrivals);
            self.rays += self.queries.len() as u64;
            let mut arrivals = self.arrivals.iter();
            travelling.retain_mut(|(number, subpath)| {
                let at = arrivals.next().and_then(Option::as_ref);
                let own = &mut self.vertices[*number];
                at.is_some_and(|at| subpath.arrive(context, bounces, at, own))
            });
        }
    }
}

impl<'p, S: Spectrum> LightSubpath<'p, S> {
    fn new(context: &Context<'_, S>, mut sampler: Sampler<'p>) -> Option<Self> {
        let Context { lights, world, purposes, .. } = context;
        let Emitted { light, emission, path_class, .. } =
            lights.emit_from_lamps(world, *purposes, &mut sampler)?;
        // Of light without a facet known where it lands.
        let (mut weights, mut image) = (SubpathWeights::SENSOR, None);
        if let Some(facet) = emission.from.facet() {
            let left_from = EmitterPlace { facet, position: emission.from.position() };
            let facet = &world.facets[facet as usize];
            let cos = facet.front_normal.dot(emission.direction);
            let per_m2_sr = facet.emitted_cd_m2 * cos / lights.lamps_lm;
            weights = SubpathWeights::of_emission(per_m2_sr, cos);
            image = context.images.emitter(facet.material).map(|number| EmitterImage {
                number,
                left_from,
                distance_m: 0.0,
                emission: per_m2_sr,
                behind_panes: false,
            });
        }
        let flux_lm = S::white() * lights.lamps_lm;
        let gain = Gain::NONE;
        Some(Self { sampler, start: emission, flux_lm, light, path_class, image, weights, gain })
    }

    /// What happens where its flight after `bounces` surfaces ends; whether it goes on.
    fn arrive(
        &mut self,
        context: &Context<'_, S>,
        bounces: u32,
        at: &Interaction,
        vertices: &mut Vec<LightVertex<S>>,
    ) -> bool {
        let (world, bsdf, frame) =
            (&context.world, context.world.bsdf(at), context.world.frame(at));
        let wo = frame.to_local(-self.start.direction);
        self.weights = match self.path_class {
            LightPathClass::Found => self.weights.arrived(at.distance_m, wo.z),
            _ if bsdf.is_specular() => self.weights,
            _ => SubpathWeights::of_landing(self.landings_m2(context, at)),
        };
        self.land(context, at, wo.z);
        let albedo = bsdf.albedo(wo, at.front, TransportMode::Importance);
        let left = (self.flux_lm * albedo).max_channel();
        // What is not a number is left to the eye subpaths, which show it.
        if !(left > 0.0 && left.is_finite()) {
            return false;
        }
        if !bsdf.is_specular() {
            let (at, flux_lm, weights) = (*at, self.flux_lm, self.weights);
            vertices.push(LightVertex { at, frame, wo, flux_lm, bounces, weights });
        }
        let albedo = left / self.flux_lm.max_channel();
        if !self.gain.grow(albedo, bounces) {
            return false;
        }
        let survival = if bounces < CERTAIN_BOUNCES { 1.0 } else { albedo };
        let factor = russian_roulette_factor(survival, &mut self.sampler);
        if factor == 0.0 {
            return false;
        }
        let next = bsdf.sample(wo, at.front, TransportMode::Importance, &mut self.sampler);
        let Some(next) = next else { return false };
        self.weights = scattered(self.weights, bsdf, wo, next.wi);
        self.image =
            self.image.and_then(|image| image.past(context, bsdf, at.facet, next.wi.z > 0.0));
        self.path_class = self.path_class.after(&context.images, bsdf, at.facet, next.wi.z > 0.0);
        self.flux_lm = self.flux_lm * next.weight * factor;
        let from: RayOrigin =
            if next.wi.z > 0.0 { world.ray_origin(at) } else { world.ray_origin_behind(at) };
        self.start = Emission { from, direction: frame.to_world(next.wi) };
        true
    }
}

impl EmitterImage {
    /// After one more specular surface, which mirrored it or did not; `None` where no vertex asks
    /// for light that came so.
    fn past<S: Spectrum>(
        self,
        context: &Context<'_, S>,
        bsdf: &Bsdf<S>,
        facet: u32,
        is_mirrored: bool,
    ) -> Option<Self> {
        let images = &context.images;
        if is_mirrored {
            let plane = images.plane_of(facet).filter(|_| !self.behind_panes)?;
            return Some(Self { number: images.emitter_in(self.number, plane)?, ..self });
        }
        let is_let_through = bsdf.straight_transmittance(1.0).is_some();
        let passes = is_let_through && !images.is_mirrored_emitter(self.number);
        passes.then_some(Self { behind_panes: true, ..self })
    }
}

impl<S: Spectrum> LightSubpath<'_, S> {
    /// Follows the image of its emitting facet, or weighs that an eye subpath asks for it where a
    /// surface that is not specular is met, at this cosine.
    fn land(&mut self, context: &Context<'_, S>, at: &Interaction, cos: f64) {
        let Context { world, images, lights, .. } = context;
        let Some(mut image) = self.image.take() else { return };
        image.distance_m += at.distance_m;
        let bsdf = world.bsdf(at);
        if bsdf.is_specular() {
            self.image = Some(image);
            return;
        }
        let surface = Surface::new(world, at, self.start.direction);
        let place = Asking::at(&Vertex::on(world, at, &surface, S::white()));
        let pdf_m2 = if images.is_mirrored_emitter(image.number) {
            images.asked_m2(world, image.number, place, image.left_from)
        } else if let Some(emitters) = &lights.emitters {
            emitters.pdf_m2(world, place, image.left_from)
        } else {
            0.0
        };
        let square_m2 = image.distance_m * image.distance_m;
        let vcm = product(pdf_m2, square_m2 / (image.emission * cos));
        self.weights = self.weights.asked(vcm);
    }

    /// The density in m^-2 with which light of a point or luminaire lands here over the specular
    /// surfaces that it came by; `None` where no eye subpath asks for that light.
    fn landings_m2(&self, context: &Context<'_, S>, at: &Interaction) -> Option<f64> {
        let Context { world, lights, .. } = context;
        let is_light = |image: u32| image as usize == self.light;
        match self.path_class {
            LightPathClass::Shown(image) if !is_light(image) => {
                let lx = context.landing_of_image_lx(image, at, self.start.direction)?;
                Some(lx / lights.lamps_lm)
            }
            LightPathClass::Shown(_) | LightPathClass::Straight => {
                let takes_both_sides = world.bsdf(at).transmits();
                Some(lights.landings_m2(self.light, at.position, at.n, takes_both_sides))
            }
            LightPathClass::Outside | LightPathClass::Caustic | LightPathClass::Found => None,
        }
    }
}

/// The weights of a subpath, light or eye, that goes on from `wo` to `wi`.
pub(crate) fn scattered<S: Spectrum>(
    weights: SubpathWeights,
    bsdf: &Bsdf<S>,
    wo: DVec3,
    wi: DVec3,
) -> SubpathWeights {
    if bsdf.is_specular() {
        return weights.mirrored(wi.z.abs(), 1.0);
    }
    let [pdf_sr, reverse_pdf_sr] = [bsdf.partition_pdf_sr(wo, wi), bsdf.partition_pdf_sr(wi, wo)];
    weights.scattered(wi.z.abs(), pdf_sr, reverse_pdf_sr)
}
