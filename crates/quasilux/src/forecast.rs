//! What a run will take of the machine: the memory of the whole program.

use crate::exit::CliError;
use crate::machine;
use quasilux_report::number::memory;
use quasilux_scene::{Loaded, Position, Scene};
use quasilux_transport::{EstimatorKind, MemoryNeed, Settings};

/// The program with small files and pictures in memory, and what a thread that traces paths, or
/// photons too, keeps at hand: measured on the examples (`docs/memory.md`).
const PROGRAM_BYTES: u64 = 26 << 20;
const PATH_THREAD_BYTES: u64 = 1 << 20;
const PHOTON_THREAD_BYTES: u64 = 4 << 20;
/// Of each byte of a project file while it is read: the most is gone before a run begins.
const READ_BYTES: u64 = 40;

/// Who works on what, and what that takes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Forecast<'a> {
    pub(crate) scene: &'a Scene,
    file_bytes: u64,
    pub(crate) settings: &'a Settings,
    pub(crate) threads: usize,
    need: MemoryNeed,
}

impl<'a> Forecast<'a> {
    pub(crate) fn new(loaded: &'a Loaded, settings: &'a Settings, threads: usize) -> Self {
        let Loaded { scene, places, .. } = loaded;
        let need = MemoryNeed::new(scene, settings);
        Self { scene, file_bytes: places.file_bytes, settings, threads, need }
    }

    /// Memory of the program for a run of this many samples; for one of any number with `None`.
    pub(crate) fn bytes(&self, samples: Option<u64>) -> u64 {
        let thread_bytes = match self.settings.estimator {
            EstimatorKind::Path => PATH_THREAD_BYTES,
            EstimatorKind::Auto
            | EstimatorKind::Photon
            | EstimatorKind::Bidirectional
            | EstimatorKind::BidirectionalMap => PHOTON_THREAD_BYTES,
        };
        let of_run = self.need.total_bytes(samples);
        let of_threads = self.threads as u64 * thread_bytes;
        let most = of_run.saturating_add(of_threads).max(READ_BYTES * self.file_bytes);
        most.saturating_add(PROGRAM_BYTES)
    }
}

/// Refuses a run for which there is not enough memory, by what takes the most of it.
///
/// # Errors
/// Then, with the place in the project file.
pub(crate) fn expect_memory(loaded: &Loaded, settings: &Settings) -> Result<(), CliError> {
    expect_bytes(loaded, settings, machine::available_bytes())
}

fn expect_bytes(loaded: &Loaded, settings: &Settings, available: u64) -> Result<(), CliError> {
    let bytes = Forecast::new(loaded, settings, 1).bytes(settings.max_samples);
    if bytes <= available {
        return Ok(());
    }
    let Greediest { what, place } = greediest(loaded, settings);
    let [needed, available] = [bytes, available].map(memory);
    let message = format!(
        "not enough memory: up to {needed} needed, mostly for {what}, and {available} available"
    );
    Err(CliError::in_file(&loaded.places.file, place, message))
}

/// What takes the most memory, and where the project file asks for it.
struct Greediest {
    what: String,
    place: Option<Position>,
}

fn greediest(loaded: &Loaded, settings: &Settings) -> Greediest {
    let Loaded { scene, places, simulation, .. } = loaded;
    let need = MemoryNeed::new(scene, settings);
    let maps_bytes = need.maps_bytes.saturating_add(need.map_tables_bytes);
    let others = [need.scene_bytes, need.sums_bytes, need.cells_bytes, need.pictures_bytes];
    if others.iter().all(|bytes| *bytes < maps_bytes) {
        let asked = simulation.map_elements.as_ref().map(|given| given.place);
        let asked = asked.or(simulation.map_element_m.as_ref().map(|given| given.place));
        let what = "illumination maps (lower map_elements)".to_owned();
        return Greediest { what, place: asked };
    }
    let sums_bytes = need.sums_bytes.max(need.cells_bytes);
    if sums_bytes >= need.scene_bytes.max(need.pictures_bytes) {
        let points: usize = scene.sensors.iter().map(quasilux_scene::Sensor::len).sum();
        let replicates = settings.effective_replicates();
        let what = format!("the sums of {points} sensor points in {replicates} replicates");
        let largest = scene.sensors.iter().zip(&places.sensors).max_by_key(|it| it.0.len());
        let largest = largest.map(|(_, place)| *place);
        let usual = Settings::default().replicates;
        let asked = simulation.replicates.as_ref().filter(|given| given.value > usual);
        return Greediest { what, place: asked.map(|given| given.place).or(largest) };
    }
    if need.scene_bytes >= need.pictures_bytes {
        let what = format!("{} triangles", scene.mesh.triangles.len());
        return Greediest { what, place: Some(places.scene) };
    }
    Greediest { what: "the pictures".to_owned(), place: places.cameras.first().copied() }
}
