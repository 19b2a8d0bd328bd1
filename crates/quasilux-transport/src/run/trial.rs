//! What must change nothing but the time, to be chosen: the ray kernel of a run, and, for the
//! photon trace by itself, how photons are taken.
//!
//! Public because benchmarks and the tests that compare stand outside the crate. The photon trace
//! has no checkpoints and no intervals: figures come from [`crate::simulate`].

pub use quasilux_bvh::SimdLevel;

pub use crate::context::{Step, Stopwatch};
pub use crate::photon::order::PhotonOrder;

use crate::context::Context;
use crate::control::watch::Watch;
use crate::estimator::photon_estimator::PhotonEstimator;
use crate::run::simulate::simulate_on;
use crate::settings::Settings;
use crate::spectrum::{Spectrum, is_grey};
use crate::stats::estimates::Estimates;
use quasilux_scene::{Rgb, Scene};
use std::ops::Range;

/// Counts of photons and rays that were traced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Traced {
    /// Photons.
    pub photons: u64,
    /// Their rays.
    pub rays: u64,
}

/// Photons on their order through one scene, seen by its sensors.
pub trait PhotonTrial: Send {
    /// Traces the photons of these indices in each replicate, on the threads of the rayon pool that
    /// the call is made in.
    fn trace(&mut self, order: PhotonOrder, indices: Range<u64>) -> Traced;

    /// Everything that the sensors counted so far.
    fn counters(&self) -> Vec<u64>;
}

/// Estimates of [`crate::simulate`] with a ray kernel of choice, one of [`SimdLevel::all`].
#[must_use]
pub fn simulate_with(simd: SimdLevel, scene: &Scene, settings: &Settings) -> Estimates {
    simulate_on(simd, scene, settings, &mut ())
}

/// Sets a scene up as the estimator `photon` does, and hands it to `measure`.
pub fn try_photons(
    scene: &Scene,
    settings: &Settings,
    stopwatch: Option<&dyn Stopwatch>,
    measure: impl FnOnce(&mut dyn PhotonTrial),
) {
    if is_grey(scene) {
        set_up::<f64>(scene, settings, stopwatch, measure);
    } else {
        set_up::<Rgb>(scene, settings, stopwatch, measure);
    }
}

fn set_up<S: Spectrum>(
    scene: &Scene,
    settings: &Settings,
    stopwatch: Option<&dyn Stopwatch>,
    measure: impl FnOnce(&mut dyn PhotonTrial),
) {
    let mut context = Context::<S>::new(scene, settings);
    context.stopwatch = stopwatch;
    measure(&mut PhotonEstimator::new(&context, scene, settings));
}

impl<S: Spectrum> PhotonTrial for PhotonEstimator<'_, S> {
    fn trace(&mut self, order: PhotonOrder, indices: Range<u64>) -> Traced {
        let counts = self.count(order, indices, &mut Watch::new(&mut ())).unwrap_or_default();
        Traced { photons: counts.emitted, rays: counts.rays }
    }

    fn counters(&self) -> Vec<u64> {
        Self::counters(self).collect()
    }
}
