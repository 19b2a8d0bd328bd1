//! Survey of light transport between cells: pilot rays from the lights, from sensors, and on from
//! every cell that any of them finds.
//!
//! A pilot of whole photons never sees the far end of a corridor. A survey of single steps does:
//! each cell sends as many rays as any other, however little light comes to it, and chains of steps
//! are left to linear algebra ([`crate::importance::flux_and_importance`]). Cells are discovered as
//! rays land in them.

use crate::bsdf::TransportMode;
use crate::context::{Context, Stream};
use crate::importance::cells::{Cells, Regions};
use crate::lights::Emission;
use crate::sensors::Target;
use crate::spectrum::Spectrum;
use crate::world::Interaction;
use crate::world::frame::Frame;
use crate::world::vertex::Vertex;
use crate::world::visibility::{LightRequest, ShadowQueue};
use glam::DVec3;
use quasilux_sampling::warp::{invert_cosine_hemisphere, sample_cosine_hemisphere};
use quasilux_sampling::{Discrete, PointSet, Sampler};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Pilot photons from the lights.
const PHOTONS: u64 = 1 << 12;
/// Sensor points that are asked, spread over all.
const MAX_SENSORS: usize = 256;
/// Lights that they are lit straight by, of all of them together; one sensor is asked at least.
const MAX_LIT: usize = 1 << 18;
/// Rays of all of them together, and the least of each.
const SENSOR_RAYS: u64 = 1 << 12;
const MIN_SENSOR_RAYS: u64 = 16;
/// Rays from each cell for a first look, and for a closer one; and how many of them before new
/// cells are looked at.
const CELL_RAYS: u32 = 16;
const MORE_CELL_RAYS: u32 = 128;
const RAYS_A_ROUND: u32 = 8;
/// No more cells than this are surveyed: 2^17 rays at first, 2^20 in all, and
/// as many connections.
const MAX_KNOWN: usize = 1 << 13;
/// Places remembered of each cell, from which its rays leave.
const PLACES: usize = 8;
/// Specular surfaces that a ray passes before it is given up.
const MAX_PASSED: u32 = 16;

/// Cells that light or sensors reach, numbered in the order of their discovery, and what lands in
/// them.
pub(crate) struct Survey {
    pub(crate) cells: Cells,
    /// Number of each cell, [`Regions::UNKNOWN`] for none.
    pub(crate) number_of_cell: Vec<u32>,
    pub(crate) known: Vec<SurveyCell>,
    pub(crate) sensors: Vec<Surveyed>,
    /// Stride of the surveyed sensors in all targets.
    pub(crate) sensor_step: usize,
    /// Photons that land in each known cell before any other.
    pub(crate) first_landings: Vec<FirstLandings>,
    pub(crate) rays: u64,
    /// Rays sent on from cells.
    sent: u64,
}

/// A cell that rays have found.
pub(crate) struct SurveyCell {
    pub(crate) cell: usize,
    pub(crate) places: Vec<Interaction>,
    /// Luminance of the albedo, mean over the places.
    pub(crate) albedo: f64,
    /// Rays sent on from here.
    pub(crate) rays: u32,
    /// Where they landed.
    landings: Vec<Transition>,
    /// Far places that light goes to, as many times tried as rays had left by then.
    connections: Vec<Transition>,
}

impl SurveyCell {
    /// Where light goes that leaves here.
    pub(crate) fn steps(&self) -> impl Iterator<Item = Transition> {
        let of_each = 1.0 / f64::from(self.rays.max(1));
        let steps = self.landings.iter().chain(&self.connections);
        steps.map(move |step| Transition { share: step.share * of_each, ..*step })
    }
}

/// A ray's end in a cell, or a place that one may end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Transition {
    /// Number of the cell.
    pub(crate) cell: u32,
    /// The part of all rays that it stands for; in [`SurveyCell`], their number.
    pub(crate) share: f64,
    /// Throughput of the specular surfaces on the way.
    pub(crate) weight: f64,
    /// The share of the light that goes to a square metre there, in m^-2, where a connection may
    /// find it too; 0 elsewhere.
    far_per_m2: f32,
    /// The point of the unit square that its direction comes from.
    pub(crate) u: [f32; 2],
}

