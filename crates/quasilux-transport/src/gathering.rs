//! The estimators that gather: paths from every sensor point, alone or ending on a map.

use crate::end::{End, Growth};
use crate::estimates::{Dimensions, Estimates};
use crate::path::{Gathered, PathWork, Rest, trace_path};
use crate::photon::{MOST_EVENTS, PhotonCounts};
use crate::settings::Settings;
use crate::simulate::Estimation;
use crate::spectrum::Spectrum;
use crate::stage::{Stage, Stream};
use crate::tally::{Quantum, Sum};
use crate::targets::{Target, by_sensor, targets};
use crate::watch::Watch;
use quasilux_sampling::{DimensionHistogram, SampleCursor};
use quasilux_scene::Scene;
use rayon::prelude::*;
use std::ops::{AddAssign, Range};

/// Paths of one piece of work.
const BLOCK: u64 = 256;
/// Pieces of work between two words to the observer.
const BLOCKS_PER_ROUND: u64 = 512;
/// The first checkpoint takes at most this many indices, and about this many paths in all.
const FIRST_SAMPLES: u64 = 16;
const FIRST_PATHS: u64 = 1 << 22;
/// Paths from all sensor points, in all replicates.
pub(crate) struct Gathering<'a, S> {
    stage: &'a Stage<'a, S>,
    scene: &'a Scene,
    targets: Vec<Target>,
    /// Direct light of point-like lights in lx, for targets that are points.
    exact_direct_lx: Vec<f64>,
    end: End<S>,
    replicates: u32,
    quantum: Quantum,
    /// Of target t in replicate r at `t * replicates + r`.
    sums: Vec<PathSums>,
    samples: u64,
    work: WorkCounts,
    photons: PhotonCounts,
    /// Targets whose direct light is not finite.
    invalid_points: u64,
    /// Targets to which light that is sampled may come straight.
    samples_direct: Vec<bool>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct PathSums {
    direct: Sum,
    indirect: Sum,
    /// Paths that came to a surface that reflects.
    reflected: u64,
}

#[derive(Clone, Debug, Default)]
struct WorkCounts {
    paths: u64,
    rays: u64,
    dimensions: DimensionHistogram,
    endless: u64,
}

/// One piece of work: some paths of one target in one replicate.
struct Block {
    target: usize,
    replicate: u32,
    indices: Range<u64>,
}

impl<'a, S: Spectrum> Gathering<'a, S> {
    pub(crate) fn new(
        stage: &'a Stage<'a, S>,
        scene: &'a Scene,
        settings: &Settings,
        watch: &mut Watch<'_>,
    ) -> Self {
        let targets = targets(scene);
        let replicates = settings.effective_replicates();
        let mut work = WorkCounts::default();
        let mut exact_direct_lx = exact_direct(stage, &targets, &mut work.rays);
        let mut invalid_points = 0;
        for value_lx in exact_direct_lx.iter_mut().filter(|value_lx| !value_lx.is_finite()) {
            // A light right at a sensor point has no illuminance to speak of.
            *value_lx = 0.0;
            invalid_points += 1;
        }
        let samples_direct = targets.iter().map(|target| samples_direct(stage, target)).collect();
        let (end, photons) = End::prepare(stage, settings, replicates, watch);
        Self {
            stage,
            scene,
            exact_direct_lx,
            end,
            replicates,
            quantum: Quantum::for_reference(stage.lights.reference_lx(&stage.world)),
            sums: vec![PathSums::default(); targets.len() * replicates as usize],
            targets,
            samples: 0,
            work,
            photons,
            invalid_points,
            samples_direct,
        }
    }

    /// Piece of work number `block` of the paths `indices` of all targets and replicates.
    fn block(&self, block: u64, indices: &Range<u64>) -> Block {
        let blocks_each = (indices.end - indices.start).div_ceil(BLOCK);
        let which = block / blocks_each;
        let first = indices.start + block % blocks_each * BLOCK;
        Block {
            target: (which / u64::from(self.replicates)) as usize,
            replicate: (which % u64::from(self.replicates)) as u32,
            indices: first..(first + BLOCK).min(indices.end),
        }
    }

