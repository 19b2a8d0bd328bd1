//! Counters of a run, and the observer behind them.

use crate::codec::{Reader, StateError, Writer};
use crate::control::observer::{Control, Observer, PictureProgress, Progress, Snapshot};
use crate::control::workers::{self, BlockSize, Received, Workers};
use crate::stats::estimates::Estimates;
use rayon::prelude::*;
use serde::Serialize;
use std::ops::Range;

/// Sensor points that are looked at between two words to the observer before the first sample: some
/// tenths of a second, where each takes longest.
pub(crate) const POINTS_AT_ONCE: usize = 1 << 12;

/// Tells the observer how far a run is, and remembers whether it said stop.
pub(crate) struct Watch<'o> {
    observer: &'o mut dyn Observer,
    progress: Progress,
    /// Rays up to the tolerance or to the limit that comes first.
    rays_to_end: Option<u64>,
    /// Photons and paths before the first checkpoint, and how many had gone before them.
    to_first: u64,
    before_first: u64,
    /// Rays allowed after the first checkpoint.
    max_rays: u64,
    /// Photons or paths between states that the observer may want.
    piece: Option<u64>,
    /// First bytes of all states: everything that does not change before the next checkpoint.
    preface: Vec<u8>,
    /// Whether it may stop the run now.
    obeys: bool,
    /// Whether it did, within a piece.
    stopped: bool,
    /// Others that trace blocks of the work.
    workers: Option<&'o mut dyn Workers>,
    /// Digest of what was decided before the first sample.
    decisions: [u8; 32],
    /// Whether what workers did is no use.
    failed: bool,
}

/// Blocks of some work that workers trace.
pub(crate) struct Blocks {
    frame: Vec<u8>,
    ranges: Vec<Range<u64>>,
}

/// The work of a block.
pub(crate) struct BlockCounts {
    pub(crate) photons: u64,
    pub(crate) paths: u64,
    pub(crate) rays: u64,
}

impl<'o> Watch<'o> {
    pub(crate) fn new(observer: &'o mut dyn Observer) -> Self {
        let progress = Progress {
            photons: 0,
            paths: 0,
            rays: 0,
            earlier_rays: 0,
            samples: 0,
            largest_relative_half_width: None,
            slope: None,
            expected_samples: None,
            expected_rays: None,
            done: None,
            done_of_first: None,
            picture: None,
        };
        let (piece, preface) = (observer.piece(), Vec::new());
        let (rays_to_end, max_rays) = (None, u64::MAX);
        let (obeys, stopped) = (false, false);
        Self {
            observer,
            progress,
            rays_to_end,
            to_first: 0,
            before_first: 0,
            max_rays,
            piece,
            preface,
            obeys,
            stopped,
            workers: None,
            decisions: [0; 32],
            failed: false,
        }
    }

    /// With others that trace blocks.
    pub(crate) fn with_workers(self, workers: &'o mut dyn Workers) -> Self {
        Self { workers: Some(workers), ..self }
    }

    /// Sets the digest of the decisions that workers must have made, too, before the first sample.
    pub(crate) fn expect_decisions(&mut self, digest: [u8; 32]) {
        self.decisions = digest;
    }

    /// Whether workers left blocks out, so that the run has no result.
    pub(crate) fn has_failed(&self) -> bool {
        self.failed
    }

    /// Blocks of `work`; `None` where there are no workers, or little of it.
    pub(crate) fn blocks<T: Serialize>(
        &self,
        frame: impl FnOnce() -> T,
        work: Range<u64>,
        size: BlockSize,
    ) -> Option<Blocks> {
        let min_paths = self.workers.as_ref()?.min_paths();
        let ranges = workers::blocks(&work, size, min_paths);
        if ranges.is_empty() {
            return None;
        }
        let mut out = Writer::default();
        out.bytes(&self.decisions);
        out.value(&frame());
        Some(Blocks { frame: out.finish(), ranges })
    }

