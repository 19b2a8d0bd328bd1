//! Histograms of dimensions as bytes.

use super::{Reader, StateError, Stored, Writer};
use quasilux_sampling::DimensionHistogram;

impl Stored for DimensionHistogram {
    fn put(&self, out: &mut Writer) {
        out.u64(self.counts().len() as u64);
        self.counts().iter().for_each(|count| out.u64(*count));
        out.i128(self.coordinates().cast_signed());
        out.u32(self.largest());
    }

    fn merge_from(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        let counts: Result<Vec<u64>, StateError> =
            (0..from.length(size_of::<u64>())?).map(|_| from.u64()).collect();
        let (counts, coordinates) = (counts?, from.i128()?.cast_unsigned());
        let other = Self::from_counts(counts, coordinates, from.u32()?);
        let other = other.ok_or(StateError::Unfit("a histogram"))?;
        // Their sums then fit, too: no count of samples is larger.
        let all = self.samples().checked_add(other.samples());
        all.ok_or(StateError::Unfit("a histogram"))?;
        self.merge(&other);
        Ok(())
    }
}
