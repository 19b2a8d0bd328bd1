//! What was found for a target in one replicate, as exact sums.

use crate::codec::Sums;
use crate::stats::tally::{Quantum, Sum};
use serde::{Deserialize, Serialize};
use std::ops::AddAssign;

/// Sums over the indices of one target in one replicate, in lx.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct TargetSums {
    /// Straight from the lights.
    pub(super) direct: Sum,
    /// All the rest.
    pub(super) indirect: Sum,
    /// The part of both that photons brought.
    pub(super) merged: Sum,
    /// By the number of bounces, the last all from there on; empty where terms are not listed.
    pub(super) terms: Box<[Sum]>,
}

impl TargetSums {
    pub(super) fn new(listed_terms: u32) -> Self {
        let terms = if listed_terms > 0 { listed_terms as usize + 1 } else { 0 };
        Self { terms: vec![Sum::default(); terms].into(), ..Self::default() }
    }

    /// Adds light that came by this many surfaces and panes.
    pub(super) fn add(&mut self, bounces: u32, lx: f64, quantum: Quantum) {
        let sum = if bounces == 0 { &mut self.direct } else { &mut self.indirect };
        sum.add(lx, quantum);
        if let Some(rest) = self.terms.len().checked_sub(1) {
            self.terms[rest.min(bounces as usize)].add(lx, quantum);
        }
    }

    /// Adds light that a photon brought.
    pub(super) fn add_merged(&mut self, bounces: u32, lx: f64, quantum: Quantum) {
        self.add(bounces, lx, quantum);
        self.merged.add(lx, quantum);
    }

    /// Contributions that are not in the sums.
    pub(super) fn invalid(&self) -> u64 {
        self.direct.invalid + self.indirect.invalid
    }
}

impl AddAssign<&Self> for TargetSums {
    fn add_assign(&mut self, other: &Self) {
        self.direct += other.direct;
        self.indirect += other.indirect;
        self.merged += other.merged;
        self.terms.iter_mut().zip(&other.terms).for_each(|(sum, more)| *sum += *more);
    }
}

impl Sums for TargetSums {
    fn checked_add(&mut self, other: &Self) -> Option<()> {
        self.direct.checked_add(&other.direct)?;
        self.indirect.checked_add(&other.indirect)?;
        self.merged.checked_add(&other.merged)?;
        let fits = self.terms.len() == other.terms.len();
        let mut terms = self.terms.iter_mut().zip(&other.terms);
        fits.then(|| terms.try_for_each(|(sum, more)| sum.checked_add(more)))?
    }
}