    /// Has workers trace blocks, and `add`s what comes of each; `false` when the observer stopped
    /// it, or workers failed, which leaves the sums unusable.
    #[must_use]
    pub(crate) fn distribute(
        &mut self,
        Blocks { frame, ranges }: &Blocks,
        add: &mut dyn FnMut(&mut Reader<'_>) -> Result<BlockCounts, StateError>,
    ) -> bool {
        let Some(workers) = self.workers.take() else { return false };
        let (mut goes_on, mut is_sound) = (true, true);
        let mut done = |received: Received<'_>| {
            let Received::Block { bytes, .. } = received else {
                // Whoever waits for long may want to stop.
                goes_on = self.tick(0, 0, 0) && !self.stopped;
                return goes_on;
            };
            let mut from = Reader::new(bytes);
            let added = add(&mut from).and_then(|counts| from.end().map(|()| counts));
            match added {
                Ok(BlockCounts { photons, paths, rays }) => {
                    // There is no state within a row of blocks.
                    goes_on = self.tick(photons, paths, rays) && !self.stopped;
                }
                Err(_) => is_sound = false,
            }
            goes_on && is_sound
        };
        let all_came = workers.trace(frame, ranges, &mut done);
        is_sound &= all_came;
        self.workers = Some(workers);
        self.failed |= !is_sound;
        goes_on && is_sound
    }

    /// A range of indices, each of this many photons or paths, in pieces between which states are
    /// kept; in one where there are none.
    pub(crate) fn pieces(
        &self,
        range: Range<u64>,
        each: u64,
    ) -> impl Iterator<Item = Range<u64>> + use<> {
        let length = self.piece.map_or(u64::MAX, |piece| (piece / each.max(1)).max(1));
        split(range, length)
    }

    /// Work in rounds of so much, and not more than a piece.
    pub(crate) fn rounds(
        &self,
        work: Range<u64>,
        most: u64,
    ) -> impl Iterator<Item = Range<u64>> + use<> {
        let length = self.piece.map_or(most, |piece| piece.clamp(1, most));
        split(work, length)
    }

    /// Sets the first bytes of all states from here on.
    pub(crate) fn preface(&mut self, put: impl FnOnce(&mut Writer)) {
        if self.piece.is_some() {
            let mut out = Writer::default();
            put(&mut out);
            self.preface = out.finish();
        }
    }

    /// After a piece: gives the observer the state, if it wants it, with the work so far before
    /// what is put out, and says whether to go on.
    #[must_use]
    pub(crate) fn keep(&mut self, put: impl FnOnce(&mut Writer)) -> bool {
        if self.piece.is_some() && self.observer.wants_state() {
            self.give_state(put);
        }
        !self.stopped
    }

    /// After the last piece: gives the observer the state, whether it wants it or not, so that it
    /// knows that the run is over.
    pub(crate) fn keep_last(&mut self, put: impl FnOnce(&mut Writer)) {
        if self.piece.is_some() {
            self.give_state(put);
        }
    }

    fn give_state(&mut self, put: impl FnOnce(&mut Writer)) {
        let mut out = Writer::behind(&self.preface);
        let Progress { photons, paths, rays, .. } = self.progress;
        out.value(&[photons, paths, rays]);
        put(&mut out);
        self.observer.state(&out.finish());
    }

    /// Begins with the work that another run had done.
    pub(crate) fn read(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        // Surveys and pilots are made again.
        let own_rays = self.progress.rays;
        let Progress { photons, paths, rays, .. } = &mut self.progress;
        [*photons, *paths, *rays] = from.value()?;
        self.progress.earlier_rays = self.progress.rays.saturating_sub(own_rays);
        Ok(())
    }

    /// Knows of the last checkpoint.
    pub(crate) fn begin_at(&mut self, estimates: &Estimates, largest: Option<f64>) {
        self.progress.samples = estimates.samples;
        self.progress.rays = self.progress.rays.max(estimates.rays);
        self.progress.slope = estimates.convergence.slope;
        self.progress.expected_samples = estimates.convergence.samples;
        self.progress.expected_rays = estimates.convergence.rays;
        self.progress.largest_relative_half_width = largest;
    }

    /// Lets the observer stop the run from here on.
    pub(crate) fn obey(&mut self) {
        self.obeys = true;
    }

    /// Whether the observer has stopped it.
    pub(crate) fn has_stopped(&self) -> bool {
        self.stopped
    }

    /// Work on each of many things, in the threads of the pool, in parts of `at_once`; `None` when
    /// the observer stopped it between two parts.
    pub(crate) fn map_in_parts<T: Sync, R: Send>(
        &mut self,
        things: &[T],
        at_once: usize,
        work: impl Fn(&T) -> R + Sync,
    ) -> Option<Vec<R>> {
        let mut done = Vec::with_capacity(things.len());
        for part in things.chunks(at_once) {
            done.par_extend(part.par_iter().map(&work));
            let _ = self.tick(0, 0, 0);
            if self.stopped {
                return None;
            }
        }
        Some(done)
    }