/// A photon that leaves its light.
pub(crate) struct PilotPhoton {
    pub(crate) emission: Emission,
    /// Its flux over that of a photon of all lights.
    pub(crate) share: f64,
}

/// Photons that land in a cell before any other, on average over all photons.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct FirstLandings {
    pub(crate) photons: f64,
    /// Flux, as a share of what all lights emit.
    pub(crate) flux: f64,
    /// The squares of their shares.
    pub(crate) squares: f64,
}

/// A sensor point with what its rays found.
pub(crate) struct Surveyed {
    /// Illuminance straight from the point-like lights, in lx.
    pub(crate) direct_lx: f64,
    pub(crate) rays: u64,
    pub(crate) landings: Vec<Transition>,
}

/// A ray's end on a surface that keeps illuminance.
struct DiffuseHit {
    at: Interaction,
    weight: f64,
    /// Whether it came past no other surface.
    is_straight: bool,
}

/// End of a ray that may have passed specular surfaces.
struct Flown {
    /// See [`Transition`].
    u: [f32; 2],
    far_per_m2: f32,
    found: Option<DiffuseHit>,
    rays: u64,
}

impl Flown {
    const NOWHERE: Self = Self { u: [0.0; 2], far_per_m2: 0.0, found: None, rays: 0 };
}

/// Connections of known cells to far ones that are drawn by their importance.
struct FarConnections<'s, 'w, 'a, S> {
    context: &'s Context<'a, S>,
    known: &'s [SurveyCell],
    /// See [`Cells::far_m`].
    far_m: f64,
    points: PointSet,
    weights: FarWeights<'w>,
}

/// The choice of far cells.
struct FarWeights<'w> {
    areas_m2: &'w [f64],
    by_importance: Discrete,
}

/// A step that was tried.
struct FarConnection {
    step: Transition,
    is_visible: bool,
}

impl FarWeights<'_> {
    /// The weight of a step to a far cell by the balance heuristic.
    fn weight(&self, far_per_m2: f32, cell: usize) -> f64 {
        let p = f64::from(far_per_m2) * self.areas_m2[cell];
        p / (p + self.by_importance.pdf(cell))
    }
}

impl<S: Spectrum> FarConnections<'_, '_, '_, S> {
    /// Draws a point of a far cell and tries whether light goes there from a cell; `None` where
    /// they are too near, or one of them turns its back on the other.
    fn connect(&self, number: usize, ray: u32) -> Option<FarConnection> {
        let Self { context, known, far_m, points, weights } = self;
        let index = number as u64 * u64::from(MORE_CELL_RAYS) + u64::from(ray);
        let mut sampler = Sampler::new(points, index);
        let choice = weights.by_importance.sample(sampler.next_1d());
        let (from, to) = (&known[number].places, &known[choice.index].places);
        let start = &from[ray as usize % from.len()];
        let end = &to[((sampler.next_1d() * to.len() as f64) as usize).min(to.len() - 1)];
        let line = end.position - start.position;
        let distance_m = line.length();
        let direction = line / distance_m;
        let (cos, cos_end) = (start.n.dot(direction), -end.n.dot(direction));
        if !(distance_m > *far_m && cos > 0.0 && cos_end > 0.0) {
            return None;
        }
        let world = &context.world;
        let is_visible =
            world.is_visible(world.ray_origin(start), direction, distance_m, end.facet);
        let far_per_m2 = (cos * cos_end / (PI * distance_m * distance_m)) as f32;
        let local = world.frame(start).to_local(direction);
        let step = Transition {
            cell: choice.index as u32,
            share: weights.weight(far_per_m2, choice.index),
            weight: 1.0,
            far_per_m2,
            u: invert_cosine_hemisphere(local.to_array()).map(|u| u as f32),
        };
        Some(FarConnection { step, is_visible })
    }
}