    fn trace_block(&self, block: &Block) -> (PathSums, WorkCounts) {
        let points = self.stage.points(block.replicate, Stream::Paths(block.target as u64));
        let rest = self.end.rest(block.replicate);
        let mut sums = PathSums::default();
        let mut work = PathWork::default();
        let (mut dimensions, mut endless) = (DimensionHistogram::new(), 0);
        for index in block.indices.clone() {
            let mut cursor = SampleCursor::new(&points, index);
            let found = self.trace_one(self.targets[block.target], &rest, &mut cursor, &mut work);
            sums.add(found, self.quantum);
            dimensions.record(cursor.used());
            endless += u64::from(found.endless);
        }
        let paths = block.indices.end - block.indices.start;
        (sums, WorkCounts { paths, rays: work.rays, dimensions, endless })
    }

    fn trace_one(
        &self,
        target: Target,
        rest: &Rest<'_, S>,
        cursor: &mut SampleCursor<'_>,
        work: &mut PathWork,
    ) -> Gathered {
        let stage = self.stage;
        match target {
            Target::Point { position, normal } => {
                let from = stage.world.vantage_of_sensor(position, normal);
                trace_path(stage, from, normal, rest, cursor, work)
            }
            Target::Cell { grid, cell } => {
                let position = grid.point_in_cell(cell, cursor.next_2d());
                let from = stage.world.vantage_of_sensor(position, grid.normal);
                let mut found = trace_path(stage, from, grid.normal, rest, cursor, work);
                let pointlikes = &stage.lights.pointlikes;
                found.direct_lx += pointlikes.all(&stage.world, from, grid.normal, &mut work.rays);
                found
            }
        }
    }
}

impl<S> Gathering<'_, S> {
    /// Whether the paths of each target found light where they came to surfaces that reflect.
    fn resolved(&self) -> Vec<bool> {
        self.sums
            .chunks_exact(self.replicates as usize)
            .zip(&self.samples_direct)
            .map(|(own, samples_direct)| {
                let found_direct = own.iter().any(|sums| !sums.direct.is_zero());
                let found_indirect = own.iter().any(|sums| !sums.indirect.is_zero());
                let reflected = own.iter().any(|sums| sums.reflected > 0);
                (found_indirect || !reflected)
                    && (found_direct || found_indirect || !samples_direct)
            })
            .collect()
    }

    fn warning(&self) -> Option<String> {
        let paths = self.work.endless;
        (paths > 0).then(|| {
            format!("{paths} paths were cut after {MOST_EVENTS} bounces: light is trapped here, and values are too low")
        })
    }
}

