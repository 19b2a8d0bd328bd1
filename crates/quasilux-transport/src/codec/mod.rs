//! What a run has summed so far, as bytes, for checkpoints and for parts of a run.
//!
//! All that grows with a run is integers, so the bytes of a run that was interrupted lead to the
//! same bits, and those of several index ranges add up to those of all of them, in any order. What
//! a run decides before its first sample (surveys, pilots, frozen maps) is a function of scene and
//! settings: it is made again, and only a digest of it is kept, so that a difference is refused and
//! not silently wrong.
//!
//! Points that are done have ended with fewer samples than others: which ones, and with how many,
//! is in a state, and the checkpoints that the next prediction is made from. Parts have no such
//! points.
//!
//! Numbers are little-endian; lists have their lengths before them. `docs/formats.md` has the
//! whole.

mod histogram;
mod reader;
mod writer;

pub use reader::StateError;

pub(crate) use reader::Reader;
pub(crate) use writer::Writer;

use sha2::{Digest, Sha256};

/// The digest of what `put` puts out.
pub(crate) fn digest(put: impl FnOnce(&mut Writer)) -> [u8; 32] {
    let mut out = Writer::default();
    put(&mut out);
    Sha256::digest(out.finish()).into()
}

/// What grows with the indices of a run.
pub(crate) trait Stored {
    /// Puts it out.
    fn put(&self, out: &mut Writer);

    /// Adds what was put out. What it is added to has the same shape, and may be half changed after
    /// an error.
    fn merge_from(&mut self, from: &mut Reader<'_>) -> Result<(), StateError>;
}

/// The same number of things on both sides, each added to its like.
impl<T: Stored> Stored for [T] {
    fn put(&self, out: &mut Writer) {
        out.u64(self.len() as u64);
        self.iter().for_each(|thing| thing.put(out));
    }

    fn merge_from(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        from.expect_length(self.len())?;
        self.iter_mut().try_for_each(|thing| thing.merge_from(from))
    }
}
