//! Mutation of files, for robustness tests of parsers.
//!
//! A damaged file is a pure function of its number and of the undamaged files, the seeds, so that a
//! finding is told by a number.

mod mutator;
mod random;

pub use mutator::mutate;
pub use random::SplitMix64;

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

/// Calls `examine` with damaged file number `index`, and names the file where that panics.
///
/// # Panics
/// Where `examine` panics.
pub fn examine_damaged<T>(
    seeds: &Seeds,
    index: u64,
    examine: impl Fn(&[u8]) -> T + std::panic::RefUnwindSafe,
) -> T {
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