impl<S: Spectrum> Estimation for Gathering<'_, S> {
    fn advance(&mut self, samples: u64, watch: &mut Watch<'_>) -> bool {
        let mut indices = self.samples..samples;
        match self.end.grow(self.stage, indices.clone(), watch) {
            Growth::Stopped => return false,
            Growth::None => {}
            Growth::NewMaps(photons) => {
                // The maps have changed, and what was read from them with them.
                self.photons += photons;
                self.sums.fill(PathSums::default());
                indices.start = 0;
            }
        }
        let blocks_each = (indices.end - indices.start).div_ceil(BLOCK);
        let blocks = blocks_each * self.sums.len() as u64;
        let mut done = 0;
        while done < blocks {
            let round = done..(done + BLOCKS_PER_ROUND).min(blocks);
            let found: Vec<(PathSums, WorkCounts)> = round
                .clone()
                .into_par_iter()
                .map(|block| self.trace_block(&self.block(block, &indices)))
                .collect();
            let (paths_before, rays_before) = (self.work.paths, self.work.rays);
            for (block, (sums, work)) in round.clone().zip(found) {
                self.sums[(block / blocks_each) as usize] += sums;
                self.work += work;
            }
            done = round.end;
            let (paths, rays) = (self.work.paths - paths_before, self.work.rays - rays_before);
            if !watch.tick(0, paths, rays, done as f64 / blocks as f64) {
                return false;
            }
        }
        self.samples = samples;
        true
    }

    fn estimates(&self) -> Estimates {
        let n = self.samples as f64;
        let replicates = self.replicates as usize;
        let mean = |sum: Sum| self.quantum.value(sum) / n;
        let row = |r: usize| -> Vec<f64> {
            let own = self.sums.iter().skip(r).step_by(replicates);
            own.zip(&self.exact_direct_lx)
                .map(|(sums, exact_lx)| exact_lx + (mean(sums.direct) + mean(sums.indirect)))
                .collect()
        };
        let rows: Vec<Vec<f64>> = (0..replicates).map(row).collect();
        let direct_lx: Vec<f64> = self
            .sums
            .chunks_exact(replicates)
            .zip(&self.exact_direct_lx)
            .map(|(own, exact_lx)| {
                exact_lx + own.iter().map(|sums| mean(sums.direct)).sum::<f64>() / replicates as f64
            })
            .collect();
        Estimates {
            sensors: by_sensor(self.scene, &rows, &direct_lx, &self.resolved()),
            samples: self.samples,
            rays: self.work.rays + self.photons.rays,
            flux: self.photons.balance(self.stage.lights.flux_lm),
            dimensions: Dimensions {
                photon: self.photons.dimensions.clone(),
                path: self.work.dimensions.clone(),
            },
            invalid_contributions: self.invalid_points
                + self.sums.iter().map(PathSums::invalid).sum::<u64>(),
            biased: self.work.endless > 0,
            warnings: self.photons.warnings().into_iter().chain(self.warning()).collect(),
            ..Estimates::default()
        }
    }

    fn first_checkpoint(&self) -> u64 {
        let affordable = FIRST_PATHS / (self.sums.len() as u64).max(1);
        let powers = (affordable + 1).next_power_of_two() / 2;
        powers.clamp(1, FIRST_SAMPLES)
    }
}

/// Whether light whose direct part is sampled may come straight to a target: not to one with all such
/// luminaires behind it.
fn samples_direct<S: Spectrum>(stage: &Stage<'_, S>, target: &Target) -> bool {
    let luminaires = &stage.lights.area_luminaires;
    stage.lights.emitters.is_some()
        || match *target {
            Target::Point { position, normal } => luminaires.may_light(position, normal),
            Target::Cell { .. } => !luminaires.is_empty(),
        }
}

/// Direct light of the point-like lights at each target that is a point, in lx: all of them tested.
fn exact_direct<S: Spectrum>(stage: &Stage<'_, S>, targets: &[Target], rays: &mut u64) -> Vec<f64> {
    let found: Vec<(f64, u64)> = targets
        .par_iter()
        .map(|target| {
            let mut rays = 0;
            let Target::Point { position, normal } = *target else { return (0.0, 0) };
            let from = stage.world.vantage_of_sensor(position, normal);
            let direct_lx = stage.lights.pointlikes.all(&stage.world, from, normal, &mut rays);
            (direct_lx, rays)
        })
        .collect();
    *rays += found.iter().map(|(_, rays)| rays).sum::<u64>();
    found.into_iter().map(|(direct_lx, _)| direct_lx).collect()
}

impl PathSums {
    fn add(&mut self, found: Gathered, quantum: Quantum) {
        self.direct.add(found.direct_lx, quantum);
        self.indirect.add_signed(found.indirect_lx, quantum);
        self.reflected += u64::from(found.reflected);
    }

    fn invalid(&self) -> u64 {
        self.direct.invalid + self.indirect.invalid
    }
}

impl AddAssign for PathSums {
    fn add_assign(&mut self, other: Self) {
        self.direct += other.direct;
        self.indirect += other.indirect;
        self.reflected += other.reflected;
    }
}

impl AddAssign for WorkCounts {
    fn add_assign(&mut self, other: Self) {
        self.paths += other.paths;
        self.rays += other.rays;
        self.dimensions.merge(&other.dimensions);
        self.endless += other.endless;
    }
}
