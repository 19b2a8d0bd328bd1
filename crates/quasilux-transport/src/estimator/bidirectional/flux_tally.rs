//! Where the flux of light subpaths went.

use crate::codec::Sums;
use crate::lights::Lights;
use crate::stats::estimates::FluxBalance;
use crate::stats::tally::{Quantum, Sum};
use serde::{Deserialize, Serialize};
use std::ops::AddAssign;

/// Flux of light subpaths, in luminance, each as if it were the only one.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct FluxTally {
    emitted: Sum,
    /// Less what goes on from surfaces.
    absorbed: Sum,
    lost: Sum,
    cut: Sum,
}

impl FluxTally {
    pub(super) fn emit(&mut self, lm: f64, quantum: Quantum) {
        self.emitted.add_signed(lm, quantum);
    }

    /// It came to a surface.
    pub(super) fn absorb(&mut self, lm: f64, quantum: Quantum) {
        self.absorbed.add_signed(lm, quantum);
    }

    /// It goes on from there.
    pub(super) fn leave(&mut self, lm: f64, quantum: Quantum) {
        self.absorbed.add_signed(-lm, quantum);
    }

    pub(super) fn lose(&mut self, lm: f64, quantum: Quantum) {
        self.lost.add_signed(lm, quantum);
    }

    /// It would go on from a surface, were one more wanted.
    pub(super) fn cut(&mut self, lm: f64, quantum: Quantum) {
        self.leave(lm, quantum);
        self.cut.add_signed(lm, quantum);
    }

    /// The shares of what lamps emit; of this many subpaths what they found where light comes from
    /// outside, which is drawn more or less evenly.
    pub(super) fn balance(
        &self,
        lights: &Lights<'_>,
        subpaths: u64,
        quantum: Quantum,
    ) -> FluxBalance {
        let [emitted, absorbed, lost, cut] =
            [self.emitted, self.absorbed, self.lost, self.cut].map(|sum| quantum.value(sum));
        let of_lamps = || lights.flux_lm / emitted;
        let lm = match lights.ways_in() {
            _ if emitted == 0.0 => 0.0,
            None => of_lamps(),
            Some(_) => (subpaths as f64).recip(),
        };
        FluxBalance {
            emitted_lm: emitted * lm,
            absorbed_lm: absorbed * lm,
            lost_lm: lost * lm,
            cut_lm: cut * lm,
        }
    }
}

impl AddAssign<&Self> for FluxTally {
    fn add_assign(&mut self, other: &Self) {
        self.emitted += other.emitted;
        self.absorbed += other.absorbed;
        self.lost += other.lost;
        self.cut += other.cut;
    }
}

impl Sums for FluxTally {
    fn checked_add(&mut self, other: &Self) -> Option<()> {
        self.emitted.checked_add(&other.emitted)?;
        self.absorbed.checked_add(&other.absorbed)?;
        self.lost.checked_add(&other.lost)?;
        self.cut.checked_add(&other.cut)
    }
}
