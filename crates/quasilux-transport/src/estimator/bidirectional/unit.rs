//! A unit of the work: some targets, in one replicate, with a few indices that follow each other.
//!
//! The light subpaths of these indices are traced once; they are counted where they cross the
//! targets, joined to them, and connected to their eye paths.

use super::counters::{Counters, Crossing};
use super::engine::Engine;
use super::eye_path::{EyePaths, SectionSums, Start};
use super::joins::Joiner;
use super::light_subpath::LightSubpaths;
use super::plan::Receiver;
use super::sums::TargetSums;
use crate::context::Stream;
use crate::path::sections::{WorkCounts, partner};
use crate::path::wave::WAVE;
use crate::spectrum::Spectrum;
use crate::stats::tally::Quantum;
use crate::stats::targets::Target;
use crate::world::visibility::ShadowQueue;
use quasilux_sampling::{PointSet, Sampler};
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Indices of a unit at most, and the first is a multiple.
pub(super) const INDICES: u64 = 16;

/// Some targets with some indices in one replicate.
pub(super) struct Unit<'t> {
    pub(super) replicate: u32,
    /// All within the same [`INDICES`].
    pub(super) indices: Range<u64>,
    /// In ascending order.
    pub(super) targets: &'t [usize],
}

/// What came of a unit.
#[derive(Serialize, Deserialize)]
pub(super) struct UnitSums {
    /// Of each target.
    pub(super) sums: Vec<TargetSums>,
    pub(super) work: WorkCounts,
    pub(super) photons: u64,
}

impl Unit<'_> {
    pub(super) fn trace<S: Spectrum>(
        &self,
        engine: &Engine<'_, '_, S>,
        quantum: Quantum,
    ) -> UnitSums {
        let Engine { context, plan, .. } = engine;
        let receivers: Vec<&Receiver> =
            self.targets.iter().map(|target| &plan.receivers[*target]).collect();
        let empty = TargetSums::new(context.listed_terms);
        let mut sums = vec![empty; self.targets.len()];
        let points = context.points(self.replicate, Stream::SharedSubpaths);
        // Subpaths that are connected must not have the same digits.
        let samplers = self.indices.clone().flat_map(|index| {
            let own = partner(index) * plan.subpaths;
            (own..own + plan.subpaths).map(|index| Sampler::new(&points, index))
        });
        let counters = Counters::new(&context.world, &receivers);
        let light = LightSubpaths::trace(engine, samplers, |passing| {
            counters.cross(engine, &receivers, passing, |crossing| {
                let Crossing { section, light, bounces } = crossing;
                sums[section].add_merged(bounces, light.luminance(), quantum);
            });
        });
        let mut work = WorkCounts { rays: light.rays, ..WorkCounts::default() };
        work.endless += light.endless;
        work.rays += self.join(engine, &receivers, &light, quantum, &mut sums);
        let of_paths = self.gather(engine, &receivers, &light, quantum, &mut sums);
        work += of_paths;
        let photons = (self.indices.end - self.indices.start) * plan.subpaths;
        UnitSums { sums, work, photons }
    }

    /// Joins light vertices to the targets; the number of rays.
    fn join<S: Spectrum>(
        &self,
        engine: &Engine<'_, '_, S>,
        receivers: &[&Receiver],
        light: &LightSubpaths<S>,
        quantum: Quantum,
        sums: &mut [TargetSums],
    ) -> u64 {
        let Engine { context, plan, .. } = engine;
        let world = &context.world;
        let mut shadows = ShadowQueue::default();
        shadows.max_bounces = context.max_bounces.unwrap_or(u32::MAX);
        let mut asked = 0;
        for (section, (target, receiver)) in self.targets.iter().zip(receivers).enumerate() {
            let points = context.points(self.replicate, Stream::Joins(*target as u64));
            let (position, n) = (receiver.position, receiver.n);
            let from = match receiver.target {
                Target::Point { position, normal } => world.ray_origin_of_sensor(position, normal),
                Target::Cell { .. } => world.ray_origin_of_sensor(position, n),
            };
            let mut joiner = Joiner { receiver, from, n, next: 0.0 };
            for (place, index) in (0..).zip(self.indices.clone()) {
                if let Target::Cell { grid, cell } = receiver.target {
                    let u = [0, 1].map(|dimension| points.coordinate(index, dimension));
                    joiner.from = world.ray_origin_of_sensor(grid.point_in_cell(cell, u), n);
                }
                joiner.next = points.coordinate(index, 2);
                let first = (place * plan.subpaths + plan.first_joined(*target, index)) as usize;
                for subpath in first..first + plan.joined as usize {
                    joiner.join(engine, section as u32, light.vertices_of(subpath), &mut shadows);
                }
            }
            asked += 1;
            if asked % 64 == 0 || asked == receivers.len() {
                shadows.answer(world, |who, light: S, bounces| {
                    sums[who as usize].add(bounces, light.luminance(), quantum);
                });
            }
        }
        shadows.rays
    }

    /// Traces the eye paths.
    fn gather<S: Spectrum>(
        &self,
        engine: &Engine<'_, '_, S>,
        receivers: &[&Receiver],
        light: &LightSubpaths<S>,
        quantum: Quantum,
        sums: &mut [TargetSums],
    ) -> WorkCounts {
        let Engine { context, plan, .. } = engine;
        let mut paths = EyePaths::default();
        let mut found = SectionSums { sums, quantum };
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
                    let subpath = place * plan.subpaths + plan.connected(target, index);
                    Start {
                        section,
                        receiver: receivers[section],
                        light,
                        subpath: subpath as usize,
                        sampler: Sampler::new(points, index),
                    }
                })
            });
            paths.trace(engine, starts, &mut found);
        }
        paths.work
    }
}
