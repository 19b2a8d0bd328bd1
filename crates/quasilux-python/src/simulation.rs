//! Runs, begun and gone on with.

use crate::blocks::PythonWorkers;
use crate::error::from_command_line;
use crate::following::{self, Failure};
use crate::options::{ResumeOptions, RunOptions};
use crate::outcome::Outcome;
use crate::progress::{Line, Reporter};
use crate::scene::Scene;
use pyo3::prelude::*;
use quasilux::embedded::{self, Finished, Listener, Order, Project, ResumableRun};
use quasilux_transport::Control;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Adds the functions to the module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(simulate, module)?)?;
    module.add_function(wrap_pyfunction!(resume, module)?)
}

/// What comes of a run.
type Outcomes = Result<Finished, Failure>;

/// Simulates a scene. `callback` gets every
/// [`Progress`](crate::progress::Progress) and says whether to stop.
#[pyfunction]
#[pyo3(signature = (scene, options, callback=None, workers=None))]
fn simulate(
    py: Python<'_>,
    scene: &Bound<'_, Scene>,
    options: RunOptions,
    callback: Option<Py<PyAny>>,
    workers: Option<Py<PyAny>>,
) -> PyResult<Outcome> {
    let project = Arc::clone(&scene.get().project);
    let order = Order::new(&options.into()).map_err(|error| from_command_line(&error))?;
    let workers = workers.map(PythonWorkers::new);
    let run = move |project: &Project, listener: Listener<'_>| match workers {
        None => embedded::simulate(project, &order, Some(listener)).map_err(Failure::Refused),
        Some(workers) => with_workers(project, &order, listener, workers),
    };
    follow(py, project, callback, Box::new(run))
}

/// Goes on with a run that was kept, of the scene or of the project that it was begun with.
#[pyfunction]
#[pyo3(signature = (checkpoint, options, scene=None, callback=None))]
fn resume(
    py: Python<'_>,
    checkpoint: PathBuf,
    options: ResumeOptions,
    scene: Option<&Bound<'_, Scene>>,
    callback: Option<Py<PyAny>>,
) -> PyResult<Outcome> {
    let kept = py.detach(|| ResumableRun::read(&checkpoint, &options.into()));
    let kept = kept.map_err(|error| from_command_line(&error))?;
    let project = match scene {
        Some(scene) => Arc::clone(&scene.get().project),
        None => Scene::new(py.detach(|| Project::open(kept.project_file())))?.project,
    };
    let run = move |project: &Project, listener: Listener<'_>| {
        kept.go_on(project, Some(listener)).map_err(Failure::Refused)
    };
    follow(py, project, callback, Box::new(run))
}

fn with_workers(
    project: &Project,
    order: &Order,
    listener: Listener<'_>,
    mut workers: PythonWorkers,
) -> Outcomes {
    let done = embedded::simulate_with_workers(project, order, Some(listener), &mut workers);
    match workers.raised {
        Some(raised) => Err(Failure::Raised(raised)),
        None => done.map_err(Failure::Refused),
    }
}

/// A run in other words: what it is of, and who listens.
type Run = Box<dyn FnOnce(&Project, Listener<'_>) -> Outcomes + Send>;

/// Starts a run on a thread of its own and waits for it.
fn follow(
    py: Python<'_>,
    project: Arc<Project>,
    callback: Option<Py<PyAny>>,
    run: Run,
) -> PyResult<Outcome> {
    let of_run = Arc::clone(&project);
    let finished = following::follow(py, callback, move |line: Line| {
        let stop = Arc::clone(&line.stop);
        let reporter = line.is_heard.then(|| Reporter::new(line, Arc::clone(&of_run)));
        run(&of_run, listener(stop, reporter))
    })?;
    Ok(Outcome::new(project, finished))
}

/// Stops the run when it is told to, and reports where somebody wants to know.
fn listener(stop: Arc<AtomicBool>, mut reporter: Option<Reporter>) -> Listener<'static> {
    Box::new(move |event| {
        if stop.load(Ordering::Relaxed) {
            return Control::Stop;
        }
        reporter.as_mut().map_or(Control::Continue, |reporter| reporter.tell(event))
    })
}
