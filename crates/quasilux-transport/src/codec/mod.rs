//! What a run has summed so far, as bytes in the postcard format, for checkpoints and for parts of
//! a run. Here are the bytes alone: the order of a state is made in `run::simulate`,
//! `control::watch` and by each estimator.
//!
//! All that grows with a run is integers, so the bytes of a run that was interrupted lead to the
//! same bits, and the sums of several index ranges add up to those of all of them, in any order.
//! What a run decides before its first sample (surveys, pilots) is a function of scene and
//! settings: it is computed again, and only a digest of it is stored, so that a difference is
//! refused and not silently wrong.
//!
//! Converged targets have ended with fewer samples than others: which ones, and with how many, is
//! part of a state, and so are the checkpoints that the next prediction is made from. Parts have no
//! converged targets.
//!
//! Bytes of any origin give values or an error: a claimed length takes no memory before this many
//! bytes are there (serde allocates at most 1 MiB ahead of the elements that it reads).
//! `docs/formats.md` describes the whole.

pub(crate) mod histogram;
mod reader;
mod writer;

pub use reader::StateError;

pub(crate) use reader::Reader;
pub(crate) use writer::Writer;

use serde::Serialize;
use serde::de::DeserializeOwned;
use sha2::{Digest, Sha256};

/// The digest of everything that `put` writes.
pub(crate) fn digest(put: impl FnOnce(&mut Writer)) -> [u8; 32] {
    let mut out = Writer::default();
    put(&mut out);
    Sha256::digest(out.finish()).into()
}

/// State that grows with the indices of a run.
pub(crate) trait Stored {
    /// Writes it.
    fn put(&self, out: &mut Writer);

    /// Adds a stored state of the same shape. `self` may be half changed after an error.
    fn merge_from(&mut self, from: &mut Reader<'_>) -> Result<(), StateError>;
}

/// Integer sums that are stored as a whole.
pub(crate) trait Sums: Serialize + DeserializeOwned {
    /// Adds each field; `None` where a sum overflows or shapes differ, with `self` half changed.
    fn checked_add(&mut self, other: &Self) -> Option<()>;
}

impl<T: Sums> Stored for T {
    fn put(&self, out: &mut Writer) {
        out.value(self);
    }

    fn merge_from(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        let other = from.value()?;
        self.checked_add(&other).ok_or(StateError::Unfit("a sum"))
    }
}

/// Adds a count to another; `None` where the sum overflows.
pub(crate) fn add_count(sum: &mut u64, more: u64) -> Option<()> {
    *sum = sum.checked_add(more)?;
    Some(())
}

/// Adds a number of quanta to another; `None` where the sum overflows.
pub(crate) fn add_quanta(sum: &mut i64, more: i64) -> Option<()> {
    *sum = sum.checked_add(more)?;
    Some(())
}

/// Lists of equal length on both sides, added element by element.
impl<T: Stored> Stored for [T] {
    fn put(&self, out: &mut Writer) {
        out.value(&self.len());
        self.iter().for_each(|element| element.put(out));
    }

    fn merge_from(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        from.expect_length(self.len())?;
        self.iter_mut().try_for_each(|element| element.merge_from(from))
    }
}