impl Survey {
    /// Traces rays from all lights, which `emit` the photons of an estimator, and from some of the
    /// targets; `None` where there is nothing.
    pub(crate) fn new<S: Spectrum>(
        context: &Context<'_, S>,
        targets: &[Target],
        emit: impl Fn(&mut Sampler<'_>) -> Option<PilotPhoton> + Sync,
    ) -> Option<Self> {
        let cells = Cells::new(&context.world)?;
        let lights = context.lights.pointlikes.len().max(1);
        let most_sensors = MAX_SENSORS.min(MAX_LIT / lights).max(1);
        let mut survey = Self {
            number_of_cell: vec![Regions::UNKNOWN; cells.len()],
            cells,
            known: Vec::new(),
            sensors: Vec::new(),
            sensor_step: targets.len().div_ceil(most_sensors).max(1),
            first_landings: Vec::new(),
            rays: 0,
            sent: 0,
        };
        survey.sample_from_lights(context, emit);
        survey.sample_from_sensors(context, targets);
        survey.explore(context, CELL_RAYS);
        Some(survey)
    }

    /// The known cells, for any place.
    pub(crate) fn regions(&self) -> Regions {
        Regions::new(self.cells.clone(), self.number_of_cell.clone())
    }

    /// Adds rays to each cell.
    pub(crate) fn refine<S: Spectrum>(&mut self, context: &Context<'_, S>) {
        self.explore(context, MORE_CELL_RAYS);
    }

    /// Connects each cell to far ones that matter, as many times as rays left it: these are chosen
    /// in proportion to `importances`. Rays find such ways so seldom that a survey by rays alone
    /// takes a dark end for darker, and a chance to get there at once for none.
    ///
    /// From a place with normal n the share of the light that goes to one with n' in a cell of area
    /// A is `p = cos cos' A / (pi d^2)`, if nothing stands between. Where such a cell is chosen
    /// with probability q, what a ray or a connection finds there counts `p / (p + q)` (balance
    /// heuristic, Veach and Guibas 1995): wrong importances leave the light that goes
    /// elsewhere to the rays.
    pub(crate) fn connect<S: Spectrum>(
        &mut self,
        context: &Context<'_, S>,
        areas_m2: &[f64],
        importances: &[f64],
    ) {
        let weights: Vec<f64> = areas_m2.iter().zip(importances).map(|(a, w)| a * w).collect();
        let Some(by_importance) = Discrete::new(&weights) else { return };
        let connections = FarConnections {
            context,
            known: &self.known,
            far_m: self.cells.far_m(),
            points: context.points(0, Stream::Survey(3)),
            weights: FarWeights { areas_m2, by_importance },
        };
        let from_cell = |number: usize| {
            let tries = 0..self.known[number].rays;
            tries.filter_map(|ray| connections.connect(number, ray)).collect::<Vec<_>>()
        };
        let found: Vec<Vec<FarConnection>> =
            (0..self.known.len()).into_par_iter().map(from_cell).collect();
        let weights = connections.weights;
        for (cell, found) in self.known.iter_mut().zip(found) {
            self.rays += found.len() as u64;
            let visible = found.into_iter().filter(|connection| connection.is_visible);
            cell.connections = visible.map(|connection| connection.step).collect();
            for ray in cell.landings.iter_mut().filter(|ray| ray.far_per_m2 > 0.0) {
                ray.share = weights.weight(ray.far_per_m2, ray.cell as usize);
            }
        }
    }

    fn sample_from_lights<S: Spectrum>(
        &mut self,
        context: &Context<'_, S>,
        emit: impl Fn(&mut Sampler<'_>) -> Option<PilotPhoton> + Sync,
    ) {
        let points = context.points(0, Stream::Survey(0));
        let fly = |index: u64| {
            let mut sampler = Sampler::new(&points, index);
            let PilotPhoton { emission, share } = emit(&mut sampler)?;
            Some((share, fly(context, emission, &mut sampler)))
        };
        let flown: Vec<Option<(f64, Flown)>> = (0..PHOTONS).into_par_iter().map(fly).collect();
        for (share, flown) in flown.into_iter().flatten() {
            if let Some(Transition { cell, weight, .. }) = self.enter(context, flown) {
                self.first_landings.resize(self.known.len(), FirstLandings::default());
                let FirstLandings { photons, flux, squares } =
                    &mut self.first_landings[cell as usize];
                *photons += weight / PHOTONS as f64;
                *flux += share * weight / PHOTONS as f64;
                *squares += share * share * weight / PHOTONS as f64;
            }
        }
    }

    fn sample_from_sensors<S: Spectrum>(&mut self, context: &Context<'_, S>, targets: &[Target]) {
        let asked = targets.iter().step_by(self.sensor_step).map(centre);
        let asked: Vec<(DVec3, DVec3)> = asked.collect();
        let rays = (SENSOR_RAYS / asked.len().max(1) as u64).max(MIN_SENSOR_RAYS);
        let points = context.points(0, Stream::Survey(1));
        let direct_lx = direct_lx(context, &asked);
        for (number, (&(position, n), direct_lx)) in (0..).zip(asked.iter().zip(direct_lx)) {
            let from = context.world.ray_origin_of_sensor(position, n);
            let frame = Frame::around(n);
            let look = |index: u64| {
                let mut sampler = Sampler::new(&points, number * rays + index);
                let wi = DVec3::from_array(sample_cosine_hemisphere(sampler.next_2d()));
                let start = Emission { from, direction: frame.to_world(wi) };
                fly(context, start, &mut sampler)
            };
            let flown: Vec<Flown> = (0..rays).into_par_iter().map(look).collect();
            let landings =
                flown.into_iter().filter_map(|flown| self.enter(context, flown)).collect();
            self.sensors.push(Surveyed { direct_lx, rays, landings });
        }
    }

    /// Sends rays on from every known cell, and from those that they find.
    fn explore<S: Spectrum>(&mut self, context: &Context<'_, S>, rays_each: u32) {
        let points = context.points(0, Stream::Survey(2));
        loop {
            let unfinished = (0..self.known.len()).filter(|&c| self.known[c].rays < rays_each);
            let round: Vec<usize> = unfinished.collect();
            if round.is_empty() {
                self.first_landings.resize(self.known.len(), FirstLandings::default());
                return;
            }
            let jobs: Vec<(u64, usize, u32)> = round
                .iter()
                .flat_map(|&cell| (0..RAYS_A_ROUND).map(move |ray| (cell, ray)))
                .zip(self.sent..)
                .map(|((cell, ray), index)| (index, cell, ray))
                .collect();
            self.sent += jobs.len() as u64;
            let (known, far_m) = (&self.known, self.cells.far_m());
            let send = |&(index, cell, ray): &(u64, usize, u32)| {
                let SurveyCell { places, rays, .. } = &known[cell];
                let at = &places[(rays + ray) as usize % places.len()];
                go_on(context, &points, index, at, far_m)
            };
            let flown: Vec<Option<Flown>> = jobs.par_iter().map(send).collect();
            for ((_, cell, _), flown) in jobs.into_iter().zip(flown) {
                let landing = flown.and_then(|flown| self.enter(context, flown));
                self.known[cell].rays += 1;
                self.known[cell].landings.extend(landing);
            }
        }
    }

    /// Numbers of a known cell and of those around it.
    pub(crate) fn numbers_around(&self, known: &SurveyCell) -> impl Iterator<Item = usize> {
        let numbers = self.cells.around(known.cell).map(|cell| self.number_of_cell[cell]);
        numbers.filter(|number| *number != Regions::UNKNOWN).map(|number| number as usize)
    }

    /// Counts a flight's rays and takes its end to its cell, which may be new; `None` where it
    /// ended nowhere, or there is no room for new cells.
    fn enter<S: Spectrum>(&mut self, context: &Context<'_, S>, flown: Flown) -> Option<Transition> {
        self.rays += flown.rays;
        let DiffuseHit { at, weight, .. } = flown.found?;
        let place = self.cells.cell(&at);
        let number = &mut self.number_of_cell[place];
        if *number == Regions::UNKNOWN {
            if self.known.len() == MAX_KNOWN {
                return None;
            }
            *number = self.known.len() as u32;
            self.known.push(SurveyCell {
                cell: place,
                places: Vec::new(),
                albedo: 0.0,
                rays: 0,
                landings: Vec::new(),
                connections: Vec::new(),
            });
        }
        let cell = *number;
        let known = &mut self.known[cell as usize];
        if known.places.len() < PLACES {
            let albedo = context
                .world
                .bsdf(&at)
                .albedo(DVec3::Z, at.front, TransportMode::Importance)
                .luminance();
            known.albedo += (albedo - known.albedo) / (known.places.len() + 1) as f64;
            known.places.push(at);
        }
        let Flown { u, far_per_m2, .. } = flown;
        Some(Transition { cell, share: 1.0, weight, far_per_m2, u })
    }
}

/// A target's middle and its normal.
fn centre(target: &Target) -> (DVec3, DVec3) {
    match target {
        Target::Point { position, normal } => (*position, *normal),
        Target::Cell { grid, cell } => (grid.point_in_cell(*cell, [0.5, 0.5]), grid.normal),
    }
}

/// Illuminance straight from the point-like lights, in lx.
fn direct_lx<S: Spectrum>(context: &Context<'_, S>, asked: &[(DVec3, DVec3)]) -> Vec<f64> {
    let mut direct_lx = vec![0.0; asked.len()];
    let receivers = (0..).zip(asked).map(|(who, &(position, n))| {
        let from = context.world.ray_origin_of_sensor(position, n);
        LightRequest { who, vertex: Vertex::sensor(from, n) }
    });
    let receivers: Vec<LightRequest<'_, S>> = receivers.collect();
    let receive = |who: u32, lx: S, _| direct_lx[who as usize] += lx.luminance();
    context.lights.pointlikes.all(&context.world, &receivers, &mut ShadowQueue::default(), receive);
    direct_lx
}

/// A ray on from a place whose albedo is counted elsewhere.
fn go_on<S: Spectrum>(
    context: &Context<'_, S>,
    points: &PointSet,
    index: u64,
    at: &Interaction,
    far_m: f64,
) -> Option<Flown> {
    let mut sampler = Sampler::new(points, index);
    let wi = context
        .world
        .bsdf(at)
        .sample(DVec3::Z, at.front, TransportMode::Importance, &mut sampler)?
        .wi;
    let world = &context.world;
    let u = invert_cosine_hemisphere(wi.abs().to_array()).map(|u| u as f32);
    let from = if wi.z > 0.0 { world.ray_origin(at) } else { world.ray_origin_behind(at) };
    let start = Emission { from, direction: world.frame(at).to_world(wi) };
    let flown = fly(context, start, &mut sampler);
    let far_per_m2 = match &flown.found {
        Some(DiffuseHit { at, is_straight: true, .. }) if wi.z > 0.0 && at.distance_m > far_m => {
            (wi.z * -at.n.dot(start.direction) / (PI * at.distance_m * at.distance_m)) as f32
        }
        _ => 0.0,
    };
    Some(Flown { u, far_per_m2, ..flown })
}

/// Flies to the first surface that keeps illuminance.
fn fly<S: Spectrum>(context: &Context<'_, S>, start: Emission, sampler: &mut Sampler<'_>) -> Flown {
    let world = &context.world;
    let Emission { mut from, mut direction } = start;
    let mut weight = 1.0;
    for passed in 0..MAX_PASSED {
        let rays = u64::from(passed) + 1;
        let nothing = Flown { found: None, rays, ..Flown::NOWHERE };
        let Some(at) = world.trace(from, direction) else { return nothing };
        let (bsdf, frame) = (world.bsdf(&at), world.frame(&at));
        if bsdf.keeps_illuminance() {
            let found = Some(DiffuseHit { at, weight, is_straight: passed == 0 });
            return Flown { found, rays, ..Flown::NOWHERE };
        }
        let wo = frame.to_local(-direction);
        let Some(next) = bsdf.sample(wo, at.front, TransportMode::Importance, sampler) else {
            return nothing;
        };
        weight *= next.weight.luminance();
        from = if next.wi.z > 0.0 { world.ray_origin(&at) } else { world.ray_origin_behind(&at) };
        direction = frame.to_world(next.wi);
    }
    Flown { rays: u64::from(MAX_PASSED), ..Flown::NOWHERE }
}
