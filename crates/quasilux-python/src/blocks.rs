//! Blocks of a run in several processes: the end that asks for them, and the one that traces them.

use crate::error::{from_command_line, input_error};
use crate::options::RunOptions;
use crate::scene::Scene;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use pyo3::types::{PyBytes, PyIterator, PyList};
use quasilux::embedded::{self, Order, Project, Source, trace_blocks};
use quasilux_transport::{BlockTracer as Tracer, Received, StateError as BadState, Workers};
use std::ops::Range;
use std::sync::Mutex;
use std::sync::mpsc::{Receiver, Sender, channel};

pyo3::create_exception!(
    _native,
    StateError,
    PyValueError,
    "A block of another run, or one that a tracer has gone past."
);

/// Adds what is here to the module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("StateError", module.py().get_type::<StateError>())?;
    module.add_function(wrap_pyfunction!(identify_run, module)?)?;
    module.add_class::<BlockTracer>()
}

/// SHA-256 of all that the blocks of a run depend on.
#[pyfunction]
fn identify_run(scene: &Bound<'_, Scene>, options: RunOptions) -> PyResult<String> {
    let order = Order::new(&options.into()).map_err(|error| from_command_line(&error))?;
    let identified = embedded::identify_run(&scene.get().project, &order);
    identified.map_err(|error| from_command_line(&error))
}

/// A block, and where what comes of it goes.
struct Task {
    frame: Vec<u8>,
    block: Range<u64>,
    answer: Sender<Result<Vec<u8>, BadState>>,
}

/// A scene ready for tracing blocks of one run, on a thread of its own that lives as long as it.
#[pyclass(frozen, module = "quasilux._native")]
pub(crate) struct BlockTracer {
    tasks: Mutex<Sender<Task>>,
}

#[pymethods]
impl BlockTracer {
    /// Of a scene in bytes, with the options of a run, and what identifies the run where it was
    /// begun.
    #[new]
    #[pyo3(signature = (bundle, options, run))]
    fn new(
        py: Python<'_>,
        bundle: PyBackedBytes,
        options: RunOptions,
        run: &str,
    ) -> PyResult<Self> {
        let (tasks, queue) = channel();
        let (ready, is_ready) = channel();
        py.detach(move || {
            let source = Source::from_bundle(&bundle).map_err(|error| from_command_line(&error))?;
            let project = Project::load(source).map_err(|error| from_command_line(&error))?;
            let order = Order::new(&options.into()).map_err(|error| from_command_line(&error))?;
            let own = embedded::identify_run(&project, &order);
            if own.map_err(|error| from_command_line(&error))? != run {
                let message = "this process has another build of quasilux than the one that asks";
                return Err(PyRuntimeError::new_err(message));
            }
            std::thread::Builder::new()
                .name("quasilux blocks".to_owned())
                .spawn(move || serve(&project, &order, &ready, queue))
                .map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
            match is_ready.recv() {
                Ok(None) => Ok(()),
                Ok(Some(refusal)) => Err(input_error(refusal)),
                Err(_) => Err(PyRuntimeError::new_err("the scene was not made ready")),
            }
        })?;
        Ok(Self { tasks: Mutex::new(tasks) })
    }

    /// Traces the part `start` to `end` of the work in `frame`.
    fn trace<'py>(
        &self,
        py: Python<'py>,
        frame: PyBackedBytes,
        start: u64,
        end: u64,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let outcome = py.detach(|| {
            let (answer, answers) = channel();
            let task = Task { frame: frame.to_vec(), block: start..end, answer };
            let is_sent = self.tasks.lock().is_ok_and(|tasks| tasks.send(task).is_ok());
            is_sent.then(|| answers.recv().ok()).flatten()
        });
        match outcome {
            Some(Ok(bytes)) => Ok(PyBytes::new(py, &bytes)),
            Some(Err(error)) => Err(StateError::new_err(error.to_string())),
            None => Err(PyRuntimeError::new_err("the thread that traces blocks has ended")),
        }
    }
}

/// Says that it is ready, or why it is not, and does what comes until nobody asks any more.
fn serve(project: &Project, order: &Order, ready: &Sender<Option<String>>, queue: Receiver<Task>) {
    let work = |tracer: &mut Tracer<'_>| {
        let _ = ready.send(None);
        for Task { frame, block, answer } in queue {
            let _ = answer.send(tracer.trace(&frame, block));
        }
    };
    if let Err(error) = trace_blocks(project, order, work) {
        let _ = ready.send(Some(error.to_string()));
    }
}

/// Workers in Python: an object whose method `trace` takes a frame and a list of ranges, and
/// iterates over pairs of the number of a block and the bytes that came of it; about once a second
/// over `None`, where nothing comes.
pub(crate) struct PythonWorkers {
    object: Py<PyAny>,
    /// What was raised there, which ended the run.
    pub(crate) raised: Option<PyErr>,
}

impl PythonWorkers {
    pub(crate) fn new(object: Py<PyAny>) -> Self {
        Self { object, raised: None }
    }

    fn ask(
        &self,
        py: Python<'_>,
        frame: &[u8],
        blocks: &[Range<u64>],
        done: &mut dyn FnMut(Received<'_>) -> bool,
    ) -> PyResult<bool> {
        let ranges = blocks.iter().map(|block| (block.start, block.end));
        let arguments = (PyBytes::new(py, frame), PyList::new(py, ranges)?);
        let answers = self.object.bind(py).call_method1("trace", arguments)?;
        let answers: Bound<'_, PyIterator> = answers.try_iter()?;
        let mut missing = vec![true; blocks.len()];
        for answer in answers.clone() {
            let answer: Option<(usize, PyBackedBytes)> = answer?.extract()?;
            let goes_on = match answer {
                None => done(Received::Nothing),
                Some((number, bytes)) => {
                    if !missing.get(number).copied().unwrap_or(false) {
                        let message = format!("block {number} was not asked for");
                        return Err(PyValueError::new_err(message));
                    }
                    missing[number] = false;
                    done(Received::Block { number, bytes: &bytes })
                }
            };
            if !goes_on {
                // Lets a generator clean up behind itself.
                let _ = answers.call_method0("close");
                return Ok(true);
            }
        }
        Ok(!missing.contains(&true))
    }
}

impl Workers for PythonWorkers {
    fn trace(
        &mut self,
        frame: &[u8],
        blocks: &[Range<u64>],
        done: &mut dyn FnMut(Received<'_>) -> bool,
    ) -> bool {
        let asked = Python::attach(|py| self.ask(py, frame, blocks, done));
        asked.unwrap_or_else(|error| {
            self.raised = Some(error);
            false
        })
    }
}
