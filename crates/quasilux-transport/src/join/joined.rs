//! What joined photons gave to all targets, in all replicates.

use super::Joining;
use super::receiver::{Group, JoinReceiver};
use crate::photon::{PhotonCounts, Source};
use crate::photons::{PhotonBatch, trace_photons};
use crate::spectrum::Spectrum;
use crate::stage::{Stage, Stream};
use crate::tally::{Quantum, Sum};
use crate::targets::Target;
use crate::trial::Way;
use crate::watch::Watch;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Targets that the same photons are joined to; others have photons of their own.
const GROUP: usize = 256;
/// Surfaces that photons leave for certain, with what absorption leaves of them: they are dear, and what
/// lands first is seldom seen by the sensors.
const CERTAIN_BOUNCES: u32 = 1;

/// Sums that grow with a run.
pub(crate) struct Joined {
    pub(crate) joining: Joining,
    targets: Vec<Target>,
    /// Illuminance to expect at each, in lx.
    expected_lx: Vec<f64>,
    /// Terms of the Neumann series that are told apart.
    terms: usize,
    quantum: Quantum,
    /// By group of targets and replicate; those of target t of a group from `t * terms` on.
    sums: Vec<Vec<Mutex<Vec<Sum>>>>,
    replicates: Range<u32>,
    /// Indices so far.
    samples: u64,
}

impl Joined {
    pub(crate) fn new(
        joining: Joining,
        targets: Vec<Target>,
        expected_lx: Vec<f64>,
        replicates: Range<u32>,
        (listed_terms, quantum): (u32, Quantum),
    ) -> Self {
        let terms = listed_terms as usize + 1;
        let of_group = |group: &[Target]| -> Vec<Mutex<Vec<Sum>>> {
            let zeros = || Mutex::new(vec![Sum::default(); group.len() * terms]);
            replicates.clone().map(|_| zeros()).collect()
        };
        let sums = targets.chunks(GROUP).map(of_group).collect();
        Self { joining, targets, expected_lx, terms, quantum, sums, replicates, samples: 0 }
    }

    /// Adds the photons that belong to the indices up to `samples`; `None` when the observer stopped it.
    pub(crate) fn grow<S: Spectrum>(
        &mut self,
        stage: &Stage<'_, S>,
        samples: u64,
        watch: &mut Watch<'_>,
    ) -> Option<PhotonCounts> {
        let photons = self.joining.photons;
        let mut counts = PhotonCounts::default();
        let chunks = self.targets.chunks(GROUP).zip(self.expected_lx.chunks(GROUP));
        for (number, ((targets, expected_lx), sums)) in (0..).zip(chunks.zip(&self.sums)) {
            let group = Group { targets, expected_lx, terms: self.terms };
            let receiver = |r: u32| {
                let points = stage.points(r, Stream::JoinedPlaces(number));
                let sums = &sums[(r - self.replicates.start) as usize];
                JoinReceiver::new(stage, &self.joining, group, (points, self.quantum), sums)
            };
            let batch = PhotonBatch {
                stream: Stream::JoinedPhotons(number),
                replicates: self.replicates.clone(),
                indices: self.samples * photons..samples * photons,
                way: Way::CoherentWaves,
                source: Source::Lights,
                windows: self.joining.windows.as_ref(),
                certain_bounces: CERTAIN_BOUNCES,
            };
            counts += trace_photons(stage, &batch, receiver, watch)?;
        }
        self.samples = samples;
        Some(counts)
    }

    /// What a target got in one replicate, in lx.
    pub(crate) fn lx(&self, replicate: usize, target: usize) -> f64 {
        // Quanta first, so that listing terms changes no bit.
        let mut sum = Sum::default();
        (0..self.terms).for_each(|term| sum += self.sum(replicate, target, term));
        self.value_lx(sum)
    }

    /// What it got of one term of the Neumann series; of the last, of all that follow too.
    pub(crate) fn term_lx(&self, replicate: usize, target: usize, term: usize) -> f64 {
        self.value_lx(self.sum(replicate, target, term))
    }

    /// What a sum means so far.
    fn value_lx(&self, sum: Sum) -> f64 {
        let photons = (self.samples * self.joining.photons).max(1) as f64;
        self.quantum.value(sum) / photons
    }

    /// Whether any replicate found light of one term.
    pub(crate) fn found_term(&self, target: usize, term: usize) -> bool {
        let replicates = 0..self.replicates.len();
        replicates.into_iter().any(|r| !self.sum(r, target, term).is_zero())
    }

    /// Whether any replicate found light.
    pub(crate) fn found(&self, target: usize) -> bool {
        (0..self.terms).any(|term| self.found_term(target, term))
    }

    /// Contributions that are not in the sums.
    pub(crate) fn invalid(&self) -> u64 {
        let lists = self.sums.iter().flatten();
        lists.flat_map(|sums| lock(sums).clone()).map(|sum| sum.invalid).sum()
    }

    fn sum(&self, replicate: usize, target: usize, term: usize) -> Sum {
        lock(&self.sums[target / GROUP][replicate])[target % GROUP * self.terms + term]
    }
}

fn lock(sums: &Mutex<Vec<Sum>>) -> std::sync::MutexGuard<'_, Vec<Sum>> {
    sums.lock().unwrap_or_else(PoisonError::into_inner)
}
