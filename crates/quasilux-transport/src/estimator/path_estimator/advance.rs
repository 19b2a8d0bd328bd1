//! Progress of the path estimator from one checkpoint to the next: photons that all paths share,
//! and the paths themselves.
//!
//! Between pieces of each of them the state can be kept. Each knows how far it is, so that a run
//! that goes on from a state finds what is left.

use super::PathEstimator;
use crate::control::watch::Watch;
use crate::path::end::{GrowingMaps, PathEnd};
use crate::path::path_batch::{PathSums, Piece, WorkCounts};
use crate::path::wave::{PathWave, WAVE};
use crate::spectrum::Spectrum;
use crate::stats::scores::Scores;
use rayon::prelude::*;
use std::ops::Range;

/// Paths between two words to the observer.
pub(super) const ROUND: u64 = 1 << 17;

impl<S: Spectrum> PathEstimator<'_, S> {
    /// Traces the photons that serve all paths of the indices up to `samples`; `false` when the
    /// observer stopped it, as below.
    pub(super) fn serve(&mut self, samples: u64, watch: &mut Watch<'_>) -> bool {
        let replicates = u64::from(self.replicates);
        for piece in watch.pieces(self.shared.end.photons(samples).unwrap_or(0..0), replicates) {
            let mut end = std::mem::replace(&mut self.shared.end, PathEnd::Nothing);
            let before = self.before();
            let look = |maps: &GrowingMaps<'_, S>| Some(before.snapshot(maps));
            let grown = end.grow(self.context, piece.end, look, watch);
            let before_lx = before.into_lx();
            self.shared.end = end;
            let Some(photons) = grown else { return false };
            self.shared.last_lx = before_lx;
            self.costs.shared.photons += photons;
            if !watch.keep(|out| self.put_all(out)) {
                return false;
            }
        }
        let caustics = self.shared.caustics.as_ref();
        let photons = caustics.map_or(0..0, |it| it.photons()..it.photons_for(samples));
        for piece in watch.pieces(photons, replicates) {
            let Some(caustics) = &mut self.shared.caustics else { break };
            let Some(rays) = caustics.grow(self.context, piece.end, watch) else { return false };
            self.costs.shared.work.rays += rays;
            if !watch.keep(|out| self.put_all(out)) {
                return false;
            }
        }
        true
    }

    /// Traces the paths of the indices up to `samples`.
    pub(super) fn gather(&mut self, samples: u64, watch: &mut Watch<'_>) -> bool {
        let indices = self.next_indices(samples);
        if let Some(is_done) = self.gather_by_workers(&indices, samples, watch) {
            self.progress.complete(samples);
            return is_done;
        }
        let each = (indices.end - indices.start) * u64::from(self.replicates);
        let paths = each * self.progress.growing().len() as u64;
        for round in watch.rounds(self.progress.done..paths, ROUND) {
            let found = self.trace_round(&round, &indices);
            let of_round = self.add(found);
            let (now, rays) = (of_round.paths, of_round.rays);
            self.costs.paths.work += of_round;
            self.progress.done = round.end;
            watch.show(|| Some(self.snapshot(&indices, self.progress.done)));
            let goes_on = watch.tick(0, now, rays);
            if !goes_on || !watch.keep(|out| self.put_all(out)) {
                return false;
            }
        }
        self.progress.complete(samples);
        true
    }

    /// Traces these paths of the row of all growing targets and replicates, each with `indices`.
    pub(super) fn trace_round(&self, round: &Range<u64>, indices: &Range<u64>) -> Vec<Piece> {
        let pieces = (round.end - round.start).div_ceil(WAVE);
        let trace = |wave: &mut PathWave<S>, piece: u64| {
            let first = round.start + piece * WAVE;
            self.trace_piece(&(first..(first + WAVE).min(round.end)), indices, wave)
        };
        (0..pieces).into_par_iter().map_init(PathWave::default, trace).collect()
    }

    /// The indices of the paths to trace: all of them where maps have grown, whose values changed.
    fn next_indices(&mut self, samples: u64) -> Range<u64> {
        if self.shared.end.photons(samples).is_none() {
            return self.progress.samples..samples;
        }
        if self.progress.done == 0 {
            let replicates = self.replicates as usize;
            for target in self.progress.growing() {
                self.sums[target * replicates..][..replicates].fill(PathSums::default());
                self.scores[*target] = Scores::default();
            }
        }
        self.progress.first..samples
    }

    /// Adds the sums of pieces and returns their work.
    pub(super) fn add(&mut self, pieces: Vec<Piece>) -> WorkCounts {
        let mut counts = WorkCounts::default();
        for Piece { first, sums, scores, work } in pieces {
            for (number, (found, scores)) in (first..).zip(sums.into_iter().zip(scores)) {
                let place = self.place(number);
                self.sums[place] += found;
                self.scores[place / self.replicates as usize].merge(&scores);
            }
            counts += work;
        }
        counts
    }
}
