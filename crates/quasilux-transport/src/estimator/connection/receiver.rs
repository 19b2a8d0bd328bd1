//! Photon receiver that connects each landing to the sensors: shadow rays with Russian roulette on
//! small deviations from the prediction.

use super::ConnectionPlan;
use super::cell_transfer::CellTransfer;
use super::exitant_flux::ExitantFlux;
use super::lock;
use super::receiver_element::ReceiverElement;
use super::view::View;
use crate::context::Context;
use crate::importance::Density;
use crate::photon::receiver::{PhotonReceiver, ReceiverCounts, SeenPhoton};
use crate::spectrum::Spectrum;
use crate::stats::tally::{Quantum, Sum};
use crate::world::Interaction;
use quasilux_bvh::RayQuery;
use quasilux_sampling::{PointSet, Sampler};
use std::f64::consts::PI;
use std::mem::take;
use std::sync::Mutex;

/// Rays that are traced together.
const RAYS: usize = 512;
/// What is right in the open may be in a shadow: it is asked for as if so large a part of it were
/// wrong.
const DOUBT: f64 = 0.25;
/// The first of the coordinates for places in cells. In two streams a dimension has the same
/// digits, permuted: those that photons draw first would decide where they are connected.
const PLACE_DIMENSION: u32 = 512;
/// Steps from target to target, and from bounce to bounce, of the number that decides it, and of
/// the place in a cell from connection to connection: the additive sequence in two dimensions with
/// the evenest gaps (M. Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018).
const STEPS: [f64; 2] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_2];
/// The same in one dimension, for the number that decides it, from connection to connection.
const STEP: f64 = 0.618_033_988_749_894_9;
/// One landing is connected to no more places of one cell.
const MAX_CONNECTIONS: f64 = 16.0;

/// Some targets that photons are connected to.
#[derive(Clone, Copy)]
pub(super) struct Group<'a> {
    pub(super) elements: &'a [ReceiverElement],
    /// Illuminance to expect at each, in lx.
    pub(super) expected_lx: &'a [f64],
    /// What photons are taken to give by the cell they land in.
    pub(super) transfer: Option<&'a CellTransfer>,
    /// Those with an end get no more.
    pub(super) ends: &'a [Option<u64>],
    /// Terms of the Neumann series that are told apart.
    pub(super) terms: usize,
    pub(super) quantum: Quantum,
}

/// Connects the photons of one wave to all targets of a group.
pub(super) struct ConnectionReceiver<'a, S> {
    context: &'a Context<'a, S>,
    plan: &'a ConnectionPlan,
    group: Group<'a>,
    /// Where what this wave found is added in the end.
    sums: &'a Mutex<Vec<Sum>>,
    own: Vec<Sum>,
    /// Coordinates of the places in cells that photons are connected to.
    points: PointSet,
    photon: Option<Seen>,
    /// How close photons are to be expected where it landed, by side.
    landings: [Density; 2],
    /// Predicted illuminance of each target by this landing.
    predicted_lx: Vec<f64>,
    shadow_rays: Vec<RayQuery>,
    light_samples: Vec<LightSample>,
    visible: Vec<bool>,
    rays: u64,
}

/// The photon that is being followed.
pub(super) struct Seen {
    /// The point in every cell.
    in_cell: [f64; 2],
    /// What decides over small contributions.
    u_roulette: f64,
}

/// Unshadowed light of one connection, and its prediction.
struct LightSample {
    /// Number of the sum.
    sum: usize,
    lx: f64,
    predicted_lx: f64,
}

impl Seen {
    /// The sampler of a photon, at its coordinates of these points.
    pub(super) fn sampler<'p>(photon: &Sampler<'_>, points: &'p PointSet) -> Sampler<'p> {
        photon.among(points, PLACE_DIMENSION)
    }

    pub(super) fn draw(sampler: &mut Sampler<'_>) -> Self {
        Self { in_cell: sampler.next_2d(), u_roulette: sampler.next_1d() }
    }
}

impl<'a, S: Spectrum> ConnectionReceiver<'a, S> {
    pub(super) fn new(
        context: &'a Context<'a, S>,
        plan: &'a ConnectionPlan,
        group: Group<'a>,
        points: PointSet,
        sums: &'a Mutex<Vec<Sum>>,
    ) -> Self {
        Self {
            context,
            plan,
            group,
            sums,
            own: vec![Sum::default(); group.elements.len() * group.terms],
            points,
            photon: None,
            landings: [Density::default(); 2],
            predicted_lx: vec![0.0; group.elements.len()],
            shadow_rays: Vec::new(),
            light_samples: Vec::new(),
            visible: Vec::new(),
            rays: 0,
        }
    }

