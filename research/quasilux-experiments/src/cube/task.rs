//! The places of a comparison with their true illuminances, and the length of its runs.

use super::scene::Places;
use super::truth::Truth;
use std::time::Duration;

/// What is measured, and how long.
#[derive(Clone)]
pub(super) struct Task {
    pub(super) places: Places,
    /// Of each of them, in lx.
    pub(super) truth_lx: Vec<f64>,
    pub(super) replicates: u32,
    pub(super) seed: u64,
    /// The largest N.
    pub(super) most: u64,
    /// A run ends at the last checkpoint that can be expected within this.
    pub(super) limit: Option<Duration>,
}

impl Task {
    /// The task at all places or some, with the truth there.
    pub(super) fn at(places: Places, truth: &Truth) -> Self {
        let of_class: Vec<f64> =
            (0..6).map(|class| truth.illuminance_lx(super::scene::inset(class))).collect();
        let truth_lx = places.iter().map(|place| of_class[place.class]).collect();
        Self { places, truth_lx, replicates: 32, seed: 0, most: u64::MAX, limit: None }
    }
}
