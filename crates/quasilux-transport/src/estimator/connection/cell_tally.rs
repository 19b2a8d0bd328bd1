//! Tally of exitant flux by survey cell: the coarse level of the two-level estimator.

use super::ConnectionPlan;
use super::cell_transfer::{CLASSES, CellTransfer};
use super::exitant_flux::{CellFlux, ExitantFlux};
use super::lock;
use crate::codec::{Reader, StateError, Stored, Writer};
use crate::context::{Context, Stream};
use crate::photon::batch::{PhotonBatch, trace_photons};
use crate::photon::counts::PhotonCounts;
use crate::photon::order::PhotonOrder;
use crate::photon::receiver::{PhotonReceiver, ReceiverCounts, SeenPhoton};
use crate::spectrum::Spectrum;
use crate::stats::tally::{Quantum, Sum};
use crate::stats::watch::Watch;
use crate::world::Interaction;
use std::ops::Range;
use std::sync::Mutex;

/// What leaves each cell of the survey, in all replicates.
pub(super) struct CellTally {
    /// Light of 0, 1, .. bounces before it landed, the last all from there on; straight light is
    /// always told apart.
    slots: usize,
    terms: usize,
    quantum: Quantum,
    cells: usize,
    /// By replicate; of cell c from `c * slots` on, in lm/sr.
    sums: Vec<Mutex<Vec<Sum>>>,
    /// By replicate, for a photon: of class k of all terms together from cell c at `k * cells + c`,
    /// then the same of each term.
    means_lm_sr: Vec<Vec<f64>>,
    replicates: Range<u32>,
}

impl CellTally {
    pub(super) fn new(
        cells: usize,
        terms: usize,
        quantum: Quantum,
        replicates: Range<u32>,
    ) -> Self {
        let slots = terms.max(2);
        let zeros = |_| Mutex::new(vec![Sum::default(); cells * slots]);
        let sums = replicates.clone().map(zeros).collect();
        let means_lm_sr = vec![Vec::new(); replicates.len()];
        Self { slots, terms, quantum, cells, sums, means_lm_sr, replicates }
    }

    /// Adds these photons in each replicate; `None` when the observer stopped it.
    pub(super) fn grow<S: Spectrum>(
        &self,
        context: &Context<'_, S>,
        connection: &ConnectionPlan,
        photons: Range<u64>,
        watch: &mut Watch<'_>,
    ) -> Option<PhotonCounts> {
        let receiver = |r: u32| {
            let sums = &self.sums[(r - self.replicates.start) as usize];
            let own = vec![Sum::default(); self.cells * self.slots];
            CellReceiver {
                context,
                connection,
                slots: self.slots,
                quantum: self.quantum,
                sums,
                own,
            }
        };
        let batch = PhotonBatch {
            stream: Stream::CellPhotons,
            replicates: self.replicates.clone(),
            indices: photons,
            order: PhotonOrder::CoherentWaves,
            lead: connection.lead(),
        };
        trace_photons(context, &batch, receiver, watch)
    }

    /// Forgets all photons.
    pub(super) fn clear(&self) {
        self.sums.iter().for_each(|sums| lock(sums).fill(Sum::default()));
    }

    /// Declares the sums complete up to this number of photons in each replicate.
    pub(super) fn freeze_converged(&mut self, photons: u64) {
        let means_of = |sums: &Mutex<Vec<Sum>>| self.means_of(&lock(sums), photons.max(1) as f64);
        self.means_lm_sr = self.sums.iter().map(means_of).collect();
    }

    fn means_of(&self, sums: &[Sum], photons: f64) -> Vec<f64> {
        // Quanta first, so that listing terms changes no bit.
        let mut totals = vec![Sum::default(); (1 + self.terms) * CLASSES * self.cells];
        for (cell, sums) in sums.chunks_exact(self.slots).enumerate() {
            for (slot, sum) in sums.iter().enumerate() {
                let (term, class) = ((slot + 1).min(self.terms - 1), usize::from(slot > 0));
                for part in [0, 1 + term] {
                    totals[(part * CLASSES + class) * self.cells + cell] += *sum;
                }
            }
        }
        totals.into_iter().map(|sum| self.quantum.value(sum) / photons).collect()
    }

    /// What all targets of a transfer got in one replicate, in lx: each of all terms of the Neumann
    /// series together, then each of the first term, and so on.
    pub(super) fn lx(&self, replicate: usize, transfer: &CellTransfer) -> Vec<f64> {
        let targets = transfer.targets();
        let mut lx = vec![0.0; (1 + self.terms) * targets];
        let mut of_class = vec![0.0; targets];
        let means = self.means_lm_sr[replicate].chunks_exact(self.cells.max(1));
        for (row, means_lm_sr) in means.enumerate() {
            let (part, class) = (row / CLASSES, row % CLASSES);
            of_class.fill(0.0);
            for (cell, lm_sr) in means_lm_sr.iter().enumerate().filter(|(_, lm_sr)| **lm_sr != 0.0)
            {
                let seen = transfer.of_cell(cell, class == 0);
                let sums = of_class.iter_mut().zip(seen);
                sums.for_each(|(sum, lx_sr_lm)| *sum += lm_sr * f64::from(*lx_sr_lm));
            }
            let sums = lx[part * targets..].iter_mut().zip(&of_class);
            sums.for_each(|(sum, of_class)| *sum += of_class);
        }
        lx
    }

    pub(super) fn sum_count(&self) -> usize {
        self.sums.len() * self.cells * self.slots
    }

    /// Contributions that are not in the sums.
    pub(super) fn invalid(&self) -> u64 {
        self.sums.iter().flat_map(|sums| lock(sums).clone()).map(|sum| sum.invalid).sum()
    }
}

impl Stored for CellTally {
    fn put(&self, out: &mut Writer) {
        self.sums.iter().for_each(|sums| lock(sums).as_slice().put(out));
    }

    fn merge_from(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        self.sums.iter().try_for_each(|sums| lock(sums).as_mut_slice().merge_from(from))
    }
}

/// Counts the photons of one wave.
struct CellReceiver<'a, S> {
    context: &'a Context<'a, S>,
    connection: &'a ConnectionPlan,
    slots: usize,
    quantum: Quantum,
    /// Where what this wave found is added in the end.
    sums: &'a Mutex<Vec<Sum>>,
    own: Vec<Sum>,
}

impl<S: Spectrum> PhotonReceiver<S> for CellReceiver<'_, S> {
    fn landing(&mut self, at: &Interaction, photon: &SeenPhoton<S>) {
        let &SeenPhoton { weight, bounces, .. } = photon;
        let leaving = ExitantFlux::new(self.context, self.connection, at, weight, bounces);
        let Some(leaving) = leaving else { return };
        let slot = (bounces as usize).min(self.slots - 1);
        for side in leaving.sides {
            for CellFlux { cell, lm_sr } in side.by_cell() {
                self.own[cell * self.slots + slot].add(lm_sr, self.quantum);
            }
        }
    }

    fn finish(self) -> ReceiverCounts {
        let mut sums = lock(self.sums);
        sums.iter_mut().zip(self.own).for_each(|(sum, own)| *sum += own);
        ReceiverCounts::default()
    }
}
