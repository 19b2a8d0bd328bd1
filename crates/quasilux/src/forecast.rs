//! What a run will take of the machine: the memory of the whole program.

use quasilux_scene::Scene;
use quasilux_transport::{EstimatorKind, MemoryNeed, Settings};

/// The program with small files in memory, and what a thread that traces paths, or photons too,
/// keeps at hand: measured on the examples (`docs/memory.md`).
const PROGRAM_BYTES: u64 = 18 << 20;
const PATH_THREAD_BYTES: u64 = 1 << 20;
const PHOTON_THREAD_BYTES: u64 = 4 << 20;

/// Who works on what, and what that takes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Forecast<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) settings: &'a Settings,
    pub(crate) threads: usize,
    need: MemoryNeed,
}

impl<'a> Forecast<'a> {
    pub(crate) fn new(scene: &'a Scene, settings: &'a Settings, threads: usize) -> Self {
        Self { scene, settings, threads, need: MemoryNeed::new(scene, settings) }
    }

    /// Memory of the program for a run of so many samples; for one of any number with `None`.
    pub(crate) fn bytes(&self, samples: Option<u64>) -> u64 {
        let thread_bytes = match self.settings.estimator {
            EstimatorKind::Path => PATH_THREAD_BYTES,
            EstimatorKind::Auto
            | EstimatorKind::Photon
            | EstimatorKind::Bidirectional
            | EstimatorKind::BidirectionalMap => PHOTON_THREAD_BYTES,
        };
        let program_bytes = PROGRAM_BYTES + self.threads as u64 * thread_bytes;
        self.need.total_bytes(samples).saturating_add(program_bytes)
    }
}
