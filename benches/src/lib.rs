//! What the benchmarks have in common: meshes, the time that work takes, and medians.

pub mod meshes;
pub mod scenes;

use quasilux_foreign::processor_seconds;
use std::time::Instant;

/// Seconds that some work takes this thread on a processor.
pub fn processor_time(work: impl FnOnce()) -> f64 {
    let start = processor_seconds();
    work();
    processor_seconds() - start
}

/// What some work gave, and how long it took.
pub struct Timed<R> {
    /// Seconds by the wall clock.
    pub seconds: f64,
    /// What the work gave.
    pub result: R,
}

/// Does some work, by the wall clock.
#[expect(clippy::disallowed_methods, reason = "a benchmark reads the clock")]
pub fn timed<R>(work: impl FnOnce() -> R) -> Timed<R> {
    let start = Instant::now();
    let result = work();
    Timed { seconds: start.elapsed().as_secs_f64(), result }
}

/// The middle one of some numbers, of which there is one at least.
#[must_use]
pub fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
