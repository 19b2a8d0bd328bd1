//! How far a job of a known length is, and how long it will take: a bar, or lines where stderr is
//! no terminal.

#![allow(clippy::disallowed_methods, reason = "work is watched by the clock")]

use crate::heartbeat::Heartbeat;
use crate::time_left;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Steps of the bar.
const STEPS: u64 = 1000;
/// Between two changes of what is shown.
const EVERY: Duration = Duration::from_millis(200);

/// Counts the steps of a job; any thread may.
pub(crate) struct Meter {
    bar: ProgressBar,
    heartbeat: Option<Heartbeat>,
    start: Instant,
    total: u64,
    done: AtomicU64,
    shown: Mutex<Instant>,
}

impl Meter {
    /// Of a job of this many steps.
    pub(crate) fn new(total: u64) -> Self {
        let style = ProgressStyle::with_template("{bar:24} {msg}")
            .expect("the template is well formed")
            .progress_chars("=> ");
        let bar = ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::stderr_with_hz(8));
        let bar = bar.with_style(style);
        let heartbeat = bar.is_hidden().then(|| Heartbeat::new("begun"));
        let start = Instant::now();
        Self { bar, heartbeat, start, total, done: AtomicU64::new(0), shown: Mutex::new(start) }
    }

    /// Counts steps.
    pub(crate) fn add(&self, steps: u64) {
        let done = self.done.fetch_add(steps, Ordering::Relaxed) + steps;
        self.show((done as f64 / self.total.max(1) as f64).min(1.0));
    }

    /// Shows the share of the job that is done, now and then.
    pub(crate) fn show(&self, share: f64) {
        // Whoever finds another one at it has nothing to add.
        let Ok(mut shown) = self.shown.try_lock() else { return };
        if shown.elapsed() < EVERY {
            return;
        }
        *shown = Instant::now();
        let news = news(share, self.start.elapsed().as_secs_f64());
        self.bar.set_position((share * STEPS as f64) as u64);
        if let Some(heartbeat) = &self.heartbeat {
            heartbeat.set(&news);
        }
        self.bar.set_message(news);
    }
}

impl Drop for Meter {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// The share that is done, and the time left at the pace so far.
fn news(share: f64, elapsed_s: f64) -> String {
    let left = time_left::in_words(time_left::seconds_left(share, elapsed_s, None));
    format!("{:.0} % done, {left}", 100.0 * share)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_takes_as_long_as_what_is_done() {
        assert_eq!(news(0.25, 10.0), "25 % done, 30 s left");
        assert_eq!(news(1e-9, 8.0), "0 % done, time left not known yet");
    }
}
