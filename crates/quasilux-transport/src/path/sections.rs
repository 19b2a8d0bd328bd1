//! Sections of paths, one target in one replicate each, that are traced in one wave, and their
//! sums.

use crate::codec::{Sums, add_count, histogram};
use crate::context::Context;
use crate::path::contribution::PathContribution;
use crate::path::end::Rest;
use crate::path::lobes::LobeSums;
use crate::path::partition::Partition;
use crate::path::specular_hits::HitCounts;
use crate::path::start::{Measurement, Start};
use crate::path::trace::PathResult;
use crate::path::wave::PathWave;
use crate::photon::caustics::CausticLookup;
use crate::purpose::Purpose;
use crate::spectrum::Spectrum;
use crate::stats::scores::Scores;
use crate::stats::tally::{Quantum, Sum};
use crate::stats::targets::Target;
use quasilux_sampling::{DimensionHistogram, PointSet, Sampler};
use serde::{Deserialize, Serialize};
use std::ops::{AddAssign, Range};

/// Odd numbers that mix the digits of indices: those of SplitMix64 (G. L. Steele, D. Lea, C. H.
/// Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014).
const MIXING: [u64; 3] = [0x9e37_79b9_7f4a_7c15, 0xbf58_476d_1ce4_e5b9, 0x94d0_49bb_1331_11eb];

/// What the paths of one target in one replicate found, in all.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct PathSums {
    pub(crate) direct: Sum,
    pub(crate) indirect: Sum,
    /// Both by the number of bounces, as [`PathContribution::terms`].
    pub(crate) terms: Vec<Sum>,
    /// Paths that came to a surface that reflects.
    pub(crate) reflected: u64,
    /// `None` where no path met a lobe under a point-like light.
    pub(crate) lobes: Option<Box<LobeSums>>,
}

/// Single contributions to one target, of all replicates.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct PathScores {
    /// Of whole paths.
    pub(crate) paths: Scores,
    /// Area lights that paths met coming from specular surfaces.
    pub(crate) specular_hits: HitCounts,
}

/// What paths cost.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct WorkCounts {
    pub(crate) paths: u64,
    pub(crate) rays: u64,
    #[serde(with = "histogram")]
    pub(crate) dimensions: DimensionHistogram,
    pub(crate) endless: u64,
}

/// Some paths of one target in one replicate.
pub(crate) struct Section<'g, S> {
    /// Which of all pairs of target and replicate.
    pub(crate) number: usize,
    pub(crate) target: Target,
    pub(crate) points: PointSet,
    pub(crate) rest: Rest<'g, S>,
    pub(crate) caustics: Option<CausticLookup<'g, S>>,
    /// What photons that are connected to the target leave to the paths.
    pub(crate) partition: Option<&'g Partition>,
    pub(crate) indices: Range<u64>,
}

/// What the paths of neighbouring sections found.
pub(crate) struct Piece {
    /// Number of the first section.
    pub(crate) first: usize,
    /// Of each section.
    pub(crate) sums: Vec<PathSums>,
    /// The same, by single paths.
    pub(crate) scores: Vec<PathScores>,
    pub(crate) work: WorkCounts,
}

/// Traces the paths of at least one section together; the numbers of sections follow each other.
pub(crate) fn trace_sections<S: Spectrum>(
    context: &Context<'_, S>,
    sections: &[Section<'_, S>],
    quantum: Quantum,
    wave: &mut PathWave<S>,
) -> Piece {
    trace_and_visit(context, sections, quantum, wave, |_| ())
}

/// The same, and shows each path that is over.
pub(crate) fn trace_and_visit<S: Spectrum>(
    context: &Context<'_, S>,
    sections: &[Section<'_, S>],
    quantum: Quantum,
    wave: &mut PathWave<S>,
    mut look: impl FnMut(&mut PathResult<S>),
) -> Piece {
    let starts = sections.iter().flat_map(|section| section.starts(context));
    let mut paths = wave.trace(context, starts);
    let mut paths = paths.iter_mut();
    let mut work = WorkCounts { rays: wave.take_rays(), ..WorkCounts::default() };
    let mut all_scores = Vec::with_capacity(sections.len());
    let mut add = |section: &Section<'_, S>| {
        let (mut sums, mut scores) = (PathSums::default(), PathScores::default());
        for path in paths.by_ref().take(section.len()) {
            let mut path = path.end();
            sums.add(&path, quantum);
            scores.add(&path.found, quantum);
            work.add(&path);
            look(&mut path);
        }
        all_scores.push(scores);
        sums
    };
    let sums = sections.iter().map(&mut add).collect();
    Piece { first: sections[0].number, sums, scores: all_scores, work }
}

impl<S: Spectrum> Section<'_, S> {
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
                virtual_lights: None,
                pixel: None,
                from,
                measurement,
                rest: &self.rest,
                caustics: self.caustics,
                partition: self.partition,
                daylight: None,
                sampler,
            }
        })
    }
}

