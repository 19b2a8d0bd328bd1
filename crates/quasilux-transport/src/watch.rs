//! Counters of a run, and the observer behind them.

use crate::estimates::Estimates;
use crate::observer::{Control, Observer, Progress, Snapshot};

/// Tells the observer how far a run is, and remembers whether it said stop.
pub(crate) struct Watch<'o> {
    observer: &'o mut dyn Observer,
    progress: Progress,
    /// Expected work at the coming checkpoint and at the end, in indices per replicate.
    coming: u64,
    end: Option<u64>,
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
        Self { observer, progress, coming: 0, end: None }
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
    /// the first checkpoint always.
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
        control == Control::Continue || self.progress.samples == 0
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
        self.progress.samples = estimates.samples;
        self.progress.largest_relative_half_width = largest;
        self.observer.checkpoint(estimates)
    }
}
