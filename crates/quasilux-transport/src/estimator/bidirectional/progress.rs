//! Progress of bidirectional paths from one checkpoint to the next, in units of work put in one
//! row; and their state, for checkpoints, parts of a run and other processes.

use super::estimator::BidirectionalEstimator;
use super::unit::{INDICES, Unit, UnitSums};
use crate::codec::{Reader, StateError, Stored, Writer};
use crate::control::observer::Snapshot;
use crate::control::watch::{BlockCounts, Watch, split};
use crate::control::workers::BlockSize;
use crate::estimator::block::BlockFrame;
use crate::sensors::snapshot;
use crate::spectrum::Spectrum;
use rayon::prelude::*;
use std::ops::Range;

/// Targets of a unit at most: its light subpaths, which other targets trace again, take a fortieth
/// of the time.
const TARGETS: usize = 256;
/// Paths between two words to the observer, about, and units at least: half a second of a processor
/// with two cores.
const ROUND: u64 = 1 << 17;
const UNITS: u64 = 32;
/// Plain paths that take about as long as one with its joins and its share of the light subpaths.
const PLAIN_PATHS: u64 = 4;

/// All units between two checkpoints: blocks of indices, one after the other, each in all
/// replicates, each for all growing targets.
#[derive(Clone, Debug)]
struct Row {
    indices: Range<u64>,
    replicates: u64,
    chunks: u64,
}

impl Row {
    fn len(&self) -> u64 {
        let blocks = self.indices.end.div_ceil(INDICES) - self.indices.start / INDICES;
        if self.indices.is_empty() { 0 } else { blocks * self.replicates * self.chunks }
    }

    /// Indices of a target of this chunk in all replicates together, those before the row included,
    /// after this many units.
    fn indices_of(&self, chunk: u64, done: u64) -> u64 {
        let pairs = done.saturating_sub(chunk).div_ceil(self.chunks);
        let (whole, others) = (pairs / self.replicates, pairs % self.replicates);
        let end = |blocks: u64| {
            let end = (self.indices.start / INDICES + blocks) * INDICES;
            end.clamp(self.indices.start, self.indices.end)
        };
        end(whole) * (self.replicates - others) + end(whole + 1) * others
    }

    fn unit<'t>(&self, number: u64, growing: &'t [usize]) -> Unit<'t> {
        let chunk = (number % self.chunks) as usize;
        let number = number / self.chunks;
        let first = (self.indices.start / INDICES + number / self.replicates) * INDICES;
        let indices = first.max(self.indices.start)..(first + INDICES).min(self.indices.end);
        let replicate = (number % self.replicates) as u32;
        let targets = &growing[chunk * TARGETS..((chunk + 1) * TARGETS).min(growing.len())];
        Unit { replicate, indices, targets }
    }
}

