//! Counters of a run, and the observer behind them.

use crate::estimates::Estimates;
use crate::observer::{Control, Observer, Progress, Snapshot};
use crate::state::Writer;
use std::ops::Range;

/// Tells the observer how far a run is, and remembers whether it said stop.
pub(crate) struct Watch<'o> {
    observer: &'o mut dyn Observer,
    progress: Progress,
    /// Expected work at the coming checkpoint and at the end, in indices per replicate.
    coming: u64,
    end: Option<u64>,
    /// Photons or paths between states that the observer may want.
    piece: Option<u64>,
    /// What a state begins with: all that does not change before the next checkpoint.
    preface: Vec<u8>,
    /// Whether it may stop the run now.
    obeys: bool,
    /// Whether it did, within a piece.
    stopped: bool,
}

impl<'o> Watch<'o> {
    pub(crate) fn new(observer: &'o mut dyn Observer) -> Self {
        let progress = Progress {
            photons: 0,
            paths: 0,
            rays: 0,
            samples: 0,
            largest_relative_half_width: None,
            done: None,
        };
        let (piece, preface) = (observer.piece(), Vec::new());
        let (obeys, stopped) = (false, false);
        Self { observer, progress, coming: 0, end: None, piece, preface, obeys, stopped }
    }

    /// A range of indices, each of so many photons or paths, in pieces between which states are kept; in
    /// one where there are none.
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

    /// What states begin with from here on.
    pub(crate) fn preface(&mut self, put: impl FnOnce(&mut Writer)) {
        if self.piece.is_some() {
            let mut out = Writer::default();
            put(&mut out);
            self.preface = out.finish();
        }
    }

    /// After a piece: gives the observer the state, if it wants it, and says whether to go on.
    #[must_use]
    pub(crate) fn keep(&mut self, put: impl FnOnce(&mut Writer)) -> bool {
        if self.piece.is_some() && self.observer.wants_state() {
            let mut out = Writer::behind(&self.preface);
            put(&mut out);
            self.observer.state(&out.finish());
        }
        !self.stopped
    }

    /// Begins where another run was at its last checkpoint.
    pub(crate) fn begin_at(&mut self, samples: u64, largest: Option<f64>) {
        self.progress.samples = samples;
        self.progress.largest_relative_half_width = largest;
        self.obeys = true;
    }

    /// Lets the observer stop the run from here on: by itself it may after the first checkpoint.
    pub(crate) fn obey(&mut self) {
        self.obeys = true;
    }

    /// Says where the next checkpoint and the expected end lie.
    pub(crate) fn expect(&mut self, coming: u64, end: Option<u64>) {
        (self.coming, self.end) = (coming, end);
    }

    /// Shows a moment of the run, if the observer wants to see it and there is something to see.
    pub(crate) fn show(&mut self, look: impl FnOnce() -> Option<Snapshot>) {
        if self.observer.wants_snapshot()
            && let Some(snapshot) = look()
        {
            self.observer.snapshot(&snapshot);
        }
    }

    /// Counts work; `share` of the way to the coming checkpoint is done. Whether to go on: before
    /// the first checkpoint always, and to the end of a piece after which a state can be kept.
    #[must_use]
    pub(crate) fn tick(&mut self, photons: u64, paths: u64, rays: u64, share: f64) -> bool {
        self.progress.photons += photons;
        self.progress.paths += paths;
        self.progress.rays += rays;
        let before = self.progress.samples as f64;
        self.progress.done = self.end.map(|end| {
            let now = before + (self.coming as f64 - before) * share;
            (now / end as f64).clamp(0.0, 1.0)
        });
        let control = self.observer.progress(&self.progress);
        self.stopped = control == Control::Stop && self.obeys;
        !self.stopped || self.piece.is_some()
    }

    /// Counts the work at a picture, of whose pass a share is done. Whether to go on.
    #[must_use]
    pub(crate) fn tick_picture(&mut self, paths: u64, rays: u64, share: f64) -> bool {
        self.progress.paths += paths;
        self.progress.rays += rays;
        self.progress.done = Some(share);
        self.observer.progress(&self.progress) == Control::Continue
    }

    pub(crate) fn checkpoint(&mut self, estimates: &Estimates, largest: Option<f64>) -> Control {
        self.obeys = true;
        self.progress.samples = estimates.samples;
        self.progress.largest_relative_half_width = largest;
        self.observer.checkpoint(estimates)
    }
}

/// A range in pieces of this length.
fn split(range: Range<u64>, length: u64) -> impl Iterator<Item = Range<u64>> {
    let mut next = range.start;
    std::iter::from_fn(move || {
        let piece = next..range.end.min(next.saturating_add(length));
        next = piece.end;
        (!piece.is_empty()).then_some(piece)
    })
}
