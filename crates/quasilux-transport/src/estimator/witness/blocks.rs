//! Blocks of the witness's work: asked of workers, and traced for others.

use super::{BATCHES, Testimony, Witness};
use crate::codec::{Reader, StateError, Stored, Writer};
use crate::estimator::block::BlockFrame;
use crate::spectrum::Spectrum;
use crate::stats::tally::Sum;
use crate::stats::watch::{BlockCounts, Watch};
use crate::stats::workers::BlockSize;
use std::ops::Range;

/// Cost of a photon that is connected to one target after the other, in paths.
const CONNECTING: u64 = 4;

impl<S: Spectrum> Witness<'_, S> {
    /// Has workers trace these photons of each batch; `false` where there are none.
    pub(super) fn photons_by_workers(
        &mut self,
        indices: &Range<u64>,
        watch: &mut Watch<'_>,
    ) -> bool {
        let (paths, sums) = (CONNECTING * u64::from(BATCHES), self.photons.sums.len() as u64);
        let size = BlockSize { paths, sums };
        let blocks = watch.blocks(|| BlockFrame::WitnessPhotons, indices.clone(), size);
        let Some(blocks) = blocks else { return false };
        // Where workers fail the run has no result.
        let _ =
            watch.aside(|watch| watch.distribute(&blocks, &mut |from| self.photons.merge(from)));
        true
    }

    /// The same of paths.
    pub(super) fn paths_by_workers(&mut self, indices: &Range<u64>, watch: &mut Watch<'_>) -> bool {
        let each = self.targets.len() as u64 * u64::from(BATCHES);
        let size = BlockSize { paths: each, sums: each };
        let blocks = watch.blocks(|| BlockFrame::WitnessPaths, indices.clone(), size);
        let (Some(blocks), Some(paths)) = (blocks, &mut self.paths) else { return false };
        let _ = watch.aside(|watch| watch.distribute(&blocks, &mut |from| paths.merge(from)));
        true
    }

    /// Traces a block for another process; its own sums mean nothing from here on.
    pub(crate) fn trace_block(
        &mut self,
        frame: &BlockFrame,
        block: Range<u64>,
    ) -> Result<Vec<u8>, StateError> {
        let is_of_paths = match frame {
            BlockFrame::WitnessPhotons => false,
            BlockFrame::WitnessPaths if self.paths.is_some() => true,
            _ => return Err(StateError::Unfit("the kind of a block")),
        };
        if block.is_empty() || block.end > super::MAX_INDICES {
            return Err(StateError::Unfit("the range of a block"));
        }
        let testimonies = [&mut self.photons].into_iter().chain(&mut self.paths);
        testimonies.for_each(Testimony::clear);
        if is_of_paths {
            self.trace_paths(block);
        } else {
            self.trace_photons(block);
        }
        let traced = if is_of_paths { self.paths.as_ref() } else { None };
        let mut out = Writer::default();
        traced.unwrap_or(&self.photons).put(&mut out);
        Ok(out.finish())
    }
}

impl Testimony {
    fn clear(&mut self) {
        self.sums.fill(Sum::default());
        self.rays = 0;
    }

    fn put(&self, out: &mut Writer) {
        out.value(&self.rays);
        self.sums.as_slice().put(out);
    }

    fn merge(&mut self, from: &mut Reader<'_>) -> Result<BlockCounts, StateError> {
        let rays = from.value()?;
        self.rays = self.rays.checked_add(rays).ok_or(StateError::Unfit("a count"))?;
        self.sums.as_mut_slice().merge_from(from)?;
        Ok(BlockCounts { photons: 0, paths: 0, rays })
    }
}
