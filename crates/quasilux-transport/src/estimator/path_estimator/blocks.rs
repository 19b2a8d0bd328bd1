//! Blocks of the path estimator's work: asked of workers, and traced for others.

use super::advance::ROUND;
use super::{PathEstimator, SharedLight};
use crate::codec::{Reader, StateError, Writer};
use crate::control::watch::{BlockCounts, Watch, split};
use crate::control::workers::BlockSize;
use crate::estimator::block::{BlockFrame, PathProgress};
use crate::estimator::progress::TargetProgress;
use crate::path::path_batch::{PathSums, Piece, WorkCounts};
use crate::spectrum::Spectrum;
use crate::stats::scores::Scores;
use std::ops::Range;

impl<S: Spectrum> PathEstimator<'_, S> {
    /// Has workers trace the paths `indices` of all growing targets and replicates, up to the
    /// checkpoint `coming`; `None` where there are no workers, `false` when the run was stopped.
    pub(super) fn gather_by_workers(
        &mut self,
        indices: &Range<u64>,
        coming: u64,
        watch: &mut Watch<'_>,
    ) -> Option<bool> {
        let pairs = self.progress.growing().len() as u64 * u64::from(self.replicates);
        let paths = (indices.end - indices.start) * pairs;
        let frame = || BlockFrame::Paths { progress: self.progress.frame(coming) };
        let size = BlockSize { paths: 1, sums: 0 };
        let blocks = watch.blocks(frame, self.progress.done..paths, size)?;
        Some(watch.distribute(&blocks, &mut |from| {
            let piece = Piece::read(from, pairs as usize)?;
            let work = self.add(vec![piece]);
            let counts = BlockCounts { photons: 0, paths: work.paths, rays: work.rays };
            self.costs.paths.work += work;
            Ok(counts)
        }))
    }

    /// Traces a block for another process, which is so far.
    pub(crate) fn trace_block(
        &mut self,
        frame: &BlockFrame,
        block: Range<u64>,
    ) -> Result<Vec<u8>, StateError> {
        let BlockFrame::Paths { progress } = frame else {
            return Err(StateError::Unfit("the kind of a block"));
        };
        self.follow(progress)?;
        self.gather_block(&block, progress.coming)
    }

    /// Goes to where another process is.
    fn follow(&mut self, progress: &PathProgress) -> Result<(), StateError> {
        self.progress.check(progress)?;
        let coming = progress.coming;
        let SharedLight { end, caustics, traced_for, .. } = &self.shared;
        let is_behind = *traced_for < coming;
        // Maps that have grown do not shrink.
        let has_maps = end.photons(coming).is_some() || caustics.is_some();
        let is_past = has_maps && *traced_for > coming;
        let mut nobody = ();
        if is_past || (is_behind && !self.serve(coming, &mut Watch::new(&mut nobody))) {
            return Err(StateError::Unfit("the progress of the run"));
        }
        self.shared.traced_for = coming;
        if self.progress.follow(progress)? {
            self.freeze_caustics();
        }
        Ok(())
    }

    fn gather_block(&self, block: &Range<u64>, coming: u64) -> Result<Vec<u8>, StateError> {
        let TargetProgress { first, samples, .. } = self.progress;
        let from = if self.shared.end.photons(coming).is_some() { first } else { samples };
        let indices = from..coming;
        let pairs = self.progress.growing().len() as u64 * u64::from(self.replicates);
        let each = indices.end - indices.start;
        let is_within = each.checked_mul(pairs).is_some_and(|paths| block.end <= paths);
        if block.is_empty() || !is_within {
            return Err(StateError::Unfit("the range of a block"));
        }
        let numbers = block.start / each..block.end.div_ceil(each);
        let mut whole = Piece::empty(numbers.start as usize..numbers.end as usize);
        for round in split(block.clone(), ROUND) {
            let found = self.trace_round(&round, &indices);
            found.into_iter().for_each(|piece| whole.absorb(piece));
        }
        let mut out = Writer::default();
        whole.put(&mut out);
        Ok(out.finish())
    }
}

impl Piece {
    /// Of no paths of these batches.
    fn empty(numbers: Range<usize>) -> Self {
        let batches = numbers.len();
        Self {
            first: numbers.start,
            sums: vec![PathSums::default(); batches],
            scores: vec![Scores::default(); batches],
            work: WorkCounts::default(),
        }
    }

    /// Adds a piece of its batches.
    fn absorb(&mut self, piece: Self) {
        let first = piece.first - self.first;
        for (sums, more) in self.sums[first..].iter_mut().zip(piece.sums) {
            *sums += more;
        }
        for (scores, more) in self.scores[first..].iter_mut().zip(&piece.scores) {
            scores.merge(more);
        }
        self.work += piece.work;
    }

    fn put(&self, out: &mut Writer) {
        out.value(&self.first);
        out.value(&self.sums);
        out.value(&self.scores);
        out.value(&self.work);
    }

    /// Of batches with numbers below `pairs`.
    fn read(from: &mut Reader<'_>, pairs: usize) -> Result<Self, StateError> {
        let (first, sums): (usize, Vec<PathSums>) = (from.value()?, from.value()?);
        let (scores, work): (Vec<Scores>, WorkCounts) = (from.value()?, from.value()?);
        let is_within = first.checked_add(sums.len()).is_some_and(|end| end <= pairs);
        if !is_within || scores.len() != sums.len() {
            return Err(StateError::Unfit("the sums of a block"));
        }
        Ok(Self { first, sums, scores, work })
    }
}
