//! A unit of the work: some targets, in one replicate, with a few indices that follow each other.
//!
//! The light subpaths of these indices are traced once; they are counted where they cross the
//! targets, joined to them, and connected to their eye paths.

use super::counters::{Counters, Crossing};
use super::engine::Engine;
use super::eye_path::{EyePaths, Sink, Start};
use super::flux_tally::FluxTally;
use super::joins::{JoinWork, Joiner};
use super::light_subpath::LightSubpaths;
use super::partner::partners;
use super::plan::{Receiver, SUBPATHS, connected};
use super::sums::TargetSums;
use crate::context::Stream;
use crate::path::path_batch::WorkCounts;
use crate::path::wave::WAVE;
use crate::spectrum::Spectrum;
use crate::stats::tally::Quantum;
use crate::world::vertex::Vertex;
use quasilux_sampling::{PointSet, Sampler};
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Indices of a unit at most, and the first is a multiple.
pub(super) const INDICES: u64 = 16;

/// Targets whose shadow rays of joins are traced together.
const ASKED_TOGETHER: usize = 16;

/// Some targets with some indices in one replicate.
pub(super) struct Unit<'t> {
    pub(super) replicate: u32,
    /// All within the same [`INDICES`].
    pub(super) indices: Range<u64>,
    /// In ascending order.
    pub(super) targets: &'t [usize],
}

/// The sums of all sections, with their unit.
struct SectionSums<'f> {
    sums: &'f mut [TargetSums],
    quantum: Quantum,
}

impl<S: Spectrum> Sink<S> for SectionSums<'_> {
    fn add(&mut self, section: usize, bounces: u32, light: S) {
        self.sums[section].add(bounces, light.luminance(), self.quantum);
    }

    fn add_merged(&mut self, section: usize, bounces: u32, light: S) {
        self.sums[section].add_merged(bounces, light.luminance(), self.quantum);
    }
}

/// Sums of a unit, and counts of its work.
#[derive(Serialize, Deserialize)]
pub(super) struct UnitSums {
    /// Of each target.
    pub(super) sums: Vec<TargetSums>,
    pub(super) work: WorkCounts,
    pub(super) photons: u64,
    pub(super) flux: FluxTally,
}

impl Unit<'_> {
    pub(super) fn trace<S: Spectrum>(
        &self,
        engine: &Engine<'_, '_, S>,
        quantum: Quantum,
    ) -> UnitSums {
        let Engine { context, receivers, .. } = engine;
        let receivers: Vec<&Receiver> =
            self.targets.iter().map(|target| &receivers[*target]).collect();
        let empty = TargetSums::new(context.listed_terms);
        let mut sums = vec![empty; self.targets.len()];
        let points = context.points(self.replicate, Stream::SharedSubpaths);
        // Subpaths that are connected must not have the same digits.
        let samplers = partners(&points, self.indices.clone(), SUBPATHS);
        let counters = Counters::new(&context.world, &receivers);
        let found = &mut SectionSums { sums: &mut sums, quantum };
        let light = LightSubpaths::trace(engine, samplers, |passing| {
            counters.cross(engine, &receivers, passing, |crossing| {
                let Crossing { section, light, bounces } = crossing;
                found.add_merged(section, bounces, light);
            });
        });
        let (rays, endless) = (light.rays, light.endless);
        let mut work = WorkCounts { rays, endless, ..WorkCounts::default() };
        work.rays += self.join(engine, &receivers, &light, found);
        work += self.gather(engine, &receivers, &light, found);
        let photons = (self.indices.end - self.indices.start) * SUBPATHS;
        UnitSums { sums, work, photons, flux: light.flux }
    }

    /// Joins light vertices to the targets; the number of rays.
    fn join<S: Spectrum>(
        &self,
        engine: &Engine<'_, '_, S>,
        receivers: &[&Receiver],
        light: &LightSubpaths<S>,
        found: &mut SectionSums<'_>,
    ) -> u64 {
        let Engine { context, .. } = engine;
        let world = &context.world;
        let mut work = JoinWork::default();
        work.shadows.max_bounces = context.max_bounces.unwrap_or(u32::MAX);
        for (section, (target, receiver)) in self.targets.iter().zip(receivers).enumerate() {
            let points = context.points(self.replicate, Stream::Joins(*target as u64));
            let places = (0..).step_by(SUBPATHS as usize);
            for (place, index) in places.zip(self.indices.clone()) {
                let u = || [0, 1].map(|dimension| points.coordinate(index, dimension));
                let vertex = Vertex::sensor(receiver.origin(world, u), receiver.n);
                let mut joiner = Joiner {
                    receiver,
                    way_out: engine.way_out_of_start(receiver, &vertex),
                    vertex,
                    max_bounces: work.shadows.max_bounces,
                    next: points.coordinate(index, 2),
                };
                let numbers = light.numbers_of(place..place + SUBPATHS as usize);
                joiner.join(engine, section as u32, light, numbers, &mut work);
            }
            let asked = section + 1;
            if asked % ASKED_TOGETHER == 0 || asked == receivers.len() {
                work.shadows.answer(world, |who, light: S, bounces| {
                    found.add(who as usize, bounces, light);
                });
            }
        }
        work.shadows.rays
    }

    /// Traces the eye paths.
    fn gather<S: Spectrum>(
        &self,
        engine: &Engine<'_, '_, S>,
        receivers: &[&Receiver],
        light: &LightSubpaths<S>,
        found: &mut SectionSums<'_>,
    ) -> WorkCounts {
        let Engine { context, .. } = engine;
        let mut paths = EyePaths::default();
        let at_once = (WAVE / (self.indices.end - self.indices.start)).max(1) as usize;
        for first in (0..self.targets.len()).step_by(at_once) {
            let sections = first..(first + at_once).min(self.targets.len());
            let stream = |section: usize| Stream::EyeSubpaths(self.targets[section] as u64);
            let points: Vec<PointSet> = sections
                .clone()
                .map(|section| context.points(self.replicate, stream(section)))
                .collect();
            let starts = sections.zip(&points).flat_map(|(section, points)| {
                let target = self.targets[section];
                (0..).zip(self.indices.clone()).map(move |(place, index)| {
                    let subpath = place * SUBPATHS + connected(target, index, SUBPATHS);
                    Start {
                        section,
                        receiver: receivers[section],
                        light,
                        subpath: subpath as usize,
                        sampler: Sampler::new(points, index),
                        surface: None,
                    }
                })
            });
            paths.trace(engine, starts, found);
        }
        paths.work
    }
}
