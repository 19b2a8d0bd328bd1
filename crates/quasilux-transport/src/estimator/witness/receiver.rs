//! Photon receiver of the witness: each landing is a virtual point light to every target.

use crate::bsdf::TransportMode;
use crate::context::Context;
use crate::estimator::connection::{ReceiverElement, View};
use crate::photon::receiver::{PhotonReceiver, ReceiverCounts, SeenPhoton};
use crate::spectrum::Spectrum;
use crate::stats::tally::{Quantum, Sum};
use crate::world::Interaction;
use glam::DVec3;
use quasilux_bvh::RayQuery;
use quasilux_sampling::{PointSet, Sampler};
use std::f64::consts::PI;
use std::sync::{Mutex, PoisonError};

/// Rays that are traced together.
const RAYS: usize = 512;
/// The first of the coordinates for places in cells: photons leave it alone.
const PLACE_DIMENSION: u32 = 512;
/// Steps of the place in a cell from target to target and from landing to landing: the additive
/// sequence in two dimensions with the evenest gaps (M. Roberts, "The unreasonable effectiveness of
/// quasirandom sequences", 2018).
const STEPS: [f64; 2] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_2];

/// Joins the photons of one wave to all targets.
pub(super) struct WitnessReceiver<'w, 'a, S> {
    context: &'w Context<'a, S>,
    elements: &'w [ReceiverElement],
    /// Coordinates of places in cells.
    places: PointSet,
    quantum: Quantum,
    /// Where what this wave found is added in the end.
    sums: &'w Mutex<Vec<Sum>>,
    own: Vec<Sum>,
    /// Place of the photon in every cell, moved on with each connection.
    in_cell: [f64; 2],
    shadow_rays: Vec<RayQuery>,
    light_samples: Vec<LightSample>,
    visible: Vec<bool>,
    rays: u64,
}

/// Unshadowed light of one connection.
struct LightSample {
    target: usize,
    lx: f64,
}

impl<'w, 'a, S: Spectrum> WitnessReceiver<'w, 'a, S> {
    pub(super) fn new(
        context: &'w Context<'a, S>,
        elements: &'w [ReceiverElement],
        places: PointSet,
        quantum: Quantum,
        sums: &'w Mutex<Vec<Sum>>,
    ) -> Self {
        Self {
            context,
            elements,
            places,
            quantum,
            sums,
            own: vec![Sum::default(); elements.len()],
            in_cell: [0.0; 2],
            shadow_rays: Vec::new(),
            light_samples: Vec::new(),
            visible: Vec::new(),
            rays: 0,
        }
    }

    /// Traces the rays that wait.
    fn answer(&mut self) {
        self.rays += self.shadow_rays.len() as u64;
        self.context.world.are_visible(&self.shadow_rays, &mut self.visible);
        for (light_sample, visible) in self.light_samples.drain(..).zip(&self.visible) {
            if *visible {
                self.own[light_sample.target].add(light_sample.lx, self.quantum);
            }
        }
        self.shadow_rays.clear();
    }
}

impl<S: Spectrum> PhotonReceiver<S> for WitnessReceiver<'_, '_, S> {
    fn follow(&mut self, sampler: &Sampler<'_>) {
        self.in_cell = sampler.among(&self.places, PLACE_DIMENSION).next_2d();
    }

    fn landing(&mut self, at: &Interaction, photon: &SeenPhoton<S>) {
        let &SeenPhoton { weight, bounces, .. } = photon;
        let Context { world, lights, max_bounces, .. } = self.context;
        if max_bounces.is_some_and(|most| bounces >= most) {
            return;
        }
        let bsdf = world.bsdf(at);
        // Intensity over the cosine, in lm/sr, to the side that it came from and to the other.
        let leaving_lm_sr = [DVec3::Z, -DVec3::Z].map(|wi| {
            let scattered =
                weight * bsdf.evaluate(DVec3::Z, wi, at.front, TransportMode::Importance);
            scattered.luminance() * lights.flux_lm
        });
        for (target, element) in self.elements.iter().enumerate() {
            for (place, step) in self.in_cell.iter_mut().zip(STEPS) {
                *place += step;
                *place -= place.floor();
            }
            let Some(view) = View::new(world, element, at, self.in_cell) else { continue };
            let lm_sr = leaving_lm_sr[usize::from(view.behind)];
            let lx = lm_sr * PI * view.pdf_m2 * view.weight;
            if lx != 0.0 {
                self.shadow_rays.push(view.shadow_ray());
                self.light_samples.push(LightSample { target, lx });
            }
        }
        if self.shadow_rays.len() >= RAYS {
            self.answer();
        }
    }

    fn finish(mut self) -> ReceiverCounts {
        self.answer();
        let mut sums = self.sums.lock().unwrap_or_else(PoisonError::into_inner);
        sums.resize(self.own.len(), Sum::default());
        sums.iter_mut().zip(self.own).for_each(|(sum, own)| *sum += own);
        ReceiverCounts { rays: self.rays, invalid: 0 }
    }
}
