//! Runs whose photons and paths are traced by other processes.

use super::run::{Order, perform};
use crate::build::{BUILD, VERSION};
use crate::commands::{Finished, count, pool};
use crate::digest::sha256_hex;
use crate::exit::CliError;
use crate::project::{self, Project};
use crate::watcher::{Listener, Watcher};
use quasilux_report::json;
use quasilux_transport::{BlockTracer, PreparedScene, Workers};

/// Simulates a project as [`super::simulate`] does, to the same bits, and has workers trace blocks
/// of the run.
///
/// # Errors
/// As there, and when the workers fail.
pub fn simulate_with_workers(
    project: &Project,
    order: &Order,
    listener: Option<Listener<'_>>,
    workers: &mut (dyn Workers + Send),
) -> Result<Finished, CliError> {
    let settings = project::settings(project, &order.simulation)?;
    let simulate = |prepared: &PreparedScene<'_>, watcher: &mut Watcher<'_>| {
        let scene = prepared.clone();
        quasilux_transport::simulate_with_workers(scene, &settings, None, watcher, workers)
            .map_err(CliError::new)
    };
    perform(project, &settings, order, listener, Box::new(simulate))
}

/// SHA-256 of all that the blocks of a run depend on: the program, the scene and the settings.
///
/// # Errors
/// When the options make no sense for the scene.
pub fn identify_run(project: &Project, order: &Order) -> Result<String, CliError> {
    let settings = project::settings(project, &order.simulation)?;
    let content = (VERSION, BUILD, &project.identity.sha256, &settings);
    Ok(sha256_hex(json::text(&content).as_bytes()))
}

/// Makes a project ready for tracing blocks of a run with these options, surveys and pilots
/// included, and lets `work` do so on as many threads as they say.
///
/// # Errors
/// When the options make no sense for the scene, and when there are no threads.
pub fn trace_blocks<T: Send>(
    project: &Project,
    order: &Order,
    work: impl FnOnce(&mut BlockTracer<'_>) -> T + Send,
) -> Result<T, CliError> {
    let settings = project::settings(project, &order.simulation)?;
    let scene = &project.loaded.scene;
    let trace = || quasilux_transport::trace_blocks(scene, &settings, work);
    Ok(pool(count(order.simulation.threads))?.install(trace))
}
