//! The counts of a run: what was traced, and what came of it.

use super::{Reader, StateError, Stored, Writer};
use crate::path::sections::{PathSums, WorkCounts};
use crate::photon::trace::PhotonCounts;
use crate::stats::tally::Sum;
use quasilux_sampling::DimensionHistogram;

impl Stored for DimensionHistogram {
    fn put(&self, out: &mut Writer) {
        out.u64(self.counts().len() as u64);
        self.counts().iter().for_each(|count| out.u64(*count));
        out.i128(self.coordinates().cast_signed());
        out.u32(self.largest());
    }

    fn take_in(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
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

impl Stored for WorkCounts {
    fn put(&self, out: &mut Writer) {
        let Self { paths, rays, dimensions, endless } = self;
        [paths, rays, endless].into_iter().for_each(|count| out.u64(*count));
        dimensions.put(out);
    }

    fn take_in(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        let Self { paths, rays, dimensions, endless } = self;
        [paths, rays, endless].into_iter().try_for_each(|count| from.add_u64(count))?;
        dimensions.take_in(from)
    }
}

impl Stored for PhotonCounts {
    fn put(&self, out: &mut Writer) {
        let Self {
            emitted,
            begun,
            absorbed,
            lost,
            cut,
            endless,
            trapped,
            rays,
            joins,
            events,
            dimensions,
        } = self;
        [emitted, begun, endless, trapped, rays, joins, events]
            .into_iter()
            .for_each(|count| out.u64(*count));
        [absorbed, lost, cut].into_iter().for_each(|quanta| out.i64(*quanta));
        dimensions.put(out);
    }

    fn take_in(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        let Self {
            emitted,
            begun,
            absorbed,
            lost,
            cut,
            endless,
            trapped,
            rays,
            joins,
            events,
            dimensions,
        } = self;
        let counts = [emitted, begun, endless, trapped, rays, joins, events];
        counts.into_iter().try_for_each(|count| from.add_u64(count))?;
        [absorbed, lost, cut].into_iter().try_for_each(|quanta| from.add_i64(quanta))?;
        dimensions.take_in(from)
    }
}

impl Stored for PathSums {
    fn put(&self, out: &mut Writer) {
        let Self { direct, indirect, terms, reflected, lobes } = self;
        direct.put(out);
        indirect.put(out);
        out.u64(*reflected);
        lobes.put(out);
        terms.as_slice().put(out);
    }

    fn take_in(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        let Self { direct, indirect, terms, reflected, lobes } = self;
        direct.take_in(from)?;
        indirect.take_in(from)?;
        from.add_u64(reflected)?;
        lobes.take_in(from)?;
        let listed = from.length(Sum::BYTES)?;
        if terms.is_empty() {
            // Before its first path a target has none.
            terms.resize(listed, Sum::default());
        }
        if listed != 0 && listed != terms.len() {
            return Err(StateError::Unfit("a list of terms"));
        }
        terms.iter_mut().take(listed).try_for_each(|term| term.take_in(from))
    }
}