    /// Ends the run, past its first checkpoint, rather than trace more rays.
    pub(crate) fn limit_rays(&mut self, max_rays: Option<u64>) {
        self.max_rays = max_rays.unwrap_or(u64::MAX);
    }

    /// Says how many photons and paths come before the next checkpoint; only the first one, about
    /// which nothing else is known, is foreseen.
    pub(crate) fn expect_work(&mut self, photons_and_paths: u64) {
        self.to_first = photons_and_paths;
        self.before_first = self.progress.photons.saturating_add(self.progress.paths);
    }

    /// Says how many rays the whole run is expected to take, limits included.
    pub(crate) fn expect(&mut self, rays: Option<u64>) {
        self.rays_to_end = rays;
    }

    /// Shows a moment of the run, if the observer wants to see it and there is something to see.
    pub(crate) fn show(&mut self, look: impl FnOnce() -> Option<Snapshot>) {
        if self.observer.wants_snapshot()
            && let Some(snapshot) = look()
        {
            self.observer.snapshot(&snapshot);
        }
    }

    /// Counts work. Whether to go on: always before the run [obeys](Self::obey), and to the end of
    /// a piece after which a state can be kept, unless there are too many rays, which no state may
    /// hold.
    #[must_use]
    pub(crate) fn tick(&mut self, photons: u64, paths: u64, rays: u64) -> bool {
        let so_far = &mut self.progress;
        // What a damaged state says may be any number.
        so_far.photons = so_far.photons.saturating_add(photons);
        so_far.paths = so_far.paths.saturating_add(paths);
        so_far.rays = so_far.rays.saturating_add(rays);
        let share = |rays: u64| (self.progress.rays as f64 / rays.max(1) as f64).clamp(0.0, 1.0);
        self.progress.done = self.rays_to_end.map(share);
        let all = self.progress.photons.saturating_add(self.progress.paths);
        let of_first = all.saturating_sub(self.before_first) as f64 / self.to_first.max(1) as f64;
        let is_first = self.progress.samples == 0 && self.to_first > 0;
        self.progress.done_of_first = is_first.then_some(of_first.min(1.0));
        let control = self.observer.progress(&self.progress);
        // Who has stopped it has, whatever is said later.
        self.stopped |= control == Control::Stop && self.obeys;
        if let Some(picture) = self.progress.picture {
            let may_go_on = self.progress.rays <= self.max_rays || picture.complete_samples == 0;
            return control == Control::Continue && may_go_on;
        }
        let is_within_limit = self.progress.rays <= self.max_rays || self.progress.samples == 0;
        is_within_limit && (!self.stopped || self.piece.is_some())
    }

    /// Begins a pass of a picture, to which work belongs from here on.
    pub(crate) fn begin_pass(&mut self, at: PictureProgress) {
        self.progress.picture = Some(at);
    }

    /// Counts work at a picture, a share of whose whole work is done, if anybody knows. Whether to
    /// go on: no limit on rays ends it before it has a first pass.
    #[must_use]
    pub(crate) fn tick_picture(
        &mut self,
        paths: u64,
        rays: u64,
        at: PictureProgress,
        done: Option<f64>,
    ) -> bool {
        self.progress.paths = self.progress.paths.saturating_add(paths);
        self.progress.rays = self.progress.rays.saturating_add(rays);
        self.progress.done = done.map(|done| done.clamp(0.0, 1.0));
        self.progress.picture = Some(at);
        let may_go_on = self.progress.rays <= self.max_rays || at.complete_samples == 0;
        self.observer.progress(&self.progress) == Control::Continue && may_go_on
    }

    pub(crate) fn checkpoint(&mut self, estimates: &Estimates, largest: Option<f64>) -> Control {
        self.begin_at(estimates, largest);
        self.observer.checkpoint(estimates)
    }
}

/// A range in pieces of this length.
pub(crate) fn split(range: Range<u64>, length: u64) -> impl Iterator<Item = Range<u64>> {
    let mut next = range.start;
    std::iter::from_fn(move || {
        let piece = next..range.end.min(next.saturating_add(length));
        next = piece.end;
        (!piece.is_empty()).then_some(piece)
    })
}
