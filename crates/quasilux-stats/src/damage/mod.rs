//! Mutation of files, for robustness tests of parsers.
//!
//! A damaged file is a pure function of its number and of the undamaged files, the seeds, so that a
//! finding is told by a number.

mod kinds;
mod mutator;

pub use kinds::{Kind, examine_kinds};
pub use mutator::mutate;

use crate::SplitMix64;
use std::ops::Range;
use std::panic::RefUnwindSafe;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;

/// Published files above this length are left out: most of the time would go into a few of them.
const MAX_SEED_BYTES: usize = 4000;

/// Undamaged files of one format.
#[derive(Clone, Debug)]
pub struct Seeds(Vec<Vec<u8>>);

impl Seeds {
    /// Files made up for the purpose.
    #[must_use]
    pub fn new(files: Vec<Vec<u8>>) -> Self {
        Self(files)
    }

    /// The same, with those of `files` that are no longer than 4000 bytes.
    #[must_use]
    pub fn with_files(mut self, files: impl IntoIterator<Item = Vec<u8>>) -> Self {
        self.0.extend(files);
        self.0.retain(|file| file.len() <= MAX_SEED_BYTES);
        self
    }

    /// The undamaged files.
    #[must_use]
    pub fn files(&self) -> &[Vec<u8>] {
        &self.0
    }

    /// Damaged file number `index`: one of the seeds after one to five changes.
    #[must_use]
    pub fn damaged(&self, index: u64) -> Vec<u8> {
        let mut random = SplitMix64::new(index);
        let mut bytes = self.0[random.below(self.0.len())].clone();
        for _ in 0..=random.below(5) {
            mutate(&mut bytes, &self.0, &mut random);
        }
        bytes
    }
}

/// What became of one file.
#[derive(Clone, Copy, Debug)]
pub struct Outcome {
    /// Whether it was read.
    pub is_read: bool,
    /// The most memory in bytes that was allocated at one time while reading.
    pub peak_bytes: usize,
}

/// What became of many files.
#[derive(Clone, Copy, Debug, Default)]
pub struct Outcomes {
    /// How many were read.
    pub read: u64,
    /// The most memory in bytes that was allocated at one time while reading one.
    pub max_bytes: usize,
}

impl Outcomes {
    fn add(&mut self, other: Self) {
        self.read += other.read;
        self.max_bytes = self.max_bytes.max(other.max_bytes);
    }
}

/// Calls `examine` with the damaged files of these numbers, on all processors, and names the file
/// where that panics.
///
/// # Panics
/// Where `examine` panics.
pub fn examine_damaged(
    seeds: &Seeds,
    indices: Range<u64>,
    examine: impl Fn(&[u8]) -> Outcome + RefUnwindSafe + Sync,
) -> Outcomes {
    let next = AtomicU64::new(indices.start);
    let work = || {
        let mut all = Outcomes::default();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            if index >= indices.end {
                return all;
            }
            let Outcome { is_read, peak_bytes } = examine_one(seeds, index, &examine);
            all.add(Outcomes { read: u64::from(is_read), max_bytes: peak_bytes });
        }
    };
    thread::scope(|scope| {
        let threads = thread::available_parallelism().map_or(1, usize::from);
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        let mut all = Outcomes::default();
        for worker in workers {
            all.add(worker.join().expect("no damaged file makes a reader panic"));
        }
        all
    })
}

fn examine_one<T>(seeds: &Seeds, index: u64, examine: impl Fn(&[u8]) -> T + RefUnwindSafe) -> T {
    let bytes = seeds.damaged(index);
    std::panic::catch_unwind(|| examine(&bytes)).unwrap_or_else(|_| {
        panic!("file {index}:\n{}", String::from_utf8_lossy(&bytes).escape_debug())
    })
}

/// Checks that a message names a position that a file of these bytes can have, and is bounded.
///
/// # Panics
/// Where it does not.
pub fn check_message(line: usize, column: usize, message: &str, bytes: &[u8]) {
    assert!(line > 0 && line <= bytes.len() + 1, "{message}");
    assert!(column > 0 && column <= bytes.len() + 1, "{message}");
    assert!(message.len() < 500, "{message}");
}
