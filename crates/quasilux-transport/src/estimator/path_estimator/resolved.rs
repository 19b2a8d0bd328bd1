//! Whether a target's replicates can tell its error: paths that met no light, or no bright part of
//! a lobe, cannot.

use super::PathEstimator;
use crate::path::lobes::LobeSums;
use crate::spectrum::Spectrum;

impl<S: Spectrum> PathEstimator<'_, S> {
    /// Whether too few paths of each target were where narrow lobes are bright.
    pub(super) fn missed_lobes(&self) -> Vec<bool> {
        let own = self.sums.chunks_exact(self.replicates as usize).enumerate();
        own.map(|(target, own)| {
            let mut lobes = LobeSums::default();
            own.iter().for_each(|sums| lobes += &sums.lobes);
            let paths = self.samples_of(target) * u64::from(self.replicates);
            let value_lx = self.moment(target, paths).all_lx.unwrap_or_default();
            lobes.are_missed(self.quantum, paths, value_lx)
        })
        .collect()
    }

    /// Whether the paths of each target found light where they came to surfaces that reflect, and
    /// met lobes.
    pub(super) fn resolved(&self, missed_lobes: &[bool]) -> Vec<bool> {
        self.sums
            .chunks_exact(self.replicates as usize)
            .zip(&self.samples_direct)
            .enumerate()
            .map(|(target, (own, samples_direct))| {
                let found_direct = own.iter().any(|sums| !sums.direct.is_zero());
                let found_indirect = own.iter().any(|sums| !sums.indirect.is_zero())
                    || self
                        .light_vertices
                        .as_ref()
                        .is_some_and(|light_vertices| light_vertices.found(target));
                let reflected = own.iter().any(|sums| sums.reflected > 0);
                !missed_lobes[target]
                    && (found_indirect || !reflected)
                    && (found_direct || found_indirect || !samples_direct)
            })
            .collect()
    }
}
