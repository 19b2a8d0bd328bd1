//! Batches of paths, one target in one replicate each, that are traced in one wave, and their
//! sums.

use crate::codec::{Sums, add_count, histogram};
use crate::context::Context;
use crate::path::contribution::PathContribution;
use crate::path::end::MapEnd;
use crate::path::start::{Measurement, PathMaps, Start};
use crate::path::trace::PathResult;
use crate::path::wave::PathWave;
use crate::photon::caustics::CausticLookup;
use crate::purpose::Purpose;
use crate::sensors::Target;
use crate::spectrum::Spectrum;
use crate::stats::scores::Scores;
use crate::stats::tally::{Quantum, Sum};
use quasilux_sampling::{DimensionHistogram, PointSet, Sampler};
use serde::{Deserialize, Serialize};
use std::ops::{AddAssign, Range};

/// Sums over all paths of one target in one replicate.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct PathSums {
    pub(crate) direct: Sum,
    pub(crate) indirect: Sum,
    /// Both by the number of bounces, as [`PathContribution::terms`].
    pub(crate) terms: Vec<Sum>,
    /// Paths that came to a surface that reflects.
    pub(crate) reflected: u64,
}

/// Counts of work done for paths.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct WorkCounts {
    pub(crate) paths: u64,
    pub(crate) rays: u64,
    #[serde(with = "histogram")]
    pub(crate) dimensions: DimensionHistogram,
    pub(crate) endless: u64,
}

/// Some paths of one target in one replicate.
pub(crate) struct PathBatch<'g, S> {
    /// Which of all pairs of target and replicate.
    pub(crate) number: usize,
    pub(crate) target: Target,
    pub(crate) points: PointSet,
    pub(crate) map_end: Option<MapEnd<'g, S>>,
    pub(crate) caustics: Option<CausticLookup<'g, S>>,
    pub(crate) indices: Range<u64>,
}

/// Results of the paths of neighbouring batches.
pub(crate) struct Piece {
    /// Number of the first batch.
    pub(crate) first: usize,
    /// Of each batch.
    pub(crate) sums: Vec<PathSums>,
    /// Counts of single paths of each batch by their value.
    pub(crate) scores: Vec<Scores>,
    pub(crate) work: WorkCounts,
}

/// Traces the paths of at least one batch together; the numbers of batches follow each other.
pub(crate) fn trace_batches<S: Spectrum>(
    context: &Context<'_, S>,
    batches: &[PathBatch<'_, S>],
    quantum: Quantum,
    wave: &mut PathWave<S>,
) -> Piece {
    let starts = batches.iter().flat_map(|batch| batch.starts(context));
    let mut paths = wave.trace(context, starts);
    let mut paths = paths.iter_mut();
    let mut work = WorkCounts { rays: wave.take_rays(), ..WorkCounts::default() };
    let mut all_scores = Vec::with_capacity(batches.len());
    let mut add = |batch: &PathBatch<'_, S>| {
        let (mut sums, mut scores) = (PathSums::default(), Scores::default());
        for path in paths.by_ref().take(batch.len()) {
            let path = path.end();
            sums.add(&path, quantum);
            let all = path.found.direct + path.found.indirect;
            scores.add(all.luminance(), quantum);
            work.add(&path);
        }
        all_scores.push(scores);
        sums
    };
    let sums = batches.iter().map(&mut add).collect();
    Piece { first: batches[0].number, sums, scores: all_scores, work }
}

impl<S: Spectrum> PathBatch<'_, S> {
    fn len(&self) -> usize {
        (self.indices.end - self.indices.start) as usize
    }

    /// Where its paths start.
    pub(crate) fn starts<'s>(
        &'s self,
        context: &Context<'_, S>,
    ) -> impl Iterator<Item = Start<'s, S>> {
        self.indices.clone().map(|index| {
            let mut sampler = Sampler::new(&self.points, index);
            let (position, n, tests_pointlikes) = match self.target {
                Target::Point { position, normal } => (position, normal, false),
                Target::Cell { grid, cell } => {
                    let u = context.draw(&mut sampler, Purpose::Cell, Sampler::next_2d);
                    (grid.point_in_cell(cell, u), grid.normal, true)
                }
            };
            let from = context.world.ray_origin_of_sensor(position, n);
            let measurement = Measurement::Illuminance { n, tests_pointlikes };
            Start {
                from,
                measurement,
                maps: PathMaps { end: self.map_end.as_ref(), caustics: self.caustics },
                daylight: None,
                sampler,
            }
        })
    }
}

impl PathSums {
    fn add<S: Spectrum>(&mut self, PathResult { found, .. }: &PathResult<S>, quantum: Quantum) {
        self.direct.add(found.direct.luminance(), quantum);
        self.indirect.add_signed(found.indirect.luminance(), quantum);
        self.reflected += u64::from(found.reflected);
        self.add_terms(found, quantum);
    }

    fn add_terms<S: Spectrum>(&mut self, found: &PathContribution<S>, quantum: Quantum) {
        self.terms.resize(found.terms.len(), Sum::default());
        for (sum, light) in self.terms.iter_mut().zip(&found.terms) {
            sum.add_signed(light.luminance(), quantum);
        }
    }

    /// Contributions that are not in the sums.
    pub(crate) fn invalid(&self) -> u64 {
        self.direct.invalid + self.indirect.invalid
    }
}

impl AddAssign for PathSums {
    fn add_assign(&mut self, other: Self) {
        self.direct += other.direct;
        self.indirect += other.indirect;
        self.reflected += other.reflected;
        self.terms.resize(self.terms.len().max(other.terms.len()), Sum::default());
        for (sum, found) in self.terms.iter_mut().zip(other.terms) {
            *sum += found;
        }
    }
}

impl WorkCounts {
    /// Counts one path; its rays are counted where they are traced.
    pub(crate) fn add<S>(&mut self, path: &PathResult<S>) {
        self.paths += 1;
        self.dimensions.record(path.dimensions);
        self.endless += u64::from(path.found.endless);
    }
}

impl AddAssign for WorkCounts {
    fn add_assign(&mut self, other: Self) {
        self.checked_add(&other).expect("the counts of one run fit 64 bits");
    }
}

impl Sums for WorkCounts {
    fn checked_add(&mut self, other: &Self) -> Option<()> {
        add_count(&mut self.paths, other.paths)?;
        add_count(&mut self.rays, other.rays)?;
        add_count(&mut self.endless, other.endless)?;
        histogram::checked_add(&mut self.dimensions, &other.dimensions)
    }
}

impl Sums for PathSums {
    fn checked_add(&mut self, other: &Self) -> Option<()> {
        self.direct.checked_add(&other.direct)?;
        self.indirect.checked_add(&other.indirect)?;
        add_count(&mut self.reflected, other.reflected)?;
        if self.terms.is_empty() {
            // Before its first path a target has none.
            self.terms.clone_from(&other.terms);
            return Some(());
        }
        let fits = other.terms.is_empty() || other.terms.len() == self.terms.len();
        let mut terms = self.terms.iter_mut().zip(&other.terms);
        fits.then(|| terms.try_for_each(|(sum, more)| sum.checked_add(more)))?
    }
}
