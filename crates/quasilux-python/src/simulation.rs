//! Runs: on a thread of their own, while the caller's waits for news, calls back and hears Ctrl-C.

use crate::blocks::PythonWorkers;
use crate::error::from_command_line;
use crate::outcome::{Failure, Outcome};
use crate::progress::{News, Reporter, answer};
use crate::scene::Scene;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use quasilux::embedded::{self, Finished, Listener, Order, Project, ResumableRun};
use quasilux_transport::Control;
use std::ffi::OsString;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

/// Adds the functions to the module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(simulate, module)?)?;
    module.add_function(wrap_pyfunction!(resume, module)?)
}

/// How long Ctrl-C may go unheard.
const TICK: Duration = Duration::from_millis(50);

/// What comes of a run.
type Outcomes = Result<Finished, Failure>;

/// Simulates a scene with options as on the command line. `callback` gets every
/// [`Progress`](crate::progress::Progress) and says whether to stop.
#[pyfunction]
#[pyo3(signature = (scene, options, callback=None, workers=None))]
fn simulate(
    py: Python<'_>,
    scene: &Bound<'_, Scene>,
    options: Vec<OsString>,
    callback: Option<Py<PyAny>>,
    workers: Option<Py<PyAny>>,
) -> PyResult<Outcome> {
    let project = Arc::clone(&scene.get().project);
    let order = Order::from_words(options).map_err(|error| from_command_line(&error))?;
    let stop = Arc::new(AtomicBool::new(false));
    let workers = workers.map(PythonWorkers::new);
    let run = move |project: &Project, listener: Listener<'_>| match workers {
        None => embedded::simulate(project, &order, Some(listener)).map_err(Failure::Refused),
        Some(workers) => with_workers(project, &order, listener, workers),
    };
    follow(py, project, callback, stop, Box::new(run))
}

/// Goes on with a run that was kept, of the scene or of the project that it was begun with.
#[pyfunction]
#[pyo3(signature = (checkpoint, options, scene=None, callback=None))]
fn resume(
    py: Python<'_>,
    checkpoint: PathBuf,
    options: Vec<OsString>,
    scene: Option<&Bound<'_, Scene>>,
    callback: Option<Py<PyAny>>,
) -> PyResult<Outcome> {
    let kept = py.detach(|| ResumableRun::read(&checkpoint, options));
    let kept = kept.map_err(|error| from_command_line(&error))?;
    let project = match scene {
        Some(scene) => Arc::clone(&scene.get().project),
        None => Scene::new(py.detach(|| Project::open(kept.project_file())))?.project,
    };
    let run = move |project: &Project, listener: Listener<'_>| {
        kept.go_on(project, Some(listener)).map_err(Failure::Refused)
    };
    follow(py, project, callback, Arc::default(), Box::new(run))
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
    stop: Arc<AtomicBool>,
    run: Run,
) -> PyResult<Outcome> {
    let (news, from_run) = channel();
    let (answers, to_run) = channel();
    let reporter =
        callback.is_some().then(|| Reporter::new(news.clone(), to_run, Arc::clone(&project)));
    let (told_to_stop, of_run) = (Arc::clone(&stop), Arc::clone(&project));
    let thread = std::thread::Builder::new().name("quasilux".to_owned()).spawn(move || {
        let finished = run(&of_run, listener(told_to_stop, reporter));
        // Nobody waits for a run that was abandoned.
        _ = news.send(News::Finished(Box::new(finished)));
    });
    let thread = thread.map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
    let waiting = Waiting { from_run: Mutex::new(from_run), answers, stop, callback };
    let finished = waiting.wait(py, thread)?;
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

/// The caller's side of a run.
struct Waiting {
    from_run: Mutex<Receiver<News>>,
    answers: Sender<Control>,
    stop: Arc<AtomicBool>,
    callback: Option<Py<PyAny>>,
}

impl Waiting {
    /// Waits for the end of the run. What the callback raises, and Ctrl-C, stop it and are raised
    /// at its end; the second Ctrl-C at once, and the run ends by itself.
    fn wait(self, py: Python<'_>, thread: JoinHandle<()>) -> PyResult<Finished> {
        let mut raised: Option<PyErr> = None;
        loop {
            let news = py.detach(|| {
                let from_run = self.from_run.lock().unwrap_or_else(PoisonError::into_inner);
                from_run.recv_timeout(TICK)
            });
            match news {
                Ok(News::Finished(outcome)) => {
                    _ = py.detach(|| thread.join());
                    return raised.map_or_else(|| result(*outcome), Err);
                }
                Ok(news) if raised.is_none() => {
                    raised = self.call_back(py, news).err();
                }
                Ok(_) => _ = self.answers.send(Control::Stop),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => match py.detach(|| thread.join()) {
                    Err(panic) => std::panic::resume_unwind(panic),
                    Ok(()) => return Err(PyRuntimeError::new_err("the run has no results")),
                },
            }
            if let Err(signal) = py.check_signals() {
                if raised.is_some() {
                    return Err(signal);
                }
                raised = Some(signal);
            }
            if raised.is_some() {
                self.stop.store(true, Ordering::Relaxed);
            }
        }
    }

    /// Passes news on, and an answer back where the run waits for one.
    fn call_back(&self, py: Python<'_>, news: News) -> PyResult<()> {
        let awaits_answer = matches!(news, News::Checkpoint(_));
        let control = match &self.callback {
            Some(callback) => answer(py, callback, news),
            None => Ok(Control::Continue),
        };
        if !matches!(control, Ok(Control::Continue)) {
            self.stop.store(true, Ordering::Relaxed);
        }
        if awaits_answer {
            _ = self.answers.send(*control.as_ref().unwrap_or(&Control::Stop));
        }
        control.map(|_| ())
    }
}

fn result(outcome: Outcomes) -> PyResult<Finished> {
    outcome.map_err(|failure| match failure {
        Failure::Refused(error) => from_command_line(&error),
        Failure::Raised(error) => error,
    })
}