/// The index of the light subpath that an eye subpath is connected to.
///
/// At one index two point sets have the same digits, permuted: subpaths of the same index would
/// have as few pairs of directions as there are permutations. So each power of two of indices up to
/// the next is mixed, by multiplications that carry digits up and shifts that carry them down: both
/// subpaths have all points of a balanced set there, and nothing in common.
pub(crate) fn partner(index: u64) -> u64 {
    let first = (index + 1).next_power_of_two() / 2;
    if first < 2 {
        return index;
    }
    let (mask, half) = (first - 1, first.trailing_zeros().div_ceil(2));
    let mut mixed = index - first;
    for odd in MIXING {
        mixed = mixed.wrapping_mul(odd).wrapping_add(odd >> 7) & mask;
        mixed ^= mixed >> half;
    }
    first + mixed
}

impl PathSums {
    fn add<S: Spectrum>(&mut self, PathResult { found, .. }: &PathResult<S>, quantum: Quantum) {
        self.direct.add(found.direct.luminance(), quantum);
        self.indirect.add_signed(found.indirect.luminance(), quantum);
        self.reflected += u64::from(found.reflected);
        if found.lobes.surfaces() > 0 {
            self.lobes.get_or_insert_default().add(found.lobes, quantum);
        }
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

impl PathScores {
    fn add<S: Spectrum>(&mut self, found: &PathContribution<S>, quantum: Quantum) {
        self.paths.add((found.direct + found.indirect).luminance().abs(), quantum);
        found.specular_hits.iter().for_each(|material| self.specular_hits.count(*material));
    }

    /// Adds those of other paths.
    pub(crate) fn merge(&mut self, other: &Self) {
        self.paths.merge(&other.paths);
        self.specular_hits.merge(&other.specular_hits);
    }
}

impl Sums for PathScores {
    fn checked_add(&mut self, other: &Self) -> Option<()> {
        self.paths.checked_add(&other.paths)?;
        self.specular_hits.checked_add(&other.specular_hits)
    }
}

impl AddAssign for PathSums {
    fn add_assign(&mut self, other: Self) {
        self.direct += other.direct;
        self.indirect += other.indirect;
        self.reflected += other.reflected;
        if let Some(more) = &other.lobes {
            **self.lobes.get_or_insert_default() += more;
        }
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
        if let Some(more) = &other.lobes {
            self.lobes.get_or_insert_default().checked_add(more)?;
        }
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

#[cfg(test)]
mod tests {
    use super::partner;

    /// Each power of two of indices up to the next keeps its indices, and the lowest digits of the
    /// two indices are independent: of 4096 pairs, all 64 combinations of three digits come about
    /// equally often. An affine map, whose lowest digits follow each other, fails.
    #[test]
    fn partners_are_all_indices_and_none_in_particular() {
        for exponent in 0..13 {
            let first = 1_u64 << exponent;
            let mut partners: Vec<u64> = (first..2 * first).map(partner).collect();
            partners.sort_unstable();
            assert!(partners.into_iter().eq(first..2 * first), "{first}");
        }
        assert_eq!(partner(0), 0);
        let mut counts = [0_u32; 64];
        for index in 4096..8192_u64 {
            counts[((index & 7) << 3 | partner(index) & 7) as usize] += 1;
        }
        // 64 each, with a standard deviation of 8.
        assert!(counts.iter().all(|count| (24..104).contains(count)), "{counts:?}");
    }
}