impl<S: Spectrum> BidirectionalEstimator<'_, S> {
    fn row(&self, indices: Range<u64>) -> Row {
        let chunks = self.progress.growing().len().div_ceil(TARGETS) as u64;
        Row { indices, replicates: self.replicates.into(), chunks }
    }

    /// Paths of a unit, at most.
    fn paths_of_a_unit(&self) -> u64 {
        self.progress.growing().len().clamp(1, TARGETS) as u64 * INDICES
    }

    /// Traces all units with the indices up to `samples`; `false` when the observer stopped it.
    pub(super) fn trace_up_to(&mut self, samples: u64, watch: &mut Watch<'_>) -> bool {
        let row = self.row(self.progress.samples..samples);
        watch.expect_work(row.len() * self.paths_of_a_unit());
        if let Some(is_done) = self.trace_by_workers(&row, samples, watch) {
            self.progress.complete(samples);
            return is_done;
        }
        let most = (ROUND / self.paths_of_a_unit()).max(UNITS);
        let pieces = watch.pieces(self.progress.done..row.len(), self.paths_of_a_unit());
        for round in pieces.flat_map(|piece| split(piece, most)) {
            let growing = self.progress.growing();
            let trace = |number| row.unit(number, growing).trace(&self.engine, self.quantum);
            let found: Vec<UnitSums> = round.clone().into_par_iter().map(trace).collect();
            self.add_units(&row, round.clone(), &found);
            self.progress.done = round.end;
            watch.show(|| Some(self.snapshot(&row)));
            let BlockCounts { photons, paths, rays } = counts(&found);
            let goes_on = watch.tick(photons, paths, rays);
            if !goes_on || !watch.keep(|out| self.put_all(out)) {
                return false;
            }
        }
        self.progress.complete(samples);
        true
    }

    /// Illuminances of the sensors after the units so far of a row: all replicates of a target
    /// together, over all indices that they have.
    fn snapshot(&self, row: &Row) -> Snapshot {
        let progress = &self.progress;
        let value_lx = |target: usize| {
            let indices = match progress.growing().binary_search(&target) {
                Ok(rank) => row.indices_of((rank / TARGETS) as u64, progress.done),
                Err(_) => progress.samples_of(target) * row.replicates,
            };
            self.all_lx(target, indices - progress.first * row.replicates)
        };
        snapshot(self.scene, (0..progress.targets()).map(value_lx))
    }

    fn add_units(&mut self, row: &Row, numbers: Range<u64>, found: &[UnitSums]) {
        for (number, found) in numbers.zip(found) {
            let Unit { replicate, targets, .. } = row.unit(number, self.progress.growing());
            let replicates = self.replicates as usize;
            for (target, sums) in targets.iter().zip(&found.sums) {
                self.sums[target * replicates + replicate as usize] += sums;
            }
            self.costs.add(found);
        }
    }

    /// Has workers trace the units of a row, up to the checkpoint `coming`; `None` where there are
    /// no workers, `false` when the run was stopped.
    fn trace_by_workers(&mut self, row: &Row, coming: u64, watch: &mut Watch<'_>) -> Option<bool> {
        let frame = || BlockFrame::Bidirectional { progress: self.progress.frame(coming) };
        let sums = self.progress.growing().len().min(TARGETS) as u64;
        let size = BlockSize { paths: self.paths_of_a_unit() * PLAIN_PATHS, sums };
        let blocks = watch.blocks(frame, self.progress.done..row.len(), size)?;
        Some(watch.distribute(&blocks, &mut |from| {
            let (first, found): (u64, Vec<UnitSums>) = (from.value()?, from.value()?);
            let numbers = first..first.saturating_add(found.len() as u64);
            let fits = |(number, found): (u64, &UnitSums)| {
                row.unit(number, self.progress.growing()).targets.len() == found.sums.len()
            };
            if numbers.end > row.len() || !numbers.clone().zip(&found).all(fits) {
                return Err(StateError::Unfit("the sums of a block"));
            }
            self.add_units(row, numbers, &found);
            Ok(counts(&found))
        }))
    }

    /// Traces units for another process.
    pub(super) fn trace_units_of(
        &mut self,
        frame: &BlockFrame,
        block: Range<u64>,
    ) -> Result<Vec<u8>, StateError> {
        let BlockFrame::Bidirectional { progress } = frame else {
            return Err(StateError::Unfit("the kind of a block"));
        };
        self.progress.follow(progress)?;
        let row = self.row(progress.samples..progress.coming);
        if block.is_empty() || block.end > row.len() {
            return Err(StateError::Unfit("the range of a block"));
        }
        let growing = self.progress.growing();
        let trace = |number| row.unit(number, growing).trace(&self.engine, self.quantum);
        let found: Vec<UnitSums> = block.clone().into_par_iter().map(trace).collect();
        let mut out = Writer::default();
        out.value(&block.start);
        out.value(&found);
        Ok(out.finish())
    }

    /// Everything, at any time between two rounds.
    pub(super) fn put_all(&self, out: &mut Writer) {
        self.progress.put(out);
        self.put_own(out);
    }

    /// Takes in what [`Self::put_all`] put out, before the first sample; `coming` is the next
    /// checkpoint.
    pub(super) fn take_in_all(
        &mut self,
        coming: u64,
        from: &mut Reader<'_>,
    ) -> Result<(), StateError> {
        self.progress.read(coming, from)?;
        if self.progress.done > self.row(self.progress.samples..coming).len() {
            return Err(StateError::Unfit("the number of samples"));
        }
        self.take_in_own(from)
    }

    /// Puts out what belongs to the indices of a part alone.
    pub(super) fn put_own(&self, out: &mut Writer) {
        self.costs.put(out);
        self.sums.as_slice().put(out);
    }

    /// Adds what [`Self::put_own`] put out.
    pub(super) fn take_in_own(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        self.costs.merge_from(from)?;
        self.sums.as_mut_slice().merge_from(from)
    }
}

/// Counts of the work of units.
fn counts(found: &[UnitSums]) -> BlockCounts {
    let sum = |of: fn(&UnitSums) -> u64| found.iter().map(of).sum();
    BlockCounts {
        photons: sum(|it| it.photons),
        paths: sum(|it| it.work.paths),
        rays: sum(|it| it.work.rays),
    }
}
