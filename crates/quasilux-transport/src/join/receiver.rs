//! What joins each landing of a photon to the sensors that see it.

use super::Joining;
use super::place::Place;
use crate::bsdf::Mode;
use crate::photon::{Flight, PhotonReceiver};
use crate::spectrum::Spectrum;
use crate::stage::Stage;
use crate::tally::{Quantum, Sum};
use crate::targets::Target;
use crate::world::Interaction;
use glam::DVec3;
use quasilux_bvh::Shot;
use quasilux_sampling::{PointSet, SampleCursor};
use std::f64::consts::{FRAC_1_PI, PI};
use std::sync::{Mutex, PoisonError};

/// Rays that are traced together.
const RAYS: usize = 512;
/// Contributions of less than this part of what the target gets in all are left to chance.
const SMALL: f64 = 0.1;
/// The first of the coordinates for places in cells. In two streams a dimension has the same digits, permuted: those
/// that photons draw first would decide where they are joined.
const PLACE_DIMENSION: u32 = 512;
/// Steps from target to target, and from bounce to bounce, of the number that decides it: the additive
/// sequence in two dimensions with the evenest gaps (M. Roberts, "The unreasonable effectiveness of
/// quasirandom sequences", 2018).
const STEPS: [f64; 2] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_2];

/// Some targets that photons are joined to.
#[derive(Clone, Copy)]
pub(super) struct Group<'a> {
    pub(super) targets: &'a [Target],
    /// Illuminance to expect at each, in lx.
    pub(super) expected_lx: &'a [f64],
    /// Terms of the Neumann series that are told apart.
    pub(super) terms: usize,
}

/// Joins the photons of one wave to all targets of a group.
pub(super) struct JoinReceiver<'a, S> {
    stage: &'a Stage<'a, S>,
    joining: &'a Joining,
    group: Group<'a>,
    quantum: Quantum,
    /// Where what this wave found is added in the end.
    sums: &'a Mutex<Vec<Sum>>,
    own: Vec<Sum>,
    /// Coordinates of the places in cells that photons are joined to.
    points: PointSet,
    photon: Option<Seen>,
    sights: Vec<Shot>,
    offers: Vec<Offer>,
    visible: Vec<bool>,
    rays: u64,
}

/// The photon that is being followed.
struct Seen {
    index: u64,
    /// The place in every cell.
    in_cell: [f64; 2],
    /// What decides over small contributions.
    chance: f64,
}

/// What a target gets if nothing stands in the way.
struct Offer {
    /// Number of the sum.
    sum: usize,
    lx: f64,
}

impl<'a, S: Spectrum> JoinReceiver<'a, S> {
    pub(super) fn new(
        stage: &'a Stage<'a, S>,
        joining: &'a Joining,
        group: Group<'a>,
        (points, quantum): (PointSet, Quantum),
        sums: &'a Mutex<Vec<Sum>>,
    ) -> Self {
        Self {
            stage,
            joining,
            group,
            quantum,
            sums,
            own: vec![Sum::default(); group.targets.len() * group.terms],
            points,
            photon: None,
            sights: Vec::new(),
            offers: Vec::new(),
            visible: Vec::new(),
            rays: 0,
        }
    }

    /// Asks for what a photon that leaves a place with this much luminance a lumen, in sr^-1 m^-2 lm,
    /// gives to one target.
    fn ask(&mut self, number: usize, at: &Interaction, leaving: &Leaving, bounces: u32) {
        let Some(Seen { in_cell, chance, .. }) = self.photon else { return };
        let Some(place) = Place::of(&self.group.targets[number], at.position, in_cell) else {
            return;
        };
        let n = place.normal;
        let world = &self.stage.world;
        let from = world.vantage_of_sensor(place.position, n);
        let way = at.position - from.position();
        let (cos_d, cos_d_there) = (n.dot(way), -at.n.dot(way));
        let behind = cos_d_there < 0.0;
        let lm_sr = if behind { leaving.behind } else { leaving.before };
        if cos_d <= 0.0 || lm_sr <= 0.0 {
            return;
        }
        let square_m2 = way.length_squared();
        let pdf_m2 = cos_d * cos_d_there.abs() * FRAC_1_PI / (square_m2 * square_m2);
        if pdf_m2 == 0.0 {
            return;
        }
        let side = if behind { -at.n } else { at.n };
        let shares = self.joining.path_shares(pdf_m2, at.position, side);
        let share = if bounces == 0 { shares.first } else { shares.rest };
        let mut lx = lm_sr * PI * pdf_m2 * place.weight * (1.0 - share);
        let least_lx = SMALL * self.group.expected_lx[number];
        if lx < least_lx {
            let u = chance + number as f64 * STEPS[0] + f64::from(bounces) * STEPS[1];
            if (u - u.floor()) * least_lx >= lx {
                return;
            }
            lx = least_lx;
        }
        // What is not a number counts: the tally must refuse it.
        if lx != 0.0 {
            let distance_m = square_m2.sqrt();
            self.sights.push(from.sight(way / distance_m, distance_m, at.facet));
            let term = (bounces as usize + 1).min(self.group.terms - 1);
            self.offers.push(Offer { sum: number * self.group.terms + term, lx });
        }
    }

    /// Traces the rays that wait.
    fn answer(&mut self) {
        self.rays += self.sights.len() as u64;
        self.stage.world.are_visible(&self.sights, &mut self.visible);
        for (offer, visible) in self.offers.drain(..).zip(&self.visible) {
            if *visible {
                self.own[offer.sum].add(offer.lx, self.quantum);
            }
        }
        self.sights.clear();
    }
}

/// What leaves a place for each side, in lm/sr.
struct Leaving {
    before: f64,
    behind: f64,
}

impl Leaving {
    fn new<S: Spectrum>(stage: &Stage<'_, S>, at: &Interaction, weight: S) -> Self {
        let bsdf = stage.world.bsdf(at);
        let along = |wi: DVec3| {
            let scattered = weight * bsdf.evaluate(DVec3::Z, wi, at.front, Mode::Flux);
            scattered.luminance() * stage.lights.flux_lm
        };
        let behind = if bsdf.transmits() { along(-DVec3::Z) } else { 0.0 };
        Self { before: along(DVec3::Z), behind }
    }
}

impl<S: Spectrum> PhotonReceiver<S> for JoinReceiver<'_, S> {
    fn follow(&mut self, index: u64) {
        if self.photon.as_ref().is_none_or(|photon| photon.index != index) {
            let mut cursor = SampleCursor::new(&self.points, index);
            cursor.skip_to(PLACE_DIMENSION);
            let (in_cell, chance) = (cursor.next_2d(), cursor.next_1d());
            self.photon = Some(Seen { index, in_cell, chance });
        }
    }

    fn flight(&mut self, _flight: &Flight, _weight: S, _bounces: u32) {}

    fn landing(&mut self, at: &Interaction, weight: S, bounces: u32) {
        if self.stage.max_bounces.is_some_and(|most| bounces >= most) {
            return;
        }
        let leaving = Leaving::new(self.stage, at, weight);
        for number in 0..self.group.targets.len() {
            self.ask(number, at, &leaving, bounces);
        }
        if self.sights.len() >= RAYS {
            self.answer();
        }
    }

    fn finish(mut self) -> u64 {
        self.answer();
        let mut sums = self.sums.lock().unwrap_or_else(PoisonError::into_inner);
        sums.iter_mut().zip(self.own).for_each(|(sum, own)| *sum += own);
        self.rays
    }
}
