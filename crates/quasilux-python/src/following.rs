//! Work on a thread of its own, while the caller's waits for news, calls back and hears Ctrl-C.

use crate::error::from_command_line;
use crate::progress::{Line, News, answer};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use quasilux::embedded::CliError;
use quasilux_transport::Control;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

/// How long Ctrl-C may go unheard.
const TICK: Duration = Duration::from_millis(50);

/// Why work has no results.
pub(crate) enum Failure {
    /// Its options or its scene make no sense.
    Refused(CliError),
    /// Its workers failed.
    Raised(PyErr),
}

/// Does work on a thread of its own and waits for it.
pub(crate) fn follow<T: Send + 'static>(
    py: Python<'_>,
    callback: Option<Py<PyAny>>,
    work: impl FnOnce(Line) -> Result<T, Failure> + Send + 'static,
) -> PyResult<T> {
    let (news, from_worker) = channel();
    let (answers, to_worker) = channel();
    let stop = Arc::new(AtomicBool::new(false));
    // It lives as long as the thread: when it is gone there are results.
    let alive = news.clone();
    let line =
        Line { news, answers: to_worker, stop: Arc::clone(&stop), is_heard: callback.is_some() };
    let thread = std::thread::Builder::new().name("quasilux".to_owned()).spawn(move || {
        let done = work(line);
        drop(alive);
        done
    });
    let thread = thread.map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
    let waiting = Waiting { from_worker: Mutex::new(from_worker), answers, stop, callback };
    waiting.wait(py, thread)
}

/// The caller's end.
struct Waiting {
    from_worker: Mutex<Receiver<News>>,
    answers: Sender<Control>,
    stop: Arc<AtomicBool>,
    callback: Option<Py<PyAny>>,
}

impl Waiting {
    /// Waits for the end of the work. What the callback raises, and Ctrl-C, stop it and are raised
    /// at its end; the second Ctrl-C at once, and the work ends by itself.
    fn wait<T: Send>(self, py: Python<'_>, thread: JoinHandle<Result<T, Failure>>) -> PyResult<T> {
        let mut raised: Option<PyErr> = None;
        loop {
            let news = py.detach(|| {
                let from_worker = self.from_worker.lock().unwrap_or_else(PoisonError::into_inner);
                from_worker.recv_timeout(TICK)
            });
            match news {
                Ok(news) if raised.is_none() => {
                    raised = self.call_back(py, news).err();
                }
                Ok(_) => _ = self.answers.send(Control::Stop),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => match py.detach(|| thread.join()) {
                    Err(panic) => std::panic::resume_unwind(panic),
                    Ok(done) => return raised.map_or_else(|| result(done), Err),
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

    /// Passes news on, and an answer back where the worker waits for one.
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

fn result<T>(done: Result<T, Failure>) -> PyResult<T> {
    done.map_err(|failure| match failure {
        Failure::Refused(error) => from_command_line(&error),
        Failure::Raised(error) => error,
    })
}