    /// Queues the shadow rays of a landing to one target, for the deviation from the prediction.
    fn ask(&mut self, number: usize, at: &Interaction, leaving: &ExitantFlux, bounces: u32) {
        let Some(Seen { in_cell, u_roulette }) = self.photon else { return };
        let (predicted_lx, element) = (self.predicted_lx[number], &self.group.elements[number]);
        let certain_lx = self.plan.small * self.group.expected_lx[number];
        let u_roulette = u_roulette + number as f64 * STEPS[0] + f64::from(bounces) * STEPS[1];
        let max_lx = leaving.lm_sr() * element.max_lx_sr_lm(at);
        let is_surely_left = |lx: f64| (1.0 + DOUBT) * lx <= fraction(u_roulette) * certain_lx;
        if is_surely_left(max_lx) && is_surely_left(predicted_lx) {
            return;
        }
        let connections = if predicted_lx > certain_lx && !element.is_point() {
            (predicted_lx / certain_lx).ceil().min(MAX_CONNECTIONS)
        } else {
            1.0
        };
        for connection in (0..MAX_CONNECTIONS as u32)
            .map(f64::from)
            .take_while(|connection| *connection < connections)
        {
            let place = [0, 1].map(|axis| fraction(in_cell[axis] + connection * STEPS[axis]));
            let u = fraction(u_roulette + connection * STEP);
            let view = View::new(&self.context.world, element, at, place);
            let lx = view.as_ref().map_or(0.0, |view| self.unshadowed_lx(view, leaving, bounces));
            let asked = ((lx - predicted_lx).abs() + DOUBT * lx.max(predicted_lx))
                / (connections * certain_lx);
            if asked <= u {
                continue;
            }
            let factor = if asked < 1.0 { 1.0 / (connections * asked) } else { 1.0 / connections };
            let term = (bounces as usize + 1).min(self.group.terms - 1);
            let sum = number * self.group.terms + term;
            let light_sample =
                LightSample { sum, lx: lx * factor, predicted_lx: predicted_lx * factor };
            match view {
                // What is not a number counts: the tally must refuse it.
                Some(view) if lx != 0.0 => {
                    self.shadow_rays.push(view.shadow_ray());
                    self.light_samples.push(light_sample);
                }
                _ => self.add(sum, -light_sample.predicted_lx),
            }
        }
    }

    /// What a target gets if nothing stands in the way.
    fn unshadowed_lx(&self, view: &View, leaving: &ExitantFlux, bounces: u32) -> f64 {
        let side = usize::from(view.behind);
        let weights_of_paths = self.plan.partition.path_weights(view.pdf_m2, self.landings[side]);
        let share = if bounces == 0 { weights_of_paths.first } else { weights_of_paths.rest };
        leaving.sides[side].lm_sr * PI * view.pdf_m2 * view.weight * (1.0 - share)
    }

    /// Traces the rays that wait.
    fn answer(&mut self) {
        self.rays += self.shadow_rays.len() as u64;
        self.context.world.are_visible(&self.shadow_rays, &mut self.visible);
        let (light_samples, visible) = (take(&mut self.light_samples), take(&mut self.visible));
        for (light_sample, visible) in light_samples.iter().zip(&visible) {
            let lx = if *visible { light_sample.lx } else { 0.0 };
            self.add(light_sample.sum, lx - light_sample.predicted_lx);
        }
        (self.light_samples, self.visible) = (light_samples, visible);
        self.light_samples.clear();
        self.shadow_rays.clear();
    }

    /// Adds what one connection gives beyond its prediction.
    fn add(&mut self, sum: usize, lx: f64) {
        self.own[sum].add_signed(lx, self.group.quantum);
    }
}

/// Of a number that is not negative.
fn fraction(x: f64) -> f64 {
    x - (x as u64) as f64
}

impl<S: Spectrum> PhotonReceiver<S> for ConnectionReceiver<'_, S> {
    fn follow(&mut self, sampler: &Sampler<'_>) {
        self.photon = Some(Seen::draw(&mut Seen::sampler(sampler, &self.points)));
    }

    fn landing(&mut self, at: &Interaction, photon: &SeenPhoton<S>) {
        let &SeenPhoton { weight, bounces, .. } = photon;
        let leaving = ExitantFlux::new(self.context, self.plan, at, weight, bounces);
        let Some(leaving) = leaving else { return };
        self.landings =
            leaving.sides.map(|side| self.plan.partition.landings.density(&side.around));
        if let Some(transfer) = self.group.transfer {
            transfer.predict(&leaving, bounces == 0, &mut self.predicted_lx);
        }
        for number in 0..self.group.elements.len() {
            if self.group.ends[number].is_none() {
                self.ask(number, at, &leaving, bounces);
            }
        }
        if self.shadow_rays.len() >= RAYS {
            self.answer();
        }
    }

    fn finish(mut self) -> ReceiverCounts {
        self.answer();
        let mut sums = lock(self.sums);
        sums.iter_mut().zip(self.own).for_each(|(sum, own)| *sum += own);
        ReceiverCounts { rays: self.rays, invalid: 0 }
    }
}
